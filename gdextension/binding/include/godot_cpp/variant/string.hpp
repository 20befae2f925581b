#pragma once

#include <cstdint>
#include <godot_cpp/subset/builtin.hpp>
#include <godot_cpp/variant/char_string.hpp>

namespace godot {

class String : public subset::Builtin<GDEXTENSION_VARIANT_TYPE_STRING, 8> {
 public:
  String() = default;
  // Latin-1, as in godot-cpp; use utf8() for text that may hold anything else than ASCII.
  String(const char* latin1) : Builtin(Uninitialised()) {
    subset::engine.string_new_with_latin1_chars(_native_ptr(), latin1);
  }

  // `length` in bytes; −1: up to the terminating zero.
  static String utf8(const char* text, std::int64_t length = -1);
  CharString utf8() const;
};

}  // namespace godot
