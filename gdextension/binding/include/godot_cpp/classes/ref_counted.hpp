#pragma once

#include <godot_cpp/classes/object.hpp>

namespace godot {

class RefCounted : public Object {
 public:
  static const char* get_class_static() { return "RefCounted"; }
  static const char* _get_engine_class_static() { return "RefCounted"; }
};

}  // namespace godot
