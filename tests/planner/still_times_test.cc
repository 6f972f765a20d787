#include "planner/swept/still_times.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "wpg/geometry/convex_body.h"

namespace halfstep {
namespace {

// A box that begins at the origin.
Scene WithBox(const ObstacleMotion& motion) {
  Scene scene;
  scene.obstacles.push_back(
      {.name = "box", .shape = MakeBox(Eigen::Vector3d(0.3, 0.4, 0.8)), .motion = motion});
  return scene;
}

void ExpectStill(const StillTimes& times, const std::vector<std::pair<double, double>>& wanted) {
  ASSERT_EQ(times.before_settled().size(), wanted.size());
  for (size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ(times.before_settled()[i].begin, wanted[i].first);
    EXPECT_EQ(times.before_settled()[i].end, wanted[i].second);
  }
}

TEST(StillTimes, NothingMovesWhereAllRest) {
  const StillTimes times(WithBox({.error = 0.02}), 600.0);
  EXPECT_EQ(times.settled(), 0.0);
  EXPECT_TRUE(times.settles());
  ExpectStill(times, {});
}

TEST(StillTimes, AnObstacleIsStillWhileItStaysBetweenTwoWays) {
  const StillTimes times(WithBox({.waypoints = {{.t = 2.0, .translation = {0, 0, 0}},
                                                {.t = 3.0, .translation = {1, 0, 0}},
                                                {.t = 5.0, .translation = {1, 0, 0}},
                                                {.t = 6.0, .translation = {0, 0, 0}}}}),
                         600.0);
  EXPECT_EQ(times.settled(), 6.0);
  ExpectStill(times, {{0.0, 2.0}, {3.0, 5.0}});
}

TEST(StillTimes, WholeTurnsAreMotion) {
  // In the middle, too, the box stands as it does at both ends.
  const double turns = 4.0 * std::numbers::pi;
  const StillTimes times(
      WithBox({.waypoints = {{.t = 2.0, .translation = {0, 0, 0}, .yaw = turns},
                             {.t = 4.0, .translation = {0, 0, 0}, .yaw = turns},
                             {.t = 5.0, .translation = {0, 1, 0}, .yaw = turns}}}),
      600.0);
  ExpectStill(times, {{2.0, 4.0}});
}

TEST(StillTimes, UncertaintyThatGrowsIsMotionUntilItsHorizon) {
  const StillTimes times(WithBox({.speed = 0.5, .measured_at = 3.0, .horizon = 2.0}), 600.0);
  EXPECT_EQ(times.settled(), 5.0);
  EXPECT_TRUE(times.settles());
  ExpectStill(times, {{0.0, 1.0}});
}

TEST(StillTimes, WhatMovesForeverIsKnownUntilTheLatestTimeOnly) {
  const StillTimes times(WithBox({.speed = 0.5}), 60.0);
  EXPECT_EQ(times.settled(), 60.0);
  EXPECT_FALSE(times.settles());
  ExpectStill(times, {});
}

}  // namespace
}  // namespace halfstep
