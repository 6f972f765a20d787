#include "wpg/robot/robot_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <regex>
#include <set>
#include <string>

#include "tests/fixture_check.h"
#include "tests/replaced.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/generated_robots.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/robot/leg_ik.h"
#include "wpg/robot/robot_fields.h"
#include "wpg/robot/sole_outline.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;

// All complaints of a robot, or "" when it is accepted.
std::string RefusalOf(const TemporaryRobot& robot) {
  try {
    (void)robot.Load();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string RefusalOf(const GeneratedRobot& robot) { return RefusalOf(TemporaryRobot(robot)); }

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
  const std::string folder = HALFSTEP_SOURCE_DIR "/wpg/robots/";
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

TEST(GeneratedRobot, LegsAreFoundInTheUrdf) {
  for (const GeneratedRobot& generated : GeneratedRobots()) {
    const RobotModel robot = TemporaryRobot(generated).Load();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Leg& leg = robot.legs[static_cast<size_t>(Index(side))];
      const Leg expected = MakeLeg(generated, side);
      EXPECT_LT((leg.hip_B - expected.hip_B).norm(), 1e-9) << generated.name;
      EXPECT_LT((leg.ankle_B - expected.ankle_B).norm(), 1e-9);
      EXPECT_LT((leg.X_BSole.matrix() - expected.X_BSole.matrix()).norm(), 1e-9);
      EXPECT_LT((leg.standing_q - expected.standing_q).norm(), 1e-9);
      EXPECT_EQ(leg.branch, expected.branch);
      for (size_t i = 0; i < 6; ++i) {
        EXPECT_LT((leg.joints[i].axis_B - expected.joints[i].axis_B).norm(), 1e-9);
        EXPECT_LT((leg.joints[i].X_BLink.matrix() - expected.joints[i].X_BLink.matrix()).norm(),
                  1e-9);
        EXPECT_NEAR(leg.joints[i].lower, expected.joints[i].lower, 1e-12);
      }
    }
    EXPECT_NEAR(robot.mass, 20 + 12 * 1.5, 1e-9);
    EXPECT_GT(robot.com_height, 0.3);
    EXPECT_EQ(robot.bodies.size(), 9u);
  }
}

TEST(GeneratedRobot, ShapesStandUprightAtZeroWhateverTheLinkFrames) {
  const RobotModel robot = TemporaryRobot(GeneratedRobots()[2]).Load();
  const Leg& leg = robot.legs[0];
  for (const RobotBody& body : robot.bodies) {
    if (body.name != "left_link3" && body.name != "left_link5") continue;
    const Isometry3d X_BLink = leg.joints[static_cast<size_t>(body.link)].X_BLink;
    const auto extent = [&](const Vector3d& d_B) {
      const Vector3d d = X_BLink.linear().transpose() * d_B;
      return Support(body.shape, d) + Support(body.shape, -d);
    };
    if (body.name == "left_link5") {
      EXPECT_NEAR(extent({1, 0, 0}), 0.2, 1e-9);
      EXPECT_NEAR(extent({0, 0, 1}), 0.04, 1e-9);
    } else {  // a tilted cylinder: a prism around it
      EXPECT_NEAR(extent({0, 0, 1}), 0.24, 1e-9);
      for (int k = 0; k < 100; ++k) {
        const double diameter = extent({std::cos(0.01 * k), std::sin(0.01 * k), 0});
        EXPECT_GE(diameter, 0.08 - 1e-12);
        EXPECT_LE(diameter, 0.08 * 1.005);
      }
    }
  }
}

TEST(GeneratedRobot, ExcludedPairsAreListedWithTheirReason) {
  const GeneratedRobot generated = GeneratedRobots()[0];
  const std::string yaml = GeneratedYaml(generated, "robot.urdf") +
                           "excluded_self_pairs:\n"
                           "  - {links: [waist, left_link2], why: padded}\n"
                           "  - {links: [right_link2, waist]}\n";
  const RobotModel robot = TemporaryRobot("excluded", GeneratedUrdf(generated), yaml).Load();
  std::map<std::string, std::string> why;
  for (const UnwatchedPair& pair : robot.unwatched_pairs) {
    why[robot.bodies[static_cast<size_t>(pair.b)].name] += pair.why + "; ";
  }
  EXPECT_EQ(why["left_link2"], "excluded by the robot file: padded; ");
  EXPECT_EQ(why["right_link2"], "excluded by the robot file; ");
}

TEST(GeneratedRobot, FixedJointsAreFoldedIn) {
  const GeneratedRobot generated = GeneratedRobots()[0];
  // A fixed link between waist and left hip, and a toe plate fixed on the left foot.
  std::string urdf =
      Replaced(GeneratedUrdf(generated), "<parent link='waist'/>", "<parent link='bracket'/>");
  urdf = Replaced(urdf, "</robot>",
                  "<link name='bracket'/><joint name='b' type='fixed'><parent link='waist'/><child "
                  "link='bracket'/></joint><link name='toe'><collision><geometry><sphere "
                  "radius='0.01'/></geometry></collision></link><joint name='t' type='fixed'>"
                  "<origin xyz='0.1 0 0'/><parent link='left_link5'/><child link='toe'/></joint>"
                  "</robot>");
  const RobotModel robot =
      TemporaryRobot("fixed", urdf, GeneratedYaml(generated, "robot.urdf")).Load();
  EXPECT_LT((robot.legs[0].hip_B - MakeLeg(generated, Side::kLeft).hip_B).norm(), 1e-9);
  const auto toe = std::find_if(robot.bodies.begin(), robot.bodies.end(),
                                [](const RobotBody& body) { return body.name == "toe"; });
  ASSERT_NE(toe, robot.bodies.end());
  EXPECT_EQ(toe->leg, 0);
  EXPECT_EQ(toe->link, 5);
  EXPECT_LT((toe->shape.center - Vector3d(0.1, 0, 0)).norm(), 1e-12);
}

// A foot whose box is replaced by another shape, which stands on the sole's plane.
RobotModel WithFoot(const std::string& geometry, double center_height) {
  const GeneratedRobot generated = GeneratedRobots()[0];
  std::string urdf = GeneratedUrdf(generated);
  for (const double side : {1.0, -1.0}) {
    const Vector3d at(generated.foot.x(), side * generated.foot.y(),
                      generated.foot.z() + center_height);
    const std::string size = "<box size='0.2 0.11 0.04'/>";
    const size_t end = urdf.find(size), begin = urdf.rfind("<collision>", end);
    urdf.replace(begin, end + size.size() - begin,
                 "<collision><origin xyz='" + generated::Text(at) + "'/><geometry>" + geometry);
  }
  return TemporaryRobot("foot", urdf, GeneratedYaml(generated, "robot.urdf")).Load();
}

TEST(GeneratedRobot, SoleOutlineHoldsEveryPointNearTheFloor) {
  // Larger than the sole rectangle of 0.2 × 0.11 m where the shape is.
  const auto reach = [](const RobotModel& robot) -> Eigen::Vector2d {
    return robot.sole_outline.rowwise().maxCoeff();
  };
  EXPECT_LT(
      (reach(WithFoot("<box size='0.24 0.1 0.04'/>", 0.02)) - Eigen::Vector2d(0.12, 0.055)).norm(),
      1e-12);
  EXPECT_LT(
      (reach(WithFoot("<box size='0.24 0.1 0.04'/>", 0.0211)) - Eigen::Vector2d(0.1, 0.055)).norm(),
      1e-12)
      << "a body 1.1 mm above the sole does not touch";
  EXPECT_NEAR(reach(WithFoot("<cylinder radius='0.15' length='0.04'/>", 0.02)).x(), 0.15, 2e-4);
  EXPECT_GE(reach(WithFoot("<cylinder radius='0.15' length='0.04'/>", 0.02)).y(), 0.15 - 1e-12);
  EXPECT_GE(reach(WithFoot("<sphere radius='0.15'/>", 0.15)).y(),
            std::sqrt(0.15 * 0.15 - 0.149 * 0.149));
}

TEST(RobotRefusal, JointLimitsMoreThanATurnApart) {
  const GeneratedRobot robot = GeneratedRobots()[0];
  const std::string yaml = GeneratedYaml(robot, "robot.urdf");
  const auto with_limits = [&](const std::string& limit) {
    const std::string lower = std::regex_replace(GeneratedUrdf(robot), std::regex("lower='[^']*'"),
                                                 "lower='-" + limit + "'");
    return std::regex_replace(lower, std::regex("upper='[^']*'"), "upper='" + limit + "'");
  };
  EXPECT_THAT(RefusalOf({"wide", with_limits("3.2"), yaml}),
              HasSubstr("left_joint0: its limits are more than a turn apart (valid: at most 360 "));
  EXPECT_NO_THROW((void)TemporaryRobot("turn", with_limits("3.14159"), yaml).Load());
  std::string narrowed = yaml + "joint_limits_deg:\n";
  for (const std::string side : {"left", "right"}) {
    for (int i = 0; i < 6; ++i) {
      narrowed += "  " + side + "_joint" + std::to_string(i) + ": [-180, 180]\n";
    }
  }
  EXPECT_NO_THROW((void)TemporaryRobot("narrowed", with_limits("3.2"), narrowed).Load());
}

TEST(RobotModel, TorqueLimitsAreTheEffortsOrTheRobotFiles) {
  EXPECT_EQ(ShippedRobot("bison").legs[0].joints[3].max_torque, 300.0);
  EXPECT_TRUE(std::isinf(LoadRobot(kHrp2).legs[0].joints[3].max_torque)) << "its efforts are 0";
  const GeneratedRobot robot = GeneratedRobots()[0];
  const std::string yaml = GeneratedYaml(robot, "robot.urdf") +
                           "effort_limits_n_m: {left_joint0: 12.5, left_joint1: none}\n";
  const RobotModel model = TemporaryRobot("efforts", GeneratedUrdf(robot), yaml).Load();
  EXPECT_EQ(model.legs[0].joints[0].max_torque, 12.5);
  EXPECT_TRUE(std::isinf(model.legs[0].joints[1].max_torque));
  EXPECT_EQ(model.legs[1].joints[0].max_torque, 100.0);
  EXPECT_THAT(model.warnings, testing::IsEmpty());
  const std::string silent =
      Replaced(GeneratedUrdf(robot), "' effort='100'/>", "' effort='0'/>");  // the first joint's
  const RobotModel unknown =
      TemporaryRobot("silent", silent, GeneratedYaml(robot, "robot.urdf")).Load();
  ASSERT_EQ(unknown.warnings.size(), 1u);
  EXPECT_THAT(unknown.warnings[0], HasSubstr("no effort limit of "));
}

// Offset hips are another class of legs, but the legs must be the same.
TEST(RobotRefusal, OneHipWhoseAxesPassEachOther) {
  GeneratedRobot robot = GeneratedRobots()[0];
  const std::string urdf = GeneratedUrdf(robot);
  const std::string yaml = GeneratedYaml(robot, "robot.urdf");
  // The left hip's third axis (z) 12 mm ahead of the first (x) and second (y).
  const std::string joint = "<child link='left_link2'/><origin xyz='0 0 0'";
  const std::string refusal = RefusalOf(
      {"apart", Replaced(urdf, joint, "<child link='left_link2'/><origin xyz='0 0.012 0'"), yaml});
  EXPECT_THAT(refusal, HasSubstr("mm off the mirror image"));
}

// Offset axes are moved with a proof that needs a posture to begin with.
TEST(RobotRefusal, OffsetAxesOfANearlyStretchedLeg) {
  GeneratedRobot robot = OffsetRobots()[0];
  std::string yaml = GeneratedYaml(robot, "robot.urdf");
  const std::string urdf = GeneratedUrdf(robot);
  yaml = yaml.substr(0, yaml.find("standing_posture_deg"));
  yaml += "standing_posture_deg: {";
  for (const std::string side : {"left", "right"}) {
    const std::string joint = (side == "left" ? "" : ", ") + side + "_joint";
    yaml += joint + "2: -9.2, " + side + "_joint3: 2.4, " + side + "_joint4: 6.8";
  }
  const std::string refusal = RefusalOf({"stretched", urdf, yaml + "}\n"});
  EXPECT_THAT(refusal, HasSubstr("left_joint2: hip axes left_joint0 and left_joint2 pass each "
                                 "other at 50.0 mm, hip axes left_joint1 and left_joint2 pass each "
                                 "other at 66.0 mm; so there is no closed form for the leg's "
                                 "joints, and in the standing posture it is too near to a "
                                 "singularity for a proof without: bend it more there"));
}

TEST(RobotRefusal, LegsThatAreNoClosedFormLegs) {
  const GeneratedRobot good = GeneratedRobots()[0];
  const std::string urdf = GeneratedUrdf(good), yaml = GeneratedYaml(good, "robot.urdf");
  EXPECT_EQ(RefusalOf(good), "");
  const auto with_axis = [&](const std::string& child, const std::string& axis) {
    const size_t at = urdf.find("<axis", urdf.find("<child link='" + child + "'/>"));
    std::string changed = urdf;
    changed.replace(at, urdf.find("/>", at) - at, "<axis xyz='" + axis + "'");
    return RefusalOf({"axis", changed, yaml});
  };
  EXPECT_THAT(with_axis("left_link5", "0 1 0"),
              HasSubstr("ankle axes left_joint4 and left_joint5 are parallel"));
  EXPECT_THAT(with_axis("left_link1", "1 0 0"),
              HasSubstr("hip axes left_joint0 and left_joint1 are parallel"));
  const Vector3d to_ankle = good.shank.normalized();
  EXPECT_THAT(with_axis("left_link3", generated::Text(to_ankle)),
              HasSubstr("the knee axis passes the ankle at"));
  EXPECT_THAT(RefusalOf({"type", Replaced(urdf, "type='revolute'", "type='continuous'"),
                         Replaced(yaml, "  left_joint0:", "#")}),
              HasSubstr("is not the mirror image of left_joint0: its limits differ"));
  EXPECT_THAT(RefusalOf({"five", Replaced(urdf, "type='revolute'", "type='fixed'"),
                         Replaced(yaml, "  left_joint0:", "#")}),
              HasSubstr("left_link5: is 5 revolute joints away from the waist (valid: 6)"));
  EXPECT_THAT(
      RefusalOf({"foot", urdf, Replaced(yaml, "waist_link: waist", "waist_link: right_link0")}),
      HasSubstr("left_link5: does not hang on right_link0"));
  EXPECT_THAT(RefusalOf({"mirror",
                         Replaced(urdf, "<child link='left_link3'/><origin xyz='0.02",
                                  "<child link='left_link3'/><origin xyz='0.0203"),
                         yaml}),
              HasSubstr("mirror image"));
  // The left leg's joints come first in the URDF.
  EXPECT_THAT(RefusalOf({"speed", Replaced(urdf, "velocity='4.5'", "velocity='4.4'"), yaml}),
              HasSubstr("is not the mirror image of left_joint1: its speed limit differs"));
  EXPECT_THAT(
      RefusalOf({"mesh",
                 Replaced(urdf, "<sphere radius='0.035'/>", "<mesh filename='http://ankle.stl'/>"),
                 yaml}),
      HasSubstr("left_link4: http://ankle.stl is no mesh path"));
  EXPECT_THAT(RefusalOf({"package",
                         Replaced(urdf, "<sphere radius='0.035'/>",
                                  "<mesh filename='package://p/ankle.stl'/>"),
                         yaml}),
              HasSubstr("left_link4: package `p` of package://p/ankle.stl has no folder"));
}

TEST(RobotRefusal, BodiesThatReachTooFar) {
  const GeneratedRobot good = GeneratedRobots()[0];
  const std::string urdf =
      Replaced(GeneratedUrdf(good), "<sphere radius='0.035'/>", "<sphere radius='101'/>");
  EXPECT_THAT(RefusalOf({"far", urdf, GeneratedYaml(good, "robot.urdf")}),
              HasSubstr("left_link4: reaches more than 100 m from its link"));
}

TEST(RobotRefusal, StretchedStandingPosture) {
  const GeneratedRobot good = GeneratedRobots()[0];
  std::string yaml = GeneratedYaml(good, "robot.urdf");
  yaml.erase(yaml.find("standing_posture_deg"));
  GeneratedRobot straight = good;
  straight.thigh = {0, 0, -0.3};
  straight.shank = {0, 0, -0.3};
  const std::string refusal =
      RefusalOf({"straight", GeneratedUrdf(straight), GeneratedYaml(straight, "robot.urdf")});
  EXPECT_EQ(refusal, "");
  EXPECT_THAT(RefusalOf({"straight", GeneratedUrdf(straight), yaml}), HasSubstr("singular"));
}

TEST(RobotRefusal, MissingUrdf) {
  const TemporaryRobot robot("gone", "", GeneratedYaml(GeneratedRobots()[0], "gone.urdf"));
  EXPECT_THAT(RefusalOf(robot), HasSubstr("gone.urdf: cannot be opened: No such file"));
}

class RobotFixture : public testing::TestWithParam<std::string> {};

TEST_P(RobotFixture, IsRefusedWithItsComplaints) { CheckFixture(GetParam(), LoadRobot); }

INSTANTIATE_TEST_SUITE_P(Yaml, RobotFixture, testing::ValuesIn(Fixtures("robot")), FixtureName);

// Half as many vertices as its hulls have; the feet stand where they stood.
TEST(RobotModel, HullsWithTooManyVerticesBecomeSimplerOnesAroundThem) {
  const RobotModel whole = Hrp2();
  EXPECT_TRUE(whole.warnings.empty()) << "shipped hulls stay as they are";
  std::ifstream file(kHrp2);
  std::string yaml{std::istreambuf_iterator<char>(file), {}};
  yaml = Replaced(yaml, "name: hrp2", "name: hrp2\nhull_vertices: 24");
  const RobotModel simple = BuildRobot(kHrp2, yaml, ReadRobotFile(kHrp2, yaml));
  ASSERT_EQ(simple.bodies.size(), whole.bodies.size());
  double largest = 0;
  int simplified = 0;
  for (size_t b = 0; b < whole.bodies.size(); ++b) {
    const ConvexBody &before = whole.bodies[b].shape, &after = simple.bodies[b].shape;
    EXPECT_LE(after.vertices.cols(), 24);
    EXPECT_EQ(whole.bodies[b].mesh_vertices, 0);
    if (simple.bodies[b].mesh_vertices == 0) continue;
    ++simplified;
    EXPECT_EQ(simple.bodies[b].mesh_vertices, before.vertices.cols());
    largest = std::max(largest, simple.bodies[b].excess);
    for (int k = 0; k < 27; ++k) {
      if (k == 13) continue;
      const Vector3d d = Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).normalized();
      EXPECT_GE(Support(after, d), Support(before, d) - 1e-14);
      EXPECT_LE(Support(after, d), Support(before, d) + simple.bodies[b].excess + 1e-14);
    }
  }
  EXPECT_GT(simplified, 10);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    EXPECT_NEAR(DepthBelowSole(simple, side), DepthBelowSole(whole, side), 1e-12);
  }
  ASSERT_EQ(simple.warnings.size(), 1u);
  EXPECT_THAT(simple.warnings[0], HasSubstr(Formatted("at most %.2g mm larger", 1e3 * largest)));
}

// What no leg needs is a warning; the same in a leg is refused.
TEST(RobotModel, AJointThatCannotMoveMattersInALegOnly) {
  const GeneratedRobot good = GeneratedRobots()[0];
  const std::string yaml = GeneratedYaml(good, "robot.urdf");
  std::string finger;
  for (const std::string name : {"thumb", "index", "ring"}) {
    finger += "<link name='" + name + "'/><joint name='move_" + name +
              "' type='revolute'><parent link='waist'/><child link='" + name +
              "'/><limit lower='0' upper='1' velocity='0' effort='1'/></joint>";
  }
  finger += "</robot>";
  const TemporaryRobot robot("finger", Replaced(GeneratedUrdf(good), "</robot>", finger), yaml);
  const RobotModel model = robot.Load();
  ASSERT_EQ(model.warnings.size(), 1u) << testing::PrintToString(model.warnings);
  EXPECT_THAT(model.warnings[0],
              HasSubstr("limit velocity: 0 is out of range (valid: > 0); it is held still, so are "
                        "move_ring, move_thumb"));
  EXPECT_THAT(
      RefusalOf({"leg", Replaced(GeneratedUrdf(good), "velocity='4'", "velocity='0'"), yaml}),
      HasSubstr("limit velocity: 0 is out of range (valid: > 0)"));
}

// A package is looked for where ROS would, and above the URDF.
TEST(RobotModel, FindsAPackageAboveTheUrdf) {
  const GeneratedRobot good = GeneratedRobots()[0];
  const TemporaryFolder place;
  std::filesystem::create_directories(place / "p/meshes");
  std::filesystem::create_directories(place / "p/urdf");
  std::filesystem::copy_file(
      std::string(HALFSTEP_SOURCE_DIR) + "/tests/fixtures/mesh/good/cube_triangles.dae",
      place / "p/meshes/ankle.dae");
  WriteText(place / "p/urdf/robot.urdf",
            Replaced(GeneratedUrdf(good), "<sphere radius='0.035'/>",
                     "<mesh filename='package://p/meshes/ankle.dae' scale='0.03 -0.03 0.03'/>"));
  WriteText(place / "p/urdf/robot.yaml", GeneratedYaml(good, "robot.urdf"));
  const RobotModel model = LoadRobot((place / "p/urdf/robot.yaml").string());
  const auto body = std::ranges::find(model.bodies, "left_link4", &RobotBody::name);
  ASSERT_NE(body, model.bodies.end());
  EXPECT_EQ(body->shape.vertices.cols(), 8);
  EXPECT_LT(body->shape.vertices.row(1).maxCoeff(), 1e-12);  // mirrored
}

}  // namespace
}  // namespace halfstep
