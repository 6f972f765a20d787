// Joints that slide, and what joints have to give.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/checker/check_trajectory.h"
#include "tests/checker/found_in_check.h"
#include "wpg/robot/gravity.h"

namespace halfstep::checker {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Kind = TrajectoryFinding::Kind;

constexpr double kMass = 2.0, kFar = 0.3, kInertia = 0.05;  // of the arm, about its centre

// A carriage along x that carries an arm turning about y, whose centre of mass is 0.3 m along its
// x.
JointedRobot Crane(const std::string& force, const std::string& torque) {
  const std::string limits = "lower='-1' upper='1' velocity='5' effort='";
  return {
      ParseUrdf("crane.urdf",
                "<robot name='crane'><link name='rail'/><link name='carriage'><inertial><mass "
                "value='3'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
                "iyz='0'/></inertial></link><link name='arm'><inertial><origin xyz='0.3 0 "
                "0'/><mass value='2'/><inertia ixx='0.01' iyy='0.05' izz='0.05' ixy='0' ixz='0' "
                "iyz='0'/></inertial><collision><origin xyz='0.5 0 0'/><geometry><sphere "
                "radius='0.05'/></geometry></collision></link><joint name='rail_joint' "
                "type='prismatic'><parent link='rail'/><child link='carriage'/><axis xyz='1 0 "
                "0'/><limit " +
                    limits + force +
                    "'/></joint><joint name='swing' type='revolute'><parent "
                    "link='carriage'/><child link='arm'/><axis xyz='0 1 0'/><limit " +
                    limits + torque + "'/></joint></robot>"),
      {}};
}

// From rest to rest, 0.4 m and 0.6 rad in a second.
Trajectory CraneTrajectory() {
  Trajectory moves;
  moves.file = "crane.csv";
  moves.joints = {"rail_joint", "swing"};
  moves.times = {0, 1};
  moves.q.resize(2, 2);
  moves.q << 0.1, 0.5, -0.2, 0.4;
  moves.v.setZero(2, 2);
  SetInterpolation({}, &moves);
  return moves;
}

// Both pieces are q₀ + D(3u² − 2u³). Lagrange: with x the carriage, φ the arm, downwards from x,
//   F = (M + m)ẍ − m l(φ̈ sin φ + φ̇² cos φ), τ = (m l² + I)φ̈ − m l ẍ sin φ − m g l cos φ.
TEST(SlidingAndTorque, TorquesAreThoseOfLagrange) {
  double force = 0.0, torque = 0.0;
  for (int n = 0; n <= 4000; ++n) {
    const double u = n / 4000.0, form = 3 * u * u - 2 * u * u * u;
    const double phi = -0.2 + 0.6 * form, speed = 0.6 * (6 * u - 6 * u * u);
    const double turn = 0.6 * (6 - 12 * u), along = 0.4 * (6 - 12 * u);
    force = std::max(
        force, std::abs((3.0 + kMass) * along -
                        kMass * kFar * (turn * std::sin(phi) + speed * speed * std::cos(phi))));
    torque = std::max(torque, std::abs((kMass * kFar * kFar + kInertia) * turn -
                                       kMass * kFar * along * std::sin(phi) -
                                       kMass * kGravity * kFar * std::cos(phi)));
  }
  const auto check = [](double most_force, double most_torque) {
    return CheckTrajectory(CraneTrajectory(),
                           Crane(std::to_string(most_force), std::to_string(most_torque)), {}, {});
  };
  EXPECT_TRUE(check(force + 1e-4, torque + 1e-4).proved());
  const TrajectoryCheck less = check(force - 1e-4, torque - 1e-4);
  EXPECT_FALSE(FoundIn(less, Kind::kTorque, "rail_joint").proved);
  EXPECT_FALSE(FoundIn(less, Kind::kTorque, "swing").proved);
}

TEST(SlidingAndTorque, WhatIsNotKnownIsTold) {
  Trajectory linear = CraneTrajectory();
  linear.interpolation = Interpolation::kLinear;
  EXPECT_THAT(CheckTrajectory(linear, Crane("99", "99"), {}, {}).not_covered,
              Contains(HasSubstr("torques: linear pieces have no accelerations")));
  EXPECT_THAT(CheckTrajectory(CraneTrajectory(), Crane("0", "99"), {}, {}).not_covered,
              Contains(HasSubstr("torque of rail_joint")));
}

// The carriage passes an obstacle and comes back between two knots that are clear of it.
TEST(SlidingAndTorque, SlidingJointsHaveLimitsAndTouchThings) {
  Trajectory there_and_back = CraneTrajectory();
  there_and_back.q << 0.0, 0.0, 0.0, 0.0;
  there_and_back.v << 3.0, -3.0, 0.0, 0.0;  // 0.75 m ahead in the middle
  Scene scene;
  Obstacle ball{.name = "ball", .shape = Sphere{0.1}};
  ball.X_WO.translation() << 1.3, 0, 0.1;
  scene.obstacles = {ball};
  const TrajectoryCheck check = CheckTrajectory(there_and_back, Crane("99", "99"), scene, {});
  EXPECT_FALSE(FoundIn(check, Kind::kClearance, "arm - ball").proved);
  EXPECT_GT(FoundIn(check, Kind::kClearance, "arm - ball").at_knots.value(), 0.6);
  const TrajectoryFinding& rail = FoundIn(check, Kind::kLimits, "rail_joint");
  EXPECT_TRUE(rail.proved && rail.slides);
  EXPECT_NEAR(rail.least, 0.25, 0.01);
  // Without the ball's reach: the arm's ball ends at 0.5 + 0.75 + 0.05 m.
  scene.obstacles[0].X_WO.translation() << 1.42, 0, 0;
  EXPECT_TRUE(
      CheckTrajectory(there_and_back, Crane("99", "99"), scene, {.clearance = 0.0199}).proved());
  EXPECT_FALSE(
      CheckTrajectory(there_and_back, Crane("99", "99"), scene, {.clearance = 0.0201}).proved());
}

}  // namespace
}  // namespace halfstep::checker
