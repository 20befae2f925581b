#include <godot_cpp/subset/method_bind.hpp>

namespace godot::subset {

void MethodBind::call(void* instance, const Variant* const* values, std::int64_t count,
                      Variant& result, GDExtensionCallError& error) const {
  const auto wanted = static_cast<std::int32_t>(arguments.size());
  const auto needed = wanted - static_cast<std::int32_t>(defaults.size());
  // Too few of them, too, are told the number of all, as the engine's own methods do.
  if (count > wanted) {
    error = {GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS, 0, wanted};
    return;
  }
  if (count < needed) {
    error = {GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS, 0, wanted};
    return;
  }
  std::vector<const Variant*> complete;
  for (std::int32_t i = 0; i < wanted; ++i) {
    const Variant* value = i < count ? values[i] : &defaults[static_cast<std::size_t>(i - needed)];
    const auto type =
        static_cast<GDExtensionVariantType>(arguments[static_cast<std::size_t>(i)].type);
    if (type != GDEXTENSION_VARIANT_TYPE_NIL &&
        engine.variant_can_convert_strict(engine.variant_get_type(value->_native_ptr()), type) ==
            0) {
      error = {GDEXTENSION_CALL_ERROR_INVALID_ARGUMENT, i, static_cast<std::int32_t>(type)};
      return;
    }
    complete.push_back(value);
  }
  error.error = GDEXTENSION_CALL_OK;
  call_variants(instance, complete.data(), result);
}

}  // namespace godot::subset
