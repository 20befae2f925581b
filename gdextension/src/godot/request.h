#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <godot_cpp/variant/dictionary.hpp>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace lobelight {

// Reads what a script asks for in a Dictionary. A key that is not there gives the fallback; what
// cannot be meant is refused with std::invalid_argument and one sentence that names the key.
class Request {
 public:
  // `kind` is what messages call the dictionary, with its article: "a recipe". Refuses every key
  // that is not among `keys`.
  Request(const godot::Dictionary& values, std::string_view kind,
          std::initializer_list<std::string_view> keys);

  // A String or StringName.
  std::string text(std::string_view key, std::string_view fallback) const;
  // Like text(), but the key has to be there and must not be empty.
  std::string required_text(std::string_view key) const;

  // Whole numbers: int, or float without a fraction (numbers that come from JSON are floats).
  int integer(std::string_view key, int fallback) const;
  std::uint64_t unsigned_integer(std::string_view key, std::uint64_t fallback) const;

  bool truth(std::string_view key, bool fallback) const;

  // A Vector2, a Vector2i, an Array of two numbers, or one number that stands for both.
  glm::dvec2 widths(std::string_view key, const glm::dvec2& fallback) const;
  // An Array of numbers; none where the key is not there.
  std::vector<double> numbers(std::string_view key) const;
  // An Array of Strings; none where the key is not there.
  std::vector<std::string> texts(std::string_view key) const;
  double real(std::string_view key, double fallback) const;
  bool has(std::string_view key) const;
  // Whether the key is there and its value is this text.
  bool says(std::string_view key, std::string_view text) const;
  // A Vector2i, a Vector2 or an Array of two whole numbers.
  glm::ivec2 counts(std::string_view key, const glm::ivec2& fallback) const;

 private:
  godot::Dictionary values_;
};

}  // namespace lobelight
