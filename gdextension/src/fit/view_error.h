#pragma once

#include <vector>

#include "base/progress.h"
#include "brdf/brdf.h"
#include "table/lobe_table.h"

namespace lobelight {

// The relative L1 error ∫ |m − f| / ∫ f of a mixture m, scaled to the mass of the slice f = ρ(i, o)
// i_z. As both have the same mass it is 2 ∫ max(0, f − m) / ∫ f, which needs nodes only where f is.
// The nodes are not those that mixtures are fitted to.
double l1_error(const Brdf& brdf, const glm::dvec3& o, const Mixture& mixture);

// l1_error() at the views of a table; view (t, p) is element p · T + t. `threads` as for
// parallel_for(). Throws Cancelled.
std::vector<double> view_errors(const LobeTable& table, const Brdf& brdf, int threads,
                                Progress& progress);

}  // namespace lobelight
