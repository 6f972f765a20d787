#include "planner/swept/obstacle_times.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/planner/swept_volume_draws.h"

namespace halfstep {
namespace {

// A box that crosses from y = −2 to 2 m within six seconds, then a turn.
Scene CrossingBox(double x) {
  Obstacle box{.name = "box", .shape = MakeBox(Eigen::Vector3d(0.3, 0.4, 0.8))};
  box.X_WO.translation() << x, -2.0, 0.4;
  box.motion.waypoints = {{.t = 6.0, .translation = {x, 2.0, 0.4}},
                          {.t = 7.0, .translation = {x, 2.0, 0.4}, .yaw = 1.5}};
  box.motion.error = 0.01;
  Scene scene;
  scene.obstacles.push_back(box);
  return scene;
}

// The least margin of the robot to the box at local time τ of a half-step that began at `start`.
double MarginAt(const RobotModel& robot, const CollisionWorld& world, const HalfStepTracks& tracks,
                double start, double tau) {
  const Posture posture = SolvePosture(robot, tracks.At(tau).value);
  double least = 1.0;
  for (const RobotBody& body : robot.bodies) {
    least = std::min(
        least, world.FindNearest(CollisionShape(body.shape), posture.OfBody(body), start + tau, 1.0)
                   .margin);
  }
  return least;
}

TEST(ObstacleTimes, WhatIsCalledFreeKeepsTheClearanceAndAHalfSecondBesideItDoesNot) {
  const RobotModel& robot = SweptRobot();
  const StepSet set = FewHalfSteps();
  const auto model = std::make_shared<Lipm>(robot.com_height);
  const double clearance = 0.005, T = set.prototype.duration;
  SweptDraw draw(5);
  int looked_at = 0, touched = 0, finite = 0;
  for (int place = 0; place < 12; ++place) {
    const Scene scene = CrossingBox(draw.Uniform(0.2, 0.6));
    const CollisionWorld world(scene);
    const ObstacleTimes times(robot, model, set, scene, clearance);
    const Side support = draw.AnySide();
    const int i = draw.Index(set.size());
    const Foothold X_WS = Foothold::Level(draw.Floor(0.2));
    const Foothold X_WF = X_WS * set.Placement(i, support);
    const TimeIntervals starts = place % 2 == 0 ? times.DownStarts(i, support, X_WS, X_WF, {})
                                                : times.UpStarts(i, support, X_WS, X_WF, {});
    const HalfStepTracks tracks = place % 2 == 0
                                      ? HalfStepTracks(set.Down(i, support), *model, X_WS)
                                      : HalfStepTracks(set.Up(i, support), *model, X_WF);
    ASSERT_FALSE(starts.empty());
    EXPECT_TRUE(std::isinf(starts.back().end));
    for (const TimeInterval& one : starts) {
      finite += std::isfinite(one.end);
      for (int sample = 0; sample < 20; ++sample) {
        const double end = std::min(one.end, one.begin + 3.0);
        const double start = sample == 0   ? one.begin
                             : sample == 1 ? end
                                           : draw.Uniform(one.begin, end);
        EXPECT_GE(MarginAt(robot, world, tracks, start, draw.Uniform(0, T)), clearance);
        ++looked_at;
      }
      // Control: half a second before it begins to be free.
      if (one.begin < 0.5) continue;
      double least = 1.0;
      for (double tau = 0.0; tau <= T; tau += T / 40) {
        least = std::min(least, MarginAt(robot, world, tracks, one.begin - 0.5, tau));
      }
      touched += least < clearance;
    }
  }
  EXPECT_GT(looked_at, 200);
  EXPECT_GT(finite, 5);
  EXPECT_GT(touched, 5);
}

// What of `all` lies within `within`; intervals that meet are one.
TimeIntervals Within(const TimeIntervals& all, const TimeInterval& within) {
  TimeIntervals cut;
  for (const TimeInterval& one : all) {
    const TimeInterval common = Common(one, within);
    if (common.begin > common.end) continue;
    if (!cut.empty() && cut.back().end == common.begin) {
      cut.back().end = common.end;
    } else {
      cut.push_back(common);
    }
  }
  return cut;
}

TEST(ObstacleTimes, AnswersAboutSomeTimesAreThoseAboutAllWhateverWasAskedBefore) {
  const RobotModel& robot = SweptRobot();
  const StepSet set = FewHalfSteps();
  const auto model = std::make_shared<Lipm>(robot.com_height);
  SweptDraw draw(11);
  int finite = 0, cheaper = 0;
  for (int place = 0; place < 6; ++place) {
    const Scene scene = CrossingBox(draw.Uniform(0.2, 0.6));
    const ObstacleTimes at_once(robot, model, set, scene, 0.005);
    const ObstacleTimes by_parts(robot, model, set, scene, 0.005);
    const Side support = draw.AnySide();
    const int i = draw.Index(set.size());
    const Foothold X_WS = Foothold::Level(draw.Floor(0.2));
    const Foothold X_WF = X_WS * set.Placement(i, support);
    const auto ask = [&](const ObstacleTimes& times, int what, const TimeInterval& within) {
      if (what == 0) return times.DownStarts(i, support, X_WS, X_WF, within);
      if (what == 1) return times.UpStarts(i, support, X_WS, X_WF, within);
      if (what == 2) return times.OnBothFeet(i, support, X_WS, X_WF, within);
      return times.OnOneFoot(support, X_WS, within);
    };
    for (int what = 0; what < 4; ++what) {
      const TimeIntervals all = ask(at_once, what, {});
      for (int question = 0; question < 8; ++question) {
        const double begin = draw.Uniform(0.0, 9.0);
        const TimeInterval within{begin, question == 3 ? INFINITY : begin + draw.Uniform(0.0, 2.0)};
        const TimeIntervals told = Within(ask(by_parts, what, within), within);
        const TimeIntervals expected = Within(all, within);
        ASSERT_EQ(told.size(), expected.size()) << what << ' ' << question;
        for (size_t j = 0; j < told.size(); ++j) {
          EXPECT_EQ(told[j].begin, expected[j].begin);
          EXPECT_EQ(told[j].end, expected[j].end);
          finite += std::isfinite(told[j].end);
        }
        if (question == 0) cheaper += by_parts.effort() < at_once.effort();
      }
    }
  }
  EXPECT_GT(finite, 50);
  EXPECT_GT(cheaper, 20);
}

}  // namespace
}  // namespace halfstep
