#pragma once

#include "experiments/checker/frame.h"
#include "experiments/checker/taylor.h"
#include "wpg/robot/robot_masses.h"

namespace halfstep::checker {

using Rate = Taylor<1>;  ///< a function of time whose derivative is bounded

/// Of a vector its first derivatives.
inline VectorIn<Rate> FirstOf(const VectorIn<Curve>& x) {
  return {x[0].Derivative<0, 1>(), x[1].Derivative<0, 1>(), x[2].Derivative<0, 1>()};
}

/// What moves bodies as they move, weight included: ∫ (ẍ + gẑ) dm and ∫ (x − r) × (ẍ + gẑ) dm.
struct Push {
  VectorIn<Rate> force{};   ///< [N]
  VectorIn<Rate> moment{};  ///< about the point r, at rest [N m]

  /// Of both together, about one point.
  void operator+=(const Push& other) {
    force = force + other.force;
    moment = moment + other.moment;
  }
};

/// Of a body in the frame X_W; r is `reference` [m], in W. Source: experiments/proof.md,
/// "Statements".
Push PushOf(const BodyMass& body, const FrameIn<Curve>& X_W,
            const Eigen::Vector3d& reference = {0, 0, 0});

}  // namespace halfstep::checker
