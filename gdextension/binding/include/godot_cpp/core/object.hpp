#pragma once

#include <godot_cpp/classes/object.hpp>
#include <godot_cpp/core/property_info.hpp>
#include <vector>

namespace godot {

// A signal's name and arguments.
struct MethodInfo {
  StringName name;
  std::vector<PropertyInfo> arguments;

  template <class... Arguments>
  explicit MethodInfo(const StringName& signal, const Arguments&... signal_arguments)
      : name(signal), arguments{signal_arguments...} {}
};

}  // namespace godot

#define ADD_SIGNAL(m_signal) ::godot::ClassDB::add_signal(get_class_static(), m_signal)
