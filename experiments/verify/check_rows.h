#pragma once

#include <algorithm>
#include <limits>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"
#include "experiments/verify/sole_polygon.h"
#include "planner/scene/scene.h"

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

/// Whether the rows keep what `certificate` demands of joint limits and speeds, reach, foot speed
/// and yaw rate, the height of a moving sole above the floor and the ZMP. `tolerance` [m]:
/// VerifyOptions.
void CheckRowMargins(const PlayedMotion& motion, const WalkFloor& floor,
                     const CertificateText& certificate, double tolerance, Findings* findings);
/// The same of how fast soles sink near where they land; nothing is said where there is no limit.
void CheckLanding(const PlayedMotion& motion, const DescribedWalk& walk,
                  const CertificateText& certificate, Findings* findings);

/// Whether the whole robot's ZMP, its joint torques and the friction that it needs (WalkDynamics)
/// keep what is demanded at the rows' times, by the walk on a floor of that friction coefficient;
/// nothing is looked at where nothing is demanded, or masses are not known.
void CheckDynamics(const std::vector<PlayedRow>& rows, const DescribedWalk& walk, double friction,
                   const CertificateText& certificate, Findings* findings);

/// Whether bodies stay above the floor, those on a foot at each row and all others at and between
/// rows, and whether standing soles keep off the no-step areas of the scene. `tolerance` [m] is
/// granted to the bodies that are not on a foot.
void CheckFloor(const PlayedMotion& motion, const WalkFloor& floor, const Scene& scene,
                const CertificateText& certificate, double tolerance, Findings* findings);

/// What supports the robot at a row.
SolePolygon PolygonOf(const PlayedRow& row, const RobotModel& robot);
/// Margins at a row: of the ZMP [m], of a leg's reach [m], of a joint's limits [rad]; and of a
/// joint's speed between row i and the next one [rad/s], with `scale` times the robot's limit.
/// `side` is Index(Side).
double ZmpMargin(const PlayedRow& row, const RobotModel& robot);
/// Of one leg.
double ReachMargin(const RobotModel& robot, const PlayedRow& row, int side);
/// Of one joint.
double JointMargin(const RobotModel& robot, const PlayedRow& row, int side, int joint);
/// Of one joint between row i and the next.
double JointSpeedMargin(const PlayedMotion& motion, size_t i, int side, int joint, double scale);
/// Speed of the sole's centre [m/s], and size of its yaw rate [rad/s], between row i and the next
/// one.
double FootSpeed(const PlayedMotion& motion, size_t i, int side);
/// Of the sole between row i and the next.
double FootYawRate(const PlayedMotion& motion, size_t i, int side);
/// How fast a sole may sink at a height [m] where it may at `limit` [m/s] in its last centimetre.
/// Source: smoothing/README.md, "Landing".
inline double LandingLimit(double limit, double height) {
  return limit * std::max(1.0, height / 0.01);
}
/// That at the higher one of row i and the next above where it lands by the walk, less how fast the
/// sole sinks between them [m/s].
double LandingMargin(const PlayedMotion& motion, size_t i, int side, const DescribedWalk& walk,
                     double limit);
/// Whether a sole moves horizontally or turns between row i and the next one.
bool MovesHorizontally(const PlayedMotion& motion, size_t i, int side);

}  // namespace halfstep::verify
