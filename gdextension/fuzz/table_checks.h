#pragma once

#include <cstdint>

#include "brdf/brdf.h"
#include "fit/table_fitter.h"

namespace lobelight::fuzz {

// Fits that cost little: few nodes and iterations.
FitOptions tiny_fit();

// What has to hold of the table of `brdf` that a fit with these options has made: lobes that are
// numbers, with weights that add up to the slice's light, of no less than 0 but where least squares
// may take a little away, and a texture that holds them.
void accept_table(const LobeTable& table, const Brdf& brdf, const Recipe& recipe,
                  const FitOptions& options);

}  // namespace lobelight::fuzz
