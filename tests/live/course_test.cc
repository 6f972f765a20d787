// Walking on command: velocities, paths and footsteps in place of a goal.

#include "experiments/live/course.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/live/course_steps.h"
#include "experiments/live/episode_touch.h"
#include "experiments/live/prepared_world.h"
#include "experiments/live/recent_part.h"
#include "tests/live/small_episode.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

constexpr double kPace = 2.0;  // [s]

// A gait on a grid of 5 cm and 0.25 rad from −0.2 to 0.2 m.
struct Stepping {
  StepSet set;
  double width = 0.2;

  Stepping() {
    for (double x = -0.2; x <= 0.21; x += 0.05) {
      for (double y = -0.35; y <= -0.19; y += 0.05) {
        for (const double yaw : {-0.25, 0.0, 0.25}) set.placements.push_back({{x, y, yaw}, 0.0});
      }
    }
  }
  Gait Of() const {
    return {.set = set, .cell = {0.025 + 1e-9, 0.025 + 1e-9, 0.125}, .width = width, .pace = kPace};
  }
  std::array<Foothold, 2> SideBySide() const {
    return {Foothold::Level({0, 0.5 * width, 0}), Foothold::Level({0, -0.5 * width, 0})};
  }
  CourseSteps Along(const Course& course, const Standing& standing, int count = 6) const {
    return FootstepsAlong(course, Of(), standing, count);
  }
};

Course Velocity(double forward, double left, double yaw_rate) {
  Course course;
  course.velocity = {forward, left, yaw_rate};
  return course;
}

Course Path(const std::vector<Eigen::Vector2d>& points, double speed = 0.06) {
  Course course;
  course.kind = CourseKind::kPath;
  course.path = points;
  course.speed = speed;
  return course;
}

Pose2 MiddleAfter(std::array<Foothold, 2> feet, const std::vector<Footstep>& footsteps) {
  for (const Footstep& one : footsteps) Nth(feet, Index(one.side)) = one.X_WF;
  return MidFeet(feet[0].Planar(), feet[1].Planar());
}

// A foot's height, duration and via point are those of the set.
TEST(CourseSteps, AVelocityIsWalkedAtItsSpeed) {
  const Stepping stepping;
  const CourseSteps all = stepping.Along(Velocity(0.04, 0, 0), {.feet = stepping.SideBySide()});
  const std::vector<Footstep>& steps = all.footsteps;
  ASSERT_EQ(steps.size(), 6U);
  EXPECT_EQ(ShortfallText(all), "");
  for (size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].side, i % 2 == 0 ? Side::kLeft : Side::kRight);
    EXPECT_NEAR(steps[i].X_WF.x, 0.04 * kPace * static_cast<double>(i + 1), 1e-12);
    EXPECT_NEAR(steps[i].X_WF.y, i % 2 == 0 ? 0.1 : -0.1, 1e-12);
  }
}

// Sideways and in yaw the foot on that side goes, twice as far, and the other one follows.
TEST(CourseSteps, SidewaysAndTurningTheMiddleKeepsTheSpeed) {
  const Stepping stepping;
  for (const Course& course : {Velocity(0, 0.03, 0), Velocity(0, 0, 0.05), Velocity(0, 0, -0.05)}) {
    const std::vector<Footstep> steps =
        stepping.Along(course, {.feet = stepping.SideBySide()}).footsteps;
    ASSERT_EQ(steps.size(), 6U);
    const Pose2 middle = MiddleAfter(stepping.SideBySide(), steps);
    EXPECT_NEAR(middle.y, 6 * kPace * course.velocity[1], 1e-9);
    EXPECT_NEAR(middle.yaw, 6 * kPace * course.velocity[2], 1e-9);
  }
}

// Metamorphic: in a mirror the other foot does the same.
TEST(CourseSteps, AreMirrored) {
  const Stepping stepping;
  std::array<Foothold, 2> feet = stepping.SideBySide();
  feet[0].x = 0.07;
  const std::array<Foothold, 2> mirrored = {feet[1].Mirrored(), feet[0].Mirrored()};
  const auto one = stepping.Along(Velocity(0.05, 0.02, 0.06), {feet, {}, Side::kLeft}).footsteps;
  const auto two =
      stepping.Along(Velocity(0.05, -0.02, -0.06), {mirrored, {}, Side::kRight}).footsteps;
  ASSERT_EQ(one.size(), two.size());
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].side, Opposite(two[i].side));
    EXPECT_NEAR(one[i].X_WF.x, two[i].X_WF.x, 1e-12);
    EXPECT_NEAR(one[i].X_WF.y, -two[i].X_WF.y, 1e-12);
    EXPECT_NEAR(one[i].X_WF.yaw, -two[i].X_WF.yaw, 1e-12);
  }
}

// What half-steps do not allow is walked as fast as they do: every footstep is in a cell of the
// set, and speed and yaw rate are lowered together.
TEST(CourseSteps, TooFastIsAsFastAsTheSetHasElements) {
  const Stepping stepping;
  const CourseSteps all = stepping.Along(Velocity(1.0, 0, 0.2), {.feet = stepping.SideBySide()});
  const std::vector<Footstep>& steps = all.footsteps;
  ASSERT_EQ(steps.size(), 6U);
  // Of 2 m a footstep about 0.2; that is said.
  EXPECT_NEAR(all.part, 0.1, 0.03);
  EXPECT_THAT(ShortfallText(all), HasSubstr(" % as far, as much as half-steps reach"));
  std::array<Foothold, 2> feet = stepping.SideBySide();
  for (const Footstep& one : steps) {
    const Foothold X_SF = Nth(feet, Index(Opposite(one.side))).Inverse() * one.X_WF;
    EXPECT_LE(X_SF.x, 0.225 + 1e-6);
    EXPECT_LE(std::abs(X_SF.yaw), 0.375 + 1e-6);
    Nth(feet, Index(one.side)) = one.X_WF;
  }
  const Pose2 middle = MiddleAfter(stepping.SideBySide(), steps);
  const double length = std::hypot(middle.x, middle.y);
  EXPECT_GT(length, 0.8);
  EXPECT_NEAR(middle.yaw / length, 0.2, 0.05);  // the curvature that was commanded
}

TEST(CourseSteps, RestClosesTheFeetOnce) {
  const Stepping stepping;
  std::array<Foothold, 2> feet = stepping.SideBySide();
  feet[0].x = 0.12;
  const CourseSteps steps = stepping.Along(Velocity(0, 0, 0), {feet, {}, Side::kLeft});
  ASSERT_EQ(steps.footsteps.size(), 1U);
  EXPECT_EQ(steps.footsteps[0].side, Side::kRight);
  EXPECT_NEAR(steps.footsteps[0].X_WF.x, 0.12, 1e-12);
  EXPECT_TRUE(steps.complete);
  // A foot in the air lands beside the other one, wherever it was to go.
  const CourseSteps landing = stepping.Along(Velocity(0, 0, 0), {feet, Side::kLeft, Side::kLeft});
  ASSERT_EQ(landing.footsteps.size(), 1U);
  EXPECT_NEAR(landing.footsteps[0].X_WF.x, 0.0, 1e-12);
}

TEST(CourseSteps, WhereTheGroundBearsNoneNothingIsComplete) {
  const Stepping stepping;
  Gait gait = stepping.Of();
  gait.ground = [](const Pose2& X_WF, double) { return X_WF.x < 0.2 ? 0.0 : std::nan(""); };
  const CourseSteps steps =
      FootstepsAlong(Velocity(0.04, 0, 0), gait, {.feet = stepping.SideBySide()}, 6);
  EXPECT_EQ(steps.footsteps.size(), 2U);
  EXPECT_FALSE(steps.complete);
}

TEST(PathLine, DirectionTellsWhichTimeItComesBy) {
  const std::vector<Eigen::Vector2d> eight = {{-1, 0}, {1, 0}, {1, 1}, {0, 1}, {0, -1}};
  const PathLine line(eight);
  EXPECT_NEAR(line.length(), 6.0, 1e-12);
  EXPECT_NEAR(line.Nearest({0.0, 0.02, 0.0}).s, 1.0, 1e-9);
  EXPECT_NEAR(line.Nearest({0.02, 0.0, -1.57}).s, 5.0, 1e-9);
  EXPECT_NEAR(line.At(2.5).X_WP.y, 0.5, 1e-12);
  EXPECT_NEAR(line.At(99.0).X_WP.y, -1.0, 1e-12);
}

// Around a corner to the end, never far from the line, and then nothing is left.
TEST(CourseSteps, APathIsFollowedToItsEnd) {
  const Stepping stepping;
  const Course course = Path({{0, 0}, {1.2, 0}, {1.2, 1.0}});
  std::array<Foothold, 2> feet = stepping.SideBySide();
  Side landed = Side::kRight;
  const PathLine line(course.path);
  int count = 0;
  while (true) {
    const CourseSteps next = stepping.Along(course, {feet, {}, landed}, 1);
    if (next.footsteps.empty()) {
      EXPECT_TRUE(next.complete);
      break;
    }
    ASSERT_LT(++count, 60);
    landed = next.footsteps[0].side;
    Nth(feet, Index(landed)) = next.footsteps[0].X_WF;
    const Pose2 middle = MidFeet(feet[0].Planar(), feet[1].Planar());
    const PathPlace near = line.Nearest(middle);
    EXPECT_LT((near.X_WP.position() - middle.position()).norm(), 0.15) << count;
  }
  const Pose2 middle = MidFeet(feet[0].Planar(), feet[1].Planar());
  EXPECT_NEAR(middle.x, 1.2, 0.03);
  EXPECT_NEAR(middle.y, 1.0, 0.03);
  EXPECT_NEAR(middle.yaw, M_PI / 2, 0.1);
}

ScriptEvent Walk(double at, double forward, double left, double yaw_rate) {
  ScriptEvent event = Event(at, "walk", "", {});
  event.velocity = {forward, left, yaw_rate};
  return event;
}

ScriptEvent Listed(double at, const std::vector<CommandedFootstep>& footsteps) {
  ScriptEvent event = Event(at, "footsteps", "", {});
  event.footsteps = footsteps;
  return event;
}

PlayedEpisode PlayScript(const std::vector<ScriptEvent>& script, double longest,
                         const Scene& scene = {}) {
  LiveConfig config = SmallWorld::Get().config;
  config.live.script = script;
  config.live.longest = longest;
  config.live.smooth_ahead = 1;  // overlaps take most of the time
  return Play(scene, config);
}

std::vector<std::string> TextsOf(const Episode& episode, const std::string& what) {
  std::vector<std::string> texts;
  for (const EpisodeEvent& event : episode.events) {
    if (event.what == what) texts.push_back(event.text);
  }
  return texts;
}

std::array<Foothold, 2> LastStance(const Episode& episode) {
  return StanceAfter(episode.Whole(episode.walks.size() - 1).sequence,
                     episode.begun.back().half_step);
}

// Each walk goes on from the one before without a jump, to the bit, of values and accelerations.
void ExpectNoJump(const Episode& episode) {
  const SuperposedWalk executed = episode.Executed();
  for (size_t k = 1; k < episode.walks.size(); ++k) {
    const double t = episode.walks[k].t;
    const SuperposedWalk before = episode.Whole(k - 1).Walk();
    const SuperposedWalk after = episode.Whole(k).Walk();
    const double at = std::min({t, before.duration(), after.duration()});
    ASSERT_EQ(before.At(at).value, after.At(at).value) << k;
    ASSERT_EQ(before.At(at).second, after.At(at).second) << k;
    ASSERT_EQ(executed.At(at).second, after.At(at).second) << k;
  }
}

// It walks through what would be its goal, never arrives, and ends at rest with its feet closed.
TEST(CommandedEpisode, WalksTurnsAndComesToRest) {
  const PlayedEpisode played =
      PlayScript({Walk(0.0, 0.05, 0, 0), Walk(9.0, 0.04, 0, 0.06), Walk(18.0, 0, 0, 0)}, 27.0);
  const Episode& episode = played.episode;
  EXPECT_EQ(episode.ending, EpisodeEnding::kEnded) << TablesText(episode);
  EXPECT_TRUE(TextsOf(episode, "stopped").empty());
  EXPECT_TRUE(TextsOf(episode, "unsafe").empty());
  EXPECT_EQ(TextsOf(episode, "commanded").size(), 3U);
  EXPECT_THAT(TextsOf(episode, "commanded").back(), "come to rest");
  const auto [left, right] = LastStance(episode);
  const Foothold X_RL = right.Inverse() * left;
  EXPECT_NEAR(X_RL.x, 0.0, 1e-9);
  EXPECT_NEAR(X_RL.yaw, 0.0, 1e-9);
  const Pose2 middle = MidFeet(left.Planar(), right.Planar());
  EXPECT_GT(middle.x, 0.3);
  EXPECT_GT(middle.yaw, 0.1);
  ExpectNoJump(episode);
}

// The way is blocked by a wall as wide as the room: it walks as far as is proved, says why, and
// goes on when the wall has gone.
TEST(CommandedEpisode, ABlockedWayIsWalkedAsFarAsIsProved) {
  Scene scene;
  scene.obstacles = {Bar("wall", 0.75, 0.0)};
  scene.obstacles[0].shape = Box{{0.02, 6.0, 1.5}};
  const PlayedEpisode played =
      PlayScript({Walk(0.0, 0.06, 0, 0), Event(16.0, "vanish", "wall", {})}, 30.0, scene);
  const Episode& episode = played.episode;
  EXPECT_FALSE(TextsOf(episode, "unsafe").empty());
  EXPECT_THAT(TextsOf(episode, "unsafe").front(), HasSubstr("the way is blocked: "));
  const auto [left, right] = LastStance(episode);
  EXPECT_GT(std::max(left.x, right.x), 0.8);
  const Approach nearest =
      NearestApproach(episode, *played.truth, SmallWorld::Get().place.robot, 0.01, 0.3);
  EXPECT_GE(nearest.distance, 0.005 - 1e-9);
  EXPECT_LT(nearest.distance, 0.2);  // it has come near
  // While it waits there the walk is not planned anew again and again.
  EXPECT_LT(std::ranges::count_if(
                episode.walks, [](const ExecutedWalk& walk) { return walk.t > 12 && walk.t < 16; }),
            4);
}

TEST(CommandedEpisode, TakesFootstepsAsTheyAreListed) {
  const double half = 0.5 * std::abs(SmallWorld::Get().start[0].y - SmallWorld::Get().start[1].y);
  const std::vector<CommandedFootstep> listed = {{Side::kLeft, {0.13, half + 0.02, 0.1}},
                                                 {Side::kRight, {0.2, -half, 0.0}},
                                                 {Side::kLeft, {0.21, half, 0.05}}};
  const PlayedEpisode played = PlayScript({Walk(0.0, 0, 0, 0), Listed(1.0, listed)}, 12.0);
  const Episode& episode = played.episode;
  EXPECT_EQ(episode.ending, EpisodeEnding::kEnded) << TablesText(episode);
  EXPECT_EQ(episode.walks.front().kind, ProposalKind::kCommanded);
  const HalfStepSequence sequence = episode.Whole(episode.walks.size() - 1).sequence;
  ASSERT_EQ(sequence.num_steps(), 3);
  for (int step = 0; step < 3; ++step) {
    const auto& [down, X_WS, rest] = Nth(sequence.half_steps, 2 * step + 1);
    const Foothold X_WF = X_WS * down.X_SF;
    EXPECT_EQ(down.swing(), Nth(listed, step).side);
    EXPECT_NEAR(X_WF.x, Nth(listed, step).X_WF.x, 1e-12);
    EXPECT_NEAR(X_WF.yaw, Nth(listed, step).X_WF.yaw, 1e-12);
  }
}

// Control of the same: with its second footstep out of reach the list is refused in words, once,
// and the robot finishes the walk that it has.
TEST(CommandedEpisode, RefusesFootstepsThatCannotBeProved) {
  const double half = 0.5 * std::abs(SmallWorld::Get().start[0].y - SmallWorld::Get().start[1].y);
  std::vector<CommandedFootstep> listed = {{Side::kLeft, {0.15, half, 0}},
                                           {Side::kRight, {1.6, -half, 0}}};
  const PlayedEpisode played = PlayScript({Walk(0.0, 0.06, 0, 0), Listed(1.0, listed)}, 20.0);
  const Episode& episode = played.episode;
  EXPECT_EQ(episode.ending, EpisodeEnding::kEnded) << TablesText(episode);
  const std::vector<std::string> refused = TextsOf(episode, "refused");
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_THAT(refused[0], HasSubstr("footstep 2 (right): "));
  EXPECT_TRUE(std::ranges::none_of(episode.walks, [](const ExecutedWalk& walk) {
    return walk.kind == ProposalKind::kCommanded;
  }));
}

// What a goal was is one again, by an event.
TEST(CommandedEpisode, AGoalEndsACourse) {
  ScriptEvent goal = Event(4.0, "goal", "", {});
  goal.goal = {0.9, 0.1};
  const PlayedEpisode played = PlayScript({Walk(0.0, 0.05, 0, 0), goal}, 40.0);
  EXPECT_EQ(played.episode.ending, EpisodeEnding::kArrived);
  EXPECT_THAT(TextsOf(played.episode, "commanded").back(), "walk to the goal");
}

// Of a long walk only its end is held: it is the same motion from then on, to the bit. What
// thinking costs does not grow, and neither does what a walk adds to the record.
TEST(CommandedEpisode, ThinkingForgetsWhatIsPast) {
  const PlayedEpisode played = PlayScript({Walk(0.0, 0.06, 0, 0)}, 75.0);
  const Episode& episode = played.episode;
  const WalkPlan plan = episode.Whole(episode.walks.size() - 1);
  const SuperposedWalk whole = plan.Walk();
  const int begun = episode.begun.back().half_step;
  ASSERT_GE(begun, 40) << "the walk is too short for this test";
  const std::optional<RecentPart> recent = RecentPart::Of(plan, whole, begun);
  ASSERT_TRUE(recent);
  const SuperposedWalk part = recent->plan.Walk();
  EXPECT_LT(part.num_half_steps(), whole.num_half_steps() - 20);
  for (int i = 2; i < part.num_half_steps(); ++i) {
    ASSERT_EQ(part.start_of(i), whole.start_of(i + recent->first));
  }
  for (double t = whole.start_of(begun); t < whole.duration(); t += 0.01) {
    ASSERT_EQ(part.At(t).value, whole.At(t).value);
    ASSERT_EQ(part.At(t).second, whole.At(t).second);
  }
  // Of each walk there is what its horizon has, not what was walked.
  for (const ExecutedWalk& walk : episode.walks) {
    EXPECT_LT(walk.tail.plan.sequence.size(), 20) << walk.t;
    EXPECT_LE(walk.tail.first, walk.first_changed);
    EXPECT_EQ(walk.tail.end(),
              episode.Whole(static_cast<size_t>(&walk - episode.walks.data())).Walk().duration());
  }
  // Counted work of the walks in the second and in the last quarter.
  const auto effort = [&](double from, double to) {
    double sum = 0.0;
    for (const ExecutedWalk& walk : episode.walks) {
      if (walk.t >= from && walk.t < to) sum += walk.effort;
    }
    return sum;
  };
  EXPECT_LE(effort(55, 75), 1.3 * effort(20, 40) + 1e-3);
  ExpectNoJump(episode);
}

// The same after more than an hour: no rest is longer than one may be.
TEST(CommandedEpisode, ThinkingForgetsHours) {
  const PlayedEpisode played = PlayScript({Walk(0.0, 0.06, 0, 0)}, 75.0);
  WalkPlan plan = played.episode.Whole(played.episode.walks.size() - 1);
  const int begun = played.episode.begun.back().half_step;
  for (const int rest : {1, 3, 5}) Nth(plan.parameters.overlaps, rest) = -0.99 * kLongestRest;
  const SuperposedWalk whole = plan.Walk();
  const std::optional<RecentPart> recent = RecentPart::Of(plan, whole, begun);
  ASSERT_TRUE(recent);
  const SuperposedWalk part = recent->plan.Walk();
  EXPECT_GT(whole.duration(), 2.9 * kLongestRest);
  EXPECT_EQ(part.duration(), whole.duration());
  const int last = part.num_half_steps() - 1;
  EXPECT_EQ(part.start_of(last), whole.start_of(recent->first + last));
}

}  // namespace
}  // namespace halfstep
