// The packed arrays: contiguous, shared until written to.
#pragma once

#include <cstdint>
#include <godot_cpp/subset/builtin.hpp>

namespace godot::subset {

// READ and WRITE are the engine's functions for a pointer to one element, SIZE and RESIZE the
// type's methods of these names.
template <GDExtensionVariantType TYPE, class Element, auto Interface::*READ, auto Interface::*WRITE,
          auto Interface::*SIZE, auto Interface::*RESIZE>
class PackedArray : public Builtin<TYPE, 16> {
 public:
  // A call into the engine: keep it out of loop conditions.
  std::int64_t size() const { return this->template call<std::int64_t>(engine.*SIZE); }
  bool is_empty() const { return size() == 0; }

  // Gives the engine's Error code, 0 = OK.
  std::int64_t resize(std::int64_t new_size) {
    return this->template call<std::int64_t>(engine.*RESIZE, new_size);
  }

  // size() elements; null when there are none. Valid until the array changes or goes.
  const Element* ptr() const {
    return is_empty() ? nullptr
                      : static_cast<const Element*>((engine.*READ)(this->_native_ptr(), 0));
  }
  Element* ptrw() {
    return is_empty() ? nullptr : static_cast<Element*>((engine.*WRITE)(this->_native_ptr(), 0));
  }
};

}  // namespace godot::subset
