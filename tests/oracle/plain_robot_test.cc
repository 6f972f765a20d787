// The oracle's robots against the project; its dynamics against differences.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/oracle/nasty_draws.h"
#include "tests/oracle/plain_dynamics.h"
#include "tests/oracle/plain_robot.h"
#include "tests/places.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::oracle {
namespace {

class PlainRobotTest : public testing::TestWithParam<std::string> {
 protected:
  const std::string path_ = InSources("wpg/robots/") + GetParam() + ".yaml";
};
INSTANTIATE_TEST_SUITE_P(Robots, PlainRobotTest, testing::ValuesIn(kShippedRobots),
                         [](const auto& info) { return info.param; });

TEST_P(PlainRobotTest, ReadsWhatTheProjectReads) {
  const PlainRobot plain(path_);
  const RobotModel robot = LoadRobot(path_);
  EXPECT_NEAR(plain.waist_height, robot.waist_height, 1e-12);
  EXPECT_NEAR(plain.com_x, robot.com_x_B, 1e-12);
  EXPECT_NEAR(plain.com_height, robot.com_height, 1e-12);
  EXPECT_NEAR(plain.standing_width, robot.standing_width, 1e-12);
  ASSERT_EQ(plain.bodies.size(), robot.bodies.size());
  for (int leg = 0; leg < 2; ++leg) {
    for (int j = 0; j < 6; ++j) {
      const auto& a = plain.joints[static_cast<size_t>(
          plain.legs[static_cast<size_t>(leg)].joints[static_cast<size_t>(j)])];
      const LegJoint& b = robot.legs[static_cast<size_t>(leg)].joints[static_cast<size_t>(j)];
      EXPECT_EQ(a.name, b.name);
      EXPECT_NEAR(a.lower, b.lower, 1e-15);
      EXPECT_NEAR(a.upper, b.upper, 1e-15);
      EXPECT_EQ(a.speed, b.max_speed);
      EXPECT_EQ(a.effort, b.max_torque);
      EXPECT_EQ(a.acceleration, b.max_acceleration);
    }
  }
}

TEST_P(PlainRobotTest, WatchesTheSamePairs) {
  const PlainRobot plain(path_);
  const RobotModel robot = LoadRobot(path_);
  std::set<std::set<std::string>> ours, theirs;
  for (const auto& [a, b] : plain.watched) {
    ours.insert(
        {plain.bodies[static_cast<size_t>(a)].name, plain.bodies[static_cast<size_t>(b)].name});
  }
  for (const auto& [a, b] : robot.self_pairs) {
    theirs.insert(
        {robot.bodies[static_cast<size_t>(a)].name, robot.bodies[static_cast<size_t>(b)].name});
  }
  EXPECT_EQ(ours, theirs);
}

TEST_P(PlainRobotTest, InverseKinematicsReachesTheSole) {
  const PlainRobot robot(path_);
  Draw draw(3);
  for (int k = 0; k < 200; ++k) {
    const int leg = draw.Below(2);
    Vector6 q = robot.Standing(leg);
    for (int j = 0; j < 6; ++j) q[j] += draw.Uniform(-0.2, 0.2);
    Vector6 found = robot.Standing(leg);
    ASSERT_TRUE(robot.SolveLeg(leg, robot.PlaceLeg(leg, q)[6], &found)) << k;
    EXPECT_LT((found - q).norm(), 1e-11) << k;
  }
}

// Derivative of a function of time, by differences of fourth order.
template <typename Function>
auto Rate(const Function& f, double t, double h) {
  return ((8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h)).eval();
}

// A walk's postures from inverse kinematics alone, for differences.
struct Postures {
  const PlainRobot& robot;
  const ClosedFormWalk& walk;

  std::array<Vector6, 2> q(double t) const {
    const WalkState::Values x = walk.At(static_cast<Real>(t)).value;
    std::array<Vector6, 2> q = {robot.Standing(0), robot.Standing(1)};
    for (int leg = 0; leg < 2; ++leg) {
      const Eigen::Vector4d& foot = x.feet[static_cast<size_t>(leg)];
      const Eigen::Isometry3d X_WSole = Place(foot.head<3>(), foot[3]);
      EXPECT_TRUE(robot.SolveLeg(leg, Waist(x).inverse() * X_WSole, &q[static_cast<size_t>(leg)]));
    }
    return q;
  }
  std::vector<Eigen::Isometry3d> links(double t) const {
    const WalkState::Values x = walk.At(static_cast<Real>(t)).value;
    std::vector<Eigen::Isometry3d> X = robot.PlaceLinks(q(t));
    for (Eigen::Isometry3d& placed : X) placed = Waist(x) * placed;
    return X;
  }
  static Eigen::Isometry3d Place(const Eigen::Vector3d& p, double yaw) {
    return Eigen::Translation3d(p) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  }
  Eigen::Isometry3d Waist(const WalkState::Values& x) const {
    const double c = std::cos(x.waist_yaw), s = std::sin(x.waist_yaw);
    return Place(
        {x.com.x() - c * robot.com_x, x.com.y() - s * robot.com_x, robot.waist_height + x.waist_z},
        x.waist_yaw);
  }
  // Momentum, angular momentum about W's origin, energy.
  Eigen::Matrix<double, 7, 1> Momenta(double t) const {
    Eigen::Matrix<double, 7, 1> sum = Eigen::Matrix<double, 7, 1>::Zero();
    const double h = 1e-3;
    const std::vector<Eigen::Isometry3d> X = links(t), a = links(t - 2 * h), b = links(t - h),
                                         c = links(t + h), d = links(t + 2 * h);
    for (size_t i = 0; i < X.size(); ++i) {
      const PlainRobot::Link& link = robot.links[i];
      const Eigen::Matrix4d rate =
          (8 * (c[i].matrix() - b[i].matrix()) - (d[i].matrix() - a[i].matrix())) / (12 * h);
      const Eigen::Vector3d r = X[i] * link.com;
      const Eigen::Vector3d v = (rate * link.com.homogeneous()).head<3>();
      const Eigen::Matrix3d turn = rate.topLeftCorner<3, 3>() * X[i].linear().transpose();
      const Eigen::Vector3d w(turn(2, 1), turn(0, 2), turn(1, 0));
      const Eigen::Vector3d spin = X[i].linear() * link.inertia * X[i].linear().transpose() * w;
      sum.head<3>() += link.mass * v;
      sum.segment<3>(3) += link.mass * r.cross(v) + spin;
      sum[6] += 0.5 * link.mass * v.squaredNorm() + 0.5 * w.dot(spin) + link.mass * 9.81 * r.z();
    }
    return sum;
  }
};

TEST_P(PlainRobotTest, DynamicsAreThoseOfDifferencesOfMomentumAndEnergy) {
  const PlainRobot robot(path_);
  Draw draw(11);
  WalkPlan plan = DrawPlan(robot, &draw);
  // From level to level, by a little.
  plan.crouch = 0.04 * robot.size();
  plan.start[0].z = 0.02 * robot.size();
  for (size_t j = 0; j < plan.steps.size(); ++j) {
    plan.steps[j].landing.z = (j % 2 == 0 ? -0.01 : 0.03) * robot.size();
    plan.steps[j].via_height += 0.04 * robot.size();
  }
  const ClosedFormWalk walk(plan);
  const Postures postures{robot, walk};
  for (const Stretch& stretch : walk.stretches()) {
    if (stretch.end - stretch.begin < 0.05) continue;
    const double t = 0.5 * (stretch.begin + stretch.end);
    const std::array<Vector6, 2> q = postures.q(t);
    std::array<Vector6, 2> speed;
    for (size_t leg = 0; leg < 2; ++leg) {
      speed[leg] = Rate([&](double s) { return postures.q(s)[leg]; }, t, 1e-3);
    }
    const WalkState state = walk.At(static_cast<Real>(t));
    const PlainDynamics found(robot, state, q, speed);
    double power = 0;
    for (size_t leg = 0; leg < 2; ++leg) {
      const Vector6 second = Rate(
          [&](double s) {
            return Vector6(Rate([&](double r) { return postures.q(r)[leg]; }, s, 1e-3));
          },
          t, 1e-3);
      EXPECT_LT((found.acceleration[leg] - second).norm(), 1e-5 * (1 + second.norm())) << t;
    }
    const Eigen::Matrix<double, 7, 1> rate =
        Rate([&](double s) { return postures.Momenta(s); }, t, 1e-3);
    const Eigen::Vector3d weight(0, 0, 9.81 * robot.mass);
    const double may_differ = 1e-5 * weight.z();
    EXPECT_LT((rate.head<3>() + weight - found.force).norm(), may_differ);
    // With the floor's wrench about the ZMP, moved to W's origin.
    const Eigen::Vector3d zmp = found.below_com + found.zmp;
    Eigen::Vector3d com(0, 0, 0);
    const auto X = postures.links(t);
    for (size_t i = 0; i < X.size(); ++i) com += robot.links[i].mass * (X[i] * robot.links[i].com);
    const Eigen::Vector3d about =
        zmp.cross(found.force) + found.yaw_moment * Eigen::Vector3d::UnitZ();
    EXPECT_LT((rate.segment<3>(3) + (com / robot.mass).cross(weight) - about).norm(),
              may_differ * 10);
    // Soles that stand do no work, so all the power is that of the joints, however they share.
    const size_t standing = stretch.in_air == 0 ? 1 : 0;
    for (size_t leg = 0; leg < 2; ++leg) {
      const bool carries = leg == standing;
      const Eigen::Vector3d force = carries ? found.force : Eigen::Vector3d(0, 0, 0);
      const Eigen::Vector3d moment(0, 0, carries ? found.yaw_moment : 0.0);
      for (size_t j = 0; j < 6; ++j) {
        power += found.Torque(leg, j, force, moment) * speed[leg][static_cast<Eigen::Index>(j)];
      }
    }
    EXPECT_NEAR(power, rate[6], may_differ) << t;
  }
}

}  // namespace
}  // namespace halfstep::oracle
