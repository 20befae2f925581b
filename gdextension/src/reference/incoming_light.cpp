#include "reference/incoming_light.h"

#include <cmath>
#include <cstddef>

namespace lobelight {

double sample_tent(double u) {
  return u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 * (1.0 - u));
}

ClusterChoice choose_in_proportion(const std::vector<double>& importance,
                                   const std::vector<double>& shares) {
  ClusterChoice choice;
  choice.cumulative.reserve(shares.size() + 1);
  choice.cumulative.push_back(0.0);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    choice.cumulative.push_back(choice.cumulative.back() + importance[k] * shares[k]);
  }
  const double total = choice.cumulative.back();
  if (!(total > 0.0) || !std::isfinite(total)) return {};
  for (double& value : choice.cumulative) value /= total;
  choice.scale.reserve(shares.size());
  for (const double value : importance) choice.scale.push_back(value / total);
  return choice;
}

}  // namespace lobelight
