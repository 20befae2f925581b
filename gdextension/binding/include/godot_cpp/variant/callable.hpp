#pragma once

#include <cstddef>
#include <godot_cpp/subset/builtin.hpp>

namespace godot {

class Object;
class StringName;
class Variant;

// A method of an object, known by the object's identifier: it does not keep the object alive, and
// calling it after the object has gone does nothing.
class Callable : public subset::Builtin<GDEXTENSION_VARIANT_TYPE_CALLABLE, 16> {
 public:
  Callable() = default;
  Callable(Object* object, const StringName& method);

  // Runs the method on the main thread, when the engine next flushes its message queue. May be
  // called from any thread. Defined in variant.hpp.
  template <class... Arguments>
  void call_deferred(const Arguments&... arguments) const;

 private:
  void call_deferred_with(const Variant* arguments, std::size_t count) const;
};

}  // namespace godot
