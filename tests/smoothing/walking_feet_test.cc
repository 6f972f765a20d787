// Where the feet of a superposed walk are: on their footsteps, above the floor, one in the air.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "smoothing/walk/superposed_walk.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

TEST(WalkingFeet, FeetLandExactlyOnTheFootstepsAndStayThere) {
  WalkDraw draw(29);
  for (int i = 0; i < 200; ++i) {
    const std::vector<Footstep> footsteps = draw.Footsteps(5);
    const HalfStepSequence sequence =
        MakeSequence(StandingFeet(), footsteps, 0.24, {.shift = draw.Uniform(0.03, 0.3)},
                     std::make_shared<Lipm>());
    const HomotopyParameters parameters = draw.ExtremeParameters(sequence);
    const SuperposedWalk walk(sequence, parameters);
    std::array<Foothold, 2> feet = StandingFeet();
    for (int step = 0; step < 5; ++step) {
      const Footstep& footstep = footsteps[static_cast<size_t>(step)];
      const auto at_rest = [&](const LocalTime& at, Side side) {
        const Pose2 expected = feet[static_cast<size_t>(Index(side))].LevelPose();
        const WalkJet x = walk.At(at);
        const Pose2 foot = FootPose(x.value, side);
        EXPECT_LT((foot.position() - expected.position()).norm(), 1e-13);
        EXPECT_NEAR(foot.yaw, expected.yaw, 1e-13);
        EXPECT_NEAR(x.value[FootIndex(side) + 2], 0.0, 1e-15);
        EXPECT_LT(x.first.segment<4>(FootIndex(side)).norm(), 1e-12);
      };
      const int up = 2 * step, down = up + 1;
      const double take_off = walk.start_of(up) + walk.tracks(up).t2();
      const double landing = walk.start_of(down) + walk.tracks(down).t1();
      ASSERT_LE(take_off, landing);
      at_rest({up, walk.tracks(up).t2()}, footstep.side);
      for (int n = 0; n <= 10; ++n) {  // the support foot does not move while the other is up
        const double t = take_off + (landing - take_off) * n / 10;
        at_rest({up, t - walk.start_of(up)}, Opposite(footstep.side));
      }
      const size_t j = static_cast<size_t>(step);
      feet[static_cast<size_t>(Index(footstep.side))] =
          footstep.X_WF * Foothold::Level({parameters.footstep_xs[j], parameters.footstep_ys[j],
                                           parameters.footstep_yaws[j]});
      at_rest({down, walk.tracks(down).t1()}, footstep.side);
    }
  }
}

TEST(WalkingFeet, NoFootGoesBelowTheFloorAndAtMostOneIsInTheAir) {
  WalkDraw draw(30);
  int in_air = 0;
  for (int i = 0; i < 300; ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    for (int n = 0; n < 60; ++n) {
      const LocalTime at = walk.Locate(draw.Uniform(0, walk.duration()));
      const WalkJet x = walk.At(at);
      EXPECT_FALSE(walk.InAir(at, Side::kLeft) && walk.InAir(at, Side::kRight));
      for (Side side : {Side::kLeft, Side::kRight}) {
        const int foot = FootIndex(side);
        EXPECT_GE(x.value[foot + 2], -1e-15);
        if (walk.InAir(at, side)) {
          ++in_air;
          EXPECT_EQ(side, walk.half_step(2 * walk.StepInAir(at)).swing());
        } else {
          EXPECT_LT(std::abs(x.value[foot + 2]), 1e-15);
          EXPECT_LT(x.first.segment<4>(foot).norm(), 1e-12);
        }
      }
    }
  }
  EXPECT_GT(in_air, 2000);
}

TEST(WalkingFeet, BeyondTheUpDownBoundTheFootWouldGoUnderTheFloor) {
  // So the bound is not only enough but needed: no further overlap can be offered.
  const HalfStepSequence sequence = MakeSequence(
      StandingFeet(), {{.side = Side::kRight, .X_WF = Foothold::Level({0.2, -0.105, 0})}}, 0.24, {},
      std::make_shared<Lipm>());
  const SuperposedWalk planned(sequence, PlannedMotion(sequence));
  const double T = planned.end_of(0);
  const double overlap = Overlapped(sequence, 1.0).overlaps[0] + 0.05;
  EXPECT_THROW(SuperposedWalk(planned).SetOverlap(0, overlap), std::logic_error);
  // The superposition by hand, for a walk does not take such an overlap.
  const auto height = [&](double t) { return planned.At(t).value[kRightZ]; };
  double lowest = 0;
  for (int n = 0; n <= 1000; ++n) {
    const double t = (2 * T - overlap) * n / 1000;
    lowest = std::min(
        lowest, height(std::min(t, T)) + height(std::clamp(t + overlap, T, 2 * T)) - height(T));
  }
  EXPECT_LT(lowest, -0.01);
}

}  // namespace
}  // namespace halfstep
