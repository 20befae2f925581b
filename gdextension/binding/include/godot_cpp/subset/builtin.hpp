// Storage and lifetime of the types whose layout belongs to the engine: String, Dictionary, …
#pragma once

#include <cstdint>
#include <cstring>
#include <godot_cpp/subset/interface.hpp>

namespace godot::subset {

// Base of the opaque types; SIZE in bytes as extension_api.json gives it for 64-bit builds.
template <GDExtensionVariantType TYPE, std::size_t SIZE>
class Builtin {
 public:
  static constexpr GDExtensionVariantType VARIANT_TYPE = TYPE;

  Builtin() { engine.types[TYPE].construct(opaque_, nullptr); }
  Builtin(const Builtin& other) {
    const GDExtensionConstTypePtr arguments[] = {other.opaque_};
    engine.types[TYPE].construct_copy(opaque_, arguments);
  }
  Builtin(Builtin&& other) noexcept : Builtin() { swap(other); }
  Builtin& operator=(const Builtin& other) {
    Builtin copy(other);
    swap(copy);
    return *this;
  }
  Builtin& operator=(Builtin&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Builtin() { engine.types[TYPE].destroy(opaque_); }

  void* _native_ptr() const { return opaque_; }

 protected:
  // For constructors that have the engine fill the storage in another way.
  struct Uninitialised {};
  explicit Builtin(Uninitialised) {}

  // Calls one of the type's methods with pointers to `arguments`, whose types must be the engine's
  // own (int64_t, double, or a class of this binding).
  template <class Result, class... Arguments>
  Result call(GDExtensionPtrBuiltInMethod method, const Arguments&... arguments) const {
    const GDExtensionConstTypePtr pointers[] = {static_cast<const void*>(&arguments)..., nullptr};
    Result result{};
    method(opaque_, pointers, &result, sizeof...(Arguments));
    return result;
  }

 private:
  // The engine moves these types about as plain bytes itself, so exchanging bytes moves them.
  void swap(Builtin& other) noexcept {
    std::uint8_t bytes[SIZE];
    std::memcpy(bytes, opaque_, SIZE);
    std::memcpy(opaque_, other.opaque_, SIZE);
    std::memcpy(other.opaque_, bytes, SIZE);
  }

  // Mutable because the engine takes non-const pointers even where it only reads.
  alignas(8) mutable std::uint8_t opaque_[SIZE] = {};
};

}  // namespace godot::subset
