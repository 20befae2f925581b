#pragma once

#include <godot_cpp/subset/builtin.hpp>

namespace godot {

class StringName : public subset::Builtin<GDEXTENSION_VARIANT_TYPE_STRING_NAME, 8> {
 public:
  StringName() = default;
  StringName(const char* name) : Builtin(Uninitialised()) {
    subset::engine.string_name_new_with_utf8_chars(_native_ptr(), name);
  }
};

}  // namespace godot
