#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "fit/slice.h"
#include "sg/mixture.h"

namespace lobelight {

// A coloured slice is fitted by the mean of its channels; the channels then share the lobes' places
// and sharpnesses and differ in their weights.

// The channels' quadrature weights at the nodes of a slice of `brdf` for the view o: their mean is
// slice.weights.
std::vector<glm::dvec3> channel_node_weights(const Brdf& brdf, const glm::dvec3& o,
                                             const Slice& slice);

// Weights of each lobe in the three channels by maximum likelihood, lobes otherwise fixed: EM's two
// steps for the weights alone, w_k ← Σ_n w_n w_k g_k(n) / Σ_j w_j g_j(n), from the lobes' own
// weights on. The likelihood is concave in the weights, so neighbouring views get weights as alike
// as their lobes are. Each channel's weights sum to its albedo; where a channel is black they are
// 0.
//
// `log_densities`: log g_k at node n, at k · nodes + n; `start`: the lobes' weights.
std::vector<glm::dvec3> channel_weights(const std::vector<glm::dvec3>& node_weights,
                                        const std::vector<double>& log_densities,
                                        const std::vector<double>& start, int iterations = 100);

// The same for a mixture of spherical Gaussians.
std::vector<glm::dvec3> channel_weights(const Slice& slice,
                                        const std::vector<glm::dvec3>& node_weights,
                                        const Mixture& mixture, int iterations = 100);

}  // namespace lobelight
