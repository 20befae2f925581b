#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "fit/slice.h"
#include "sg/mixture.h"

namespace lobelight {

// Coloured slices: lobes are fitted to the mean of the three channels. The channels share the
// lobes' means and sharpnesses; each has weights of its own.

// The channels' quadrature weights at the nodes of a slice of `brdf` for the view o: their mean is
// slice.weights.
std::vector<glm::dvec3> channel_node_weights(const Brdf& brdf, const glm::dvec3& o,
                                             const Slice& slice);

// The weights of each lobe in the three channels, by maximum likelihood with the lobes' means and
// sharpnesses fixed. Each iteration sets w_k ← Σ_n w_n w_k g_k(n) / Σ_j w_j g_j(n), beginning with
// `start`. The likelihood is concave in the weights, so similar lobes in neighbouring views get
// similar weights. A channel's weights sum to its albedo; a black channel's are 0.
//
// `log_densities` has log g_k at node n at index k · nodes + n; `start` has the lobes' weights.
std::vector<glm::dvec3> channel_weights(const std::vector<glm::dvec3>& node_weights,
                                        const std::vector<double>& log_densities,
                                        const std::vector<double>& start, int iterations = 100);

// The same for a mixture of spherical Gaussians.
std::vector<glm::dvec3> channel_weights(const Slice& slice,
                                        const std::vector<glm::dvec3>& node_weights,
                                        const Mixture& mixture, int iterations = 100);

}  // namespace lobelight
