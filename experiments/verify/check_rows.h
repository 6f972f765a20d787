#pragma once

#include <algorithm>
#include <limits>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"
#include "experiments/verify/sole_polygon.h"

namespace halfstep::verify {

/// The margin of what has no limit [any unit].
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Whether the rows are a motion at all: at least two, numbers finite and at most 10,000 in size,
/// times that increase from 0, half-steps that do not decrease. The other checks need it.
bool CheckIsMotion(const std::vector<PlayedRow>& rows, Findings* findings);

/// Whether the rows agree with each other, whoever made them: soles are where forward kinematics
/// puts them, the CoM is rigid with the waist, which is as high as the walk has it, CoM and ZMP
/// satisfy the linear inverted pendulum, and standing feet are at the height of their footsteps and
/// at rest. Differences of c and ċ must agree with ċ and c̈
/// by the trapezoidal rule, within its error: with M a bound of |c⃜| between two rows h apart (from
/// `walk`), M h²/12 for c̈, and |c⃛| h²/12 for ċ with |c⃛| ≤ |Δc̈|/h + M h.
/// Source: the rule's remainder, −h³ f″/12; wpg/README.md, "Rest to rest", for M.
void CheckConsistency(const PlayedMotion& motion, const DescribedWalk& walk, Findings* findings);

/// Whether bodies that are not on a foot stay above the floor at and between rows, by what is
/// demanded less `tolerance` [m].
void CheckFloor(const PlayedMotion& motion, const WalkFloor& floor,
                const CertificateText& certificate, double tolerance, Findings* findings);

/// What supports the robot at a row.
SolePolygon PolygonOf(const PlayedRow& row, const RobotModel& robot);
/// Margins at a row: of the ZMP [m], of a leg's reach [m], of a joint's limits [rad]. `side` is
/// Index(Side).
double ZmpMargin(const PlayedRow& row, const RobotModel& robot);
/// Of one leg.
double ReachMargin(const RobotModel& robot, const PlayedRow& row, int side);
/// Of one joint.
double JointMargin(const RobotModel& robot, const PlayedRow& row, int side, int joint);
/// How fast a sole may sink at a height [m] where it may at `limit` [m/s] in its last centimetre.
/// Source: smoothing/README.md, "Landing".
inline double LandingLimit(double limit, double height) {
  return limit * std::max(1.0, height / 0.01);
}

}  // namespace halfstep::verify
