#pragma once

#include <deque>
#include <vector>

#include "sg/mixture.h"

namespace lobelight {

// Steps longer than those of expectation maximisation. Near a maximum, each EM step multiplies the
// error along a direction by a factor of that direction; where lobes overlap the factor is close to
// 1, and EM is slow. The last few steps show these factors in the subspace that they span. In this
// subspace the step is Newton's, outside it EM's.
//
// This is Anderson's acceleration (Walker and Ni 2011, "Anderson acceleration for fixed-point
// iterations") with two changes that make it suitable for maximisation. The factors come from the
// symmetric part of the projected Jacobian, in the metric of the complete-data Fisher information:
// EM's Jacobian is symmetric in that metric. And where a factor is above 1, which means that EM
// moves away from a saddle, the step goes on in EM's direction and not back, as in the saddle-free
// Newton method (Dauphin et al. 2014).
class EmAcceleration {
 public:
  // `longest_step`: see EmOptions.
  explicit EmAcceleration(double longest_step) : longest_step_(longest_step) {}

  // Call this once after each EM step, with the lobes before and after it. Returns the lobes to
  // continue with; weights sum to 1. The first steps are EM's own.
  Mixture propose(const Mixture& before, const Mixture& after);

  // The number of steps that are remembered: as many as Matrix3 has rows. Two to four work equally
  // well.
  static constexpr std::size_t kMemory = 3;
  // Each EM step is assumed to shrink the error by at least this share. So no step is longer than
  // 1/0.03 times EM's.
  static constexpr double kLeastContraction = 0.03;

 private:
  using Vector = std::vector<double>;
  // Differences between successive calls, newest first: of the lobes and of EM's step.
  struct Difference {
    Vector place;
    Vector step;
  };

  double longest_step_;
  std::deque<Difference> memory_;
  Vector previous_place_;
  Vector previous_step_;
};

}  // namespace lobelight
