// Heights of footsteps: those of the ground under them, and of the level that is chosen.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/config/experiment_config.h"
#include "tests/experiments/child_process.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

// A step across x = 1 m, 0.15 m high; a sole whose outline lies on both sides stands on neither.
class OneStair final : public Ground {
 public:
  double Floor() const override { return 0.0; }
  const std::vector<GroundSolid>& Solids() const override { return solids_; }
  const std::vector<GroundLevel>& Levels() const override { return levels_; }
  std::optional<GroundLevel> LevelUnder(const Eigen::Matrix2Xd& outline, const Pose2& X_WF,
                                        double) const override {
    const Eigen::RowVectorXd x = (X_WF.rotation() * outline).row(0).array() + X_WF.x;
    if (x.maxCoeff() < 1.0) return levels_[0];
    return x.minCoeff() > 1.0 ? std::optional(levels_[1]) : std::nullopt;
  }
  std::optional<GroundLevel> OnlyLevel() const override { return std::nullopt; }

 private:
  std::vector<GroundLevel> levels_ = {{.number = 0, .height = 0.0}, {.number = 1, .height = 0.15}};
  std::vector<GroundSolid> solids_;
};

TEST(Footholds, HaveTheHeightOfTheGroundUnderThem) {
  ExperimentConfig config;
  config.robot = "hrp2";
  config.scene = "none";
  config.footsteps = {{"left", {0.5, 0.1, 0.0}, {}, {}}, {"right", {1.5, -0.1, 0.2}, {}, 1.5}};
  const RobotModel robot = LoadPlace(config).robot;
  const OneStair stair;
  for (const Foothold& sole : StartOf(config, robot, stair)) EXPECT_EQ(sole.height, 0.0);
  const std::vector<Footstep> footsteps = FootstepsOf(config, robot, stair);
  ASSERT_EQ(footsteps.size(), 2u);
  EXPECT_EQ(footsteps[0].X_WF, Foothold({0.5, 0.1, 0.0}, 0.0));
  EXPECT_EQ(footsteps[1].side, Side::kRight);
  EXPECT_EQ(footsteps[1].X_WF, Foothold({1.5, -0.1, 0.2}, 0.15));
  EXPECT_EQ(footsteps[0].duration, config.half_step.duration);
  EXPECT_EQ(footsteps[1].duration, 1.5);
  config.footsteps[1].X_WF.x = 1.0;
  try {
    (void)SequenceOf(config, robot, stair);
    FAIL() << "a sole on the edge";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "footsteps[1]: the ground does not bear a sole at x = 1 m, y = -0.1 m (valid: all "
                 "of it on one level)");
  }
}

// Of the shipped flight: where the soles stand, and what its levels are called.
TEST(Footholds, StandOnTheLevelsOfAScene) {
  const auto config_of = [](const std::string& name) {
    return LoadConfig(ShippedConfig(name), {});
  };
  std::vector<double> heights;
  const ExperimentConfig up = config_of("stairs_15cm");
  const Place place = LoadPlace(up);
  for (const Footstep& step : FootstepsOf(up, place.robot, *place.scene.ground)) {
    heights.push_back(step.X_WF.height);
  }
  EXPECT_THAT(heights, testing::ElementsAre(0.15, 0.3, 0.45, 0.45));
  const ExperimentConfig down = config_of("stairs_10cm_down");
  const Place top = LoadPlace(down);
  EXPECT_EQ(StartOf(down, top.robot, *top.scene.ground)[1].height, 0.3);
  EXPECT_EQ(FootstepsOf(down, top.robot, *top.scene.ground).back().X_WF.height, 0.0);
}

TEST(Footholds, AreOnTheLevelThatWasChosen) {
  const RobotModel robot = LoadPlace(LoadConfig(ShippedConfig("bar_8cm"), {})).robot;
  const Scene scene = ParseScene("bridge.yaml", R"(surfaces:
  - {name: bridge, polygon_m: [[-1, -1], [1, -1], [1, 1], [-1, 1]], height_m: 2.5, thickness_m: 0.1}
  - {name: box, polygon_m: [[1, -1], [2, -1], [2, 1], [1, 1]], height_m: 0.2}
)");
  const Ground& ground = *scene.ground;
  const auto height = [&](double x, const LevelChoice& on) {
    return OnGround(ground, robot, {x, 0, 0}, "footsteps[3]", on).height;
  };
  EXPECT_EQ(height(0, {}), 2.5);
  EXPECT_EQ(height(0, {.name = "floor"}), 0.0);
  EXPECT_EQ(height(0, {.name = "bridge"}), 2.5);
  EXPECT_EQ(height(0, {.z = 0.0}), 0.0);
  EXPECT_EQ(height(1.5, {.z = 0.2}), 0.2);
  const auto refusal = [&](double x, const LevelChoice& on) -> std::string {
    try {
      (void)height(x, on);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(0, {.name = "brigde"}),
            "footsteps[3].level: the scene has no surface of the name 'brigde' (did you mean "
            "'bridge'? valid: bridge, box, floor)");
  EXPECT_EQ(refusal(0, {.z = 0.21}),
            "footsteps[3].z_m: no level of the scene is at z = 0.21 m (valid: 0, 0.2, 2.5)");
  EXPECT_EQ(refusal(0, {.name = "box"}),
            "footsteps[3]: the ground does not bear a sole at x = 0 m, y = 0 m: there is nothing "
            "below it (valid: all of it on one level)");
  EXPECT_THAT(refusal(1.9, {}), testing::HasSubstr(" mm over the edge of box (valid: all of it"));
}

}  // namespace
}  // namespace halfstep
