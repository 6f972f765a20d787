#include "experiments/survey/rest_torques.h"

#include <array>
#include <cmath>
#include <limits>

#include "experiments/survey/self_gaps.h"
#include "experiments/survey/stance_search.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/elementary.h"
#include "wpg/files/text.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/leg_torques.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"
#include "wpg/robot/torque_limits.h"

namespace halfstep {
namespace {

// Torques of both legs while `support` carries all and the CoM is accelerated by `acceleration`
// [m/s²], all else at rest.
std::optional<std::array<Vector6d, 2>> TorquesAt(const RobotModel& robot, const WalkState& x,
                                                 Side support,
                                                 const Eigen::Vector2d& acceleration) {
  WalkJet jet{.value = x};
  jet.second.segment<2>(kComX) = acceleration;
  Posture posture = SolvePosture(robot, x);
  if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) return std::nullopt;
  const RobotDynamics dynamics(robot, jet, posture, kGravity);
  std::array<Vector6d, 2> torques;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    Nth(torques, Index(side)) =
        LegTorques(dynamics, side, FootLoads::OneFoot(support).On(side, dynamics.contact()));
  }
  return torques;
}

}  // namespace

std::optional<RestTorque> WeakestAtRest(const RobotModel& robot) {
  if (!robot.masses.known() || !TorqueFault(robot).empty()) return std::nullopt;
  const HalfStepSequence sequence = SixSteps(robot, DefaultHalfStep(robot));
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  std::optional<RestTorque> weakest;
  for (const int i : {1, 3}) {  // a half-step down begins at rest on one foot
    const WalkState x = walk.At(walk.start_of(i)).value;
    const Side support = Nth(sequence.half_steps, i).half_step.support;
    const Eigen::Vector2d inwards =
        x.segment<2>(FootIndex(Opposite(support))) - x.segment<2>(FootIndex(support));
    const double yaw = x[kWaistYaw], towards = support == Side::kLeft ? -1 : 1;
    const Eigen::Vector2d aside = towards * Eigen::Vector2d(-Sin(yaw), Cos(yaw));
    const auto rest = TorquesAt(robot, x, support, {0, 0});
    const auto moved = TorquesAt(robot, x, support, aside);  // by 1 m/s²
    if (!rest || !moved || inwards.dot(aside) <= 0) return std::nullopt;
    for (size_t leg = 0; leg < 2; ++leg) {
      for (size_t j = 0; j < 6; ++j) {
        const LegJoint& joint = robot.legs[leg].joints[j];
        const double torque = (*rest)[leg][static_cast<Eigen::Index>(j)];
        const double needed = std::abs(torque), limit = joint.max_torque;
        if (weakest && !(needed / limit > weakest->needed / weakest->limit)) continue;
        const double sign = torque < 0 ? -1 : 1;
        const double eased = sign * (torque - (*moved)[leg][static_cast<Eigen::Index>(j)]);
        const double acceleration = (needed - limit) / eased;
        double inside = 0.0;
        if (needed > limit) {
          inside = eased > 0 ? acceleration * robot.com_height / kGravity
                             : std::numeric_limits<double>::infinity();
        }
        weakest = {joint.name, needed, limit, inside};
      }
    }
  }
  return weakest;
}

std::vector<std::string> RestText(const RestTorque& rest, double stance,
                                  const std::string& robot_file) {
  if (!(rest.needed > rest.limit)) return {};
  std::string text = Formatted("at rest on one foot %s needs %.3g of its %.3g N m",
                               rest.joint.c_str(), rest.needed, rest.limit);
  if (rest.inside < stance) {
    text += Formatted(
        "; it would hold only while the CoM were %.2g cm further inside than the ZMP whenever a "
        "foot is in the air",
        100 * rest.inside);
  } else {
    text += "; no place of the CoM between the feet would relieve it enough";
  }
  return {text, Formatted("what helps then: `effort_limits_n_m` of %s, if the motors give more "
                          "for as long as a step takes; else less mass above the legs",
                          robot_file.c_str())};
}

}  // namespace halfstep
