#include "godot/lobe_baker.h"

#include <cmath>
#include <cstring>
#include <exception>
#include <glm/geometric.hpp>
#include <godot_cpp/variant/utility_functions.hpp>
#include <limits>
#include <stdexcept>

#include "brdf/measured.h"
#include "fit/slice.h"
#include "fit/table_fitter.h"
#include "godot/convert.h"
#include "godot/request.h"

using namespace godot;

namespace lobelight {

namespace {

Recipe read_recipe(const Dictionary& values) {
  const Request request(values, "a recipe",
                        {"brdf", "alpha", "lobes", "views", "method", "seed", "threads"});
  Recipe recipe;
  recipe.brdf = request.text("brdf", recipe.brdf);
  if (is_measured_file(recipe.brdf)) {
    recipe.brdf = file_system_path(to_godot(recipe.brdf));
    recipe.alpha = glm::dvec2(0.0);
  }
  recipe.alpha = request.widths("alpha", recipe.alpha);
  recipe.lobes = request.integer("lobes", recipe.lobes);
  recipe.views = request.counts("views", recipe.views);
  recipe.method = fit_method_from_string(request.text("method", to_string(recipe.method)));
  recipe.seed = request.unsigned_integer("seed", recipe.seed);
  recipe.threads = request.integer("threads", recipe.threads);
  validate(recipe);
  return recipe;
}

PackedByteArray texels(const LobeTable& table) {
  const std::vector<std::uint16_t> halves = table.to_rgba16f();
  const std::size_t size = halves.size() * sizeof(halves[0]);
  PackedByteArray bytes;
  bytes.resize(static_cast<std::int64_t>(size));
  std::memcpy(bytes.ptrw(), halves.data(), size);
  return bytes;
}

Dictionary bake_recipe(const Recipe& recipe, Progress& progress) {
  FitReport report;
  const std::unique_ptr<Brdf> brdf = make_brdf(recipe.brdf, recipe.alpha);
  const LobeTable table = fit_table(*brdf, recipe, progress, &report);
  Dictionary result;
  result["brdf"] = to_godot(brdf->name());
  result["alpha"] = to_godot(table.alpha());
  result["lobes"] = table.lobes();
  result["views"] = to_godot(table.views());
  result["method"] = to_godot(to_string(recipe.method));
  result["seed"] = recipe.seed;
  result["width"] = table.width();
  result["height"] = table.height();
  result["data"] = texels(table);
  result["seconds"] = report.seconds;
  result["iterations"] = to_godot(report.iterations);
  result["log_likelihood"] = to_godot(report.log_likelihood);
  if (const auto* measured = dynamic_cast<const MeasuredBrdf*>(brdf.get())) {
    result["clamped"] = static_cast<std::int64_t>(measured->clamped());
    result["asymmetry"] = measured->asymmetry();
  }
  return result;
}

}  // namespace

void LobeBaker::_bind_methods() {
  ClassDB::bind_method(D_METHOD("bake", "recipe"), &LobeBaker::bake, DEFVAL(Dictionary()));
  ClassDB::bind_static_method("LobeBaker", D_METHOD("directional_albedo", "brdf", "alpha", "view"),
                              &LobeBaker::directional_albedo);
}

Dictionary LobeBaker::bake(const Dictionary& recipe) const { return run(recipe); }

LobeTask::Work LobeBaker::prepare(const Dictionary& recipe) const {
  return
      [recipe = read_recipe(recipe)](Progress& progress) { return bake_recipe(recipe, progress); };
}

double LobeBaker::directional_albedo(const String& brdf, const Vector2& alpha,
                                     const Vector3& view) {
  try {
    const glm::dvec3 direction(view.x, view.y, view.z);
    const double length = glm::length(direction);
    if (!(direction.z > 0.0) || !std::isfinite(length)) {
      throw std::invalid_argument("view must point above the horizon: its z must be positive.");
    }
    const std::string given = to_std(brdf);
    const std::unique_ptr<Brdf> model =
        make_brdf(is_measured_file(given) ? file_system_path(brdf) : given, {alpha.x, alpha.y});
    return sample_slice(*model, direction / length).albedo;
  } catch (const std::exception& error) {
    UtilityFunctions::push_error(to_godot(error.what()));
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace lobelight
