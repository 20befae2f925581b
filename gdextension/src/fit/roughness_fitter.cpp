#include "fit/roughness_fitter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "base/one_line.h"
#include "base/parallel.h"
#include "fit/continuation.h"
#include "fit/table_fitter.h"
#include "table/half_float.h"

namespace lobelight {

namespace {

// The recipe of the first table of its kind, isotropic or anisotropic, from which all others are
// continued.
Recipe table_recipe(const SetRecipe& set, const glm::dvec2& alpha, const glm::ivec2& views) {
  Recipe recipe;
  recipe.brdf = set.brdf;
  recipe.alpha = alpha;
  recipe.lobes = set.lobes;
  recipe.views = views;
  // Lobe k must be the same lobe at all widths, and round highlights have no arc.
  recipe.placement = Placement::em;
  recipe.seed = set.seed;
  recipe.threads = set.threads;
  return recipe;
}

// The weighted sum of tables' entries, for widths `alpha`.
class Blend {
 public:
  Blend(const glm::dvec2& alpha, const glm::ivec2& views, int lobes)
      : alpha_(alpha),
        views_(views),
        lobes_(lobes),
        entries_(static_cast<std::size_t>(lobes * views.x * views.y), LobeTable::Entry(0.0)) {}

  // `sharper` is added to the binary logarithms of the sharpnesses.
  void add(const LobeTable& table, double share, double sharper = 0.0) {
    auto sum = entries_.begin();
    for (int k = 0; k < lobes_; ++k) {
      for (int p = 0; p < views_.y; ++p) {
        for (int t = 0; t < views_.x; ++t, ++sum) {
          LobeTable::Entry entry = table.entry(k, t, p);
          entry.z += sharper;
          *sum += share * entry;
        }
      }
    }
  }

  LobeTable table() const {
    std::vector<std::uint16_t> texels;
    texels.reserve(4 * entries_.size());
    for (const LobeTable::Entry& entry : entries_) {
      for (int c = 0; c < 4; ++c) texels.push_back(half_from_double(entry[c]));
    }
    return LobeTable::from_rgba16f(alpha_, lobes_, views_, texels);
  }

 private:
  glm::dvec2 alpha_;
  glm::ivec2 views_;
  int lobes_;
  std::vector<LobeTable::Entry> entries_;
};

// The fit of one set.
class SetFit {
 public:
  SetFit(const SetRecipe& recipe, std::vector<std::uint16_t> texels, Progress& progress)
      : recipe_(recipe), layout_(recipe), texels_(std::move(texels)), progress_(progress) {
    texels_.resize(layout_.total());
  }

  std::vector<std::uint16_t> run();
  // `progress` is this table's own.
  std::vector<std::uint16_t> fit(int table, Progress& progress);

 private:
  // The levels of the table that is fitted first, the root. Isotropic: the middle width.
  // Anisotropic: a ratio of about 5, where the lobes lie in a row; from there the rows of all views
  // and ratios can be reached.
  glm::ivec2 root(bool isotropic) const {
    const int last = layout_.levels() - 1;
    return isotropic ? glm::ivec2(last / 2) : glm::ivec2(3 * last / 4, 7 * last / 16);
  }
  // Steps between neighbouring widths from the root to a table.
  int distance(int table) const {
    const bool isotropic = layout_.is_isotropic(table);
    const glm::ivec2 way = layout_.level(table) - root(isotropic);
    return isotropic ? std::abs(way.x) : std::abs(way.x) + std::abs(way.y);
  }
  // The neighbouring tables that are one step closer to the root.
  std::vector<int> parents(int table) const;

  glm::dvec2 alpha(int table) const {
    const glm::ivec2 level = layout_.level(table);
    return {recipe_.widths[static_cast<std::size_t>(level.x)],
            recipe_.widths[static_cast<std::size_t>(level.y)]};
  }
  LobeTable stored(int table) const {
    const auto first = texels_.begin() + static_cast<std::ptrdiff_t>(layout_.offset(table));
    const auto last = texels_.begin() + static_cast<std::ptrdiff_t>(layout_.offset(table + 1));
    return LobeTable::from_rgba16f(alpha(table), recipe_.lobes, layout_.views(table),
                                   {first, last});
  }

  const SetRecipe& recipe_;
  SetLayout layout_;
  std::vector<std::uint16_t> texels_;
  Progress& progress_;
};

std::vector<int> SetFit::parents(int table) const {
  const glm::ivec2 level = layout_.level(table);
  const bool isotropic = layout_.is_isotropic(table);
  std::vector<int> found;
  const auto consider = [&](int x, int y) {
    if (y < 0 || x >= layout_.levels() || x < y) return;
    const int other = isotropic ? layout_.isotropic_table(x) : layout_.pair_table(x, y);
    if (distance(other) < distance(table)) found.push_back(other);
  };
  for (const int step : {-1, 1}) {
    if (isotropic) {
      consider(level.x + step, level.y + step);
    } else {
      consider(level.x + step, level.y);
      consider(level.x, level.y + step);
    }
  }
  return found;
}

std::vector<std::uint16_t> SetFit::fit(int table, Progress& progress) {
  const std::vector<int> from = parents(table);
  const glm::ivec2 views = layout_.views(table);
  if (from.empty()) {
    return fit_table(table_recipe(recipe_, alpha(table), views), progress, nullptr).to_rgba16f();
  }
  const auto brdf = make_brdf(recipe_.brdf, alpha(table));
  Blend blend(alpha(table), views, recipe_.lobes);
  for (const int parent : from) {
    // A lobe's sharpness is roughly proportional to 1 / (alpha_x alpha_y).
    const glm::dvec2 ratio = alpha(parent) / alpha(table);
    blend.add(stored(parent), 1.0 / static_cast<double>(from.size()), std::log2(ratio.x * ratio.y));
  }
  const LobeTable start = blend.table();
  // The first parent says which lobes are mirror images of one another.
  const LobeTable model = stored(from.front());

  const auto starts = [&](int p, const std::vector<Mirror>&) -> NextStart {
    return [&, p](int t, const Mixture&) {
      ViewStart view{start.mixture_at_view(t, p), {}};
      if (p == 0) {
        view.mirrors = MovingMirror::recognise(model.mixture_at_view(t, p), 1).mirrors();
      } else if (p == views.y - 1) {
        MovingMirror mirror = MovingMirror::recognise(model.mixture_at_view(t, p), 0);
        mirror.advance(view.lobes);
        view.mirrors = mirror.mirrors();
      }
      return view;
    };
  };
  LobeTable result(alpha(table), recipe_.lobes, views);
  Mixture pole = start.mixture_at_view(0, 0);
  lift_above_horizon(pole);
  // One thread: run() fits the tables of a front in parallel.
  const Continuation how{*brdf, recipe_.seed, 1, false, {}};
  continue_over_views(how, std::move(pole), starts, result, progress, nullptr);
  return result.to_rgba16f();
}

std::vector<std::uint16_t> SetFit::run() {
  progress_.set(0.0);
  // A front has the tables at one distance from their roots, which do not depend on one another.
  std::vector<std::vector<int>> fronts;
  for (int table = 0; table < layout_.tables(); ++table) {
    const auto d = static_cast<std::size_t>(distance(table));
    if (fronts.size() <= d) fronts.resize(d + 1);
    fronts[d].push_back(table);
  }
  for (const std::vector<int>& front : fronts) {
    parallel_for(front.size(), recipe_.threads, progress_, [&](std::size_t n) {
      // The time is proportional to the number of views.
      Progress progress(progress_, static_cast<double>(layout_.size(front[n])) /
                                       static_cast<double>(layout_.total()));
      const std::vector<std::uint16_t> own = fit(front[n], progress);
      std::copy(own.begin(), own.end(),
                texels_.begin() + static_cast<std::ptrdiff_t>(layout_.offset(front[n])));
    });
  }
  progress_.set(1.0);
  return std::move(texels_);
}

[[noreturn]] void refuse(const std::ostringstream& sentence) {
  throw std::invalid_argument(sentence.str());
}

}  // namespace

SetLayout::SetLayout(const SetRecipe& recipe)
    : levels_(static_cast<int>(recipe.widths.size())), lobes_(recipe.lobes), views_(recipe.views) {}

glm::ivec2 SetLayout::level(int table) const {
  if (is_isotropic(table)) return glm::ivec2(table - pairs());
  int x = 0;
  while (pair_table(x + 1, 0) <= table) ++x;
  return {x, table - pair_table(x, 0)};
}

std::size_t SetLayout::size(int table) const {
  const glm::ivec2 grid = views(table);
  return 4 * static_cast<std::size_t>(lobes_) * static_cast<std::size_t>(grid.x) *
         static_cast<std::size_t>(grid.y);
}

std::size_t SetLayout::offset(int table) const {
  const int before = std::min(table, pairs());
  return static_cast<std::size_t>(before) * size(0) +
         static_cast<std::size_t>(table - before) * size(pairs());
}

void validate(const SetRecipe& recipe) {
  std::ostringstream sentence;
  if (recipe.widths.size() < 2 || recipe.widths.size() > kMaxWidths) {
    sentence << "widths has " << recipe.widths.size() << " numbers, but needs 2 to " << kMaxWidths
             << ".";
    refuse(sentence);
  }
  for (std::size_t i = 1; i < recipe.widths.size(); ++i) {
    if (recipe.widths[i] > recipe.widths[i - 1]) continue;
    sentence << "widths has " << recipe.widths[i] << " after " << recipe.widths[i - 1]
             << ", but must rise.";
    refuse(sentence);
  }
  const auto& names = brdf_names();
  if (std::find(names.begin(), names.end(), recipe.brdf) == names.end()) {
    sentence << "brdf is \"" << one_line(recipe.brdf)
             << "\", but sets of tables are fitted of models only.";
    refuse(sentence);
  }
  if (recipe.views.x < 2 || recipe.views.y < 1) {
    sentence << "views is (" << recipe.views.x << ", " << recipe.views.y
             << "), but a set needs at least 2 elevations and 1 azimuth.";
    refuse(sentence);
  }
  if (recipe.views.y > 1 && is_always_isotropic(recipe.brdf)) {
    sentence << "views is (" << recipe.views.x << ", " << recipe.views.y << "), but \""
             << recipe.brdf << "\" is isotropic: a set of it has 1 azimuth.";
    refuse(sentence);
  }
  for (const double width : {recipe.widths.front(), recipe.widths.back()}) {
    validate(table_recipe(recipe, glm::dvec2(width), recipe.views));
  }
}

std::vector<std::uint16_t> fit_table_set(const SetRecipe& recipe, Progress& progress) {
  validate(recipe);
  return SetFit(recipe, {}, progress).run();
}

std::vector<std::uint16_t> refit_table(const SetRecipe& recipe,
                                       const std::vector<std::uint16_t>& texels, int table,
                                       Progress& progress) {
  validate(recipe);
  const SetLayout layout(recipe);
  if (texels.size() != layout.total()) {
    throw std::invalid_argument("The texels do not have the size of the set of tables.");
  }
  if (table < 0 || table >= layout.tables()) {
    throw std::invalid_argument("The set has no table of this number.");
  }
  return SetFit(recipe, texels, progress).fit(table, progress);
}

}  // namespace lobelight
