#pragma once

#include <vector>

#include "wpg/motion/half_step_shape.h"
#include "wpg/motion/profile_jet.h"
#include "wpg/motion/vector_ball.h"

namespace halfstep {

/// How quantities go from rest to rest in a half-step of duration T: π(τ) is 0 and at rest before
/// τ = 0, 1 and at rest after T, and C² in between, τ the local time [s]. Immutable.
class Profile {
 public:
  virtual ~Profile() = default;
  /// Value and derivatives at τ [s].
  virtual ProfileJet At(double tau) const = 0;
  /// Derivatives of value, first and second at τ with respect to a number of the half-step's shape;
  /// all 0 when the profile does not depend on it. At a knot: of one side.
  virtual ProfileJet ByShape(double HalfStepShape::*number, double tau) const = 0;
  /// How At is computed where local times are off by at most `time` [s]: holds for all τ.
  virtual ProfileAccuracy Accuracy(double time) const = 0;
  /// sup |π̈| over local times [from, to] [s], some of which are between 0 and T [1/s²].
  virtual double SecondBound(double from, double to) const = 0;
  /// All values of the third time derivative over local times [from, to] [1/s³], but for rounding.
  /// Only where QuantityTraits::bounded_third asks for it (std::logic_error).
  virtual Range ThirdRange(double from, double to) const = 0;
  /// Appends the local times in (0, T] at which the profile changes its formula [s].
  virtual void AddKnots(std::vector<double>* knots) const = 0;
};

}  // namespace halfstep
