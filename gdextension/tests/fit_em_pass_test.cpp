#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "fit/em_pass.h"
#include "fit/initial_guess.h"

namespace lobelight {
namespace {

Mixture start_for(const Slice& slice, int lobes) {
  Mixture mixture = initial_guess(slice, lobes);
  for (Lobe& lobe : mixture) lobe.weight /= slice.albedo;
  return mixture;
}

// The slice's share of lobe k at node n, and the log-likelihood, by long double arithmetic.
struct Direct {
  long double log_likelihood = 0.0L;
  std::vector<std::vector<long double>> share;
};

Direct direct_expectation(const Slice& slice, const Mixture& mixture) {
  Direct direct;
  direct.share.assign(mixture.size(), std::vector<long double>(slice.weights.size()));
  for (std::size_t n = 0; n < slice.weights.size(); ++n) {
    long double sum = 0.0L;
    for (std::size_t k = 0; k < mixture.size(); ++k) {
      direct.share[k][n] =
          static_cast<long double>(mixture[k].weight) *
          std::exp(static_cast<long double>(log_density(mixture[k].gaussian, slice.directions[n])));
      sum += direct.share[k][n];
    }
    const long double weight = static_cast<long double>(slice.weights[n] / slice.albedo);
    direct.log_likelihood += weight * std::log(sum);
    for (auto& share : direct.share) share[n] *= weight / sum;
  }
  return direct;
}

TEST_CASE("A pass gives the likelihood and the moments that long double sums give") {
  for (const glm::dvec2& alpha : {glm::dvec2(0.02, 0.02), glm::dvec2(0.1, 0.4)}) {
    const Slice slice = sample_slice(*make_brdf("ggx", alpha), {0.6, 0.0, 0.8}, 20);
    for (const int lobes : {1, 5, 16}) {
      const Mixture mixture = start_for(slice, lobes);
      const Direct direct = direct_expectation(slice, mixture);
      EmWorkspace workspace;
      std::vector<EmMoments> moments;
      const double log_likelihood = em_pass(EmNodes(slice), mixture, moments, workspace);
      CHECK(log_likelihood ==
            doctest::Approx(static_cast<double>(direct.log_likelihood)).epsilon(1e-13));
      REQUIRE(moments.size() == mixture.size());
      for (std::size_t k = 0; k < mixture.size(); ++k) {
        long double weight = 0.0L, spread = 0.0L, shift_x = 0.0L;
        for (std::size_t n = 0; n < slice.weights.size(); ++n) {
          const glm::dvec3 d = slice.directions[n] - mixture[k].gaussian.mean;
          weight += direct.share[k][n];
          shift_x += direct.share[k][n] * static_cast<long double>(d.x);
          spread += direct.share[k][n] * static_cast<long double>(glm::dot(d, d));
        }
        CHECK(moments[k].weight == doctest::Approx(static_cast<double>(weight)).epsilon(1e-12));
        CHECK(moments[k].spread == doctest::Approx(static_cast<double>(spread)).epsilon(1e-12));
        const double width = std::sqrt(moments[k].weight * moments[k].spread);
        CHECK(std::abs(moments[k].shift.x - static_cast<double>(shift_x)) < 1e-12 * width);
      }
    }
  }
}

TEST_CASE("A pass gives the same bits whatever the width of the registers") {
  // The widest set that the processor has is what is in use; all that it has are compared.
  CHECK(usable_simd().back() == widest_simd());
  for (const int nodes : {6, 31, 64}) {
    const Slice slice = sample_slice(*make_brdf("ward", {0.01, 0.3}), {0.9, 0.1, 0.42}, nodes);
    const EmNodes prepared(slice);
    for (const int lobes : {1, 3, 8, 32}) {
      const Mixture mixture = start_for(slice, lobes);
      EmWorkspace workspace;
      std::vector<EmMoments> expected;
      const double likelihood = em_pass(prepared, mixture, expected, workspace, Simd::baseline);
      for (const Simd simd : usable_simd()) {
        std::vector<EmMoments> moments;
        CHECK(em_pass(prepared, mixture, moments, workspace, simd) == likelihood);
        for (std::size_t k = 0; k < mixture.size(); ++k) {
          CHECK(moments[k].weight == expected[k].weight);
          CHECK(moments[k].shift == expected[k].shift);
          CHECK(moments[k].spread == expected[k].spread);
        }
      }
    }
  }
}

TEST_CASE("Nodes far from every lobe neither vanish nor poison the sums") {
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const glm::dvec3 side(1.0, 0.0, 0.0);
  const Slice slice{{up, side}, {0.25, 0.75}, 1.0};
  // Both densities at `side` are e^−1e8 and less: none of them is a double above 0.
  const Mixture mixture{{0.5, {up, 1e8}}, {0.5, {-up, 1e8}}};
  EmWorkspace workspace;
  std::vector<EmMoments> moments;
  const double log_likelihood = em_pass(EmNodes(slice), mixture, moments, workspace);
  CHECK(std::isfinite(log_likelihood));
  CHECK(moments[0].weight == doctest::Approx(0.25 + 0.75 / 2));
  CHECK(moments[1].weight == doctest::Approx(0.75 / 2));
}

}  // namespace
}  // namespace lobelight
