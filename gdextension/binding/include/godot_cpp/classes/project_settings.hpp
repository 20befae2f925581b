#pragma once

#include <godot_cpp/classes/object.hpp>

namespace godot {

class ProjectSettings : public Object {
 public:
  static ProjectSettings* get_singleton();

  // Absolute path of a res:// or user:// path in the file system; other paths come back unchanged.
  String globalize_path(const String& path) const;

 private:
  using Object::Object;
};

}  // namespace godot
