#pragma once

// From a recipe to a table or a set of tables, with errors and reports. Everything here throws
// std::invalid_argument with one sentence for an invalid recipe, MeasuredFileError or ImageError
// for an invalid file, and Cancelled soon after `progress` is cancelled. Bytes are the same for any
// number of threads. bake/memory.h bounds the memory.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bake/lobe_count.h"
#include "base/progress.h"
#include "fit/roughness_fitter.h"
#include "fit/table_fitter.h"

namespace lobelight {

struct TableRequest {
  Recipe recipe;
  // Set for "lobes": "auto"; the recipe's own number of lobes is then ignored.
  std::optional<LobeTarget> target;
};

struct BakedTable {
  std::string brdf;  // a model's name, or a file's without its folder
  Recipe recipe;     // with the lobes that the table has, and where they are
  LobeTable table;
  FitReport report;
  std::vector<double> errors;  // view_errors(); none of refined tables, which hold no Gaussians
  std::optional<double> predicted_psnr;  // of "lobes": "auto"

  // For measured BRDFs; see the members of MeasuredBrdf with these names.
  struct Measurements {
    std::size_t clamped = 0;
    double asymmetry = 0.0;
  };
  std::optional<Measurements> measurements;
};

struct BakedSet {
  SetRecipe recipe;
  std::vector<std::uint16_t> texels;  // as SetLayout has them
  double seconds = 0.0;
};

// Quick, as no file is read. Also refuses bakes that need too much memory (bake/memory.h).
void validate(const TableRequest& request);
void validate_set(const SetRecipe& recipe);

BakedTable bake_table(const TableRequest& request, Progress& progress,
                      const LobeCountOptions& options = {});
BakedSet bake_set(const SetRecipe& recipe, Progress& progress);

}  // namespace lobelight
