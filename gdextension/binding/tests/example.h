// A class as src/godot has them, declared here and defined elsewhere: GCC's sanitizer judges an
// address by whether it sees what lies there.
#pragma once

#include <cstdint>
#include <godot_cpp/classes/ref_counted.hpp>

namespace binding_test {

class Example : public godot::RefCounted {
  GDCLASS(Example, godot::RefCounted)

 public:
  std::int64_t add(std::int64_t one, std::int64_t other);
  std::int64_t twice(std::int64_t value) const;
  static std::int64_t sum(std::int64_t one, std::int64_t two, std::int64_t three);

 protected:
  static void _bind_methods();
};

}  // namespace binding_test
