#pragma once

#include <cstddef>
#include <godot_cpp/classes/wrapped.hpp>
#include <godot_cpp/variant/variant.hpp>

namespace godot {

class Object : public Wrapped {
 public:
  static const char* get_class_static() { return "Object"; }
  static const char* _get_engine_class_static() { return "Object"; }

  // Calls what is connected to the signal, at once and on this thread.
  template <class... Arguments>
  void emit_signal(const StringName& signal, const Arguments&... arguments) {
    const Variant values[] = {Variant(signal), Variant(arguments)...};
    emit_signal_with(values, 1 + sizeof...(Arguments));
  }

 protected:
  using Wrapped::Wrapped;

 private:
  void emit_signal_with(const Variant* arguments, std::size_t count);
};

}  // namespace godot
