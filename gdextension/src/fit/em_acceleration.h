#pragma once

#include <deque>
#include <vector>

#include "sg/mixture.h"

namespace lobelight {

// Steps that go further than expectation maximisation does. Close to a maximum EM shrinks the error
// along each direction by a factor of its own, and by next to nothing along directions in which
// lobes overlap. The last few steps tell these factors within the subspace that they span: there
// the step is Newton's, outside it is EM's.
//
// This is Anderson's acceleration (Walker and Ni 2011, "Anderson acceleration for fixed-point
// iterations") but for two things that make it fit to climb: the factors are taken from the
// part of the projected Jacobian that is symmetric in the metric of the complete-data Fisher
// information, in which EM's Jacobian is symmetric; and a direction in which EM moves away from a
// saddle (factor above 1) is followed forwards instead of backwards, as in the saddle-free Newton
// method (Dauphin et al. 2014).
class EmAcceleration {
 public:
  // A step changes no mean by more than `longest_step` standard deviations, and no weight and
  // sharpness by more than this in their logarithm.
  explicit EmAcceleration(double longest_step) : longest_step_(longest_step) {}

  // To be called once after each EM step, with the lobes before and after it; gives the lobes to go
  // on with. Weights sum to 1. The first steps are EM's.
  Mixture propose(const Mixture& before, const Mixture& after);

  // Steps that are remembered, as many as Matrix3 has rows. Two to four do equally well.
  static constexpr std::size_t kMemory = 3;
  // EM's error is taken to shrink by this share per step at least: the bound of how much further
  // than EM's a step may go, 1/0.03.
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
