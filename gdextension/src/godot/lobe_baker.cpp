#include "godot/lobe_baker.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <glm/geometric.hpp>
#include <godot_cpp/variant/utility_functions.hpp>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <tuple>

#include "base/pi.h"
#include "brdf/measured.h"
#include "fit/roughness_fitter.h"
#include "fit/slice.h"
#include "fit/table_fitter.h"
#include "fit/view_error.h"
#include "godot/convert.h"
#include "godot/lobe_count.h"
#include "godot/request.h"

using namespace godot;

namespace lobelight {

namespace {

constexpr int kMaxPlaneDirections = 100000;

// The recipe of a set of tables: one with "widths" instead of "alpha".
SetRecipe read_set_recipe(const Dictionary& values) {
  const Request request(values, "a recipe for a set of tables",
                        {"brdf", "widths", "lobes", "views", "seed", "threads"});
  SetRecipe recipe;
  recipe.brdf = request.text("brdf", recipe.brdf);
  recipe.widths = request.numbers("widths");
  recipe.lobes = request.integer("lobes", recipe.lobes);
  recipe.views = request.counts("views", recipe.views);
  recipe.seed = request.unsigned_integer("seed", recipe.seed);
  recipe.threads = request.integer("threads", recipe.threads);
  validate(recipe);
  return recipe;
}

// "lobes": "auto".
bool asks_for_count(const Request& request) { return request.says("lobes", "auto"); }

LobeCountRequest read_count_request(const Request& request, const Recipe& recipe) {
  LobeCountRequest count;
  if (recipe.refine) {
    throw std::invalid_argument(
        "refine is true, but \"auto\" counts Gaussians: lobes must be a number.");
  }
  count.recipe = recipe;
  count.target = request.real("target", count.target);
  count.max_lobes = request.integer("max_lobes", count.max_lobes);
  for (const std::string& path : request.texts("environments")) {
    count.environments.push_back(file_system_path(to_godot(path)));
  }
  validate(count);
  return count;
}

Recipe read_recipe(const Request& request) {
  Recipe recipe;
  recipe.brdf = request.text("brdf", recipe.brdf);
  if (is_measured_file(recipe.brdf)) {
    recipe.brdf = file_system_path(to_godot(recipe.brdf));
    recipe.alpha = glm::dvec2(0.0);
  }
  recipe.alpha = request.widths("alpha", recipe.alpha);
  if (!asks_for_count(request)) recipe.lobes = request.integer("lobes", recipe.lobes);
  recipe.views = request.counts("views", recipe.views);
  recipe.method = fit_method_from_string(request.text("method", to_string(recipe.method)));
  recipe.refine = request.truth("refine", recipe.refine);
  recipe.seed = request.unsigned_integer("seed", recipe.seed);
  recipe.threads = request.integer("threads", recipe.threads);
  validate(recipe);
  return recipe;
}

Dictionary to_dictionary(const LobeTable& table, const FitReport& report, const Brdf& brdf,
                         const Recipe& recipe, Progress& progress) {
  Dictionary result;
  result["brdf"] = to_godot(brdf.name());
  result["alpha"] = to_godot(table.alpha());
  result["lobes"] = table.lobes();
  result["views"] = to_godot(table.views());
  result["method"] = to_godot(to_string(recipe.method));
  result["refine"] = recipe.refine;
  result["seed"] = recipe.seed;
  result["width"] = table.width();
  result["height"] = table.height();
  result["data"] = to_bytes(table.to_rgba16f());
  result["seconds"] = report.seconds;
  result["iterations"] = to_godot(report.iterations);
  result["log_likelihood"] = to_godot(report.log_likelihood);
  result["first_view_curve"] = to_godot(report.first_view_curve);
  // Refined lobes do not stand for Gaussians.
  if (!recipe.refine)
    result["errors"] = to_godot(view_errors(table, brdf, recipe.threads, progress));
  if (const auto* measured = dynamic_cast<const MeasuredBrdf*>(&brdf)) {
    result["clamped"] = static_cast<std::int64_t>(measured->clamped());
    result["asymmetry"] = measured->asymmetry();
  }
  return result;
}

Dictionary bake_recipe(const Recipe& recipe, Progress& progress) {
  FitReport report;
  const std::unique_ptr<Brdf> brdf = make_brdf(recipe.brdf, recipe.alpha);
  const LobeTable table = fit_table(*brdf, recipe, progress, &report);
  Progress errors(progress, 0.0);
  return to_dictionary(table, report, *brdf, recipe, errors);
}

Dictionary bake_enough_lobes(const LobeCountRequest& request, Progress& progress) {
  const std::unique_ptr<Brdf> brdf = make_brdf(request.recipe.brdf, request.recipe.alpha);
  const LobeCount found = find_lobe_count(request, *brdf, progress);
  Progress errors(progress, 0.0);
  Dictionary result = to_dictionary(found.table, found.report, *brdf, request.recipe, errors);
  result["target"] = request.target;
  result["predicted_psnr"] = found.trials.back().psnr;
  return result;
}

Dictionary bake_set(const SetRecipe& recipe, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::uint16_t> texels = fit_table_set(recipe, progress);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  Array widths;
  for (const double width : recipe.widths) widths.append(width);
  Dictionary result;
  result["brdf"] = to_godot(recipe.brdf);
  result["widths"] = widths;
  result["lobes"] = recipe.lobes;
  result["views"] = to_godot(recipe.views);
  result["seed"] = recipe.seed;
  result["width"] = recipe.views.x;
  result["height"] = static_cast<std::int64_t>(texels.size()) / (4 * recipe.views.x);
  result["data"] = to_bytes(texels);
  result["seconds"] = elapsed.count();
  return result;
}

// The model or the file's measurements. Measurements are kept for the next call: they take a while
// to read, and plots ask for many slices of them.
std::shared_ptr<const Brdf> find_brdf(const String& brdf, const Vector2& alpha) {
  const std::string given = to_std(brdf);
  const glm::dvec2 widths(alpha.x, alpha.y);
  if (!is_measured_file(given)) return make_brdf(given, widths);
  static std::mutex mutex;
  static std::shared_ptr<const Brdf> kept;
  static std::tuple<std::string, std::filesystem::file_time_type, double, double> kept_key;
  const std::string path = file_system_path(brdf);
  std::error_code missing;
  const auto time = std::filesystem::last_write_time(std::filesystem::u8path(path), missing);
  const auto key = std::make_tuple(path, time, widths.x, widths.y);
  const std::lock_guard lock(mutex);
  if (!kept || kept_key != key) {
    kept = make_brdf(path, widths);
    kept_key = key;
  }
  return kept;
}

// Unit vector; throws std::invalid_argument unless it is above the horizon.
glm::dvec3 read_view(const Vector3& view) {
  const glm::dvec3 direction(view.x, view.y, view.z);
  const double length = glm::length(direction);
  if (!(direction.z > 0.0) || !std::isfinite(length)) {
    throw std::invalid_argument("view must point above the horizon: its z must be positive.");
  }
  return direction / length;
}

}  // namespace

void LobeBaker::_bind_methods() {
  ClassDB::bind_method(D_METHOD("refit", "recipe", "data", "table"), &LobeBaker::refit);
  ClassDB::bind_method(D_METHOD("bake", "recipe"), &LobeBaker::bake, DEFVAL(Dictionary()));
  ClassDB::bind_static_method("LobeBaker", D_METHOD("directional_albedo", "brdf", "alpha", "view"),
                              &LobeBaker::directional_albedo);
  ClassDB::bind_static_method("LobeBaker",
                              D_METHOD("slice_in_plane", "brdf", "alpha", "view", "count"),
                              &LobeBaker::slice_in_plane, DEFVAL(181));
}

Dictionary LobeBaker::bake(const Dictionary& recipe) const { return run(recipe); }

Dictionary LobeBaker::refit(const Dictionary& recipe, const PackedByteArray& data,
                            int table) const {
  try {
    std::vector<std::uint16_t> texels(static_cast<std::size_t>(data.size()) /
                                      sizeof(std::uint16_t));
    if (!texels.empty()) std::memcpy(texels.data(), data.ptr(), texels.size() * sizeof(texels[0]));
    Progress progress;
    Dictionary result;
    result["data"] = to_bytes(refit_table(read_set_recipe(recipe), texels, table, progress));
    return result;
  } catch (const std::exception& error) {
    return error_result(error.what());
  }
}

LobeTask::Work LobeBaker::prepare(const Dictionary& recipe) const {
  if (recipe.has("widths")) {
    return [recipe = read_set_recipe(recipe)](Progress& progress) {
      return bake_set(recipe, progress);
    };
  }
  const Request request(recipe, "a recipe",
                        {"brdf", "alpha", "lobes", "views", "method", "refine", "seed", "threads",
                         "target", "max_lobes", "environments"});
  const Recipe read = read_recipe(request);
  if (asks_for_count(request)) {
    return [count = read_count_request(request, read)](Progress& progress) {
      return bake_enough_lobes(count, progress);
    };
  }
  for (const char* key : {"target", "max_lobes", "environments"}) {
    if (request.has(key)) {
      throw std::invalid_argument(std::string(key) + " goes with lobes \"auto\" only.");
    }
  }
  return [read](Progress& progress) { return bake_recipe(read, progress); };
}

double LobeBaker::directional_albedo(const String& brdf, const Vector2& alpha,
                                     const Vector3& view) {
  try {
    return sample_slice(*find_brdf(brdf, alpha), read_view(view)).albedo;
  } catch (const std::exception& error) {
    UtilityFunctions::push_error(to_godot(error.what()));
    return std::numeric_limits<double>::quiet_NaN();
  }
}

PackedFloat32Array LobeBaker::slice_in_plane(const String& brdf, const Vector2& alpha,
                                             const Vector3& view, int count) {
  try {
    if (count < 2 || count > kMaxPlaneDirections) {
      throw std::invalid_argument("count must be from 2 to 100000.");
    }
    const glm::dvec3 o = read_view(view);
    const double side = std::hypot(o.x, o.y);
    const glm::dvec2 azimuth = side > 0.0 ? glm::dvec2(o.x, o.y) / side : glm::dvec2(1.0, 0.0);
    const std::shared_ptr<const Brdf> model = find_brdf(brdf, alpha);
    std::vector<double> values;
    for (int n = 0; n < count; ++n) {
      const double angle = kPi * (n / (count - 1.0) - 0.5);
      const glm::dvec3 i(std::sin(angle) * azimuth, std::cos(angle));
      values.push_back(model->evaluate(i, o) * i.z);
    }
    return to_godot(values);
  } catch (const std::exception& error) {
    UtilityFunctions::push_error(to_godot(error.what()));
    return PackedFloat32Array();
  }
}

}  // namespace lobelight
