// Episodes on ground with levels: half-steps are called free by their proofs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/checker/prove_walk.h"
#include "experiments/live/episode_files.h"
#include "experiments/live/episode_reader.h"
#include "experiments/live/free_half_steps.h"
#include "experiments/live/judged_promise.h"
#include "experiments/live/messages.h"
#include "experiments/live/spare_boxes.h"
#include "experiments/run/certified_half_steps.h"
#include "experiments/verify/verify_run.h"
#include "tests/live/small_episode.h"
#include "tests/refusal_of.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

// A platform of 5 cm, in heights that add up only to rounding, and a box beside the way.
constexpr char kScene[] =
    "surfaces:\n"
    "  - {name: low, polygon_m: [[0.14, -1], [0.5, -1], [0.5, 1], [0.14, 1]], height_m: 0.04}\n"
    "  - {name: high, polygon_m: [[0.5, -1], [3, -1], [3, 1], [0.5, 1]], height_m: 0.11}\n"
    "obstacles:\n"
    "  - name: box\n"
    "    box: {size_m: [0.2, 0.2, 0.15]}\n"
    "    pose: {xyz: [1.0, 0.9, 0.185]}\n"
    "    motion: {speed_m_s: 0.15}\n";
constexpr char kConfig[] =
    "robot: hrp2\n"
    "scene: levels.yaml\n"
    "start: {left: {x_m: -0.1, y_m: 0.105}, right: {x_m: -0.1, y_m: -0.105}}\n"
    "goal: {x_m: 1.2, y_m: 0, radius_m: 0.15}\n"
    "half_step: {via_height_m: 0.12, foot_delay: 0.15, lift_share: 0.6, rise_end: 0.85,\n"
    "            crouch_m: 0.02}\n"
    "step_set: {x_min_m: -0.1, x_max_m: 0.4, y_min_m: -0.27, y_max_m: -0.17,\n"
    "           spacing_m: 0.1, yaws_rad: [0]}\n"
    "planner: {name: astar, unimproved_nodes: 0, max_nodes: 500}\n"
    "live: {smooth_ahead: 4, tolerance_s: 0.1, longest_s: 60, horizon_s: 2,\n"
    "       sensing: {rests_after_s: 0.4}}\n";

struct OnLevels {
  explicit OnLevels(const std::string& config_text = kConfig) {
    WriteText(folder / "levels.yaml", kScene);
    config = LoadLiveConfig(WriteText(folder / "episode.yaml", config_text), {});
    place = LoadEpisodePlace(config);
  }
  Episode Walk(const Replanner& replanner) const {
    const TrueWorld truth(place.scene, config.experiment.goal, config.live);
    StandInSensor sensor(truth, config.live, 1);
    const auto start = StartOf(config.experiment, place.robot, *place.scene.ground);
    Episode episode = RunLockstep(replanner, &sensor, start, {});
    episode.promise = JudgePromise(episode, &truth, place, config.live);
    return episode;
  }
  TemporaryFolder folder;
  LiveConfig config;
  Place place;
};

TEST(LevelEpisode, ArrivesAroundWhatIsCarriedIntoItsWayAndIsVerified) {
  OnLevels world;
  world.config.live.script = {Event(0.2, "carry", "box", {1.0, 0.3, 0.185}, 0.15)};
  const Episode episode = world.Walk({world.place, world.config});
  ASSERT_EQ(episode.ending, EpisodeEnding::kArrived) << episode.message;
  EXPECT_EQ(episode.promise.status(), PromiseStatus::kKept);
  EXPECT_TRUE(std::ranges::any_of(episode.walks, [](const ExecutedWalk& walk) {
    return walk.t > 0.0 && walk.kind == ProposalKind::kChanged;
  })) << TablesText(episode);
  // Again, by what was remembered of nothing.
  EXPECT_EQ(TablesText(world.Walk({world.place, world.config})), TablesText(episode));

  const std::string path = world.folder / "run";
  RunFolder folder(path, false);
  WriteEpisode(episode, world.config, world.place, &folder);
  folder.Publish();
  const Episode read = ReadEpisode(path, world.config, world.place);
  EXPECT_EQ(read.walks.back().tail.plan.sequence.half_steps.back().X_WS.height, 0.11);
  const auto verified = verify::VerifyRun({.prove = checker::ProverOfWalks(), .run = path});
  ASSERT_EQ(verified.size(), 1u);
  EXPECT_TRUE(verified[0].verified) << testing::PrintToString(verified[0].reasons);

  // A sole in the air is found without any hash.
  const std::string footsteps = path + "/walks/000/footsteps.csv";
  std::string text = ReadText(footsteps);
  const size_t at = text.find(",0.04,");
  ASSERT_NE(at, std::string::npos);
  WriteText(footsteps, text.replace(at, 6, ",0.05,"));
  EXPECT_THAT(verify::VerifyRun({.prove = checker::ProverOfWalks(), .run = path})[0].reasons,
              testing::Contains(HasSubstr("no level at z = 0.05 m bears all of the sole")));
}

TEST(LevelEpisode, AnObstacleInTheWayIsAllThatCountsBeyondTheGround) {
  const OnLevels world;
  const FreeHalfSteps half_steps(world.place, world.config.experiment);
  const Scene empty = world.place.scene.Emptied();
  Scene with = empty;
  with.obstacles = {world.place.scene.obstacles[0]};
  with.obstacles[0].motion = {.error = 0.005, .speed = 0.1, .horizon = 1.0};
  const auto without = half_steps.Among(empty);
  int free = 0, refused = 0, slow = 0, not_lifted = 0;
  for (const double y : {0.9, 0.55, 0.5, 0.45, 0.4, 0.35, 0.3}) {
    with.obstacles[0].X_WO.translation().y() = y;
    const auto among = half_steps.Among(with);
    Scene resting = with;
    resting.obstacles[0].motion.speed = 0.0;
    const auto at_rest = half_steps.Among(resting);
    for (int i = 0; i < half_steps.set().size(); ++i) {
      const Foothold X_WS({0.9, 0.1, 0.0}, 0.11);
      if (!without->DownIsFree(i, Side::kLeft, X_WS)) continue;
      const bool is_free = among->DownIsFree(i, Side::kLeft, X_WS);
      (is_free ? free : refused) += 1;
      const bool if_it_rested = at_rest->DownIsFree(i, Side::kLeft, X_WS);
      EXPECT_LE(is_free, if_it_rested);  // it counts wherever it may be
      slow += if_it_rested && !is_free ? 1 : 0;
      if (y != 0.4 || !without->UpIsFree(i, Side::kLeft, X_WS)) continue;
      not_lifted += among->UpIsFree(i, Side::kLeft, X_WS) ? 0 : 1;
    }
  }
  EXPECT_GT(free, 0);
  EXPECT_GT(refused, 0);
  EXPECT_GT(slow, 0);
  EXPECT_GT(not_lifted, 0);
}

// Where no obstacle is, half-steps are free that are proved on the ground, and no others.
TEST(LevelEpisode, WhatIsNotProvedOnTheGroundIsNotFree) {
  OnLevels world;
  // Soles that land on the platform come nearer to it than that before they are where they land.
  world.config.experiment.smoothing.limits.demanded_of(MarginFamily::kFloor) = 0.04;
  const FreeHalfSteps half_steps(world.place, world.config.experiment);
  const Scene empty = world.place.scene.Emptied();
  const auto query = half_steps.Among(empty);
  const HalfStepCertifier certifier(world.place.robot, empty, world.config.experiment);
  const StepSet& set = half_steps.set();
  const PlanRequest request = half_steps.Request(*query);
  const Foothold X_WS({0.0, 0.1, 0.0}, 0.0);
  int free = 0, no_down = 0, no_up = 0;
  for (int i = 0; i < set.size(); i += 2) {
    const Pose2 X_WF = (X_WS * set.Placement(i, Side::kLeft)).Planar();
    const double height = request.ground(X_WF, X_WS.height);
    if (!std::isfinite(height)) continue;
    HalfStep down = set.Down(i, Side::kLeft), up = set.Up(i, Side::kLeft);
    down.X_SF.height = height - X_WS.height;
    up.X_SF.height = X_WS.height - height;
    const bool may_land = certifier.Certifies(down, X_WS);
    const bool may_lift = certifier.Certifies(up, {X_WF, height});
    EXPECT_EQ(query->DownIsFree(i, Side::kLeft, X_WS), may_land) << i;
    EXPECT_EQ(query->UpIsFree(i, Side::kLeft, X_WS), may_lift) << i;
    free += may_land && may_lift, no_down += !may_land, no_up += !may_lift;
  }
  EXPECT_GT(free, 0);
  EXPECT_GT(no_down, 0);
  EXPECT_GT(no_up, 0);
}

// On flat ground a half-step is the same wherever it is; a tread ends.
TEST(LevelEpisode, WhatIsRememberedOnLevelsIsRememberedByPlace) {
  const SmallWorld& small = SmallWorld::Get();
  const auto walk_from = [&](double x) {
    const std::array<Foothold, 2> start = {Foothold::Level({x, 0.105, 0.0}),
                                           Foothold::Level({x, -0.105, 0.0})};
    const HalfStep like = PrototypeOf(small.config.experiment);
    WalkPlan plan;
    plan.sequence =
        MakeSequence(start, {{Side::kLeft, Foothold::Level({x + 0.2, 0.105, 0.0})}},
                     like.via_lateral, like.shape, MotionModelOf(small.place.robot, like.shape));
    plan.parameters = PlannedMotion(plan.sequence);
    return plan.Walk();
  };
  RememberedHalfSteps on_levels(true), on_the_floor(false);
  for (RememberedHalfSteps* all : {&on_levels, &on_the_floor}) all->Remember(walk_from(0.0), 1);
  EXPECT_TRUE(on_levels.Knows(walk_from(0.0), 1));
  EXPECT_FALSE(on_levels.Knows(walk_from(0.05), 1));
  EXPECT_TRUE(on_the_floor.Knows(walk_from(0.05), 1));
}

TEST(LevelEpisode, TellsHeightsToItsClients) {
  OnLevels world;
  const Episode episode = world.Walk({world.place, world.config});
  ASSERT_EQ(episode.ending, EpisodeEnding::kArrived) << episode.message;
  const nlohmann::json walk = WalkMessage(episode.walks[0], 0);
  EXPECT_EQ(walk["footsteps"].front()["z_m"], 0.0);
  EXPECT_NEAR(walk["footsteps"].back()["z_m"], 0.11, 1e-12);
  EXPECT_EQ(WorldMessage(episode.worlds[0], 0.0)["goal"]["z_m"], 0.11);
}

TEST(LevelEpisode, WhatItCannotProveIsRefused) {
  OnLevels drifting;
  drifting.config.live.drift = 0.01;
  EXPECT_THAT(RefusalOf([&] { LoadEpisodePlace(drifting.config); }),
              HasSubstr("live.drift_m_s: the ground has levels, whose borders are taken as exact "
                        "(valid: 0)"));
  OnLevels baked;
  baked.config.experiment.planner.free_by = "volumes";
  EXPECT_THAT(RefusalOf([&] { FormFor(baked.place, baked.config.experiment); }),
              HasSubstr("planner.free_by: volumes know no ground"));
}

// The form of the config does not reach; another one is taken before the robot walks.
TEST(LevelEpisode, TheFormOfHalfStepsIsFoundBeforeItBegins) {
  OnLevels world;
  ExperimentConfig config = world.config.experiment;
  config.half_step.via_height = 0.06;
  const EpisodeForm formed = FormFor(world.place, config);
  EXPECT_GT(formed.half_step.via_height, 0.07);
  EXPECT_EQ(formed.why_none, "");
  const SmallWorld& small = SmallWorld::Get();
  EXPECT_EQ(FormFor(small.place, small.config.experiment).half_step.via_height,
            small.config.experiment.half_step.via_height);
  config.goal.X_WG.x = 3.5;  // beyond all that bears
  config.planner.max_nodes = 10;
  EXPECT_THAT(FormFor(world.place, config).why_none, HasSubstr("no plan"));
}

}  // namespace
}  // namespace halfstep
