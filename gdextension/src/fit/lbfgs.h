#pragma once

#include <functional>
#include <vector>

#include "base/progress.h"

namespace lobelight {

// The value of a function at `x`; writes its gradient, of x's size. Infinity where it is not
// defined.
using Objective =
    std::function<double(const std::vector<double>& x, std::vector<double>& gradient)>;

struct LbfgsOptions {
  int max_iterations = 30;
  // Stops when an iteration lowers the value by less than this.
  double tolerance = 1e-6;
  // No variable changes by more than this in one iteration.
  double longest_step = 0.3;
  // Asked between iterations whether to stop; may be null.
  const Progress* progress = nullptr;
};

struct LbfgsResult {
  std::vector<double> x;
  std::vector<double> values;  // of the start, then after each iteration; never rises
  bool converged = false;      // stopped by the tolerance or where no step leads lower
};

// Minimises from `start` on: L-BFGS (Nocedal and Wright 2006, "Numerical Optimization", algorithms
// 7.4 and 7.5) with steps that are halved until the value falls enough (Armijo's rule). Kinks, as
// they are in the objective where a variance is a level's, cost steps but do no harm. Throws
// Cancelled.
LbfgsResult minimise(const Objective& objective, std::vector<double> start,
                     const LbfgsOptions& options = {});

}  // namespace lobelight
