#include "example.h"

#include <godot_cpp/core/class_db.hpp>

namespace binding_test {

std::int64_t Example::add(std::int64_t one, std::int64_t other) { return one + other; }

std::int64_t Example::twice(std::int64_t value) const { return 2 * value; }

std::int64_t Example::sum(std::int64_t one, std::int64_t two, std::int64_t three) {
  return one + two + three;
}

void Example::_bind_methods() {
  using namespace godot;
  ClassDB::bind_method(D_METHOD("add", "one", "other"), &Example::add, DEFVAL(1));
  ClassDB::bind_method(D_METHOD("twice", "value"), &Example::twice);
  ClassDB::bind_static_method("Example", D_METHOD("sum", "one", "two", "three"), &Example::sum,
                              DEFVAL(20), DEFVAL(300));
}

}  // namespace binding_test
