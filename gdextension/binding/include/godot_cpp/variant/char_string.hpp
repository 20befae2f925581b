#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace godot {

// Bytes that String::utf8() gives, terminated by a zero.
class CharString {
 public:
  CharString() = default;
  explicit CharString(std::string text) : text_(std::move(text)) {}

  const char* get_data() const { return text_.c_str(); }
  const char* ptr() const { return text_.c_str(); }
  std::int64_t length() const { return static_cast<std::int64_t>(text_.size()); }

 private:
  std::string text_;
};

}  // namespace godot
