#pragma once

#include <cmath>

#include "brdf/brdf.h"
#include "table/lobe_table.h"

namespace lobelight {

// Mean and greatest of the L1 errors ∫ |m − f| / ∫ f of several views.
struct Errors {
  double sum = 0.0;
  double worst = 0.0;
  int count = 0;

  void add(double error) {
    sum += error;
    // What is no number is the worst, and stays it.
    if (!(error <= worst) && !std::isnan(worst)) worst = error;
    ++count;
  }
  double mean_per_cent() const { return 100.0 * sum / count; }
  double worst_per_cent() const { return 100.0 * worst; }
};

struct TableErrors {
  Errors at_views;
  Errors between_views;  // half-way between the grid's views
};

// The error of a table's mixtures, scaled to the slice's albedo, against ρ(i, o) i_z. Between views
// a table is interpolated.
TableErrors table_errors(const LobeTable& table, const Brdf& brdf);

}  // namespace lobelight
