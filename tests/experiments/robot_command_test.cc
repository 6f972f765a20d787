#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/config/scaled_defaults.h"
#include "experiments/survey/robot_picture.h"
#include "experiments/survey/robot_survey.h"
#include "experiments/survey/starter_config.h"
#include "experiments/survey/support_search.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/patterns.h"
#include "tests/places.h"
#include "tests/replaced.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/generated_robots.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/files/input_error.h"
#include "wpg/geometry/rotation.h"
#include "wpg/robot/standing_bounds.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const fs::path kRobots = InSources("wpg/robots");

TEST(RobotCommand, MakesARobotOfAUrdfThatWalksSixSteps) {
  const TemporaryFolder place;
  const std::vector<std::string> arguments = {
      "robot",     (kRobots / "hrp2.urdf").string(),
      "--package", "hrp2_bodies=" + (kRobots / "hrp2").string(),
      "--out",     "guess.yaml"};
  const Outcome outcome = Halfstep(place.path(), arguments);
  EXPECT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("dichotomy              converged        certified"));
  EXPECT_THAT(ReadText(place / "guess.svg"), StartsWith("<svg "));
  // Beside the shipped file, which was made by hand.
  const RobotModel guess = LoadRobot((place / "guess.yaml").string());
  const RobotModel hrp2 = LoadRobot((kRobots / "hrp2.yaml").string());
  EXPECT_NEAR(guess.standing_width, hrp2.standing_width, 0.002);
  EXPECT_NEAR(guess.waist_height, hrp2.waist_height, 0.02);
  EXPECT_LT((guess.legs[0].X_BSole.translation() - hrp2.legs[0].X_BSole.translation()).norm(),
            1e-3);
  EXPECT_EQ(guess.legs[0].joints[3].name, "LLEG_JOINT3");
  EXPECT_EQ(guess.legs[1].joints[3].name, "RLEG_JOINT3");
  // What is there is not replaced unless that is asked for.
  const Outcome again = Halfstep(place.path(), arguments);
  EXPECT_EQ(again.status, kBadInput);
  EXPECT_EQ(again.err, "guess.yaml: is there already (--overwrite replaces it)\n");
  // The config beside it is one of `run`.
  const Outcome run =
      Halfstep(place.path(), {"run", "guess_six_steps.yaml", "--out", "run", "--quiet"});
  EXPECT_EQ(run.status, kSuccess) << run.err;
}

// Robots of 0.45 m and 1.75 m: no number is the user's, and those of the shipped files come out.
TEST(RobotCommand, MakesTheOtherShippedRobotsOfTheirUrdfs) {
  for (const std::string name : {"wren", "bison"}) {
    SCOPED_TRACE(name);
    const TemporaryFolder place;
    const Outcome outcome = Halfstep(
        place.path(), {"robot", (kRobots / (name + ".urdf")).string(), "--package",
                       name + "_bodies=" + (kRobots / name).string(), "--out", "guess.yaml"});
    EXPECT_EQ(outcome.status, kSuccess) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("dichotomy              converged        certified"));
    const RobotModel guess = LoadRobot((place / "guess.yaml").string());
    const RobotModel shipped = LoadRobot((kRobots / (name + ".yaml")).string());
    for (size_t leg = 0; leg < 2; ++leg) {
      const Leg &a = guess.legs[leg], &b = shipped.legs[leg];
      EXPECT_LT((a.X_BSole.matrix() - b.X_BSole.matrix()).norm(), 1e-12);
      for (size_t j = 0; j < 6; ++j) EXPECT_EQ(a.joints[j].name, b.joints[j].name);
    }
    EXPECT_EQ(guess.mass, shipped.mass);
    EXPECT_EQ(guess.self_pairs.size(), shipped.self_pairs.size());
  }
}

TEST(RobotSurvey, FindsLegsSolesAndAPostureOfRobotsWithOtherAxes) {
  for (const GeneratedRobot& robot : GeneratedRobots()) {
    SCOPED_TRACE(robot.name);
    const TemporaryFolder place;
    const std::string file = WriteText(place / "robot.urdf", GeneratedUrdf(robot));
    const RobotDraft draft = SurveyRobot({.urdf = file}).draft;
    EXPECT_TRUE(draft.R_LinkB.isIdentity(0.0));
    EXPECT_TRUE(draft.legs.sides_by_name);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const auto i = static_cast<size_t>(Index(side));
      for (size_t k = 0; k < 6; ++k) {
        EXPECT_EQ(draft.urdf.joints[static_cast<size_t>(draft.legs.joints[i][k])].name,
                  std::string(Name(side)) + "_joint" + std::to_string(k));
      }
    }
    const RobotModel model = ModelOf(draft);  // throws where the soles are not level
    const Leg expected = MakeLeg(robot, Side::kLeft);
    EXPECT_NEAR(model.legs[0].X_BSole.translation().z(), expected.X_BSole.translation().z(), 1e-6);
    EXPECT_NEAR(model.legs[0].X_BSole.translation().x(), model.legs[1].X_BSole.translation().x(),
                1e-6);
  }
}

// HRP-2's arms stretch to the sides where its joints are zero; the file lowers them.
TEST(RobotSurvey, LowersArmsThatStretchToTheSides) {
  const TemporaryFolder place;
  std::string urdf = ReadText(kRobots / "hrp2.urdf");
  for (const auto& [arm, roll] : {std::pair{"RARM", "-1.5707963"}, {"LARM", "1.5707963"}}) {
    const std::string child = std::string("<child link=\"") + arm + "_LINK1\"/>\n    <origin ";
    urdf = Replaced(urdf, child, child + "rpy=\"" + roll + " 0 0\" ");
  }
  const auto survey = [&](const std::string& text) {
    return ModelOf(SurveyRobot({.urdf = WriteText(place / "robot.urdf", text),
                                .packages = {{"hrp2_bodies", (kRobots / "hrp2").string()}}})
                       .draft);
  };
  const RobotModel hangs = survey(ReadText(kRobots / "hrp2.urdf")), lowered = survey(urdf);
  const auto breadth = [](const RobotModel& robot) { return StandingBounds(robot).sizes().y(); };
  EXPECT_NEAR(breadth(lowered), breadth(hangs), 0.02);
  EXPECT_NEAR(lowered.com_height, hangs.com_height, 0.002);
}

// Knees of half the torque: bison stands straighter, and the file says why.
TEST(RobotSurvey, BendsKneesLessForTheirTorque) {
  const TemporaryFolder place;
  const std::string urdf =
      AllReplaced(ReadText(kRobots / "bison.urdf"), "effort=\"300\"", "effort=\"150\"");
  const RobotDraft draft =
      SurveyRobot({.urdf = WriteText(place / "bison.urdf", urdf),
                   .packages = {{"bison_bodies", (kRobots / "bison").string()}}})
          .draft;
  EXPECT_EQ(draft.standing.bend, 0.94);
  EXPECT_THAT(YamlOf(draft),
              testing::ContainsRegex("94 % of the stretched leg apart \\(with more bend a joint "
                                     "lacks [0-9.]+ N m in six steps\\)"));
  EXPECT_GE(LeastInSixSteps(ModelOf(draft), MarginFamily::kTorque, 0.01), 0.0);
}

// On soles of 3.5 cm the whole robot's ZMP comes nearer to their edges than is demanded.
TEST(RobotSurvey, MovesTheSupportPointsOfNarrowSolesOnly) {
  RobotModel robot = ShippedRobot("bison");
  EXPECT_EQ(FindSupport(robot).offset, 0.0);
  robot.sole_size.y() = 0.035;
  const FoundSupport found = FindSupport(robot);
  EXPECT_LT(found.before, DefaultLimits(robot).demanded_of(MarginFamily::kZmpRobot));
  EXPECT_NE(found.offset, 0.0);
  EXPECT_GT(found.after, found.before);
  // What the search left is what a config without numbers gets.
  robot.support_point = found.offset;
  EXPECT_NEAR(LeastInSixSteps(robot, MarginFamily::kZmpRobot, 0.01), found.after, 1e-12);
}

TEST(StarterConfig, SaysWhyStepsAreShort) {
  RobotModel robot = ShippedRobot("hrp2");
  const StarterConfig config{.robot_file = "r.yaml"};
  EXPECT_THAT(StarterConfigText(robot, config), testing::Not(HasSubstr("in place of 0.212 m")));
  for (Leg& leg : robot.legs) leg.joints[4].lower = -0.65;  // ankles [rad]
  EXPECT_THAT(StarterConfigText(robot, config),
              HasSubstr("m in place of 0.211 m: with longer ones a leg comes to its limits."));
}

TEST(StarterConfig, AsksASearchForARobotThatCannotRest) {
  const RobotModel robot = ShippedRobot("wren");
  EXPECT_THAT(StarterConfigText(robot, {.robot_file = "r.yaml"}),
              testing::Not(HasSubstr("\nsmoothing: {methods")));
  EXPECT_THAT(StarterConfigText(robot, {.robot_file = "r.yaml", .why_search = "is too weak"}),
              HasSubstr("# This robot is too weak.\n# So a search looks for another walk.\n"
                        "smoothing: {methods: [halfstep/sqp]}\n"));
}

std::string UrdfRefusal(const std::string& urdf) {
  const TemporaryFolder place;
  const RobotSurvey survey = SurveyRobot({.urdf = WriteText(place / "robot.urdf", urdf)});
  return survey.refused.empty() ? "" : survey.refused.front();
}

TEST(RobotSurvey, SaysFirstWhatKeepsARobotFromBeingOfTheClass) {
  GeneratedRobot robot = GeneratedRobots()[0];
  const std::string good = GeneratedUrdf(robot);
  EXPECT_EQ(UrdfRefusal(good), "");
  EXPECT_THAT(UrdfRefusal("<robot name='r'><link name='stone'/></robot>"),
              HasSubstr("there are no two legs (valid: two legs of six revolute joints)"));
  EXPECT_THAT(UrdfRefusal(AllReplaced(good, "joint5' type='revolute'", "joint5' type='fixed'")),
              HasSubstr("has 5 moving joints"));
  // An ankle that turns one way only.
  const std::string ankle("('left_joint4'[^]*?<limit lower=')[^']*(' upper=')[^']*");
  const std::string stiff = UrdfRefusal(AllReplaced(good, ankle, "$011.4$021.5"));
  EXPECT_THAT(stiff, HasSubstr("within the joints' limits: left_joint4 would be at "));
  EXPECT_THAT(stiff, HasSubstr("its limits are 80.2 and 85.9 deg (valid: "));
  // What is wrong with a finger is told later, and as a warning.
  const std::string finger =
      "<link name='finger'/><joint name='grip' type='revolute'><parent link='waist'/>"
      "<child link='finger'/><axis xyz='0 0 0'/></joint></robot>";
  EXPECT_EQ(UrdfRefusal(Replaced(good, "</robot>", finger)), "");
}

// An arm that cannot come to zero stands at its limit, which rounding must not carry it over.
TEST(RobotSurvey, WritesAnglesThatReadBackWithinTheirLimits) {
  const std::string urdf = GeneratedUrdf(GeneratedRobots()[0]);
  for (const char* limits : {"lower='0.1234567' upper='1'", "lower='-1' upper='-0.1234567'",
                             "lower='0.123456' upper='1'", "lower='-1' upper='-0.123456'"}) {
    const TemporaryFolder place;
    const std::string arm =
        "<link name='arm'/><joint name='shoulder' type='revolute'><parent link='waist'/><child "
        "link='arm'/><axis xyz='0 1 0'/><limit velocity='1' effort='1' " +
        std::string(limits) + "/></joint></robot>";
    const RobotSurvey survey =
        SurveyRobot({.urdf = WriteText(place / "robot.urdf", Replaced(urdf, "</robot>", arm))});
    ASSERT_THAT(survey.refused, IsEmpty());
    EXPECT_THAT(YamlOf(survey.draft), HasSubstr("'shoulder': ")) << limits;
    EXPECT_NO_THROW((void)ModelOf(survey.draft)) << limits;
  }
}

// Of the 24 ways to lay a frame along the axes, eight have an upright x, which leaves yaw open.
TEST(RobotSurvey, WritesTurnedFramesThatReadBack) {
  const TemporaryFolder place;
  const std::string urdf = GeneratedUrdf(GeneratedRobots()[0]);
  RobotDraft draft = SurveyRobot({.urdf = WriteText(place / "robot.urdf", urdf)}).draft;
  int frames = 0;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      if (x % 3 == y % 3) continue;
      draft.R_LinkB.col(0) = (x < 3 ? 1 : -1) * Eigen::Vector3d::Unit(x % 3);
      draft.R_LinkB.col(1) = (y < 3 ? 1 : -1) * Eigen::Vector3d::Unit(y % 3);
      draft.R_LinkB.col(2) = draft.R_LinkB.col(0).cross(draft.R_LinkB.col(1));
      if (draft.R_LinkB.isIdentity()) continue;  // is not written
      const PatternMatch n =
          FirstMatch(YamlOf(draft), "waist_rpy_deg: \\[([-.0-9]+), ([-.0-9]+), ([-.0-9]+)\\]");
      ASSERT_TRUE(n);
      constexpr double kDegree = std::numbers::pi / 180.0;
      const Eigen::Matrix3d R = RollPitchYaw(kDegree * std::stod(n[1]), kDegree * std::stod(n[2]),
                                             kDegree * std::stod(n[3]));
      EXPECT_LT((R - draft.R_LinkB).norm(), 1e-9) << n[0];
      ++frames;
    }
  }
  EXPECT_EQ(frames, 23);
}

// A waist frame 2 m below: the robot is the same, but for where its waist is said to be.
TEST(RobotSurvey, TakesAWaistFrameBelowTheFloor) {
  const TemporaryFolder place;
  const std::string low =
      "<link name='low'/><joint name='below' type='fixed'><parent link='low'/><child link='waist'/>"
      "<origin xyz='0 0 2'/></joint></robot>";
  const std::string urdf = Replaced(GeneratedUrdf(GeneratedRobots()[0]), "</robot>", low);
  const RobotDraft draft = SurveyRobot({.urdf = WriteText(place / "robot.urdf", urdf)}).draft;
  const std::string yaml = YamlOf(draft);
  const RobotModel robot = LoadRobot(WriteText(place / "robot.yaml", yaml));
  const RobotModel below = LoadRobot(
      WriteText(place / "low.yaml", Replaced(yaml, "waist_link: 'waist'", "waist_link: 'low'")));
  EXPECT_NEAR(below.waist_height, robot.waist_height - 2.0, 1e-12);
  EXPECT_NEAR(below.com_height, robot.com_height, 1e-12);
  EXPECT_THAT(RobotPicture(below), StartsWith("<svg "));
}

// What is refused leaves what was found, with the reason.
TEST(RobotCommand, WritesTheDraftOfARobotThatItRefuses) {
  const TemporaryFolder place;
  GeneratedRobot robot = GeneratedRobots()[0];
  const std::string urdf = GeneratedUrdf(robot);
  const auto draft_of = [&](const std::string& text, const std::string& refusal) {
    WriteText(place / "robot.urdf", text);
    const Outcome outcome = Halfstep(place.path(), {"robot", "robot.urdf", "--overwrite"});
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_THAT(outcome.err, HasSubstr(refusal));
    EXPECT_THAT(outcome.err, HasSubstr("written: robot.yaml, what was found, marked as refused; "
                                       "--overwrite replaces it"));
    EXPECT_FALSE(fs::exists(place / "robot.svg"));
    const std::string draft = ReadText(place / "robot.yaml");
    EXPECT_THAT(draft, StartsWith("# REFUSED, as said below."));
    EXPECT_THAT(draft, HasSubstr(refusal));
    // The file itself says so to whoever uses it.
    EXPECT_THROW((void)LoadRobot((place / "robot.yaml").string()), InputError);
    return draft;
  };
  const std::string no_legs =
      draft_of("<robot name='r'><link name='stone'/></robot>", "there are no two legs");
  EXPECT_THAT(no_legs, HasSubstr("# Waist and legs were not found."));
  // Feet without bodies.
  const std::string no_soles = draft_of(
      AllReplaced(urdf, "<collision>[^\\n]*<box size='0.2 0.11 0.04'/>[^\\n]*</collision>", ""),
      "foot has no collision bodies");
  EXPECT_THAT(no_soles, HasSubstr("waist_link: 'waist'"));
  EXPECT_THAT(no_soles, HasSubstr("# The soles were not looked for."));
}

TEST(ScaledDefaults, AreHrp2sForHrp2) {
  ExperimentConfig scaled;
  ScaleDefaults(MeasureRobot((kRobots / "hrp2.yaml").string()), &scaled);
  const auto text = [](ExperimentConfig config) {
    return WriteYaml([&config](Fields& fields) { DeclareFields(fields, &config); });
  };
  EXPECT_EQ(text(scaled), text(ExperimentConfig{}));
}

// A row whose key is no number of the config would scale nothing.
TEST(ScaledDefaults, AreOfKeysThatThereAre) {
  const std::vector<KeyDescription> formulas = ConfigKeys();
  std::vector<KeyDescription> values = formulas;
  DescribeScaling(MeasureRobot((kRobots / "hrp2.yaml").string()), &values);
  int scaled = 0;
  const std::function<void(const std::vector<KeyDescription>&, const std::vector<KeyDescription>&)>
      count = [&](const auto& before, const auto& after) {
        for (size_t i = 0; i < before.size(); ++i) {
          if (before[i].otherwise != after[i].otherwise) ++scaled;
          count(before[i].keys, after[i].keys);
        }
      };
  count(formulas, values);
  EXPECT_EQ(scaled, 37);
}

TEST(ScaledDefaults, GoByTheLegUnlessAKeySaysOtherwise) {
  RobotMeasures half = MeasureRobot((kRobots / "hrp2.yaml").string());
  half.leg_length *= 0.25;
  half.standing_width *= 0.5;
  half.lift *= 0.25;
  half.aside *= 0.5;
  half.slowest_joint = 100.0;  // [rad/s]
  ExperimentConfig config;
  ScaleDefaults(half, &config);
  EXPECT_EQ(config.half_step.duration, 1.0);
  EXPECT_EQ(config.half_step.zmp_shift, 0.05);
  EXPECT_EQ(config.half_step.via_height, 0.0625);
  EXPECT_EQ(config.half_step.via_lateral, 0.12);
  EXPECT_EQ(config.half_step.foot_delay, 0.115);  // 0.0625 m · S(0.115/0.475) = 6 mm
  EXPECT_DOUBLE_EQ(config.step_set.x_max, 7 * config.step_set.spacing);
  EXPECT_EQ(config.half_step.support_point, 0.0);
  half.support_point = -0.011;
  half.slowest_joint = 1.7;  // [rad/s]
  ScaleDefaults(half, &(config = {}));
  EXPECT_EQ(config.half_step.duration, 4.0);
  EXPECT_EQ(config.half_step.support_point, -0.011);
  const TemporaryFolder place;
  const Outcome outcome =
      Halfstep(place.path(), {"explain-config", "via_height_m", "--robot", "hrp2"});
  EXPECT_THAT(outcome.out,
              HasSubstr("half_step.via_height_m: number [m], else min(`0.25` · ℓ/0.705 m, 0.95 "
                        "lift) = 0.25, valid: 0.01 … 1"));
}

}  // namespace
}  // namespace halfstep
