#include "godot/lobe_baker.h"

#include <cstring>
#include <exception>
#include <godot_cpp/variant/utility_functions.hpp>
#include <limits>
#include <stdexcept>

#include "bake/bake.h"
#include "bake/slice_plot.h"
#include "brdf/measured.h"
#include "godot/convert.h"
#include "godot/request.h"

using namespace godot;

namespace lobelight {

namespace {

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
  validate_set(recipe);
  return recipe;
}

LobeTarget read_target(const Request& request) {
  LobeTarget target;
  target.psnr = request.real("target", target.psnr);
  target.max_lobes = request.integer("max_lobes", target.max_lobes);
  for (const std::string& path : request.texts("environments")) {
    target.environments.push_back(file_system_path(to_godot(path)));
  }
  return target;
}

TableRequest read_table_request(const Dictionary& values) {
  const Request request(values, "a recipe",
                        {"brdf", "alpha", "lobes", "views", "method", "refine", "placement",
                         "reach", "seed", "threads", "target", "max_lobes", "environments"});
  TableRequest table;
  Recipe& recipe = table.recipe;
  recipe.brdf = request.text("brdf", recipe.brdf);
  if (is_measured_file(recipe.brdf)) {
    recipe.brdf = file_system_path(to_godot(recipe.brdf));
    recipe.alpha = glm::dvec2(0.0);
  }
  recipe.alpha = request.widths("alpha", recipe.alpha);
  recipe.views = request.counts("views", recipe.views);
  recipe.method = fit_method_from_string(request.text("method", to_string(recipe.method)));
  recipe.refine = request.truth("refine", recipe.refine);
  recipe.placement = placement_from_string(request.text("placement", to_string(recipe.placement)));
  recipe.reach = request.real("reach", recipe.reach);
  recipe.seed = request.unsigned_integer("seed", recipe.seed);
  recipe.threads = request.integer("threads", recipe.threads);
  if (request.says("lobes", "auto")) {
    table.target = read_target(request);
  } else {
    recipe.lobes = request.integer("lobes", recipe.lobes);
    for (const char* key : {"target", "max_lobes", "environments"}) {
      if (request.has(key)) {
        throw std::invalid_argument(std::string(key) + " goes with lobes \"auto\" only.");
      }
    }
  }
  validate(table);
  return table;
}

Dictionary to_dictionary(const BakedTable& baked, const TableRequest& request) {
  const LobeTable& table = baked.table;
  Dictionary result;
  result["brdf"] = to_godot(baked.brdf);
  result["alpha"] = to_godot(table.alpha());
  result["lobes"] = table.lobes();
  result["views"] = to_godot(table.views());
  result["method"] = to_godot(to_string(baked.recipe.method));
  result["refine"] = baked.recipe.refine;
  result["placement"] = to_godot(to_string(baked.recipe.placement));
  if (baked.recipe.placement == Placement::arc) result["reach"] = baked.recipe.reach;
  result["seed"] = baked.recipe.seed;
  result["width"] = table.width();
  result["height"] = table.height();
  result["data"] = to_bytes(table.to_rgba16f());
  result["seconds"] = baked.report.seconds;
  result["iterations"] = to_godot(baked.report.iterations);
  result["log_likelihood"] = to_godot(baked.report.log_likelihood);
  result["first_view_curve"] = to_godot(baked.report.first_view_curve);
  if (!baked.errors.empty()) result["errors"] = to_godot(baked.errors);
  if (request.target) result["target"] = request.target->psnr;
  if (baked.predicted_psnr) result["predicted_psnr"] = *baked.predicted_psnr;
  if (baked.measurements) {
    result["clamped"] = static_cast<std::int64_t>(baked.measurements->clamped);
    result["asymmetry"] = baked.measurements->asymmetry;
  }
  return result;
}

Dictionary to_dictionary(const BakedSet& baked) {
  const SetRecipe& recipe = baked.recipe;
  Array widths;
  for (const double width : recipe.widths) widths.append(width);
  Dictionary result;
  result["brdf"] = to_godot(recipe.brdf);
  result["widths"] = widths;
  result["lobes"] = recipe.lobes;
  result["views"] = to_godot(recipe.views);
  result["seed"] = recipe.seed;
  result["width"] = recipe.views.x;
  result["height"] = static_cast<std::int64_t>(baked.texels.size()) / (4 * recipe.views.x);
  result["data"] = to_bytes(baked.texels);
  result["seconds"] = baked.seconds;
  return result;
}

std::string brdf_name(const String& brdf) {
  const std::string name = to_std(brdf);
  return is_measured_file(name) ? file_system_path(brdf) : name;
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
      return to_dictionary(bake_set(recipe, progress));
    };
  }
  return [request = read_table_request(recipe)](Progress& progress) {
    return to_dictionary(bake_table(request, progress), request);
  };
}

double LobeBaker::directional_albedo(const String& brdf, const Vector2& alpha,
                                     const Vector3& view) {
  try {
    return lobelight::directional_albedo(brdf_name(brdf), to_widths(alpha), to_core(view));
  } catch (const std::exception& error) {
    UtilityFunctions::push_error(to_godot(error.what()));
    return std::numeric_limits<double>::quiet_NaN();
  }
}

PackedFloat32Array LobeBaker::slice_in_plane(const String& brdf, const Vector2& alpha,
                                             const Vector3& view, int count) {
  try {
    return to_godot(
        lobelight::slice_in_plane(brdf_name(brdf), to_widths(alpha), to_core(view), count));
  } catch (const std::exception& error) {
    UtilityFunctions::push_error(to_godot(error.what()));
    return PackedFloat32Array();
  }
}

}  // namespace lobelight
