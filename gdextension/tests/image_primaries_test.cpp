#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "image/primaries.h"

namespace lobelight {
namespace {

void check_matrix(const Primaries& primaries, const glm::dmat3& rows, double tolerance) {
  const auto conversion = conversion_to_rec709(primaries);
  REQUIRE(conversion);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      INFO("row ", row, " column ", column);
      CHECK((*conversion)[column][row] == doctest::Approx(rows[row][column]).epsilon(tolerance));
    }
  }
}

TEST_CASE("Primaries: Rec. 709 stays") {
  const auto conversion = conversion_to_rec709(kRec709);
  REQUIRE(conversion);
  for (int i = 0; i < 3; ++i) {
    CHECK(glm::length((*conversion)[i] - glm::dmat3(1.0)[i]) < 1e-12);
  }
}

TEST_CASE("Primaries: BT.2020 to BT.709 as ITU-R BT.2087-0 has it") {
  const Primaries rec2020 = {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kRec709.white};
  const glm::dmat3 rows(1.6605, -0.5876, -0.0728, -0.1246, 1.1329, -0.0083, -0.0182, -0.1006,
                        1.1187);
  check_matrix(rec2020, rows, 2e-3);
}

TEST_CASE("Primaries: ACEScg to Rec. 709 with Bradford adaptation") {
  // As the ACES project's reference implementation has it (AP1 to sRGB, D60 to D65).
  const Primaries acescg = {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}};
  const glm::dmat3 rows(1.70505, -0.62179, -0.08326, -0.13026, 1.14080, -0.01055, -0.02400,
                        -0.12897, 1.15297);
  check_matrix(acescg, rows, 1e-3);
}

TEST_CASE("Primaries: white stays white") {
  const Primaries cie_rgb = {
      {0.7347, 0.2653}, {0.2738, 0.7174}, {0.1666, 0.0089}, {1.0 / 3, 1.0 / 3}};
  const auto conversion = conversion_to_rec709(cie_rgb);
  REQUIRE(conversion);
  CHECK(glm::length(*conversion * glm::dvec3(1.0) - glm::dvec3(1.0)) < 1e-12);
}

TEST_CASE("Primaries: CIE XYZ holds tristimulus values, which no white changes") {
  // IEC 61966-2-1, from XYZ to linear sRGB.
  const glm::dmat3 rows(3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570);
  check_matrix(kCieXyz, rows, 3e-3);
  // A third, rounded, is a third.
  const auto rounded = conversion_to_rec709({{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, {0.333, 0.333}});
  REQUIRE(rounded);
  for (int i = 0; i < 3; ++i) {
    CHECK(glm::length((*rounded)[i] - (*conversion_to_rec709(kCieXyz))[i]) < 1e-12);
  }
  // Values by those of a white (Imf::RGBtoXYZ with it): white becomes that white, not Rec. 709's.
  const auto d50 = conversion_to_rec709({{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, {0.3457, 0.3585}});
  REQUIRE(d50);
  const glm::dvec3 white = *conversion_to_rec709(kCieXyz) * glm::dvec3(0.96422, 1.0, 0.82521);
  CHECK(glm::length(*d50 * glm::dvec3(1.0) - white) < 1e-3);
}

TEST_CASE("Primaries: sRGB as ICC profiles state it, adapted to D50, is Rec. 709") {
  const Primaries d50 = {
      {0.64845, 0.33088}, {0.32119, 0.59789}, {0.15590, 0.06606}, {0.34571, 0.35854}};
  const auto conversion = conversion_to_rec709(d50);
  REQUIRE(conversion);
  for (int i = 0; i < 3; ++i) {
    CHECK(glm::length((*conversion)[i] - glm::dmat3(1.0)[i]) < 1e-3);
  }
}

TEST_CASE("Primaries on one line or one point are refused") {
  CHECK(!conversion_to_rec709({{0, 0}, {0, 0}, {0, 0}, {0, 0}}));
  CHECK(!conversion_to_rec709({{0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}, {0.3127, 0.329}}));
  CHECK(!conversion_to_rec709({{0.64, 0.33}, {0.3, 0.6}, {0.15, 0.06}, {0.3, 0.0}}));
}

}  // namespace
}  // namespace lobelight
