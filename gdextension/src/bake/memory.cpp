#include "bake/memory.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include "base/one_line.h"
#include "base/parallel.h"
#include "brdf/measured.h"
#include "fit/memory.h"

namespace lobelight {

namespace {

std::size_t count(int value) { return static_cast<std::size_t>(std::max(value, 0)); }

// A lobe's texel as the core has it and as the engine's array has it.
constexpr std::size_t kTexelBytes = 2 * 4 * sizeof(std::uint16_t);

// What is said of a view beside the lobes: its error twice, and copies of the report's numbers.
constexpr std::size_t kViewBytes = 24;

// Of measurements: the file's numbers as doubles and their integrals, and the samples' tables.
constexpr std::size_t kFileFactor = 6;
constexpr std::size_t kSampleTables = std::size_t{16} << 20;

constexpr std::size_t kBesides = 1 << 20;

// Of the environments' texels.
constexpr std::size_t kLightBytes = 76;
constexpr std::size_t kSampledBytes = 50;

// A set's table on its way, for each of its texels: its start, its model, the result, a blend of
// the parents, and their halves.
constexpr std::size_t kSetTexelBytes = 176;

std::size_t file_bytes(const std::string& path) {
  std::error_code missing;
  const std::uintmax_t size = std::filesystem::file_size(std::filesystem::u8path(path), missing);
  // What is wrong with the file is said when it is read.
  return missing ? 0 : static_cast<std::size_t>(size);
}

std::string gibibytes(std::size_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g GiB", static_cast<double>(bytes) / (1 << 30));
  return text;
}

void check(std::size_t bound, const std::string& what) {
  if (bound <= kMemoryLimit) return;
  throw std::invalid_argument(what + ", which takes " + gibibytes(bound) +
                              " of memory, but may take at most " + gibibytes(kMemoryLimit) + ".");
}

std::size_t picture_bytes(int width, int height) { return count(width) * count(height) * 48; }

}  // namespace

std::size_t memory_bound(const TableRequest& request) {
  Recipe recipe = request.recipe;
  if (request.target) recipe.lobes = request.target->max_lobes;
  const bool is_file = is_measured_file(recipe.brdf);
  recipe.views = resolve_views(recipe, !is_file && recipe.alpha.x == recipe.alpha.y);
  const std::size_t views = count(recipe.views.x) * count(recipe.views.y);
  const std::size_t lobes = count(recipe.lobes);
  std::size_t bound =
      kBesides + fit_memory_bound(recipe) + views * (lobes * kTexelBytes + kViewBytes);
  if (is_file) {
    const std::size_t threads = std::min(views, count(resolve_threads(recipe.threads)));
    const std::size_t nodes =
        count(FitOptions().nodes_per_axis) * count(FitOptions().nodes_per_axis);
    bound += kFileFactor * file_bytes(recipe.brdf) + kSampleTables;
    // Second texels, and each view's channels at the nodes and the lobes' densities there.
    bound += views * lobes * (sizeof(LobeTable::Entry) + kTexelBytes);
    bound += threads * nodes * (sizeof(glm::dvec3) + 2 * sizeof(double) * lobes);
  }
  if (request.target) {
    const std::size_t texels = count(kEnvironmentWidth) * count(kEnvironmentHeight);
    const std::size_t environments = request.target->environments.size();
    bound += 8 * kBesides + environments * texels * kLightBytes;
    if (environments > 0) bound += texels * kSampledBytes;
  }
  return bound;
}

std::size_t memory_bound(const SetRecipe& recipe) {
  const SetLayout layout(recipe);
  Recipe table;
  table.lobes = recipe.lobes;
  table.views = layout.views(0);
  table.placement = Placement::em;
  const std::size_t threads =
      std::min(count(layout.tables()), count(resolve_threads(recipe.threads)));
  table.threads = static_cast<int>(threads);
  // fit_memory_bound() of one table has the working memory of as many threads as it has views.
  table.views.x = std::max(table.views.x, table.threads);
  const std::size_t one = layout.size(0) / 4;
  return kBesides + fit_memory_bound(table) + layout.total() / 4 * kTexelBytes +
         threads * one * kSetTexelBytes;
}

std::size_t memory_bound(const SphereRequest& request, int environment_width,
                         int environment_height) {
  const std::size_t pictures = request.room ? kWalls : 1;
  std::size_t bound =
      kBesides + picture_bytes(request.options.size, request.options.size) +
      pictures * count(environment_width) * count(environment_height) * kSampledBytes +
      // Points of both samplers, a quarter of them at a time.
      4 * count(request.options.samples);
  if (is_measured_file(request.brdf)) {
    bound += kFileFactor * file_bytes(request.brdf) + kSampleTables;
  }
  return bound;
}

void check_memory(const TableRequest& request) {
  TableRequest without = request;
  if (without.target) without.target->environments.clear();
  if (is_measured_file(request.recipe.brdf)) {
    check(memory_bound(without), "brdf is \"" + one_line(request.recipe.brdf) + "\", a file of " +
                                     gibibytes(file_bytes(request.recipe.brdf)));
  }
  if (!request.target) return;
  check(memory_bound(request),
        "environments has " + std::to_string(request.target->environments.size()) + " paths");
}

void check_memory(const SetRecipe& recipe) {
  std::ostringstream set;
  set << "widths has " << recipe.widths.size() << " numbers, lobes is " << recipe.lobes
      << " and views is (" << recipe.views.x << ", " << recipe.views.y << ")";
  const std::size_t texels = SetLayout(recipe).total() / 4;
  if (texels > kMaxImageTexels) {
    set << ", which makes " << texels << " texels, but an image of the engine holds at most "
        << kMaxImageTexels << ".";
    throw std::invalid_argument(set.str());
  }
  check(memory_bound(recipe), set.str());
}

void check_memory(const SphereRequest& request, int environment_width, int environment_height) {
  check(memory_bound(request, environment_width, environment_height),
        environment_width > 0
            ? (request.room ? "walls has a picture of " : "env is a panorama of ") +
                  std::to_string(environment_width) + " x " + std::to_string(environment_height) +
                  " texels"
            : "size is " + std::to_string(request.options.size) + " and brdf is \"" +
                  one_line(request.brdf) + "\"");
}

}  // namespace lobelight
