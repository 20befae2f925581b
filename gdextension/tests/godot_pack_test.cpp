#include <doctest/doctest.h>

#include <cstdint>
#include <new>
#include <vector>

#include "godot/pack.h"

namespace lobelight {

namespace {

// As the engine's packed arrays behave: a resize that fails changes nothing, and an array without
// elements has no address.
template <std::int64_t Most>
class Packed {
 public:
  std::int64_t resize(std::int64_t size) {
    if (size > Most) return 6;  // ERR_OUT_OF_MEMORY
    values_.resize(static_cast<std::size_t>(size));
    return 0;
  }
  std::int64_t size() const { return static_cast<std::int64_t>(values_.size()); }
  float* ptrw() { return values_.empty() ? nullptr : values_.data(); }

 private:
  std::vector<float> values_;
};

}  // namespace

TEST_CASE("an array for which the engine has no memory is not written to") {
  const std::vector<double> values{1.0, 2.0, 3.0};
  CHECK_THROWS_AS((pack<Packed<2>>(values)), std::bad_alloc);
  CHECK_THROWS_AS(sized<Packed<2>>(3), std::bad_alloc);
  auto packed = pack<Packed<3>>(values);
  REQUIRE(packed.size() == 3);
  CHECK(packed.ptrw()[2] == 3.0f);
  CHECK(pack<Packed<0>>(std::vector<double>{}).size() == 0);
}

}  // namespace lobelight
