// Levers of tubes, one error at a time, where drawn motions come nowhere near a bound.

#include "smoothing/margins/tube_levers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/smoothing/drawn_motion.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/geometry/rotation.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kTurn = 1e-4;  // of a joint [rad]
constexpr double kAnywhere = 1e3;
constexpr Tube kByJoints = {.waist = kAnywhere, .waist_turn = 1.0, .joint = kTurn};

// Points on a body's surface that are farthest, in its frame: those of its rim and of its balls.
Eigen::Matrix3Xd Surface(const ConvexBody& shape) {
  std::vector<Vector3d> points;
  for (int k = 0; k < 200; ++k) {
    const double z = -1.0 + 0.01 * k, yaw = 2.4 * k;
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    points.push_back(SupportPoint(shape, Vector3d(r * std::cos(yaw), r * std::sin(yaw), z)));
  }
  Eigen::Matrix3Xd matrix(3, static_cast<Eigen::Index>(points.size()));
  for (size_t i = 0; i < points.size(); ++i) matrix.col(static_cast<Eigen::Index>(i)) = points[i];
  return matrix;
}

double WayBetween(const Eigen::Matrix3Xd& points, const Isometry3d& X, const Isometry3d& moved) {
  return (X * points - moved * points).colwise().norm().maxCoeff();
}

// Where a leg's link is, seen from the sole.
Isometry3d SeenFromSole(const Leg& leg, const Vector6d& q, int link) {
  const LegFrames frames = PlaceLeg(leg, q);
  return frames.X_BLink[6].inverse() * Nth(frames.X_BLink, link);
}

// The sole stands, and one joint between it and a body turns: the body turns about that joint. The
// sum over the joints is the bound's; each of them alone reaches most of its part in some posture.
TEST(TubeLevers, BodiesTurnAboutEachJointBetweenThemAndTheirSole) {
  WalkDraw draw(1);
  for (const RobotModel& robot : RobotsOfAllKinds()) {
    const TubeLevers levers(robot);
    for (size_t b = 0; b < robot.bodies.size(); ++b) {
      const RobotBody& body = robot.bodies[b];
      if (body.leg < 0 || body.link < 0 || body.link == 5) continue;
      const Leg& leg = Nth(robot.legs, body.leg);
      const Eigen::Matrix3Xd surface = Surface(body.shape);
      std::vector<double> largest(6, 0.0);
      for (int i = 0; i < 10; ++i) {
        Vector6d q = leg.standing_q;
        for (int j = 0; j < 6; ++j) q[j] += draw.Uniform(-1.0, 1.0);
        for (int j = body.link + 1; j < 6; ++j) {
          Vector6d turned = q;
          turned[j] += kTurn;
          Nth(largest, j) =
              std::max(Nth(largest, j), WayBetween(surface, SeenFromSole(leg, q, body.link),
                                                   SeenFromSole(leg, turned, body.link)));
        }
      }
      double sum = 0.0;
      for (const double way : largest) sum += way;
      EXPECT_LE(sum, levers.WayOf(b, kByJoints) + 1e-12) << robot.name << " " << body.name;
    }
  }
}

// A wide flat cylinder on a shin: its rim goes farther than its axis.
TEST(TubeLevers, CountTheRimOfACylinder) {
  RobotModel robot = Hrp2();
  const auto shin = std::ranges::find_if(
      robot.bodies, [](const RobotBody& body) { return body.leg == 0 && body.link == 3; });
  ASSERT_NE(shin, robot.bodies.end());
  shin->shape = MakeCylinder(0.3, 0.01);
  const TubeLevers levers(robot);
  const Eigen::Matrix3Xd surface = Surface(shin->shape);
  const Leg& leg = robot.legs[0];
  double largest = 0.0;
  for (const int axis : {0, 1, 2}) {
    const Isometry3d X = Nth(leg.joints, 3).X_BLink;
    Isometry3d moved = X;
    moved.prerotate(AxisRotation(kTurn, Vector3d::Unit(axis)));
    largest = std::max(largest, WayBetween(surface, X, moved));
  }
  const double bound = levers.WayOf(static_cast<size_t>(shin - robot.bodies.begin()),
                                    {.foot = kAnywhere, .waist_turn = kTurn});
  EXPECT_LE(largest, bound);
  EXPECT_GT(largest, 0.5 * bound);
}

// Two feet that both move inwards come nearer by both ways.
TEST(TubeLevers, FeetComeNearerByBothWays) {
  const RobotModel robot = Hrp2();
  const TubeLevers levers(robot);
  int feet = 0;
  for (size_t p = 0; p < robot.self_pairs.size(); ++p) {
    const RobotBody &a = Nth(robot.bodies, robot.self_pairs[p][0]),
                    &b = Nth(robot.bodies, robot.self_pairs[p][1]);
    if (a.link != 5 || b.link != 5) continue;
    ++feet;
    EXPECT_NEAR(levers.NearerBy(p, {.foot = 0.01, .waist = kAnywhere, .joint = 1.0}), 0.02, 1e-12);
  }
  EXPECT_GT(feet, 0);
}

// Distances along the axes' points from a body to each of `chain`, whatever the posture.
std::vector<double> Reaches(const RobotModel& robot, const RobotBody& body,
                            const std::vector<Vector3d>& chain) {
  const Isometry3d X = body.link < 0 ? Isometry3d::Identity()
                                     : Nth(Nth(robot.legs, body.leg).joints, body.link).X_BLink;
  std::vector<double> reaches = {
      ((X * body.shape.vertices).colwise() - chain[0]).colwise().norm().maxCoeff() +
      body.shape.disc_radius + body.shape.ball_radius};
  for (size_t i = 1; i < chain.size(); ++i) {
    reaches.push_back(reaches.back() + (chain[i] - chain[i - 1]).norm());
  }
  return reaches;
}

// Each joint between a shin and the waist turns one of the two past the other: the one that
// reaches less far from it.
TEST(TubeLevers, AJointTurnsTheBodyThatReachesLessFar) {
  const RobotModel robot = Hrp2();
  const TubeLevers levers(robot);
  int seen = 0;
  for (size_t p = 0; p < robot.self_pairs.size(); ++p) {
    RobotBody a = Nth(robot.bodies, robot.self_pairs[p][0]),
              b = Nth(robot.bodies, robot.self_pairs[p][1]);
    if (a.link < 0) std::swap(a, b);
    if (b.link >= 0 || a.link < 2) continue;
    ++seen;
    std::vector<Vector3d> chain;
    for (int j = a.link; j >= 0; --j) {
      chain.push_back(Nth(robot.legs, a.leg).AxisPoint(static_cast<size_t>(j)));
    }
    const std::vector<double> from_a = Reaches(robot, a, chain);
    std::ranges::reverse(chain);
    std::vector<double> from_b = Reaches(robot, b, chain);
    std::ranges::reverse(from_b);
    double sum = 0.0;
    for (size_t i = 0; i < chain.size(); ++i) sum += std::min(from_a[i], from_b[i]);
    const Tube tube = {.foot = kAnywhere, .waist = kAnywhere, .joint = kTurn};
    EXPECT_NEAR(levers.NearerBy(p, tube), kTurn * sum, 1e-12);
  }
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace halfstep
