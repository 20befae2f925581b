#pragma once

#include <gdextension_interface.h>

namespace godot {

class ClassDB;

// The C++ half of an object; `_owner` is the engine's half, which owns this one.
class Wrapped {
 public:
  Wrapped(const Wrapped&) = delete;
  Wrapped& operator=(const Wrapped&) = delete;
  virtual ~Wrapped() = default;

  GDExtensionObjectPtr _owner = nullptr;

 protected:
  // Takes the engine's half that ClassDB has ready for the object under construction.
  Wrapped();
  // For objects of the engine that this library only calls.
  explicit Wrapped(GDExtensionObjectPtr owner) : _owner(owner) {}

  static void _bind_methods() {}
  friend class ClassDB;
};

}  // namespace godot

// First line of every class that is registered.
#define GDCLASS(m_class, m_inherits)                                                               \
 public:                                                                                           \
  using self_type = m_class;                                                                       \
  using parent_type = m_inherits;                                                                  \
  static const char* get_class_static() { return #m_class; }                                       \
  static const char* get_parent_class_static() { return m_inherits::get_class_static(); }          \
  /* The nearest ancestor that the engine itself implements. */                                    \
  static const char* _get_engine_class_static() { return m_inherits::_get_engine_class_static(); } \
                                                                                                   \
 private:                                                                                          \
  friend class ::godot::ClassDB;
