#pragma once

#include <Eigen/Core>

#include "wpg/geometry/foothold.h"
#include "wpg/motion/half_step.h"
#include "wpg/motion/walk_state.h"

namespace halfstep {

/// How a sole's place moves along a parameter, in W: (x, y, yaw), [m], [m], [rad].
using SoleMove = Eigen::Vector3d;

/// How the two states in which a half-step rests change, per unit of what is moved.
struct RestStateSlopes {
  WalkState floor = WalkState::Zero();  ///< of HalfStep::OnFloor()
  WalkState via = WalkState::Zero();    ///< of HalfStep::AtVia()
};

/// How AtVia() changes, in S, per unit of a number of the half-step that it is affine in:
/// via_height, via_lateral, via_along, support_point. It is constant, and OnFloor() does not
/// change.
WalkState ViaSlope(HalfStep half_step, double HalfStep::*number);
/// The same of a number of its shape.
WalkState ViaSlope(HalfStep half_step, double HalfStepShape::*number);
/// The slopes in W when its soles move, the support sole standing at X_WS.
RestStateSlopes SlopesOfStates(const HalfStep& half_step, const Foothold& X_WS,
                               const SoleMove& support, const SoleMove& swing);

}  // namespace halfstep
