// Robots whose feet are each their own: legs that are no mirror images, soles that are no boxes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "experiments/commands/commands.h"
#include "experiments/survey/robot_survey.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/patterns.h"
#include "tests/places.h"
#include "tests/replaced.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/generated_robots.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

const fs::path kShipped = InSources("wpg/robots");

// The URDF's text with `part` replaced after the joint of that name begins.
std::string WithJoint(const std::string& urdf, const std::string& joint, const std::string& part,
                      const std::string& by) {
  const size_t from = urdf.find("<joint name=\"" + joint + "\"");
  return urdf.substr(0, from) + Replaced(urdf.substr(from), part, by);
}

// wren with a right shin that is 2.5 mm longer, an ankle axis that is 0.5 deg askew, a hip that
// turns less, and a knee whose speed limit is a slip of its maker.
std::string UnequalWren() {
  std::string urdf = ReadText(kShipped / "wren.urdf");
  urdf = WithJoint(urdf, "right_ankle_pitch", "0 0 -0.093", "0 0 -0.0955");
  urdf = WithJoint(urdf, "right_ankle_roll", "xyz=\"1 0 0\"", "xyz=\"0.99996192 0.00872654 0\"");
  urdf = WithJoint(urdf, "right_hip_yaw", "upper=\"0.610865238198015\"", "upper=\"0.55\"");
  return WithJoint(urdf, "right_knee", "velocity=\"5.65\"", "velocity=\"5.25\"");
}

TEST(UnequalFeet, WalkWithEachLegAsItIs) {
  const TemporaryFolder place;
  WriteText(place / "wren.urdf", UnequalWren());
  const Outcome outcome =
      Halfstep(place.path(), {"robot", "wren.urdf", "--package",
                              "wren_bodies=" + (kShipped / "wren").string(), "--out", "own.yaml"});
  EXPECT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("dichotomy              converged        certified"));
  EXPECT_THAT(
      outcome.err,
      AllOf(HasSubstr("the right leg differs from the left one's mirror image: "),
            HasSubstr("ankle by 2.5 mm"), HasSubstr("the axis of right_ankle_roll by 0.5 deg"),
            HasSubstr("the limits of right_hip_yaw by 3.49 deg"),
            HasSubstr("the speed limit of right_knee by 0.4 rad/s"),
            HasSubstr("; each leg is taken as it is")));
  const RobotModel robot = LoadRobot((place / "own.yaml").string());
  EXPECT_FALSE(robot.legs_are_mirrored);
  EXPECT_EQ(robot.legs[1].joints[3].max_speed, 5.25);
  EXPECT_EQ(robot.legs[0].joints[3].max_speed, 5.65);
  // The longer leg is bent more, so that both soles are level with each other (or else loading
  // would complain).
  EXPECT_GT(std::abs(robot.legs[1].standing_q[3]), std::abs(robot.legs[0].standing_q[3]) + 0.01);
}

// A foot's box of 0.2 x 0.11 x 0.04 m in the place of which other shapes carry.
std::string WithFeet(const std::string& urdf, const std::string& shapes) {
  const std::string foot =
      "<collision><origin xyz='([^ ]*) ([^ ]*) ([^']*)' rpy='[^']*'/><geometry><box size='0.2 0.11 "
      "0.04'/></geometry></collision>";
  std::string text, rest = urdf;
  for (PatternMatch found = FirstMatch(rest, foot); found; found = FirstMatch(rest, foot)) {
    std::string own = shapes;
    for (const auto& [name, group] : {std::pair{"X", 1}, std::pair{"Y", 2}, std::pair{"Z", 3}}) {
      own = AllReplaced(own, "\\{" + std::string(name) + "([-+][0-9.]*)\\}",
                        "{" + found[static_cast<size_t>(group)] + "$1}");
    }
    // Adds up what stands in braces.
    const std::string sum = "\\{([-0-9.e]*)([-+][0-9.]*)\\}";
    for (PatternMatch two = FirstMatch(own, sum); two; two = FirstMatch(own, sum)) {
      own = two.before + std::to_string(std::stod(two[1]) + std::stod(two[2])) + two.after;
    }
    text += found.before + own;
    rest = found.after;
  }
  return text + rest;
}

std::string ShapeAt(const std::string& xyz, const std::string& rpy, const std::string& geometry) {
  return "<collision><origin xyz='" + xyz + "' rpy='" + rpy + "'/><geometry>" + geometry +
         "</geometry></collision>";
}

TEST(SurveyedSoles, OfBallsOfLyingCylindersAndOfPoints) {
  GeneratedRobot robot = GeneratedRobots()[0];  // link frames are parallel to the waist's
  const std::string urdf = GeneratedUrdf(robot);
  std::string balls, points, cylinders;
  for (const char* x : {"{X-0.09}", "{X+0.09}"}) {
    for (const char* y : {"{Y-0.045}", "{Y+0.045}"}) {
      const std::string at = std::string(x) + " " + y;
      balls += ShapeAt(at + " {Z-0.01}", "0 0 0", "<sphere radius='0.01'/>");
      points += ShapeAt(at + " {Z-0.02}", "0 0 0", "<sphere radius='0.00001'/>");
    }
  }
  for (const char* y : {"{Y-0.045}", "{Y+0.045}"}) {
    cylinders += ShapeAt("{X+0.0} " + std::string(y) + " {Z-0.01}", "0 1.57 0",  // not quite flat
                         "<cylinder radius='0.01' length='0.18'/>");
  }
  for (const auto& [name, shapes] : {std::pair{"balls", balls}, std::pair{"points", points},
                                     std::pair{"cylinders", cylinders}}) {
    SCOPED_TRACE(name);
    const TemporaryFolder place;
    const RobotSurvey survey =
        SurveyRobot({.urdf = WriteText(place / "robot.urdf", WithFeet(urdf, shapes))});
    ASSERT_THAT(survey.refused, IsEmpty());
    const RobotModel model = ModelOf(survey.draft);
    EXPECT_NEAR(model.sole_size.x(), 0.18, 2e-4);
    EXPECT_GE(model.sole_size.y(), 0.09 - 2e-4);
    // What is round touches where it is less than 0.2 mm above the floor.
    EXPECT_LE(model.sole_size.y(), 0.09 + 2e-4 + (name == std::string("cylinders") ? 4e-3 : 0.0));
    const Leg box = MakeLeg(robot, Side::kLeft);
    EXPECT_NEAR(model.legs[0].X_BSole.translation().x(), box.X_BSole.translation().x(), 1e-4);
    EXPECT_NEAR(model.legs[0].X_BSole.translation().y(), box.X_BSole.translation().y(), 1e-4);
    EXPECT_THAT(YamlOf(survey.draft), HasSubstr("lowest balls, cylinders, edges and points"));
  }
}

// Three balls under a foot that is tilted with all joints at zero.
TEST(SurveyedSoles, OfBallsThatLieAskew) {
  const std::string urdf = GeneratedUrdf(GeneratedRobots()[0]);
  std::string balls;
  for (const char* at : {"{X-0.09} {Y-0.045} {Z-0.01}", "{X-0.09} {Y+0.045} {Z-0.01}",
                         "{X+0.09} {Y-0.045} {Z+0.005}", "{X+0.09} {Y+0.045} {Z+0.005}"}) {
    balls += ShapeAt(at, "0 0 0", "<sphere radius='0.01'/>");
  }
  const TemporaryFolder place;
  const RobotSurvey survey =
      SurveyRobot({.urdf = WriteText(place / "robot.urdf", WithFeet(urdf, balls))});
  ASSERT_THAT(survey.refused, IsEmpty());
  for (const FoundSole& sole : survey.draft.soles) {
    EXPECT_NEAR(sole.tilt, std::atan2(0.015, 0.18), 1e-4);
    EXPECT_NEAR(sole.size.x(), std::hypot(0.015, 0.18), 1e-4);
  }
  EXPECT_NO_THROW((void)ModelOf(survey.draft));
}

TEST(SurveyedSoles, DifferByFoot) {
  std::string urdf = GeneratedUrdf(GeneratedRobots()[0]);
  // The left foot comes first.
  urdf = Replaced(urdf, "<box size='0.2 0.11 0.04'/>", "<box size='0.19 0.12 0.04'/>");
  const TemporaryFolder place;
  const RobotSurvey survey = SurveyRobot({.urdf = WriteText(place / "robot.urdf", urdf)});
  ASSERT_THAT(survey.refused, IsEmpty());
  EXPECT_THAT(YamlOf(survey.draft),
              AllOf(HasSubstr("# What both soles have: 0.19 x 0.12 m and 0.2 x 0.11 m."),
                    HasSubstr("sole_size_m: [0.19, 0.11]")));
}

TEST(SurveyedSoles, MayBeStated) {
  const TemporaryFolder place;
  const std::string urdf = GeneratedUrdf(GeneratedRobots()[0]);
  const auto refused = [&](const std::string& shapes, const std::optional<StatedSoles>& soles) {
    const RobotSurvey survey = SurveyRobot(
        {.urdf = WriteText(place / "robot.urdf", WithFeet(urdf, shapes)), .soles = soles});
    if (survey.refused.empty()) {
      EXPECT_EQ(ModelOf(survey.draft).sole_size.x(), 0.15);
    }
    return survey.refused.empty() ? "" : survey.refused[0];
  };
  const std::string one_ball =
      ShapeAt("{X+0.0} {Y+0.0} {Z-0.01}", "0 0 0", "<sphere radius='0.01'/>");
  EXPECT_THAT(refused(one_ball, {}), HasSubstr("stands on an edge or a point"));
  EXPECT_EQ(refused(one_ball, StatedSoles{.size = {0.15, 0.08}, .centre = Eigen::Vector2d(0, 0)}),
            "");
  EXPECT_THAT(refused("", {}), HasSubstr("foot has no collision bodies (valid: some, or --sole"));
  EXPECT_EQ(refused("", StatedSoles{.size = {0.15, 0.08}, .centre = Eigen::Vector2d(0.02, 0)}), "");
}

TEST(SurveyedSoles, AreRefusedWhereTheOptionIsNone) {
  const TemporaryFolder place;
  WriteText(place / "robot.urdf", GeneratedUrdf(GeneratedRobots()[0]));
  const Outcome outcome =
      Halfstep(place.path(), {"robot", "robot.urdf", "--sole", "0.2", "0.1", "0"});
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("--sole: no sole (valid: LENGTH WIDTH"));
}

}  // namespace
}  // namespace halfstep
