#include "tests/oracle/plain_dynamics.h"

#include <cmath>
#include <vector>

namespace halfstep::oracle {
namespace {

const Eigen::Vector3d kUp(0, 0, 1);

}  // namespace

// How a frame moves. Its origin is seen from below the CoM.
struct PlainDynamics::Frame {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin{0, 0, 0}, velocity{0, 0, 0}, acceleration{0, 0, 0};
  Eigen::Vector3d turns{0, 0, 0}, turns_rate{0, 0, 0};  // ω, ω̇

  Eigen::Vector3d AccelerationOf(const Eigen::Vector3d& lever) const {
    return acceleration + turns_rate.cross(lever) + turns.cross(turns.cross(lever));
  }
  // The frame that a joint carries.
  Frame Beyond(const PlainRobot::Joint& joint, double q, double speed, double rate) const {
    const Eigen::Vector3d lever = R * joint.xyz, axis = R * joint.axis;
    Frame next;
    next.R = R * Eigen::AngleAxisd(q, joint.axis).toRotationMatrix();
    next.origin = origin + lever;
    next.velocity = velocity + turns.cross(lever);
    next.acceleration = AccelerationOf(lever);
    next.turns = turns + speed * axis;
    next.turns_rate = turns_rate + rate * axis + speed * turns.cross(axis);
    return next;
  }
};

// What a joint's acceleration must add: the sole is accelerated as the walk says.
void PlainDynamics::Accelerate(const PlainRobot& robot, const WalkState& state, const Frame& waist,
                               const std::array<Vector6, 2>& q,
                               const std::array<Vector6, 2>& speed) {
  for (size_t leg = 0; leg < 2; ++leg) {
    std::array<Frame, 6> links;
    for (size_t j = 0; j < 6; ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      const auto& joint = robot.joints[static_cast<size_t>(robot.legs[leg].joints[j])];
      links[j] = (j == 0 ? waist : links[j - 1]).Beyond(joint, q[leg][k], speed[leg][k], 0);
    }
    const Eigen::Vector3d lever = links[5].R * robot.legs[leg].sole;
    const Eigen::Vector3d sole = links[5].origin + lever;
    Eigen::Matrix<double, 6, 6> J;
    for (size_t j = 0; j < 6; ++j) {
      const auto& joint = robot.joints[static_cast<size_t>(robot.legs[leg].joints[j])];
      const Eigen::Vector3d axis = links[j].R * joint.axis;
      J.col(static_cast<Eigen::Index>(j)) << axis, axis.cross(sole - links[j].origin);
    }
    Vector6 lacks;
    lacks << state.second.feet[leg][3] * kUp - links[5].turns_rate,
        state.second.feet[leg].head<3>() - links[5].AccelerationOf(lever);
    acceleration[leg] = J.fullPivLu().solve(lacks);
  }
}

PlainDynamics::PlainDynamics(const PlainRobot& robot, const WalkState& state,
                             const std::array<Vector6, 2>& q, const std::array<Vector6, 2>& speed) {
  const auto &x = state.value, &v = state.rate, &a = state.second;
  below_com.head<2>() = x.com;
  // The CoM of the walk is com_x ahead of the waist.
  const Eigen::Vector2d ahead(std::cos(x.waist_yaw), std::sin(x.waist_yaw));
  const Eigen::Vector2d aside(-ahead.y(), ahead.x());
  Frame waist;
  waist.R = Eigen::AngleAxisd(x.waist_yaw, kUp).toRotationMatrix();
  waist.origin << -robot.com_x * ahead, robot.waist_height + x.waist_z;
  waist.velocity << v.com - robot.com_x * v.waist_yaw * aside, v.waist_z;
  waist.acceleration << a.com -
                            robot.com_x * (a.waist_yaw * aside - v.waist_yaw * v.waist_yaw * ahead),
      a.waist_z;
  waist.turns = v.waist_yaw * kUp;
  waist.turns_rate = a.waist_yaw * kUp;
  Accelerate(robot, state, waist, q, speed);

  // Of all joints; those outside the legs rest while standing.
  std::vector<std::array<double, 3>> moves;
  for (const PlainRobot::Joint& joint : robot.joints) moves.push_back({joint.standing, 0, 0});
  std::vector<std::array<int, 2>> is_leg_joint(robot.joints.size(), {-1, -1});
  for (size_t leg = 0; leg < 2; ++leg) {
    for (size_t j = 0; j < 6; ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      const auto joint = static_cast<size_t>(robot.legs[leg].joints[j]);
      moves[joint] = {q[leg][k], speed[leg][k], acceleration[leg][k]};
      is_leg_joint[joint] = {static_cast<int>(leg), static_cast<int>(j)};
    }
  }
  std::vector<Frame> frames(robot.links.size());
  Eigen::Vector3d moment(0, 0, 0);                   // about the point below the CoM
  for (size_t i = 0; i < robot.links.size(); ++i) {  // parents come first
    const PlainRobot::Link& link = robot.links[i];
    Frame& frame = frames[i];
    if (static_cast<int>(i) == robot.waist) frame = waist;
    if (link.parent >= 0) {
      const auto joint = static_cast<size_t>(link.joint);
      const auto& [angle, rate, second] = moves[joint];
      frame =
          frames[static_cast<size_t>(link.parent)].Beyond(robot.joints[joint], angle, rate, second);
      if (const auto [leg, j] = is_leg_joint[joint]; leg >= 0) {
        Carried& its = carried[static_cast<size_t>(leg)][static_cast<size_t>(j)];
        its.point = frame.origin;
        its.axis = frame.R * robot.joints[joint].axis;
      }
    }
    const Eigen::Vector3d lever = frame.R * link.com, com = frame.origin + lever;
    const Eigen::Vector3d push = link.mass * (frame.AccelerationOf(lever) + kGravity * kUp);
    const Eigen::Matrix3d I = frame.R * link.inertia * frame.R.transpose();
    const Eigen::Vector3d spin = I * frame.turns_rate + frame.turns.cross(I * frame.turns);
    force += push;
    moment += com.cross(push) + spin;
    for (int k = static_cast<int>(i); k >= 0; k = robot.links[static_cast<size_t>(k)].parent) {
      const int joint = robot.links[static_cast<size_t>(k)].joint;
      if (joint < 0 || is_leg_joint[static_cast<size_t>(joint)][0] < 0) continue;
      const auto [leg, j] = is_leg_joint[static_cast<size_t>(joint)];
      Carried& its = carried[static_cast<size_t>(leg)][static_cast<size_t>(j)];
      its.force += push;
      its.moment += (com - its.point).cross(push) + spin;
    }
  }
  zmp = Eigen::Vector3d(-moment.y(), moment.x(), 0) / force.z();
  yaw_moment = (moment - zmp.cross(force)).z();
}

double PlainDynamics::Torque(size_t leg, size_t joint, const Eigen::Vector3d& floor_force,
                             const Eigen::Vector3d& floor_moment) const {
  const Carried& its = carried[leg][joint];
  return its.axis.dot(its.moment - (zmp - its.point).cross(floor_force) - floor_moment);
}

}  // namespace halfstep::oracle
