#pragma once

#include <array>

#include "tests/oracle/closed_form_walk.h"
#include "tests/oracle/real_vectors.h"
#include "wpg/motion/walk_state.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::oracle {

/// A leg between an upright waist and a level sole in the oracle's precision: Newton's method from
/// what is nearly there.
struct ExactLeg {
  Real6 q{}, speeds{};
  std::array<Real33, 6> R{};  ///< of the links' displacements from q = 0, seen from the waist
  std::array<Real3, 6> t{};   ///< x ↦ R x + t
  bool found = false;         ///< to a residual of 1e-28
};

/// The joints' angles and speeds at the walk's exact quantities.
ExactLeg SolveExactLeg(const RobotModel& robot, Side side, const ClosedFormWalk::Quantities& value,
                       const ClosedFormWalk::Quantities& rate, const Vector6d& near);

/// The place in W of a point of link `link` of a leg, `p_L` in its frame.
Real3 PointAt(const RobotModel& robot, Side side, const ExactLeg& leg, size_t link,
              const Eigen::Vector3d& p_L, const ClosedFormWalk::Quantities& value);

/// The distance of hip and ankle when the leg is stretched, less that of the exact pose [m].
Real ExactReach(const RobotModel& robot, Side side, const ExactLeg& leg);

}  // namespace halfstep::oracle
