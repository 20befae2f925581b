#pragma once

#include <cstddef>
#include <godot_cpp/variant/variant.hpp>

namespace godot {

class UtilityFunctions {
 public:
  // Prints the arguments, joined, as an error of the running script.
  template <class... Arguments>
  static void push_error(const Variant& first, const Arguments&... others) {
    const Variant values[] = {first, Variant(others)...};
    push_error_with(values, 1 + sizeof...(Arguments));
  }

 private:
  static void push_error_with(const Variant* arguments, std::size_t count);
};

}  // namespace godot
