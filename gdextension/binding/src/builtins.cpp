// What the builtin types' headers declare and cannot define without a whole Variant.
#include <godot_cpp/classes/object.hpp>
#include <godot_cpp/variant/variant.hpp>
#include <string>
#include <vector>

namespace godot {

using subset::engine;

String String::utf8(const char* text, std::int64_t length) {
  String result;
  // The engine constructs in place, so the empty string that stands there goes first; an empty one
  // holds nothing, and its bytes are overwritten.
  if (length < 0) {
    engine.string_new_with_utf8_chars(result._native_ptr(), text);
  } else {
    engine.string_new_with_utf8_chars_and_len2(result._native_ptr(), text, length);
  }
  return result;
}

CharString String::utf8() const {
  const GDExtensionInt length = engine.string_to_utf8_chars(_native_ptr(), nullptr, 0);
  std::string text(static_cast<std::size_t>(length), '\0');
  engine.string_to_utf8_chars(_native_ptr(), text.data(), length);
  return CharString(std::move(text));
}

std::int64_t Array::size() const { return call<std::int64_t>(engine.array_size); }

void Array::append(const Variant& value) {
  call<std::int64_t>(engine.array_append, value);  // returns nothing
}

const Variant& Array::operator[](std::int64_t index) const {
  return *static_cast<const Variant*>(engine.array_operator_index_const(_native_ptr(), index));
}

std::int64_t Dictionary::size() const { return call<std::int64_t>(engine.dictionary_size); }

bool Dictionary::has(const Variant& key) const {
  return call<GDExtensionBool>(engine.dictionary_has, key) != 0;
}

Array Dictionary::keys() const { return call<Array>(engine.dictionary_keys); }

const Variant& Dictionary::operator[](const Variant& key) const {
  return *static_cast<const Variant*>(
      engine.dictionary_operator_index_const(_native_ptr(), key._native_ptr()));
}

Variant& Dictionary::operator[](const Variant& key) {
  return *static_cast<Variant*>(engine.dictionary_operator_index(_native_ptr(), key._native_ptr()));
}

Callable::Callable(Object* object, const StringName& method) : Builtin(Uninitialised()) {
  const GDExtensionConstTypePtr arguments[] = {&object->_owner, method._native_ptr()};
  engine.callable_of_method(_native_ptr(), arguments);
}

void Callable::call_deferred_with(const Variant* arguments, std::size_t count) const {
  std::vector<GDExtensionConstTypePtr> pointers;
  for (std::size_t i = 0; i < count; ++i) pointers.push_back(arguments[i]._native_ptr());
  engine.callable_call_deferred(_native_ptr(), pointers.data(), nullptr, static_cast<int>(count));
}

}  // namespace godot
