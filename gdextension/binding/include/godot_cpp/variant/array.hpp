#pragma once

#include <cstdint>
#include <godot_cpp/subset/builtin.hpp>

namespace godot {

class Variant;

class Array : public subset::Builtin<GDEXTENSION_VARIANT_TYPE_ARRAY, 8> {
 public:
  std::int64_t size() const;
  bool is_empty() const { return size() == 0; }
  void append(const Variant& value);
  // `index` in 0 … size() − 1. Valid until the array changes.
  const Variant& operator[](std::int64_t index) const;
};

}  // namespace godot
