#include "experiments/config/experiment_config.h"
#include "experiments/config/data_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "experiments/config/experiment.h"
#include "experiments/tables/result_tables.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/solver_method_options.h"
#include "tests/fixture_check.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

const fs::path kConfigs = InSources("experiments/configs");

std::string Written(ExperimentConfig config) {
  return WriteYaml([&config](Fields& fields) { DeclareFields(fields, &config); });
}

TEST(ExperimentConfig, ALevelIsWrittenWhereItIsSaid) {
  const TemporaryFolder place;
  const std::string text =
      "{robot: hrp2, scene: none, footsteps: [{foot: right, x_m: 0.2, y_m: -0.1, level: floor},\n"
      "  {foot: left, x_m: 0.2, y_m: 0.1, z_m: 0}]}";
  const std::string written = Written(LoadConfig(WriteText(place / "c.yaml", text), {}));
  EXPECT_THAT(written, testing::HasSubstr("    level: floor\n"));
  EXPECT_THAT(written, testing::HasSubstr("    z_m: 0\n"));
  EXPECT_EQ(Written(LoadConfig(WriteText(place / "again.yaml", written), {})), written);
  const std::string plain = Written(LoadConfig((kConfigs / "bar_8cm.yaml").string(), {}));
  EXPECT_THAT(plain,
              testing::Not(testing::AnyOf(testing::HasSubstr("level"), testing::HasSubstr("z_m"),
                                          testing::HasSubstr("foothold"))));
}

// What a tube takes of margins is derived for one level.
TEST(ExperimentConfig, ATubeOnLevelsIsRefused) {
  const auto prepare = [](const std::string& name) {
    Prepare(
        LoadConfig((kConfigs / (name + ".yaml")).string(), {{"smoothing.tube.foot_m", "0.001"}}));
  };
  EXPECT_NO_THROW(prepare("bar_8cm"));
  EXPECT_THAT([&] { prepare("stairs_10cm"); },
              testing::ThrowsMessage<InputError>(
                  testing::StartsWith("smoothing.tube: the scene's ground is uneven (4 levels)")));
}

// A table of footsteps that has heights chooses levels by them.
TEST(ExperimentConfig, FootstepsCsvHasHeightsWhereTheGroundIsUneven) {
  const TemporaryFolder place;
  const Experiment e = Prepare(LoadConfig((kConfigs / "stairs_10cm.yaml").string(), {}));
  const CsvFile table = FootstepsCsv(e.sequence);
  EXPECT_THAT(table.text, testing::StartsWith("footstep,foot,x_m,y_m,z_m,yaw_rad,"));
  EXPECT_THAT(table.text, testing::HasSubstr("\n3,right,0.84,-0.085,0.3,0.0,"));
  const Experiment flat = Prepare(LoadConfig((kConfigs / "bar_8cm.yaml").string(), {}));
  EXPECT_THAT(FootstepsCsv(flat.sequence).text,
              testing::StartsWith("footstep,foot,x_m,y_m,yaw_rad,"));
  WriteText(place / "steps.csv", table.text);
  const ExperimentConfig read = LoadConfig(
      WriteText(place / "c.yaml",
                "{robot: hrp2, scene: " + (kConfigs / "../scenes/stairs_10cm.yaml").string() +
                    ", footsteps_file: {path: steps.csv}}"),
      {});
  EXPECT_EQ(read.footsteps[2].on.z, 0.3);
  EXPECT_EQ(read.start_left_on.z, 0.0);
  const HalfStepSequence again = Prepare(read).sequence;
  for (size_t i = 0; i < again.half_steps.size(); ++i) {
    EXPECT_EQ(again.half_steps[i].X_WS, e.sequence.half_steps[i].X_WS);
  }
}

class RefusedConfig : public testing::TestWithParam<std::string> {};
TEST_P(RefusedConfig, SaysWhy) {
  CheckFixture(GetParam(), [](const std::string& path) { LoadConfig(path, {}); });
}
INSTANTIATE_TEST_SUITE_P(Config, RefusedConfig, testing::ValuesIn(Fixtures("config")), FixtureName);

std::vector<std::string> ShippedConfigs() {
  std::vector<std::string> paths;
  for (const fs::path& path : YamlFiles(kConfigs)) paths.push_back(path.string());
  return paths;
}

class ShippedConfigTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Config, ShippedConfigTest, testing::ValuesIn(ShippedConfigs()),
                         FixtureName);

TEST_P(ShippedConfigTest, LoadsWithItsRobotAndScene) {
  const ExperimentConfig config = LoadConfig(GetParam(), {});
  EXPECT_EQ(config.name, fs::path(GetParam()).stem());
  const Experiment experiment = Prepare(config);
  EXPECT_EQ(experiment.robot.name, config.robot);
  EXPECT_EQ(experiment.scene.obstacles.empty() && experiment.scene.no_step.empty() &&
                experiment.scene.ground->OnlyLevel(),
            config.scene == "none");
  EXPECT_NE(config.has_goal, !config.footsteps.empty());
  EXPECT_EQ(experiment.sequence.size(), static_cast<int>(2 * config.footsteps.size()));
  EXPECT_EQ(FootholdOnNoStep(experiment), std::nullopt);
}

// What a run writes as its config.yaml, read in the run's folder, is the same experiment.
TEST_P(ShippedConfigTest, ReadsBackFromAnotherFolder) {
  const TemporaryFolder place;
  const ExperimentConfig config = LoadConfig(GetParam(), {{"smoothing.sampling_s", "0.0123"}});
  const std::string text = Written(MovedTo(place.path(), config));
  const std::string path = WriteText(place / "config.yaml", text);
  const ExperimentConfig again = LoadConfig(path, {});
  EXPECT_EQ(Written(again), text);
  EXPECT_EQ(again.name, config.name);
  EXPECT_EQ(again.smoothing.sampling, 0.0123);
  EXPECT_EQ(again.footsteps.size(), config.footsteps.size());
  EXPECT_EQ(RobotPath(again), RobotPath(config));
  EXPECT_EQ(ScenePath(again).has_value(), ScenePath(config).has_value());
  if (ScenePath(config)) {
    EXPECT_TRUE(fs::equivalent(*ScenePath(again), *ScenePath(config)));
  }
  const Experiment a = Prepare(config), b = Prepare(again);
  for (int i = 0; i < a.sequence.size(); ++i) {
    const size_t k = static_cast<size_t>(i);
    EXPECT_EQ(a.sequence.half_steps[k].X_WS, b.sequence.half_steps[k].X_WS);
    EXPECT_EQ(a.sequence.half_steps[k].half_step.X_SF, b.sequence.half_steps[k].half_step.X_SF);
  }
}

constexpr const char* kAllKeys = R"(name: everything
robot: hrp2
scene: none
start:
  left: {x_m: 0.01, y_m: 0.11, yaw_deg: 5}
  right: {x_m: -0.01, y_m: -0.12, yaw_deg: 0}
footsteps:
  - {foot: left, x_m: 0.2, y_m: 0.1, yaw_deg: -30, via_height_m: 0.2, duration_s: 1.5}
half_step: {duration_s: 1.75, zmp_shift_s: 0.2, via_height_m: 0.22, via_lateral_m: 0.25,
            foot_delay: 0.125}
smoothing:
  methods: [dichotomy/published]
  acceptance: sampled
  sampling_s: 0.004
  dichotomy: {tolerance_s: 0.002, order: right_to_left, passes: 3, up_down_cap: 0.9,
              down_up_cap: 0.7}
  limits: {foot_speed_m_s: none, foot_yaw_rate_rad_s: 1.5, joint_speed_scale: 0.75}
  margins: {floor_m: 0.001, zmp_m: 0.002, reach_m: 0.003, joint_rad: 0.004,
            joint_speed_rad_s: 0.005, foot_speed_m_s: 0.006, foot_yaw_rate_rad_s: 0.007,
            clearance_m: 0.008, self_clearance_m: 0.009, ground_m: 0.011, no_step_m: 0.012,
            zmp_robot_m: 0.013, torque_n_m: 14, friction: 0.015, joint_acceleration_rad_s2: 1.6}
  tube: {foot_m: 0.001, foot_deg: 2, waist_m: 0.003, waist_deg: 4, joint_rad: 0.005,
         joint_speed_rad_s: 0.006, zmp_m: 0.007}
output: {directory: ../out, period_s: 0.02}
seed: 42
)";

TEST(ExperimentConfig, EveryKeyReachesItsField) {
  const TemporaryFolder place;
  const ExperimentConfig c = LoadConfig(WriteText(place / "c.yaml", kAllKeys), {});
  constexpr double kDegree = std::numbers::pi / 180;
  EXPECT_EQ(c.name, "everything");
  EXPECT_TRUE(c.has_start);
  EXPECT_EQ(c.start_left, (Pose2{0.01, 0.11, 5 * kDegree}));
  EXPECT_EQ(c.start_right, (Pose2{-0.01, -0.12, 0}));
  ASSERT_EQ(c.footsteps.size(), 1u);
  EXPECT_EQ(c.footsteps[0].foot, "left");
  EXPECT_NEAR(c.footsteps[0].X_WF.yaw, -30 * kDegree, 1e-15);
  EXPECT_EQ(c.footsteps[0].via_height, 0.2);
  EXPECT_EQ(c.footsteps[0].duration, 1.5);
  EXPECT_EQ(c.half_step.duration, 1.75);
  EXPECT_EQ(c.half_step.zmp_shift, 0.2);
  EXPECT_EQ(c.half_step.via_height, 0.22);
  EXPECT_EQ(c.half_step.via_lateral, 0.25);
  EXPECT_EQ(c.half_step.foot_delay, 0.125);
  const SmoothingConfig& s = c.smoothing;
  EXPECT_THAT(s.methods, testing::ElementsAre("dichotomy/published"));
  EXPECT_EQ(s.sampling, 0.004);
  const DichotomyOptions dichotomy = s.options.Get(DichotomyGroup());
  EXPECT_EQ(dichotomy.tolerance, 0.002);
  EXPECT_EQ(dichotomy.order, DichotomyOptions::Order::kRightToLeft);
  EXPECT_EQ(dichotomy.passes, 3);
  EXPECT_EQ(dichotomy.up_down_cap, 0.9);
  EXPECT_EQ(dichotomy.down_up_cap, 0.7);
  EXPECT_EQ(s.limits.foot_speed, std::nullopt);
  EXPECT_EQ(s.limits.foot_yaw_rate, 1.5);
  EXPECT_EQ(s.limits.joint_speed_scale, 0.75);
  EXPECT_EQ(s.limits.tube, (Tube{.foot = 0.001,
                                 .foot_turn = 2 * kDegree,
                                 .waist = 0.003,
                                 .waist_turn = 4 * kDegree,
                                 .joint = 0.005,
                                 .joint_speed = 0.006,
                                 .zmp = 0.007}));
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kFloor), 0.001);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kZmp), 0.002);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kReach), 0.003);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kJoint), 0.004);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kJointSpeed), 0.005);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kFootSpeed), 0.006);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kFootYawRate), 0.007);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kClearance), 0.008);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kSelfClearance), 0.009);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kGround), 0.011);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kNoStep), 0.012);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kZmpRobot), 0.013);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kTorque), 14);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kFriction), 0.015);
  EXPECT_EQ(s.limits.demanded_of(MarginFamily::kJointAcceleration), 1.6);
  EXPECT_EQ(c.output_directory, "../out");
  EXPECT_EQ(c.output_period, 0.02);
  EXPECT_EQ(c.seed, 42);
  EXPECT_EQ(MovedTo(place / "out", c).output_directory, ".");
  const std::string text = Written(c);
  EXPECT_EQ(Written(LoadConfig(WriteText(place / "again.yaml", text), {})), text);
}

TEST(ExperimentConfig, AllFamiliesAreVariablesUnlessToldNot) {
  const TemporaryFolder place;
  const auto choice_of = [&place](const std::string& optimizer) {
    const std::string text =
        "robot: hrp2\nscene: none\nfootsteps: [{foot: right, x_m: 0.2, y_m: -0.105}]\n"
        "smoothing: {optimizer: {" +
        optimizer + "}}\n";
    return LoadConfig(WriteText(place / "c.yaml", text), {})
        .smoothing.options.Get(OptimizerGroup())
        .options.program.parameters;
  };
  const ParameterChoice all = choice_of("all_families: true, foot_ramps: false");
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    if (traits.always) continue;
    // Footsteps are told apart: where feet stand is no form of a half-step.
    const bool left_alone = family == ParameterFamily::kFootRamp || traits.move != nullptr;
    EXPECT_EQ(all.moves(family), !left_alone) << traits.key;
    // The default; a config that names some of them has these alone.
    EXPECT_EQ(choice_of("").moves(family), traits.move == nullptr) << traits.key;
    EXPECT_EQ(choice_of("footsteps: true").moves(family), true) << traits.key;
    const bool named = family == ParameterFamily::kHeightScale ||
                       family == ParameterFamily::kDuration || traits.of_heights;
    EXPECT_EQ(choice_of("heights: true, durations: true").moves(family), named) << traits.key;
    EXPECT_FALSE(choice_of("all_families: false").moves(family)) << traits.key;
  }
  EXPECT_TRUE(choice_of("footsteps: true").footsteps);
  EXPECT_EQ(all.bound("least_duration"), 0.2);
  EXPECT_EQ(choice_of("").bound("least_duration"), 0.2);
  EXPECT_EQ(choice_of("heights: true").bound("least_duration"), 0.5);
  EXPECT_EQ(choice_of("all_families: true, least_duration: 0.4").bound("least_duration"), 0.4);
  // What a config says is what is written of it.
  const std::string text =
      "robot: hrp2\nscene: none\nfootsteps: [{foot: right, x_m: 0.2, y_m: -0.105}]\n"
      "smoothing: {optimizer: {all_families: true, heights: false, least_duration: 0.4}}\n";
  const ExperimentConfig config = LoadConfig(WriteText(place / "some.yaml", text), {});
  const ExperimentConfig again = LoadConfig(WriteText(place / "written.yaml", Written(config)), {});
  EXPECT_EQ(again.smoothing.options.Get(OptimizerGroup()).options.program.parameters,
            config.smoothing.options.Get(OptimizerGroup()).options.program.parameters);
  EXPECT_FALSE(again.smoothing.options.Get(OptimizerGroup()).options.program.parameters.heights);
}

TEST(ExperimentConfig, AProfileIsWhatIsDemandedWhereNoKeySaysOtherwise) {
  const TemporaryFolder place;
  const auto limits = [&](const std::string& robot, const std::vector<YamlOverride>& overrides) {
    const std::string text =
        "robot: " + robot + "\nscene: none\nfootsteps: [{foot: right, x_m: 0.2, y_m: -0.105}]\n";
    const ExperimentConfig c = LoadConfig(WriteText(place / "c.yaml", text), overrides);
    const ExperimentConfig again = LoadConfig(WriteText(place / "written.yaml", Written(c)), {});
    EXPECT_EQ(again.smoothing.profile, c.smoothing.profile);
    EXPECT_EQ(again.smoothing.limits.demanded, c.smoothing.limits.demanded);
    EXPECT_EQ(again.smoothing.limits.foot_speed, c.smoothing.limits.foot_speed);
    return c.smoothing.limits;
  };
  EXPECT_EQ(limits("hrp2", {}).demanded, LimitsOf(DemandProfile::kWalkable).demanded);
  // A sole of 66 mm in place of 137 mm.
  EXPECT_EQ(limits("wren", {}).demanded_of(MarginFamily::kZmpRobot), 0.0132);
  EXPECT_EQ(limits("hrp2", {{"smoothing.profile", "limit"}}).demanded, MarginLimits{}.demanded);
  // A profile leaves what it is not about as it is scaled, and scales what it is about alike.
  const MarginLimits wren = limits("wren", {}),
                     limit = limits("wren", {{"smoothing.profile", "limit"}});
  EXPECT_EQ(limit.demanded_of(MarginFamily::kFriction), 0.0);
  EXPECT_EQ(limit.demanded_of(MarginFamily::kDoubleSupport), kNotDemanded);
  EXPECT_EQ(limit.demanded_of(MarginFamily::kZmpRobot), 0.00482);
  for (const MarginFamily family : {MarginFamily::kZmp, MarginFamily::kSelfClearance}) {
    EXPECT_LT(limit.demanded_of(family), MarginLimits{}.demanded_of(family));
    EXPECT_EQ(limit.demanded_of(family), wren.demanded_of(family));
  }
  EXPECT_EQ(limit.foot_speed, wren.foot_speed);
  EXPECT_LT(*wren.foot_speed, 1.0);
  const MarginLimits paper = limits("hrp2", {{"smoothing.profile", "paper"},
                                             {"smoothing.margins.friction", "0.1"},
                                             {"smoothing.limits.foot_speed_m_s", "0.9"}});
  EXPECT_EQ(paper.demanded_of(MarginFamily::kZmpRobot), kNotDemanded);
  EXPECT_EQ(paper.demanded_of(MarginFamily::kFriction), 0.1);
  EXPECT_EQ(paper.foot_speed, 0.9);
  EXPECT_EQ(paper.foot_yaw_rate, std::nullopt);
  EXPECT_THROW(limits("hrp2", {{"smoothing.profile", "safe"}}), InputError);
}

TEST(ExperimentConfig, NothingNeedBeDemandedOfTheWholeRobotsZmp) {
  const TemporaryFolder place;
  const ExperimentConfig c = LoadConfig(WriteText(place / "c.yaml", kAllKeys),
                                        {{"smoothing.margins.zmp_robot_m", "none"}});
  EXPECT_EQ(c.smoothing.limits.demanded_of(MarginFamily::kZmpRobot), kNotDemanded);
  const std::string text = Written(c);
  EXPECT_THAT(text, testing::HasSubstr("zmp_robot_m: none"));
  EXPECT_EQ(Written(LoadConfig(WriteText(place / "again.yaml", text), {})), text);
  EXPECT_THROW(
      LoadConfig(WriteText(place / "zmp.yaml", kAllKeys), {{"smoothing.margins.zmp_m", "none"}}),
      InputError);
}

// Written back it is there only where it says something; of a robot without limits it says nothing.
TEST(ExperimentConfig, WhatIsDemandedOfJointAccelerationsIsWrittenWhereItIsNotTheDefault) {
  const TemporaryFolder place;
  const std::string key = "smoothing.margins.joint_acceleration_rad_s2";
  const auto config = [&](const std::string& value) {
    return LoadConfig(WriteText(place / "c.yaml", kAllKeys), {{key, value}});
  };
  EXPECT_THAT(Written(config("0")), testing::Not(testing::HasSubstr("joint_acceleration")));
  for (const std::string value : {"1.6", "none"}) {
    const std::string text = Written(config(value));
    EXPECT_THAT(text, testing::HasSubstr("joint_acceleration_rad_s2: " + value));
    EXPECT_EQ(Written(LoadConfig(WriteText(place / "again.yaml", text), {})), text);
  }
}

// Nor is what a config has to ask for.
TEST(ExperimentConfig, WhatMayBeAskedForIsWrittenWhereItIs) {
  const TemporaryFolder place;
  const std::string path = WriteText(place / "c.yaml", kAllKeys);
  const std::vector<YamlOverride> asked = {{"smoothing.margins.double_support_s", "0.1"},
                                           {"smoothing.margins.landing_speed_m_s", "0.02"},
                                           {"smoothing.limits.landing_speed_m_s", "0.25"},
                                           {"smoothing.limits.joint_acceleration_rad_s2", "40"}};
  const std::string plain = Written(LoadConfig(path, {{"smoothing.profile", "limit"}}));
  for (const char* word : {"double_support", "landing_speed"}) {
    EXPECT_THAT(plain, testing::Not(testing::HasSubstr(word)));
  }
  const ExperimentConfig c = LoadConfig(path, asked);
  EXPECT_EQ(c.smoothing.limits.demanded_of(MarginFamily::kDoubleSupport), 0.1);
  EXPECT_EQ(c.smoothing.limits.demanded_of(MarginFamily::kLandingSpeed), 0.02);
  EXPECT_EQ(c.smoothing.limits.landing_speed, 0.25);
  EXPECT_EQ(c.smoothing.assumed_acceleration, 40.0);
  const std::string text = Written(c);
  EXPECT_EQ(Written(LoadConfig(WriteText(place / "again.yaml", text), {})), text);
  const RobotModel robot = LoadPlace(c).robot;
  EXPECT_EQ(robot.legs[1].joints[5].max_acceleration, 40.0);
  ASSERT_TRUE(robot.assumed_acceleration);
  EXPECT_EQ(robot.assumed_acceleration->joints, 12);
}

TEST(ExperimentConfig, DefaultsAreThoseOfTheReadme) {
  const TemporaryFolder place;
  const ExperimentConfig c = LoadConfig(
      WriteText(place / "short.yaml",
                "{robot: hrp2, scene: none, footsteps: [{foot: right, x_m: 0.2, y_m: -0.1}]}"),
      {});
  EXPECT_EQ(c.name, "short");
  EXPECT_FALSE(c.has_start);
  EXPECT_THAT(c.smoothing.methods, testing::ElementsAre("dichotomy"));
  EXPECT_EQ(c.output_period, std::nullopt);
  const Experiment experiment = Prepare(c);
  EXPECT_EQ(experiment.sequence.start[0],
            Foothold::Level({0, 0.5 * experiment.robot.standing_width, 0}));
  EXPECT_EQ(experiment.sequence.start[1], experiment.sequence.start[0].Mirrored());
}

// A longer half-step keeps the proportions of its phases.
TEST(ExperimentConfig, AFootstepsOwnDurationScalesTheShift) {
  const ExperimentConfig c =
      LoadConfig((kConfigs / "fig4_raw_sequence.yaml").string(), {{"footsteps.2.duration_s", "4"}});
  const HalfStepSequence sequence = Prepare(c).sequence;
  EXPECT_EQ(sequence.half_steps[4].half_step.duration, 4.0);
  EXPECT_EQ(sequence.half_steps[4].half_step.shape.shift, 0.05);
  EXPECT_EQ(sequence.half_steps[6].half_step.duration, 2.0);
}

}  // namespace
}  // namespace halfstep
