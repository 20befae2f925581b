#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/progress.h"
#include "table/lobe_table.h"

namespace lobelight {

// Tables of one BRDF over its widths (alpha_x, alpha_y), fitted so that lobe k of neighbouring
// widths is the same lobe. So tables can be interpolated in the logarithms of the widths.
//
// Each view of a table starts from the lobes of the same view at the neighbouring widths. A
// continuation over the views alone is not enough: at equal widths the lobes at normal incidence
// lie nearly on top of one another, and where they separate on the way to grazing views differs
// from width to width.
struct SetRecipe {
  std::string brdf = "ward";  // a model's name
  // The widths on each axis, rising; at least two. Steps of a factor √2 or less interpolate well.
  std::vector<double> widths;
  int lobes = 8;
  // Of an anisotropic table; isotropic ones have views.x × 1. With views.y = 1, the set has these
  // only.
  glm::ivec2 views{16, 8};
  std::uint64_t seed = 0;
  int threads = 0;  // zero or negative: every core
};

constexpr int kMaxWidths = 64;

// The order in which a set's tables are stored: first the anisotropic tables of all pairs x ≥ y,
// pair (x, y) at x (x + 1) / 2 + y, then the isotropic tables of all widths. A pair x < y is the
// table of (y, x) with the axes exchanged. Equal widths have a table of each kind: the anisotropic
// one is there to be interpolated with its neighbours.
class SetLayout {
 public:
  explicit SetLayout(const SetRecipe& recipe);

  int levels() const { return levels_; }
  int pairs() const { return views_.y > 1 ? levels_ * (levels_ + 1) / 2 : 0; }
  int tables() const { return pairs() + levels_; }

  int pair_table(int x, int y) const { return x * (x + 1) / 2 + y; }
  int isotropic_table(int level) const { return pairs() + level; }
  bool is_isotropic(int table) const { return table >= pairs(); }

  // The levels of the widths along x and y.
  glm::ivec2 level(int table) const;

  // Elevations × azimuths.
  glm::ivec2 views(int table) const { return {views_.x, is_isotropic(table) ? 1 : views_.y}; }

  // In half floats: the texels of a table are those of LobeTable::to_rgba16f().
  std::size_t size(int table) const;
  std::size_t offset(int table) const;
  std::size_t total() const { return offset(tables()); }

 private:
  int levels_;
  int lobes_;
  glm::ivec2 views_;
};

// Throws std::invalid_argument with one sentence that names the key and the value.
void validate(const SetRecipe& recipe);

// Fits all tables and returns their texels. Each table starts from the rounded texels of its
// parents, the neighbouring widths that are fitted before it. The bytes are the same for any number
// of threads. Throws what validate() throws, and Cancelled.
std::vector<std::uint16_t> fit_table_set(const SetRecipe& recipe, Progress& progress);

// Fits one table of a finished set again, from its parents' texels in the set, and returns the
// bytes that the set has for it: so a part of a set can be checked. Throws std::invalid_argument
// also if the texels have another size or there is no such table.
std::vector<std::uint16_t> refit_table(const SetRecipe& recipe,
                                       const std::vector<std::uint16_t>& texels, int table,
                                       Progress& progress);

}  // namespace lobelight
