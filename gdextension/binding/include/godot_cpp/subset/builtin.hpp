// Storage and lifetime of the types whose layout belongs to the engine: String, Dictionary, …
#pragma once

#include <cstdint>
#include <cstring>
#include <godot_cpp/subset/interface.hpp>

namespace godot::subset {

struct BuiltinFunctions {
  GDExtensionPtrConstructor construct;
  GDExtensionPtrConstructor construct_copy;
  GDExtensionPtrDestructor destroy;

  explicit BuiltinFunctions(GDExtensionVariantType type)
      // The engine's order for every one of these types: 0 is the default, 1 the copy.
      : construct(engine.variant_get_ptr_constructor(type, 0)),
        construct_copy(engine.variant_get_ptr_constructor(type, 1)),
        destroy(engine.variant_get_ptr_destructor(type)) {}
};

template <GDExtensionVariantType TYPE>
const BuiltinFunctions& builtin_functions() {
  static const BuiltinFunctions functions(TYPE);
  return functions;
}

// Base of the opaque types; SIZE in bytes as extension_api.json gives it for 64-bit builds.
template <GDExtensionVariantType TYPE, std::size_t SIZE>
class Builtin {
 public:
  static constexpr GDExtensionVariantType VARIANT_TYPE = TYPE;

  Builtin() { builtin_functions<TYPE>().construct(opaque_, nullptr); }
  Builtin(const Builtin& other) {
    const GDExtensionConstTypePtr arguments[] = {other.opaque_};
    builtin_functions<TYPE>().construct_copy(opaque_, arguments);
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
  ~Builtin() { builtin_functions<TYPE>().destroy(opaque_); }

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
    if (method != nullptr) method(opaque_, pointers, &result, sizeof...(Arguments));
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

// A method of the enclosing builtin type, looked up once for each place that names it.
#define GODOT_SUBSET_METHOD(name, hash)                                 \
  ([]() {                                                               \
    static const GDExtensionPtrBuiltInMethod method =                   \
        ::godot::subset::find_builtin_method(VARIANT_TYPE, name, hash); \
    return method;                                                      \
  }())
