#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "experiments/live/messages.h"
#include "experiments/live/past_worlds.h"
#include "experiments/live/spare_boxes.h"
#include "experiments/server/client_sensor.h"
#include "experiments/server/edited_sensor.h"
#include "experiments/server/served_episode.h"
#include "tests/live/small_episode.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using std::chrono::steady_clock;
using testing::HasSubstr;

LiveConfig ServedConfig(const std::string& source = "stand_in") {
  LiveConfig config = SmallWorld::Get().config;
  config.live.sensing.source = source;
  config.live.sensing.noise = 0.0;
  return ServedEpisode::Served(config);
}

Scene OneBar(const LiveConfig& config, double speed = 0.0) {
  Scene scene;
  scene.obstacles = {Bar("bar", 0.75, 2.0)};
  scene.obstacles[0].motion.speed = speed;
  return WithSpareBoxes(scene, config.live);
}

// A sensor whose world people edit, and what it refused.
struct Edited {
  explicit Edited(double speed = 0.0)
      : config(ServedConfig()),
        scene(OneBar(config, speed)),
        sensor(TrueWorld(scene, config.experiment.goal, config.live), config.live, 1, &inbox,
               [this](const std::string& sentence) { refused = sentence; }) {}

  // The newest frame that has arrived by `now`.
  World At(double now) {
    std::optional<World> newest;
    while (std::optional<Frame> frame = sensor.Next(now)) newest = frame->world;
    EXPECT_TRUE(newest);
    return *newest;
  }

  LiveConfig config;
  Scene scene;
  ClientInbox inbox;
  std::string refused;
  EditedSensor sensor;
};

TEST(SpareBoxes, AreNotThereUntilTheyAppear) {
  Edited edited;
  EXPECT_EQ(edited.scene.obstacles.size(), 9U);
  EXPECT_EQ(edited.At(0.0).scene.obstacles.size(), 1U);
  edited.inbox.Add(Edit(AddBox{{1.0, 0.5, 0.05}, 0.5}));
  edited.At(0.4);
  const World world = edited.At(0.8);
  ASSERT_EQ(world.scene.obstacles.size(), 2U);
  EXPECT_EQ(world.scene.obstacles[1].name, "spare_1");
  EXPECT_EQ(world.scene.obstacles[1].X_WO.translation(), Eigen::Vector3d(1.0, 0.5, 0.05));
  // One that was taken away is there for the next.
  edited.inbox.Add(Edit(Remove{1}));
  edited.At(1.2);
  EXPECT_EQ(edited.At(1.6).scene.obstacles.size(), 1U);
  edited.inbox.Add(Edit(AddBox{{2.0, 0.5, 0.05}, 0.5}));
  edited.At(2.0);
  const Obstacle again = edited.At(2.4).scene.obstacles.back();
  EXPECT_EQ(again.name, "spare_1");
  EXPECT_NEAR(again.X_WO.linear()(1, 0), std::sin(0.5), 1e-12);
  EXPECT_EQ(edited.refused, "");
}

TEST(SpareBoxes, TakeNoNameOfTheScene) {
  const LiveConfig config = ServedConfig();
  Scene scene;
  scene.obstacles = {Bar("spare_3", 0.0, 0.0)};
  const std::vector<SceneMistake> mistakes =
      MistakesOf(config.live, WithSpareBoxes(scene, config.live));
  ASSERT_EQ(mistakes.size(), 1U);
  EXPECT_EQ(mistakes[0].key, "spare_boxes");
  EXPECT_THAT(mistakes[0].what, HasSubstr("'spare_3' is an obstacle of the scene already"));
}

TEST(SpareBoxes, AreRefusedWhenAllAreThere) {
  Edited edited;
  for (int i = 0; i < 9; ++i) edited.inbox.Add(Edit(AddBox{{1.0, 0.1 * i, 0.05}, 0.0}));
  edited.At(0.4);
  EXPECT_THAT(edited.refused, HasSubstr("every spare box is there already (valid: at most 8"));
}

// What is carried keeps to the speed that the robot is told, so no frame contradicts another.
TEST(EditedSensor, CarriesNoFasterThanTheSpeedBound) {
  Edited edited(0.3);
  edited.sensor.Next(0.0);
  edited.inbox.Add(Edit(Carry{0, {1.5, 1.0, 0.02}, 2.0}));
  World last = edited.At(0.2);
  PastWorlds past({&last, 1});
  for (int i = 2; i < 60; ++i) {
    const WorldUpdate update = Updated(last, past, edited.At(0.2 * i), edited.config.live);
    EXPECT_TRUE(update.contradictions.empty()) << i;
    last = update.world;
    past.Add(last);
  }
  const Obstacle& bar = last.scene.obstacles[0];
  EXPECT_LT((bar.X_WO.translation() - Eigen::Vector3d(1.5, 1.0, 0.02)).norm(), 1e-9);
}

// The script of the folder's config makes the same world again.
TEST(EditedSensor, TheScriptSaysWhatPeopleDid) {
  Edited edited(0.3);
  edited.At(0.4);
  edited.sensor.Begin(0.6);
  edited.inbox.Add(Edit(Carry{0, {1.5, 1.0, 0.02}, 0.7}));
  edited.sensor.Next(1.0);
  edited.inbox.Add(Edit(MoveGoal{{2.0, 0.5}}));
  edited.inbox.Add(Edit(Remove{0}));
  edited.sensor.Next(2.0);
  LiveConfig again = edited.config;
  again.live.script = edited.sensor.truth().Script();
  const std::string text = WriteYaml([&](Fields& fields) { DeclareFields(fields, &again); });
  const LiveConfig read = ParseLiveConfig("again.yaml", text, {});
  ASSERT_EQ(read.live.script.size(), 3U);
  const TrueWorld one = edited.sensor.truth();
  const TrueWorld two = TrueWorld(edited.scene, read.experiment.goal, read.live).Since(0.6);
  for (double t = -0.6; t < 4.0; t += 0.01) {
    ASSERT_EQ(one.IsThere(0, t), two.IsThere(0, t)) << t;
    const Eigen::Isometry3d a = one.PoseAt(0, t), b = two.PoseAt(0, t);
    ASSERT_LT((a.matrix() - b.matrix()).norm(), 1e-12) << t;
    ASSERT_EQ(one.GoalAt(t).X_WG.x, two.GoalAt(t).X_WG.x) << t;
  }
}

// A command counts from the next frame on, in place of the goal, until a goal is set; the script
// has it. Of those that wait only the last is one.
TEST(EditedSensor, CommandsAreInTheScript) {
  Edited edited;
  EXPECT_EQ(edited.At(0.4).course, nullptr);
  const auto command = [](double forward) {
    Command one;
    one.event.what = "walk";
    one.event.velocity = {forward, 0, 0};
    return Edit(one);
  };
  edited.inbox.Add(command(0.05));
  edited.inbox.Add(command(0.1));
  edited.At(0.8);
  const World world = edited.At(1.2);
  ASSERT_NE(world.course, nullptr);
  EXPECT_EQ(world.course->velocity[0], 0.1);
  ASSERT_EQ(edited.sensor.truth().Script().size(), 1U);
  LiveConfig again = edited.config;
  again.live.script = edited.sensor.truth().Script();
  const std::string text = WriteYaml([&](Fields& fields) { DeclareFields(fields, &again); });
  const LiveConfig read = ParseLiveConfig("again.yaml", text, {});
  EXPECT_EQ(read.live.script[0].velocity, (std::vector<double>{0.1, 0, 0}));
  edited.inbox.Add(Edit(MoveGoal{{2.0, 0.5}}));
  edited.At(1.6);
  EXPECT_EQ(edited.At(2.0).course, nullptr);
}

TEST(EditedSensor, RefusesToCarryWhatIsNotThere) {
  Edited edited;
  edited.inbox.Add(Edit(Carry{1, {0, 0, 0}, 0.0}));
  edited.sensor.Next(0.2);
  EXPECT_THAT(edited.refused, HasSubstr("'spare_1' is not there"));
}

TEST(ClientInbox, IsBounded) {
  ClientInbox inbox;
  for (int i = 0; i < 10'000; ++i) inbox.Add(Edit(Remove{0}));
  EXPECT_FALSE(inbox.Add(Edit(Remove{0})));
  EXPECT_LE(inbox.TakeEdits().size(), 1000U);
  for (int i = 0; i < 10'000; ++i) EXPECT_TRUE(inbox.Add(Edit(Carry{0, {1.0, 0, 0}, 0.0})));
  EXPECT_EQ(inbox.TakeEdits().size(), 1U);
  for (int i = 0; i < 10'000; ++i) inbox.Add(ClientInbox::Measurement{});
  EXPECT_FALSE(inbox.Add(ClientInbox::Measurement{}));
}

ClientInbox::Measurement MeasuredAgo(double age, const Eigen::Vector3d& place) {
  MeasuredFrame frame;
  frame.seen.push_back({0, Eigen::Isometry3d(Eigen::Translation3d(place))});
  return {steady_clock::now() - std::chrono::duration_cast<steady_clock::duration>(
                                    std::chrono::duration<double>(age)),
          frame};
}

TEST(ClientSensor, FramesAreAsOldAsClientsSay) {
  const LiveConfig config = ServedConfig("client");
  Scene scene;
  scene.obstacles = {Bar("bar", 0.75, 2.0)};
  scene.no_step.resize(2);
  ClientInbox inbox;
  ClientSensor sensor(scene, config, &inbox);
  EXPECT_FALSE(sensor.Next(1.0));
  inbox.Add(MeasuredAgo(0.5, {1, 2, 3}));
  inbox.Add(MeasuredAgo(0.7, {1, 2, 4}));  // older than the one before
  const std::optional<Frame> frame = sensor.Next(1.0);
  ASSERT_TRUE(frame && frame->world);
  EXPECT_LE(frame->taken, 0.5);
  EXPECT_EQ(frame->world->measured_at, frame->taken);
  EXPECT_EQ(frame->world->scene.obstacles[0].X_WO.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(frame->world->scene.obstacles[0].motion.measured_at, frame->taken);
  EXPECT_EQ(frame->world->areas, (std::vector<size_t>{0, 1}));
  EXPECT_FALSE(sensor.Next(1.0));
}

// Where clients measure they command as well. A goal that is told again ends nothing.
TEST(ClientSensor, ClientsCommandUntilTheyMoveTheGoal) {
  const LiveConfig config = ServedConfig("client");
  ClientInbox inbox;
  ClientSensor sensor({}, config, &inbox);
  const auto measured_with_goal = [&](double now, double x) {
    ClientInbox::Measurement one{steady_clock::now(), {}};
    one.frame.goal = Eigen::Vector2d(x, 0.0);
    inbox.Add(one);
    return sensor.Next(now)->world->course;
  };
  Command command;
  command.event.what = "walk";
  command.event.velocity = {0.1, 0, 0};
  EXPECT_EQ(measured_with_goal(1.0, 1.2), nullptr);
  inbox.Add(Edit(command));
  ASSERT_NE(measured_with_goal(2.0, 1.2), nullptr);
  EXPECT_EQ(measured_with_goal(3.0, 1.3), nullptr);
}

TEST(ClientSensor, TheRobotMayArriveOnlyWhenAClientEndsTheEpisode) {
  const LiveConfig config = ServedConfig("client");
  ClientInbox inbox;
  ClientSensor sensor({}, config, &inbox);
  EXPECT_GT(sensor.QuietFrom(), config.live.longest - 1e-9);
  EXPECT_LT(sensor.QuietFrom(), config.live.longest);
  inbox.End();
  EXPECT_LT(sensor.QuietFrom(), 0.0);
}

// A row of a message is a row of trajectory.csv without its margins.
TEST(Messages, RowsHaveTheColumnsThatHelloNames) {
  const SmallWorld& small = SmallWorld::Get();
  const Episode episode = Play({}, small.config).episode;
  const auto hello = HelloMessage(small.config, small.place.robot, {}, {});
  const SuperposedWalk executed = episode.Executed();
  const auto motion = MotionMessage(small.place.robot, executed, 0, 0.5, 1.0, 0.005);
  EXPECT_EQ(motion["rows"].size(), 101U);
  for (const auto& row : motion["rows"]) ASSERT_EQ(row.size(), hello["columns"].size());
  EXPECT_EQ(hello["columns"][0], "t_s");
  EXPECT_DOUBLE_EQ(motion["rows"][1][0], 0.505);
  const auto end = MotionMessage(small.place.robot, executed, 0, 1e3, 1e3 + 1, 0.005);
  EXPECT_EQ(end["rows"].size(), 1U);
}

TEST(Messages, AWalkTellsItsFootstepsAndTimes) {
  const SmallWorld& small = SmallWorld::Get();
  const Episode episode = Play({}, small.config).episode;
  const auto walk = WalkMessage(episode.walks.front(), 0);
  const HalfStepSequence& sequence = episode.walks.front().tail.plan.sequence;
  EXPECT_EQ(walk["footsteps"].size(), static_cast<size_t>(sequence.num_steps()) + 2);
  EXPECT_EQ(walk["half_steps"].size(), static_cast<size_t>(sequence.size()));
  EXPECT_EQ(walk["half_steps"].back()["end_s"], walk["duration_s"]);
  EXPECT_TRUE(GrantMessage(episode.grants.front(), 0)["valid_until_s"].is_null());
}

}  // namespace
}  // namespace halfstep
