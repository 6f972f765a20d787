#pragma once

#include <limits>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"
#include "planner/scene/scene.h"

namespace halfstep::verify {

/// The margin of what has no limit [any unit].
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Whether the rows are a motion at all: numbers finite and of human size, times increasing from 0.
/// The other checks need it.
bool CheckIsMotion(const std::vector<PlayedRow>& rows, Findings* findings);

/// What the rows say against each other, whoever made them: soles where forward kinematics puts
/// them, CoM rigid above the waist, CoM, its derivatives and the ZMP a linear inverted pendulum,
/// standing feet on the floor and at rest. Differences of c and
/// ċ against ċ and c̈ by the trapezoidal rule, within its error: with M a bound of |c⃜| between two
/// rows h apart (from `walk`), M h²/12 for c̈, and |c⃛| h²/12 for ċ with |c⃛| ≤ |Δc̈|/h + M h.
/// Source: the rule's remainder, −h³ f″/12; wpg/README.md, "Rest to rest", for M.
void CheckConsistency(const PlayedMotion& motion, const DescribedWalk& walk, Findings* findings);

/// Joint limits and speeds, reach, foot speed, height while moving, ZMP against what
/// `certificate` demands.
void CheckRowMargins(const PlayedMotion& motion, const CertificateText& certificate,
                     double tolerance, Findings* findings);

/// Bodies above the floor, a foot's at each row, all others at each row and between two; standing
/// soles beside the no-step areas of the scene.
void CheckFloor(const PlayedMotion& motion, const Scene& scene, const CertificateText& certificate,
                double tolerance, Findings* findings);

/// Margins of one family and side, leg or joint at a row (reach: of both legs, …); +∞: nothing to
/// watch. Speeds: between row i and the next one.
double ZmpMargin(const PlayedRow& row, const RobotModel& robot);
double ReachMargin(const RobotModel& robot, const PlayedRow& row, int side);
double JointMargin(const RobotModel& robot, const PlayedRow& row, int side, int joint);
double JointSpeedMargin(const PlayedMotion& motion, size_t i, int side, int joint, double scale);
/// Of the sole's centre [m/s] and of its yaw [rad/s], between row i and the next one.
double FootSpeed(const PlayedMotion& motion, size_t i, int side);
double FootYawRate(const PlayedMotion& motion, size_t i, int side);
/// Whether a sole moves horizontally or turns between row i and the next one.
bool MovesHorizontally(const PlayedMotion& motion, size_t i, int side);

}  // namespace halfstep::verify
