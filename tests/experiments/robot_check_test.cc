// `halfstep robot --check`: what it says, and what it refuses.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/config/scaled_defaults.h"
#include "experiments/survey/rest_torques.h"
#include "experiments/survey/robot_check_screen.h"
#include "experiments/survey/self_gaps.h"
#include "experiments/survey/stance_search.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/experiments/child_process.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/motion/posture.h"
#include "wpg/robot/gravity.h"

namespace halfstep {
namespace {

using nlohmann::json;
using testing::HasSubstr;

RobotCheck Fabricated() {
  RobotCheck check;
  check.measures.leg_length = 0.5;
  check.measures.lift = 0.2;
  check.half_step.duration = 1.6;
  check.half_step.via_height = 0.1;
  check.places = 600;
  check.half_steps = 200;
  check.reach = {.forward = 0.3,
                 .backward = 0.25,
                 .nearest = 0.1,
                 .farthest = 0.2,
                 .inwards = 0.25,
                 .outwards = 0.5,
                 .stride = 0.3};
  return check;
}

TEST(RobotCheck, SaysWhatARobotCanDo) {
  const RobotModel robot = ShippedRobot("wren");
  RobotCheck check = Fabricated();
  check.walk = StraightWalk{0.3, 5.0, "dichotomy"};
  check.bar = SteppedBar{.height = 0.05, .thickness = 0.02, .stride = 0.3};
  check.stairs = {.flight = {.rise = 0.04, .run = 0.15}, .half_step = {}};
  check.not_covered = NotCoveredOf(robot);
  const std::string screen = RobotCheckScreen(robot, check);
  EXPECT_THAT(screen, HasSubstr("200 of 600 places"));
  EXPECT_THAT(screen, HasSubstr("0.30 m/s: six steps of 0.3 m in 5.00 s, dichotomy (certified)"));
  EXPECT_THAT(screen, HasSubstr("a bar 5 cm high and 2 cm thick"));
  EXPECT_THAT(screen, HasSubstr("climbs   stairs of 4 cm at treads of 15 cm, up and down"));
  EXPECT_LE(std::ranges::count(screen, '\n'), 40);  // one screen
  const json read = json::parse(RobotCheckJson(robot, check));
  EXPECT_EQ(read["walk"]["speed_m_s"], 0.3);
  EXPECT_EQ(read["reach"]["farthest_m"], 0.2);
  EXPECT_EQ(read["stairs"]["rise_m"], 0.04);
  EXPECT_EQ(read["not_covered"].size(), check.not_covered.size());
}

TEST(RobotCheck, SaysWhyARobotDoesNotWalk) {
  const RobotModel robot = ShippedRobot("wren");
  RobotCheck check = Fabricated();
  check.why_no_walk = {"the first reason", "the second", "the third", "the fourth"};
  const std::string screen = RobotCheckScreen(robot, check);
  EXPECT_THAT(screen, HasSubstr("six steps straight ahead are not certified; worst first:"));
  EXPECT_THAT(screen, HasSubstr("the third"));
  EXPECT_THAT(screen, testing::Not(HasSubstr("the fourth")));
  EXPECT_THAT(screen, HasSubstr("no stairs at treads of 13.5 cm, of the rises from 0.16 cm"));
  EXPECT_TRUE(json::parse(RobotCheckJson(robot, check))["walk"].is_null());
}

// What the hip's roll axis carries at rest, by hand: the weight of all but its own leg.
TEST(RestTorques, SaysWhatAJointWouldNeed) {
  RobotModel robot = ShippedRobot("bison");
  const auto strong = WeakestAtRest(robot);
  ASSERT_TRUE(strong.has_value());
  EXPECT_LE(strong->needed, strong->limit);
  EXPECT_EQ(strong->inside, 0.0);
  EXPECT_THAT(RestText(*strong, robot.standing_width, "r.yaml"), testing::IsEmpty());
  robot.legs[0].joints[0].max_torque = 1.0;
  const auto feeble = WeakestAtRest(robot);
  ASSERT_TRUE(feeble.has_value());
  EXPECT_THAT(RestText(*feeble, robot.standing_width, "r.yaml")[0],
              HasSubstr("; no place of the CoM between the feet would relieve it enough"));
  robot.legs[0].joints[0].max_torque = 0.97 * feeble->needed;
  const auto weak = WeakestAtRest(robot);
  ASSERT_TRUE(weak.has_value());
  EXPECT_EQ(weak->joint, robot.legs[0].joints[0].name);
  // The left foot carries.
  const HalfStepSequence sequence = SixSteps(robot, DefaultHalfStep(robot));
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  const Posture posture = SolvePosture(robot, walk.At(walk.start_of(1)).value);
  const Eigen::Vector3d hip = posture.X_WB * robot.legs[0].joints[0].point_B;
  const BodyMass& waist = robot.masses.waist;
  double about = waist.mass * ((posture.X_WB * waist.com).y() - hip.y());
  for (size_t i = 0; i < 6; ++i) {
    const BodyMass& link = robot.masses.links[1][i];
    about += link.mass * ((posture.X_WLink[1][i] * link.com).y() - hip.y());
  }
  EXPECT_NEAR(weak->needed, std::abs(kGravity * about), 1e-6);
  EXPECT_GT(weak->inside, 0.0);
  const auto text = RestText(*weak, robot.standing_width, "r.yaml");
  ASSERT_EQ(text.size(), 2u);
  EXPECT_THAT(text[0], HasSubstr("at rest on one foot " + weak->joint + " needs "));
  EXPECT_THAT(text[0], HasSubstr(" N m; it would hold only while the CoM were "));
  EXPECT_THAT(text[1], HasSubstr("`effort_limits_n_m` of r.yaml"));
  EXPECT_GT(feeble->inside, weak->inside);  // the more it lacks, the further
  robot.masses.fault = "none";
  EXPECT_FALSE(WeakestAtRest(robot).has_value());
}

TEST(RobotCheck, SaysWhenNothingFarOutIsCertified) {
  RobotCheck check = Fabricated();
  check.reach = {};
  EXPECT_THAT(RobotCheckScreen(ShippedRobot("wren"), check),
              HasSubstr("  they reach  nothing: none of those farthest out is certified\n"));
}

// What is told is certified again, and what is far too high is not climbed.
TEST(RobotCheck, FindsStairsThatARobotClimbs) {
  const RobotModel robot = ShippedRobot("bison");
  ExperimentConfig config;
  ScaleDefaults(MeasuresOf(robot), &config);
  const auto goes_on = [] { return true; };
  const auto stairs = HighestStairs(UsualRun(robot), robot, config, goes_on);
  ASSERT_TRUE(stairs.has_value());
  EXPECT_GT(stairs->flight.rise, 0.1);
  EXPECT_LT(stairs->flight.rise, stairs->half_step.via_height);
  EXPECT_TRUE(FormFor(stairs->flight, robot, config, goes_on).has_value());
  // The next one that is tried is not certified.
  const Flight next{.rise = stairs->flight.rise + 0.005 * MeasuresOf(robot).leg_length / 0.705,
                    .run = stairs->flight.run};
  EXPECT_FALSE(FormFor(next, robot, config, goes_on).has_value());
  EXPECT_FALSE(HighestStairs(UsualRun(robot), robot, config, [] { return false; }).has_value());
}

// At a tenth of the effort, for what it finds and not for how much.
TEST(RobotCheck, LooksAtTheRobotThatIsGiven) {
  const RobotModel robot = ShippedRobot("wren");
  const RobotCheck check = CheckRobot("wren", robot, {}, 0.1);
  EXPECT_GT(check.reach.stride, 0.0);
  EXPECT_GE(check.reach.forward, check.reach.stride - 0.02);
  EXPECT_GE(check.reach.farthest, check.reach.nearest);
  EXPECT_GT(check.half_steps, 0);
  EXPECT_LE(check.half_steps, check.places);
  ASSERT_TRUE(check.walk.has_value());
  // Twelve half-steps of 1.2 s, more than halved: methods have run.
  EXPECT_LT(check.walk->duration, 7.2);
  EXPECT_LE(check.walk->stride, check.reach.stride);
  EXPECT_FALSE(check.stairs.has_value()) << "its steps are shorter than a tread for its soles";
  // Its foot rises that high and no higher.
  if (check.bar) {
    EXPECT_LT(check.bar->height, check.half_step.via_height);
  }
}

TEST(RobotCheck, RefusesWhatItCannotLookAt) {
  const TemporaryFolder place;
  const auto refused = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = Halfstep(place.path(), arguments);
    EXPECT_EQ(outcome.status, kBadInput);
    return outcome.err;
  };
  EXPECT_THAT(refused({"robot", "r.urdf", "--check"}),
              HasSubstr("is no robot file (valid: one in .yaml, or a shipped robot's name"));
  EXPECT_THAT(refused({"robot", "wren", "--check", "--out", "x.yaml"}),
              HasSubstr("--out: --check makes no robot file"));
  EXPECT_THAT(refused({"robot", "r.urdf", "--json"}), HasSubstr("--json: of --check only"));
  EXPECT_THAT(refused({"robot", "nobody", "--check"}), HasSubstr("nobody"));
}

}  // namespace
}  // namespace halfstep
