#pragma once

#include <optional>

#include "wpg/robot/leg_continuation.h"
#include "wpg/robot/leg_ik.h"
#include "wpg/robot/leg_motion_bound.h"

namespace halfstep {

/// Joint bounds of a leg without closed form over an interval, from what is known at m: the joint
/// angles that SolveLegIk gave and their frames (waist and sole upright), the joint speeds [rad/s]
/// and the sole's motion seen from the waist. `off` says how far rounding may carry all of these.
/// The proof is a bootstrap: assumed bounds of the speeds hold where they imply smaller ones.
/// Returns none when it fails. Where there is a bound, the leg stays in its branch (StaysInBranch)
/// and regular. Source: smoothing/README.md, "Motion bounds".
std::optional<JointBounds> BoundOffsetJoints(const Leg& leg, const Vector6d& q,
                                             const LegFrames& frames, const Vector6d& speeds,
                                             const SoleDrift& of_sole, const LegRounding& off = {});

/// A bound of the hip–ankle distance's change while the knee turns by at most `turn` [rad].
double LegLengthChange(const LegLength& length, double turn);

}  // namespace halfstep
