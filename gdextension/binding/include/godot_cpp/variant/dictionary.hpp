#pragma once

#include <cstdint>
#include <godot_cpp/subset/builtin.hpp>

namespace godot {

class Array;
class Variant;

class Dictionary : public subset::Builtin<GDEXTENSION_VARIANT_TYPE_DICTIONARY, 8> {
 public:
  std::int64_t size() const;
  bool is_empty() const { return size() == 0; }
  bool has(const Variant& key) const;
  Array keys() const;
  // The const form is for keys that are there; the other adds a missing one with a null value.
  const Variant& operator[](const Variant& key) const;
  Variant& operator[](const Variant& key);
};

}  // namespace godot
