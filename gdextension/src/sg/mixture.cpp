#include "sg/mixture.h"

namespace lobelight {

double evaluate(const Mixture& mixture, const glm::dvec3& direction) {
  double sum = 0.0;
  for (const Lobe& lobe : mixture) sum += lobe.weight * density(lobe.gaussian, direction);
  return sum;
}

double total_weight(const Mixture& mixture) {
  double sum = 0.0;
  for (const Lobe& lobe : mixture) sum += lobe.weight;
  return sum;
}

}  // namespace lobelight
