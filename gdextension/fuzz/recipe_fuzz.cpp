// Recipes of tables and of sets. An input is the fields one behind the other, then the material's
// name; what is missing is 0. Recipes that are accepted and small are fitted.

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "brdf/measured.h"
#include "checks.h"
#include "fit/memory.h"
#include "fit/roughness_fitter.h"
#include "table_checks.h"

namespace lobelight::fuzz {

const char* const kReader = "recipe";

namespace {

struct Fields {
  std::uint8_t is_set, method, refine, widths;
  std::int32_t lobes, views_x, views_y, threads;
  std::uint32_t placement;
  std::uint64_t seed;
  double alpha_x, alpha_y, reach;
};

// What `placement` says, modulo three.
enum : std::uint32_t { kAutomatic, kEm, kArc };
constexpr std::array kPlacements{Placement::automatic, Placement::em, Placement::arc};

constexpr int kMostTexels = 24;
constexpr std::size_t kMostWidths = 80;

Bytes bytes_of(const Fields& fields, const std::vector<double>& widths, const std::string& name) {
  Bytes bytes;
  const auto append = [&](const void* from, std::size_t count) {
    const auto* const begin = static_cast<const std::uint8_t*>(from);
    bytes.insert(bytes.end(), begin, begin + count);
  };
  append(&fields, sizeof fields);
  for (const double width : widths) append(&width, sizeof width);
  append(name.data(), name.size());
  return bytes;
}

bool is_small(int lobes, const glm::ivec2& views) {
  return lobes * views.x * views.y <= kMostTexels;
}

void check_table(const Recipe& recipe) {
  validate(recipe);
  ++counts.accepted;
  const FitOptions options = tiny_fit();
  require(fit_memory_bound(recipe, options) > 0, "takes no memory, as its bound has it");
  if (is_measured_file(recipe.brdf) || !is_small(recipe.lobes, resolve_views(recipe))) return;
  const auto brdf = make_brdf(recipe.brdf, recipe.alpha);
  Progress progress;
  accept_table(fit_table(recipe, progress, nullptr, options), *brdf, recipe, options);
}

void check_set(const SetRecipe& recipe) {
  validate(recipe);
  ++counts.accepted;
  const SetLayout layout(recipe);
  require(layout.total() > 0, "has tables of no size");
}

}  // namespace

std::vector<Bytes> seeds() {
  const double width = 0.3;
  return {
      bytes_of({0, 1, 0, 0, 2, 3, 1, 1, kEm, 7, width, width, 0.0}, {}, "ggx"),
      bytes_of({0, 1, 0, 0, 3, 3, 1, 1, kAutomatic, 7, width, width, 0.0}, {}, "ggx"),
      bytes_of({0, 1, 1, 0, 1, 2, 2, 2, kEm, 0, 0.1, width, 0.0}, {}, "ward"),
      bytes_of({0, 0, 0, 0, 3, 2, 2, 0, kAutomatic, 1, 1.0, 0.01, 0.0}, {}, "ward_bounded"),
      bytes_of({0, 1, 0, 0, 3, 2, 2, 1, kArc, 1, 1.0, 0.01, 2.0}, {}, "ward"),
      bytes_of({0, 1, 0, 0, 2, 2, 3, 1, kArc, 1, 0.02, width, 0.0}, {}, "ggx"),
      bytes_of({0, 1, 0, 0, 32, 256, 256, 0, kAutomatic, 1, 0.0, 0.0, 0.0}, {}, "file.binary"),
      bytes_of({1, 0, 0, 3, 4, 16, 8, 0, kAutomatic, 1, 0.0, 0.0, 0.0}, {0.1, 0.2, 0.4}, "ggx"),
  };
}

}  // namespace lobelight::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lobelight;
  fuzz::Fields fields{};
  const std::size_t length = std::min(size, sizeof fields);
  if (length > 0) std::memcpy(&fields, data, length);
  data += length;
  size -= length;
  std::vector<double> widths(
      std::min({fuzz::kMostWidths, std::size_t{fields.widths}, size / sizeof(double)}));
  if (!widths.empty()) std::memcpy(widths.data(), data, widths.size() * sizeof(double));
  data += widths.size() * sizeof(double);
  size -= widths.size() * sizeof(double);
  const std::string name(reinterpret_cast<const char*>(data), size);
  try {
    if (fields.is_set != 0) {
      SetRecipe recipe;
      recipe.brdf = name;
      recipe.widths = widths;
      recipe.lobes = fields.lobes;
      recipe.views = {fields.views_x, fields.views_y};
      recipe.seed = fields.seed;
      recipe.threads = fields.threads;
      fuzz::check_set(recipe);
      return 0;
    }
    Recipe recipe;
    recipe.brdf = name;
    recipe.alpha = {fields.alpha_x, fields.alpha_y};
    recipe.lobes = fields.lobes;
    recipe.views = {fields.views_x, fields.views_y};
    recipe.method = fields.method != 0 ? FitMethod::continuation : FitMethod::independent;
    recipe.refine = fields.refine != 0;
    recipe.placement = fuzz::kPlacements[fields.placement % fuzz::kPlacements.size()];
    recipe.reach = fields.reach;
    recipe.seed = fields.seed;
    recipe.threads = fields.threads;
    fuzz::check_table(recipe);
  } catch (const std::invalid_argument& error) {
    fuzz::refuse(error.what(), "");
  }
  return 0;
}
