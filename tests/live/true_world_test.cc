#include "experiments/live/true_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/live/small_episode.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

Scene TwoBars() {
  Scene scene;
  scene.obstacles = {Bar("a", 1.0, 0.0), Bar("b", 2.0, 0.0)};
  scene.no_step.push_back((Eigen::Matrix2Xd(2, 3) << 0, 1, 0, 5, 5, 6).finished());
  return scene;
}

LiveOptions With(std::vector<ScriptEvent> script) {
  LiveOptions options;
  options.script = std::move(script);
  return options;
}

TEST(TrueWorld, ObstaclesJumpAreCarriedAppearAndVanish) {
  ScriptEvent turn = Event(4.0, "carry", "a", {1.0, 1.0, 0.02}, 0.5);
  turn.turn = 1.0;
  const TrueWorld truth(TwoBars(), {},
                        With({Event(1.0, "jump", "a", {1.0, 2.0, 0.02}), turn,
                              Event(2.0, "appear", "b", {}), Event(5.0, "vanish", "b", {})}));
  EXPECT_EQ(truth.PoseAt(0, 0.999).translation().y(), 0.0);
  EXPECT_EQ(truth.PoseAt(0, 1.0).translation().y(), 2.0);
  EXPECT_NEAR(truth.PoseAt(0, 5.0).translation().y(), 1.5, 1e-12);
  EXPECT_NEAR(truth.PoseAt(0, 5.0).linear()(1, 0), std::sin(0.5), 1e-12);
  EXPECT_NEAR(truth.PoseAt(0, 9.0).translation().y(), 1.0, 1e-12);
  EXPECT_FALSE(truth.IsThere(1, 1.9));
  EXPECT_TRUE(truth.IsThere(1, 2.0));
  EXPECT_FALSE(truth.IsThere(1, 5.0));
  EXPECT_NEAR(truth.end(), 6.0, 1e-12);
  EXPECT_EQ(truth.SpeedOf(0), 0.5);
}

TEST(TrueWorld, GoalsMoveAreasAppearAndFramesAreLost) {
  ScriptEvent goal = Event(1.0, "goal", "", {});
  goal.goal = {3.0, 4.0};
  ScriptEvent lose = Event(2.0, "lose", "", {});
  lose.lasts = 0.5;
  const TrueWorld truth(TwoBars(), {}, With({goal, lose, Event(3.0, "forbid", "", {})}));
  EXPECT_EQ(truth.GoalAt(0.5).X_WG.x, 0.0);
  EXPECT_EQ(truth.GoalAt(1.0).X_WG.y, 4.0);
  EXPECT_TRUE(truth.IsSeen(1.9));
  EXPECT_FALSE(truth.IsSeen(2.4));
  EXPECT_TRUE(truth.IsSeen(2.5));
  EXPECT_FALSE(truth.AreaIsThere(0, 2.9));
  EXPECT_TRUE(truth.AreaIsThere(0, 3.0));
}

// Metamorphic: the same world, seen by a walk that begins later.
TEST(TrueWorld, SinceIsTheSameWorldEarlier) {
  const TrueWorld truth(TwoBars(), {},
                        With({Event(1.0, "jump", "a", {1.0, 2.0, 0.02}),
                              Event(4.0, "carry", "a", {1.0, 1.0, 0.02}, 0.5)}));
  const TrueWorld since = truth.Since(0.7);
  for (double t = 0.0; t < 8.0; t += 0.37) {
    EXPECT_LT((since.PoseAt(0, t).translation() - truth.PoseAt(0, t + 0.7).translation()).norm(),
              1e-12);
  }
  EXPECT_NEAR(since.end(), truth.end() - 0.7, 1e-12);
}

// A robot that strays sees obstacles and the goal's place moved rigidly.
TEST(TrueWorld, IsSeenFromARobotThatStrays) {
  LiveOptions options = With({Event(1.0, "jump", "a", {1.0, 2.0, 0.02})});
  options.drift = 0.5;
  const Pose2 moved{0.1, -0.2, 0.3};
  GoalConfig goal;
  goal.X_WG = {3.0, 1.0, 0.0};
  Scene scene = TwoBars();
  scene.no_step.clear();
  const TrueWorld truth(scene, goal, options);
  const TrueWorld seen = truth.SeenFrom([&](double t) { return t < 2.0 ? Pose2() : moved; });
  EXPECT_EQ(seen.PoseAt(0, 1.5).translation(), Eigen::Vector3d(1.0, 2.0, 0.02));
  const Eigen::Isometry3d expected = ToIsometry(moved * Pose2{1.0, 2.0, 0.0}, 0.02);
  EXPECT_TRUE(seen.PoseAt(0, 2.5).isApprox(expected, 1e-12));
  EXPECT_LT((seen.GoalAt(2.5).X_WG.position() - moved * Eigen::Vector2d(3.0, 1.0)).norm(), 1e-12);
  EXPECT_EQ(seen.GoalAt(2.5).X_WG.yaw, 0.0);
  EXPECT_NEAR(truth.PoseAt(0, 2.0).translation().x(), 2.0, 1e-12);
}

TEST(TrueWorld, RefusesAScriptThatNamesWhatIsNotThere) {
  ScriptEvent forbid = Event(1.0, "forbid", "", {});
  forbid.area = 2;
  try {
    const TrueWorld truth(TwoBars(), {}, With({Event(1.0, "vanish", "chair", {}), forbid}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.complaints(),
                testing::ElementsAre("live.script[0].obstacle: 'chair' is not in the scene (valid: "
                                     "a, b)",
                                     testing::HasSubstr("live.script[1].area: 2: the scene has "
                                                        "1 no-step areas")));
  }
}

}  // namespace
}  // namespace halfstep
