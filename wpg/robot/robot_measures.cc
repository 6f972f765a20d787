#include "wpg/robot/robot_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/files/yaml_fields.h"
#include "wpg/geometry/side.h"
#include "wpg/nth.h"
#include "wpg/robot/leg_ik.h"
#include "wpg/robot/robot_fields.h"
#include "wpg/robot/robot_legs.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {
namespace {

constexpr double kWithin = 0.02;  // of a joint's limits [rad]

double ShareOf(const LegJoint& joint) {
  if (std::abs(joint.axis_B.y()) > 0.7) return 1.0;
  return std::abs(joint.axis_B.z()) > 0.7 ? 0.1 : 0.3;
}

// Whether a sole can be there, `y` aside of the other one, on which the CoM is, and `z` above it.
bool Reaches(const RobotModel& robot, Side side, double y, double z) {
  Eigen::Isometry3d X_BSole = Eigen::Isometry3d::Identity();
  X_BSole.translation() = Eigen::Vector3d(robot.com_x_B, Sign(side) * y, z - robot.waist_height);
  const Leg& leg = Nth(robot.legs, side);
  const LegIkSolution solution = SolveLegIk(leg, X_BSole);
  if (solution.status != LegIkStatus::kSolved) return false;
  for (size_t i = 0; i < 6; ++i) {
    const double q = solution.q[static_cast<Eigen::Index>(i)];
    if (q < leg.joints[i].lower + kWithin || q > leg.joints[i].upper - kWithin) return false;
  }
  return true;
}

// The same of either sole.
bool BothReach(const RobotModel& robot, double y, double z) {
  return Reaches(robot, Side::kLeft, y, z) && Reaches(robot, Side::kRight, y, z);
}

// The last of `steps` + 1 places from `begin` to `end` before one that does not do.
template <typename Does>
double Last(double begin, double end, int steps, const Does& does) {
  double last = begin;
  for (int i = 0; i <= steps; ++i) {
    const double next = begin + (end - begin) * i / steps;
    if (!does(next)) break;
    last = next;
  }
  return last;
}

}  // namespace

double LegLengthOf(const RobotModel& robot) { return LengthOfLeg(robot.legs[0]); }

RobotMeasures MeasuresOf(const RobotModel& robot) {
  RobotMeasures m{.leg_length = LegLengthOf(robot),
                  .standing_width = robot.standing_width,
                  .slowest_joint = std::numeric_limits<double>::infinity(),
                  .support_point = robot.support_point,
                  .sole_width = robot.sole_size.minCoeff()};
  for (const Leg& each : robot.legs) {
    for (const LegJoint& joint : each.joints) {
      m.slowest_joint = std::min(m.slowest_joint, joint.max_speed / ShareOf(joint));
    }
  }
  const double w = m.standing_width;
  m.aside = Last(w, 8.0 / 7.0 * w, 20, [&](double y) {
    return BothReach(robot, y, 0.0) && BothReach(robot, y, 0.1 * m.leg_length);
  });
  m.lift =
      Last(0.0, 0.5 * m.leg_length, 100, [&](double z) { return BothReach(robot, m.aside, z); });
  m.lift = std::min(m.lift, robot.largest_lift);
  return m;
}

RobotMeasures MeasureRobot(const std::string& yaml_path) {
  const std::string text = ReadYamlFile(yaml_path);
  return MeasuresOf(BuildRobot(yaml_path, text, ReadRobotFile(yaml_path, text), RobotParts::kLegs));
}

}  // namespace halfstep
