#include "experiments/replay/episode_physics.h"
#include "experiments/config/data_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/replay/physics_record.h"
#include "experiments/replay/simulation.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/experiments/short_episode.h"
#include "tests/live/small_episode.h"
#include "tests/temporary_folder.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"

namespace halfstep::replay {
namespace {

using testing::HasSubstr;

#define SKIP_WITHOUT_PHYSICS() \
  if (!WhyNoSimulation().empty()) GTEST_SKIP() << WhyNoSimulation()

const WholeRobot& Hrp2() {
  static const WholeRobot robot = LoadWholeRobot((RobotsFolder() / "hrp2.yaml").string());
  return robot;
}

/// An episode of the small world, executed in physics.
struct PlayedInPhysics {
  Episode episode;
  PhysicalOutcome outcome;
};
EpisodeRobot RobotOf(const ModelOptions& model = {}) {
  return {.setup = {.robot = Hrp2(),
                    .obstacles = {},
                    .ground = {},
                    .model = model,
                    .relief = {},
                    .play = {},
                    .control = {}}};
}
PlayedInPhysics PlayInPhysics(const Scene& scene, const LiveConfig& config,
                              const EpisodeRobot& robot = RobotOf(), bool feedback = true) {
  const SmallWorld& small = SmallWorld::Get();
  const TrueWorld truth(scene, config.experiment.goal, config.live);
  const Replanner replanner(small.place, config, *small.baked.cached.volumes);
  EpisodePhysics physics(robot, truth, config.live);
  StandInSensor sensor(feedback ? physics.SeenByRobot() : truth, config.live, 1);
  PlayedInPhysics played;
  played.episode = RunLockstep(replanner, &sensor, small.start,
                               {.on_tick = [&](const EpisodeTick& tick) { physics.Play(tick); },
                                .on_wait = {},
                                .held = {},
                                .waits = [&](Side support) { return physics.Waits(support); },
                                .felt = [&] { return physics.TakeFelt(); },
                                .fallen = [&] { return physics.fallen(); },
                                .stop = {}});
  played.outcome = physics.Finish(played.episode);
  return played;
}

long TimesOf(const Episode& episode, const std::string& what) {
  return std::ranges::count(episode.events, what, &EpisodeEvent::what);
}

/// r and v that cover the noise and how the simulated robot strays.
LiveConfig Covering() {
  LiveConfig config = SmallWorld::Get().config;
  config.live.sensing.error = 0.012;
  config.live.drift = 0.001;
  return config;
}

// A bar is put into the way of a robot that sees it.
PlayedInPhysics PlayBarInTheWay() {
  LiveConfig config = Covering();
  config.live.script = {Event(1.2, "jump", "bar", {0.75, 0.1, 0.02})};
  Scene scene;
  scene.obstacles = {Bar("bar", 0.75, 2.0)};
  return PlayInPhysics(scene, config);
}

const PlayedInPhysics& BarInTheWay() {
  static const PlayedInPhysics played = PlayBarInTheWay();
  return played;
}

TEST(EpisodePhysicsTest, ArrivesInTheWorldAndTouchesNothing) {
  SKIP_WITHOUT_PHYSICS();
  const auto& [episode, outcome] = BarInTheWay();
  EXPECT_EQ(episode.ending, EpisodeEnding::kArrived);
  // Nothing but the jump was a contradiction: the drift is covered.
  EXPECT_EQ(TimesOf(episode, "contradicted"), 1);
  const ReplayResult& result = outcome.replayed.result;
  EXPECT_TRUE(result.stayed_up);
  EXPECT_TRUE(result.touches.empty());
  EXPECT_TRUE(outcome.in_goal);
  EXPECT_LT(outcome.goal_off, 0.003);
  EXPECT_NEAR(result.weight_share, 1.0, 0.01);
  EXPECT_GT(result.support.largest_shift, 0.0005);
  EXPECT_NEAR(result.ended, episode.end + PlayOptions().hold, 0.02);
}

TEST(EpisodePhysicsTest, TheSameAgainToTheByte) {
  SKIP_WITHOUT_PHYSICS();
  const PlayedInPhysics &one = BarInTheWay(), two = PlayBarInTheWay();
  EXPECT_EQ(TablesText(one.episode), TablesText(two.episode));
  EXPECT_EQ(ReplayCsv(one.outcome.replayed.result.rows).text,
            ReplayCsv(two.outcome.replayed.result.rows).text);
}

// Control: what is carried into the way unseen is touched.
TEST(EpisodePhysicsTest, WhatIsNotSeenIsTouched) {
  SKIP_WITHOUT_PHYSICS();
  LiveConfig config = Covering();
  ScriptEvent lose = Event(1.0, "lose", "", {});
  lose.lasts = 30.0;
  config.live.script = {lose, Event(2.0, "carry", "wall", {0.55, 0.0, 0.4}, 1.0)};
  config.live.drift = 0.0;
  Scene scene;
  scene.obstacles = {Bar("wall", 0.55, 2.0)};
  scene.obstacles[0].shape = Box{{0.1, 1.0, 0.8}};
  scene.obstacles[0].X_WO.translation().z() = 0.4;
  const std::vector<TouchRecord> touches =
      PlayInPhysics(scene, config).outcome.replayed.result.touches;
  ASSERT_FALSE(touches.empty());
  EXPECT_FALSE(touches[0].at_rest);
  EXPECT_GT(touches[0].begin, 2.0);
  EXPECT_GT(touches[0].force, 1.0);
}

/// Servos so soft that the robot strays by centimetres.
EpisodeRobot Soft(double stiffness, double damping) {
  ModelOptions model;
  model.stiffness = stiffness;
  model.damping = damping;
  return RobotOf(model);
}

TEST(EpisodePhysicsTest, ARobotThatFallsEndsTheEpisode) {
  SKIP_WITHOUT_PHYSICS();
  const auto [episode, outcome] = PlayInPhysics({}, SmallWorld::Get().config, Soft(500.0, 50.0));
  EXPECT_EQ(episode.ending, EpisodeEnding::kFell);
  EXPECT_THAT(episode.message, HasSubstr("the robot fell at "));
  EXPECT_FALSE(outcome.replayed.result.stayed_up);
  EXPECT_FALSE(outcome.in_goal);
  EXPECT_NEAR(outcome.replayed.result.ended, episode.end, 1e-9);
}

// The drift is fed back: the goal is met where it is, not where it would be without drift.
TEST(EpisodePhysicsTest, FeedbackMeetsTheGoalWhereItIs) {
  SKIP_WITHOUT_PHYSICS();
  LiveConfig config = SmallWorld::Get().config;
  config.experiment.goal.radius = 0.06;
  const EpisodeRobot soft = Soft(3000.0, 300.0);
  const PhysicalOutcome with = PlayInPhysics({}, config, soft).outcome;
  const PhysicalOutcome without = PlayInPhysics({}, config, soft, /*feedback=*/false).outcome;
  EXPECT_TRUE(with.replayed.result.stayed_up);
  EXPECT_TRUE(without.replayed.result.stayed_up);
  EXPECT_TRUE(with.in_goal);
  EXPECT_GT(without.goal_off, 0.01);
  EXPECT_LT(with.goal_off, 0.2 * without.goal_off);
}

// The world of the robot is the true one, moved rigidly so that the support feet meet.
TEST(EpisodePhysicsTest, SeesTheWorldFromItsSupportFoot) {
  SKIP_WITHOUT_PHYSICS();
  Scene scene;
  scene.obstacles = {Bar("bar", 1.0, 1.5)};
  LiveConfig config = SmallWorld::Get().config;
  config.live.sensing.noise = 0.0;
  const auto [episode, outcome] = PlayInPhysics(scene, config, Soft(3000.0, 300.0));
  const World& last = episode.worlds.back();
  const SuperposedWalk walk = episode.Executed();
  const auto row = std::ranges::find_if(outcome.replayed.result.rows, [&](const ReplayRow& r) {
    return r.t > last.measured_at - 1e-6;
  });
  ASSERT_TRUE(row->support.has_value());
  const WalkState x = walk.At(row->t).value;
  const Eigen::Vector4d sole = x.segment<4>(FootIndex(*row->support));
  const Pose2 X_WS{sole[0], sole[1], sole[3]}, bar{1.0, 1.5, 0.0};
  const Eigen::Vector3d& drift = row->support_drift;
  const Pose2 X_US{sole[0] + drift[0], sole[1] + drift[1], sole[3] + drift[2]};
  const Pose2 expected = X_WS * X_US.Inverse() * bar;
  const Eigen::Isometry3d& seen = last.scene.obstacles[0].X_WO;
  EXPECT_TRUE(seen.isApprox(ToIsometry(expected, seen.translation().z()), 1e-9));
  EXPECT_GT((seen.translation() - Eigen::Vector3d(1.0, 1.5, 0.02)).norm(), 0.005);
}

/// A short walk: three steps.
LiveConfig ThreeSteps() {
  LiveConfig config = Covering();
  config.experiment.goal.X_WG.x = 0.45;
  return config;
}

/// Moved by the controller, whose sensors have noise.
EpisodeRobot Controlled(EpisodeRobot robot) {
  robot.setup.control = {.make =
                             [](const control::ControlledRobot& of) {
                               return control::Controllers::Standard().Make("dcm", of);
                             },
                         .sensors = {.delay = 0.005, .seed = 1}};
  robot.controller = "dcm";
  return robot;
}

TEST(EpisodePhysicsTest, AControllerExecutesTheWalkAndTheSameAgainToTheByte) {
  SKIP_WITHOUT_PHYSICS();
  EpisodeRobot soft = Soft(10000.0, 300.0);
  soft.controller = "none";
  const PlayedInPhysics open = PlayInPhysics({}, ThreeSteps(), soft);
  const PlayedInPhysics one = PlayInPhysics({}, ThreeSteps(), Controlled(soft));
  const PlayedInPhysics two = PlayInPhysics({}, ThreeSteps(), Controlled(soft));
  EXPECT_EQ(one.episode.ending, EpisodeEnding::kArrived);
  EXPECT_EQ(TimesOf(one.episode, "early") + TimesOf(one.episode, "late"), 0);
  EXPECT_EQ(TimesOf(one.episode, "stopped"), 0);
  const ReplayResult& controlled = one.outcome.replayed.result;
  EXPECT_LT(controlled.off.most.waist, 0.5 * open.outcome.replayed.result.off.most.waist);
  EXPECT_LT(controlled.largest_tilt, open.outcome.replayed.result.largest_tilt);
  EXPECT_THAT(PhysicsText(one.outcome), HasSubstr("controller dcm: off the plan"));
  EXPECT_EQ(TablesText(one.episode), TablesText(two.episode));
  EXPECT_EQ(ReplayCsv(controlled.rows).text, ReplayCsv(two.outcome.replayed.result.rows).text);
}

// By itself, without physics: what the executor does when it is told that a foot does not carry.
TEST(EpisodePhysicsTest, NoFootIsLiftedAsLongAsTheRobotWaits) {
  constexpr double kFrom = 2.0, kUntil = 4.0;
  double now = 0.0;
  const auto waits = [&now](Side) {
    return now > kFrom && now < kUntil ? std::string("a foot does not carry yet") : "";
  };
  const Episode episode =
      Play({}, SmallWorld::Get().config,
           {.on_tick = [&now](const EpisodeTick& tick) { now = tick.now; }, .waits = waits})
          .episode;
  EXPECT_EQ(episode.ending, EpisodeEnding::kArrived);
  EXPECT_EQ(TimesOf(episode, "stopped"), 1);
  int after = 0;
  for (const EpisodeEvent& event : episode.events) {
    if (event.what == "stopped") {
      EXPECT_THAT(event.text, HasSubstr(": a foot does not carry yet"));
    }
    if (event.what != "begins" || event.half_step % 2 != 0) continue;
    EXPECT_FALSE(event.t > kFrom + 0.02 && event.t < kUntil) << event.t;
    after += event.t >= kUntil ? 1 : 0;
  }
  EXPECT_GT(after, 0);
}

TEST(EpisodePhysicsTest, AFootThatCarriesLateIsMissedAndThenTold) {
  const SuperposedWalk walk = Play({}, SmallWorld::Get().config).episode.Executed();
  const RobotModel& robot = Hrp2().model;
  const Side swing = walk.half_step(2).swing();
  const double landing = walk.start_of(3) + walk.tracks(3).t1();
  control::ContactWatch watch(robot);
  std::vector<control::Contact> told;
  bool missed = false;
  for (double t = 0.0; t < landing + 0.5; t += 0.005) {
    control::MeasuredState measured;
    measured.t = t;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const bool late = side == swing && t > landing - 0.1 && t < landing + 0.2;
      const bool lifted = late || walk.InAir(walk.Locate(t), side);
      Nth(measured.loads, Index(side)).force = lifted ? 0.0 : 0.5 * robot.mass * kGravity;
    }
    if (const auto contact = watch.Look(measured, walk)) told.push_back(*contact);
    missed = missed || watch.misses(swing);
  }
  EXPECT_TRUE(missed);
  EXPECT_FALSE(watch.misses(swing));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].foot, swing);
  EXPECT_EQ(told[0].half_step, 3);
  EXPECT_GT(told[0].late, 0.1);
  EXPECT_LT(told[0].late, 0.21);
}

TEST(EpisodePhysicsTest, AFootThatMeetsTheFloorEarlyIsNotPushedIntoIt) {
  SKIP_WITHOUT_PHYSICS();
  EpisodeRobot open = RobotOf();
  open.setup.relief.curb = 0.01;
  const PlayedInPhysics pushed = PlayInPhysics({}, ThreeSteps(), open);
  const PlayedInPhysics met = PlayInPhysics({}, ThreeSteps(), Controlled(open));
  for (const PlayedInPhysics& one : {std::cref(pushed), std::cref(met)}) {
    EXPECT_GE(TimesOf(one.episode, "early"), 1);
  }
  EXPECT_LT(met.outcome.replayed.result.largest_tilt,
            0.7 * pushed.outcome.replayed.result.largest_tilt);
}

TEST(EpisodePhysicsTest, APushActsAndIsTold) {
  SKIP_WITHOUT_PHYSICS();
  EpisodeRobot robot = Soft(3000.0, 150.0);
  const auto push = [&robot](double impulse) {
    robot.pushes = {{.at = 2.0, .duration = 0.1, .impulse_W = {0.0, impulse, 0.0}}};
  };
  push(17.0);
  EXPECT_EQ(PlayInPhysics({}, ThreeSteps(), robot).episode.ending, EpisodeEnding::kFell);
  push(4.0);
  const PhysicalOutcome stands = PlayInPhysics({}, ThreeSteps(), Controlled(robot)).outcome;
  EXPECT_TRUE(stands.replayed.result.stayed_up);
  EXPECT_THAT(PhysicsText(stands), HasSubstr("pushed at 2.00 s for 0.10 s: x 0.0 N s, y 4.0 N s"));
}

TEST(LiveInPhysicsCommand, WritesAFolderThatVerifiesAndReplaysOrSaysWhyNot) {
  const TemporaryFolder place;
  WriteText(place / "scene.yaml", BoxAside("1.5"));
  WriteText(place / "walk.yaml", std::string(kShortEpisode) +
                                     "  horizon_s: 3\n"
                                     "  drift_m_s: 0.001\n"
                                     "  sensing: {error_m: 0.012}\n");
  const Outcome live =
      Halfstep(place.path(), {"live", "walk.yaml", "--in-physics", "--out", "episode", "--json"});
  if (!WhyNoSimulation().empty()) {
    EXPECT_EQ(live.status, kBadInput);
    EXPECT_THAT(live.err, HasSubstr(WhyNoSimulation()));
    EXPECT_FALSE(std::filesystem::exists(place / "episode"));
    return;
  }
  ASSERT_EQ(live.status, kSuccess) << live.err;
  const auto physics = nlohmann::json::parse(live.out)["physics"];
  EXPECT_TRUE(physics["stayed_up"]);
  EXPECT_EQ(physics["touches_walking"], 0);
  EXPECT_TRUE(physics["in_goal"]);
  const auto manifest = nlohmann::json::parse(ReadText(place / "episode/manifest.json"));
  EXPECT_EQ(manifest["physics"]["touches_walking"], 0);
  EXPECT_TRUE(manifest["files"].contains("physics.csv"));
  const ParsedCsv table(ReadText(place / "episode/physics.csv"));
  EXPECT_NEAR(table.Number(table.size() - 1, "t_s"), physics["ended_s"], 1e-9);
  const Outcome verify = Halfstep(place.path(), {"verify", "episode", "--quiet"});
  EXPECT_EQ(verify.status, kSuccess) << verify.err;
  // What was executed, played afterwards, goes the same way.
  const Outcome replay = Halfstep(place.path(), {"replay", "episode", "--json"});
  const auto again = nlohmann::json::parse(replay.out)["methods"][0];
  for (const char* part : {"x_m", "y_m", "yaw_rad"}) {
    EXPECT_NEAR(again["support_drift"]["at_end"][part],
                physics["support_drift"]["at_end"][part].get<double>(), 1e-4);
  }
}

}  // namespace
}  // namespace halfstep::replay
