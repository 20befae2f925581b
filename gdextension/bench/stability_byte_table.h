#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "table/lobe_table.h"

namespace lobelight::stability {

// A lobe table in four bytes a texel, as small ready tables can be stored: slopes/alpha in [−4, 4],
// log2 κ between the table's own least and largest, and the lobe's share of its view's albedo. The
// albedos, one a view, stay as they are. Shares are rounded so that their sum stays 1 (largest
// remainders), which keeps the energy whatever the number of lobes.
class ByteTable {
 public:
  static constexpr double kLargestSlope = 4.0;

  explicit ByteTable(const LobeTable& table);

  // The texel as a shader decodes it.
  glm::vec4 texel(int lobe, int t, int p) const;

 private:
  std::size_t view(int t, int p) const {
    return static_cast<std::size_t>(p) * static_cast<std::size_t>(views_.x) +
           static_cast<std::size_t>(t);
  }

  int lobes_;
  glm::ivec2 views_;
  double least_log2_kappa_;
  double log2_kappa_range_;
  std::vector<double> albedo_;
  std::vector<std::array<std::uint8_t, 4>> bytes_;  // lobe k of view v at v · lobes + k
};

}  // namespace lobelight::stability
