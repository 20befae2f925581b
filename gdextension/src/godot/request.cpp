#include "godot/request.h"

#include <algorithm>
#include <cmath>
#include <godot_cpp/variant/variant.hpp>
#include <limits>
#include <optional>
#include <stdexcept>

#include "base/as_written.h"
#include "godot/convert.h"

namespace lobelight {

namespace {

using godot::Variant;

bool is_text(const Variant& value) {
  return value.get_type() == Variant::STRING || value.get_type() == Variant::STRING_NAME;
}

std::string quoted(std::string_view text) { return '"' + std::string(text) + '"'; }

// The value as a message shows it: short, on one line, with its type.
std::string described(const Variant& value) {
  constexpr std::size_t kLongest = 60;
  if (value.get_type() == Variant::NIL) return "null";
  std::string shown = to_std(value.stringify());
  const auto is_control = [](unsigned char byte) { return byte < ' ' || byte == 0x7f; };
  std::replace_if(shown.begin(), shown.end(), is_control, ' ');
  if (shown.size() > kLongest) {
    // Not in the middle of a UTF-8 sequence.
    std::size_t end = kLongest;
    while (end > 0 && (static_cast<unsigned char>(shown[end]) & 0xc0) == 0x80) --end;
    shown = shown.substr(0, end) + "…";
  }
  if (is_text(value)) shown = quoted(shown);
  return shown + " (" + to_std(Variant::get_type_name(value.get_type())) + ")";
}

[[noreturn]] void refuse(std::string_view key, const Variant& value, std::string_view wanted) {
  throw std::invalid_argument(std::string(key) + " is " + described(value) + ", but must be " +
                              std::string(wanted) + ".");
}

std::optional<double> number(const Variant& value) {
  if (value.get_type() == Variant::INT || value.get_type() == Variant::FLOAT) {
    return static_cast<double>(value);
  }
  return std::nullopt;
}

std::optional<std::int64_t> whole_number(const Variant& value) {
  if (value.get_type() == Variant::INT) return static_cast<std::int64_t>(value);
  if (value.get_type() != Variant::FLOAT) return std::nullopt;
  const double real = value;
  // Doubles hold every whole number up to 2^53; beyond it a float is not what was written.
  constexpr double kLargestExact = 9007199254740992.0;
  if (!(std::abs(real) <= kLargestExact) || real != std::floor(real)) return std::nullopt;
  return static_cast<std::int64_t>(real);
}

std::optional<int> small_number(const Variant& value) {
  const std::optional<std::int64_t> wide = whole_number(value);
  if (!wide || *wide < std::numeric_limits<int>::min() || *wide > std::numeric_limits<int>::max()) {
    return std::nullopt;
  }
  return static_cast<int>(*wide);
}

struct Two {
  Variant first;
  Variant second;
};

// The components of what can stand for two numbers.
std::optional<Two> two_components(const Variant& value) {
  switch (value.get_type()) {
    case Variant::VECTOR2: {
      const godot::Vector2 vector = value;
      return Two{as_written(vector.x), as_written(vector.y)};
    }
    case Variant::VECTOR2I: {
      const godot::Vector2i vector = value;
      return Two{vector.x, vector.y};
    }
    case Variant::ARRAY: {
      const godot::Array array = value;
      if (array.size() != 2) return std::nullopt;
      return Two{array[0], array[1]};
    }
    default:
      return std::nullopt;
  }
}

Variant key_variant(std::string_view key) { return to_godot(key); }

}  // namespace

Request::Request(const godot::Dictionary& values, std::string_view kind,
                 std::initializer_list<std::string_view> keys)
    : values_(values) {
  const godot::Array given = values.keys();
  const std::int64_t count = given.size();
  for (std::int64_t i = 0; i < count; ++i) {
    const Variant& key = given[i];
    if (is_text(key) &&
        std::find(keys.begin(), keys.end(), to_std(key.stringify())) != keys.end()) {
      continue;
    }
    std::string message = (is_text(key) ? quoted(to_std(key.stringify())) : described(key)) +
                          " is not a key of " + std::string(kind) + "; known are";
    const char* separator = " ";
    for (const std::string_view known : keys) {
      message += separator + quoted(known);
      separator = ", ";
    }
    throw std::invalid_argument(message + ".");
  }
}

std::string Request::text(std::string_view key, std::string_view fallback) const {
  if (!values_.has(key_variant(key))) return std::string(fallback);
  const Variant& value = values_[key_variant(key)];
  if (!is_text(value)) refuse(key, value, "a String");
  return to_std(value);
}

std::string Request::required_text(std::string_view key) const {
  const std::string value = text(key, "");
  if (value.empty()) throw std::invalid_argument(std::string(key) + " is missing.");
  return value;
}

int Request::integer(std::string_view key, int fallback) const {
  if (!values_.has(key_variant(key))) return fallback;
  const Variant& value = values_[key_variant(key)];
  const std::optional<int> read = small_number(value);
  if (!read) refuse(key, value, "a whole number of at most 31 bits");
  return *read;
}

std::uint64_t Request::unsigned_integer(std::string_view key, std::uint64_t fallback) const {
  if (!values_.has(key_variant(key))) return fallback;
  const Variant& value = values_[key_variant(key)];
  const std::optional<std::int64_t> read = whole_number(value);
  if (!read || *read < 0) refuse(key, value, "a whole number of at least 0");
  return static_cast<std::uint64_t>(*read);
}

bool Request::truth(std::string_view key, bool fallback) const {
  if (!values_.has(key_variant(key))) return fallback;
  const Variant& value = values_[key_variant(key)];
  if (value.get_type() != Variant::BOOL) refuse(key, value, "true or false");
  return static_cast<bool>(value);
}

glm::dvec2 Request::widths(std::string_view key, const glm::dvec2& fallback) const {
  if (!values_.has(key_variant(key))) return fallback;
  const Variant& value = values_[key_variant(key)];
  if (const std::optional<double> both = number(value)) return glm::dvec2(*both);
  if (const std::optional<Two> two = two_components(value)) {
    const std::optional<double> x = number(two->first);
    const std::optional<double> y = number(two->second);
    if (x && y) return {*x, *y};
  }
  refuse(key, value, "a number, a Vector2 or an Array of two numbers");
}

std::vector<double> Request::numbers(std::string_view key) const {
  std::vector<double> read;
  if (!has(key)) return read;
  const Variant& value = values_[key_variant(key)];
  constexpr const char* kWanted = "an Array of numbers";
  if (value.get_type() != Variant::ARRAY) refuse(key, value, kWanted);
  const godot::Array array = value;
  const std::int64_t count = array.size();
  for (std::int64_t i = 0; i < count; ++i) {
    const std::optional<double> one = number(array[i]);
    if (!one) refuse(key, value, kWanted);
    read.push_back(*one);
  }
  return read;
}

std::vector<std::string> Request::texts(std::string_view key) const {
  std::vector<std::string> read;
  if (!has(key)) return read;
  const Variant& value = values_[key_variant(key)];
  constexpr const char* kWanted = "an Array of Strings";
  if (value.get_type() != Variant::ARRAY) refuse(key, value, kWanted);
  const godot::Array array = value;
  const std::int64_t count = array.size();
  for (std::int64_t i = 0; i < count; ++i) {
    if (!is_text(array[i])) refuse(key, value, kWanted);
    read.push_back(to_std(array[i]));
  }
  return read;
}

double Request::real(std::string_view key, double fallback) const {
  if (!has(key)) return fallback;
  const Variant& value = values_[key_variant(key)];
  const std::optional<double> read = number(value);
  if (!read) refuse(key, value, "a number");
  return *read;
}

bool Request::says(std::string_view key, std::string_view text) const {
  if (!has(key)) return false;
  const Variant& value = values_[key_variant(key)];
  return is_text(value) && to_std(value) == text;
}

bool Request::has(std::string_view key) const { return values_.has(key_variant(key)); }

glm::ivec2 Request::counts(std::string_view key, const glm::ivec2& fallback) const {
  if (!values_.has(key_variant(key))) return fallback;
  const Variant& value = values_[key_variant(key)];
  if (const std::optional<Two> two = two_components(value)) {
    const std::optional<int> x = small_number(two->first);
    const std::optional<int> y = small_number(two->second);
    if (x && y) return {*x, *y};
  }
  refuse(key, value, "a Vector2i, or a Vector2 or an Array of two whole numbers");
}

}  // namespace lobelight
