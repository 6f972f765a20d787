// The shipped robots: published numbers, bodies, watched pairs.

#include "wpg/robot/robot_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "tests/places.h"
#include "tests/replaced.h"
#include "tests/wpg/generated_robots.h"
#include "tests/wpg/shipped_robots.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

TEST(Hrp2, HasThePublishedNumbers) {
  const RobotModel robot = LoadRobot(kHrp2);
  EXPECT_EQ(robot.name, "hrp2");
  EXPECT_NEAR(robot.mass, 56.87, 0.005);
  EXPECT_NEAR(robot.com_x_B, 0.0136, 0.00005);
  EXPECT_EQ(robot.com_height, 0.814);
  EXPECT_NEAR(robot.waist_height, 0.648702, 5e-7);
  EXPECT_NEAR(robot.waist_height,
              0.105 + 0.3 * std::cos(26 * kDegree) + 0.3 * std::cos(24 * kDegree), 1e-12);
  EXPECT_NEAR(robot.standing_width, 0.21, 1e-12);
  EXPECT_EQ(robot.sole_size, Eigen::Vector2d(0.2172, 0.137));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Leg& leg = robot.legs[static_cast<size_t>(Index(side))];
    EXPECT_LT((leg.hip_B - Vector3d(0, Sign(side) * 0.06, 0)).norm(), 1e-12);
    const Isometry3d X_BSole = LegForwardKinematics(leg, leg.standing_q)[6];
    const Vector3d ankle = X_BSole * (leg.X_BSole.inverse() * leg.ankle_B);
    EXPECT_NEAR(ankle.x(), 0.0095, 0.0001);
    EXPECT_NEAR(ankle.y(), Sign(side) * 0.095, 1e-12);
    EXPECT_NEAR(leg.joints[3].lower, 2 * kDegree, 1e-12);
    EXPECT_EQ(leg.joints[0].max_speed, 3.54108);
    EXPECT_EQ(LegBranchOf(leg, leg.standing_q), leg.branch);
  }
}

// The sole's centre lies `foot` from the ankle, seen from the right leg.
void ExpectLengths(const RobotModel& robot, double hips, double thigh, double shank,
                   const Vector3d& foot) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Leg& leg = robot.legs[static_cast<size_t>(Index(side))];
    const Vector3d& knee = leg.joints[3].point_B;
    EXPECT_NEAR(leg.hip_B.y(), 0.5 * Sign(side) * hips, 1e-12);
    EXPECT_NEAR((leg.hip_B - knee).norm(), thigh, 1e-12);
    EXPECT_NEAR((leg.ankle_B - knee).norm(), shank, 1e-12);
    const Vector3d mirrored(foot.x(), -Sign(side) * foot.y(), foot.z());
    EXPECT_LT((leg.X_BSole.translation() - leg.ankle_B - mirrored).norm(), 1e-12);
  }
}

double HeightOf(const RobotModel& robot) {
  double top = 0.0;
  for (const RobotBody& body : robot.bodies) {
    if (body.leg < 0) top = std::max(top, body.shape.vertices.row(2).maxCoeff());
  }
  return top - robot.legs[0].X_BSole.translation().z();  // legs stretched
}

TEST(Wren, HasThePublishedNumbers) {
  const RobotModel robot = ShippedRobot("wren");
  EXPECT_NEAR(robot.mass, 2.9, 0.03);
  EXPECT_NEAR(HeightOf(robot), 0.4545, 0.0005);
  EXPECT_EQ(robot.sole_size, Eigen::Vector2d(0.104, 0.066));
  ExpectLengths(robot, 0.074, 0.093, 0.093, {0, -0.0105, -0.0335});
  // Left pitch axes point the other way, so mirrored postures have opposite angles.
  EXPECT_LT((robot.legs[0].standing_q + robot.legs[1].standing_q).norm(), 1e-12);
}

TEST(Bison, HasThePublishedNumbersAndAxesOfItsOwn) {
  const RobotModel robot = ShippedRobot("bison");
  EXPECT_NEAR(robot.mass, 95.0, 0.05);
  EXPECT_NEAR(HeightOf(robot), 1.75, 0.02);
  ExpectLengths(robot, 0.170, 0.380, 0.325, {0.002, 0, -0.107});
  const std::array<Vector3d, 6> right = {-Vector3d::UnitX(), Vector3d::UnitZ(),
                                         -Vector3d::UnitY(), Vector3d::UnitY(),
                                         -Vector3d::UnitX(), -Vector3d::UnitY()};
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_LT((robot.legs[1].joints[i].axis_B - right[i]).norm(), 1e-12) << i;
    EXPECT_EQ(robot.legs[0].joints[i].lower, robot.legs[1].joints[i].lower) << i;
  }
  EXPECT_LT((robot.legs[0].standing_q - robot.legs[1].standing_q).norm(), 1e-12);
}

TEST(Hrp2, ComHeightOfTheModelWhenTheFileGivesNone) {
  const std::string folder = InSources("wpg/robots/");
  std::ifstream file(kHrp2);
  std::string yaml{std::istreambuf_iterator<char>(file), {}};
  yaml = Replaced(yaml, "com_height_m: 0.814", "com_height_m: none");
  yaml = Replaced(yaml, "urdf: hrp2.urdf", "urdf: " + folder + "hrp2.urdf");
  yaml = Replaced(yaml, "./hrp2}", folder + "hrp2}");
  const RobotModel robot = TemporaryRobot("com", "", yaml).Load();
  EXPECT_NEAR(robot.com_height, 0.8077, 0.00005);
}

TEST(Hrp2, BodiesFillTheirExtents) {
  const RobotModel robot = LoadRobot(kHrp2);
  struct Extents {
    std::string name;
    Vector3d low, high;
  };
  for (const Extents& e : {Extents{"RLEG_LINK2", {-0.050, -0.136, -0.337}, {0.057, 0.001, 0.040}},
                           Extents{"RLEG_LINK3", {-0.077, -0.126, -0.336}, {0.106, 0.015, 0.104}},
                           Extents{"LLEG_LINK3", {-0.077, -0.015, -0.336}, {0.106, 0.126, 0.104}},
                           Extents{"RLEG_LINK5", {-0.106, -0.079, -0.105}, {0.136, 0.058, 0.035}},
                           Extents{"WAIST", {-0.173, -0.164, 0.065}, {0.123, 0.164, 0.330}}}) {
    const auto body = std::find_if(robot.bodies.begin(), robot.bodies.end(),
                                   [&](const RobotBody& b) { return b.name == e.name; });
    ASSERT_NE(body, robot.bodies.end()) << e.name;
    EXPECT_LT((body->shape.vertices.rowwise().minCoeff() - e.low).norm(), 1e-12) << e.name;
    EXPECT_LT((body->shape.vertices.rowwise().maxCoeff() - e.high).norm(), 1e-12) << e.name;
  }
  EXPECT_EQ(robot.bodies.size(), 23u);
}

TEST(Hrp2, HeadIsOnTopAndHandsAreBesideTheWaist) {
  const RobotModel robot = LoadRobot(kHrp2);
  for (const RobotBody& body : robot.bodies) {
    if (body.name == "HEAD_LINK1") {
      EXPECT_NEAR(body.shape.vertices.row(2).maxCoeff() + robot.waist_height, 1.507, 1e-3);
    }
    if (body.name == "RARM_LINK5") {
      EXPECT_EQ(body.leg, -1);
      EXPECT_LT(body.shape.vertices.row(1).maxCoeff(), -0.25);
      EXPECT_LT(body.shape.vertices.row(2).maxCoeff(), 0.1);
    }
  }
}

// Names of the bodies of all watched pairs, and of all others that move against each other with the
// reason why not.
using NamePair = std::pair<std::string, std::string>;
struct WatchedPairs {
  explicit WatchedPairs(const RobotModel& robot) {
    const auto names = [&](int a, int b) {
      return std::pair(std::minmax(robot.bodies[static_cast<size_t>(a)].name,
                                   robot.bodies[static_cast<size_t>(b)].name));
    };
    for (const auto& [a, b] : robot.self_pairs) watched.insert(names(a, b));
    for (const UnwatchedPair& pair : robot.unwatched_pairs) {
      EXPECT_LT(pair.a, pair.b);
      unwatched[names(pair.a, pair.b)] = pair.why;
    }
    size_t moving = 0;
    for (size_t a = 0; a < robot.bodies.size(); ++a) {
      for (size_t b = 0; b < a; ++b) {
        const RobotBody &first = robot.bodies[a], &second = robot.bodies[b];
        if (first.leg == second.leg && first.link == second.link) continue;
        const NamePair pair = names(static_cast<int>(a), static_cast<int>(b));
        EXPECT_NE(watched.contains(pair), unwatched.contains(pair)) << pair.first << pair.second;
        ++moving;
      }
    }
    EXPECT_EQ(watched.size() + unwatched.size(), moving);
  }
  std::set<NamePair> watched;
  std::map<NamePair, std::string> unwatched;
};

TEST(ShippedRobots, EveryTwoBodiesThatMoveAgainstEachOtherAreWatchedOrSaidNotToBe) {
  for (const std::string& name : kShippedRobots) {
    SCOPED_TRACE(name);
    const RobotModel robot = ShippedRobot(name);
    const WatchedPairs pairs(robot);
    EXPECT_EQ(pairs.watched.size(), robot.self_pairs.size());
    EXPECT_EQ(pairs.unwatched.size(), 18u) << "of each leg: six joints, two at the hip, one ankle";
  }
}

TEST(Hrp2, WatchesWhatItsLegsMayMeet) {
  auto [watched, unwatched] = WatchedPairs(LoadRobot(kHrp2));
  for (const std::pair<std::string, std::string> pair :
       {std::pair{"LLEG_LINK5", "RLEG_LINK5"}, std::pair{"LARM_LINK5", "LLEG_LINK2"},
        std::pair{"LLEG_LINK1", "RLEG_LINK1"}, std::pair{"LLEG_LINK0", "RLEG_LINK0"},
        std::pair{"RLEG_LINK3", "WAIST"}, std::pair{"RLEG_LINK2", "WAIST"},
        std::pair{"RLEG_LINK2", "RLEG_LINK4"}, std::pair{"RLEG_LINK2", "RLEG_LINK5"},
        std::pair{"LLEG_LINK1", "LLEG_LINK3"}}) {
    EXPECT_TRUE(watched.contains(pair)) << pair.first << " " << pair.second;
  }
  EXPECT_EQ((unwatched[{"RLEG_LINK2", "RLEG_LINK3"}]), "joined by RLEG_JOINT3");
  EXPECT_EQ((unwatched[{"RLEG_LINK0", "WAIST"}]), "joined by RLEG_JOINT0");
  EXPECT_EQ((unwatched[{"RLEG_LINK1", "WAIST"}]),
            "joined at the hip by RLEG_JOINT0 and RLEG_JOINT1");
  EXPECT_EQ((unwatched[{"LLEG_LINK3", "LLEG_LINK5"}]),
            "joined at the ankle by LLEG_JOINT4 and LLEG_JOINT5");
}

TEST(Hrp2, SoleOutlineIsTheFootsBottomOfBothFeet) {
  const RobotModel robot = LoadRobot(kHrp2);
  // The feet's extents about the ankle, seen from the sole's centre; left and right mirrored.
  ASSERT_EQ(robot.sole_outline.cols(), 4);
  EXPECT_LT((robot.sole_outline.rowwise().maxCoeff() - Eigen::Vector2d(0.121, 0.069)).norm(),
            1e-12);
  EXPECT_LT((robot.sole_outline.rowwise().minCoeff() + Eigen::Vector2d(0.121, 0.069)).norm(),
            1e-12);
}

}  // namespace
}  // namespace halfstep
