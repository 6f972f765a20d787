#include "wpg/motion/half_step_sequence.h"
#include "wpg/motion/lipm.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "tests/wpg/sequence_draw.h"
#include "wpg/motion/half_step_tracks.h"
#include "wpg/motion/walk_state.h"

namespace halfstep {
namespace {

WalkState StartInW(const PlacedHalfStep& p) { return Transformed(p.X_WS, p.half_step.Start()); }
WalkState EndInW(const PlacedHalfStep& p) { return Transformed(p.X_WS, p.half_step.End()); }
double Difference(const WalkState& a, const WalkState& b) { return (a - b).cwiseAbs().maxCoeff(); }

// The waist comes to another height in up half-steps, and nowhere else.
TEST(MakeSequence, TheWaistChangesItsHeightAsFootstepsSay) {
  const auto at = [](Side side, double x, double height, std::optional<double> crouch) {
    return Footstep{.side = side,
                    .X_WF = {{x, side == Side::kLeft ? 0.1 : -0.1, 0.0}, height},
                    .crouch = crouch};
  };
  const HalfStepSequence s =
      MakeSequence(StandingFeet(),
                   {at(Side::kRight, 0.1, 0.0, 0.15), at(Side::kLeft, 0.2, 0.0, 0.15),
                    at(Side::kRight, 0.3, -0.05, 0.02), at(Side::kLeft, 0.4, -0.05, {})},
                   0.22, {.crouch = 0.01}, std::make_shared<Lipm>(0.8));
  const std::vector<double> ends = {-0.15, -0.15, -0.15, -0.15, -0.02, -0.07, -0.06, -0.06};
  for (size_t i = 0; i < ends.size(); ++i) {
    EXPECT_DOUBLE_EQ(EndInW(s.half_steps[i])[kWaistZ], ends[i]) << i;
    const WalkState begin = StartInW(s.half_steps[i]);
    EXPECT_DOUBLE_EQ(begin[kWaistZ], i == 0 ? -0.01 : ends[i - 1]) << i;
    if (i > 0) {
      EXPECT_LT(Difference(begin, EndInW(s.half_steps[i - 1])), 1e-14) << i;
    }
    const HalfStepTracks tracks(s.half_steps[i].half_step, *s.model, s.half_steps[i].X_WS);
    EXPECT_EQ(tracks.waist_rises(), begin[kWaistZ] != EndInW(s.half_steps[i])[kWaistZ]) << i;
  }
  EXPECT_TRUE(ChangesCrouch(s));
  EXPECT_FALSE(ChangesCrouch(MakeSequence(StandingFeet(), {at(Side::kRight, 0.1, -0.05, {})}, 0.22,
                                          {.crouch = 0.01}, std::make_shared<Lipm>(0.8))));
}

TEST(MakeSequence, OneStepByHand) {
  const HalfStepSequence s =
      MakeSequence(StandingFeet(),
                   {{.side = Side::kRight,
                     .X_WF = Foothold::Level({0.2, -0.125, 0.1}),
                     .via_height = 0.2,
                     .duration = 1.7}},
                   0.22, {.shift = 0.06, .foot_delay = 0.12}, std::make_shared<Lipm>(0.7));
  ASSERT_EQ(s.size(), 2);
  EXPECT_EQ(s.num_steps(), 1);
  EXPECT_EQ(s.num_junctions(), 1);
  EXPECT_EQ(dynamic_cast<const Lipm&>(*s.model).com_height(), 0.7);
  for (const PlacedHalfStep& placed : s.half_steps) {
    const HalfStep& h = placed.half_step;
    EXPECT_EQ(placed.X_WS, Foothold::Level({0, 0.105, 0}));
    EXPECT_EQ(h.support, Side::kLeft);
    EXPECT_EQ(h.duration, 1.7);
    EXPECT_EQ(h.via_height, 0.2);
    EXPECT_EQ(h.via_lateral, 0.22);
    EXPECT_EQ(h.shape, (HalfStepShape{.shift = 0.06, .foot_delay = 0.12}));
  }
  EXPECT_EQ(s.half_steps[0].half_step.kind, HalfStepKind::kUp);
  EXPECT_EQ(s.half_steps[1].half_step.kind, HalfStepKind::kDown);
  EXPECT_EQ(s.half_steps[0].half_step.X_SF, Foothold::Level({0, -0.21, 0}));
  EXPECT_NEAR(s.half_steps[1].half_step.X_SF.y, -0.23, 1e-15);
  EXPECT_NEAR(s.half_steps[1].half_step.X_SF.x, 0.2, 1e-15);
  EXPECT_EQ(s.half_steps[1].half_step.X_SF.yaw, 0.1);
}

TEST(MakeSequence, EachHalfStepBeginsWhereTheOneBeforeEnds) {
  SequenceDraw draw(5);
  for (int i = 0; i < 50; ++i) {
    const std::vector<Footstep> footsteps = draw.Footsteps(6);
    const HalfStepSequence s =
        MakeSequence(StandingFeet(), footsteps, 0.24, {}, std::make_shared<Lipm>());
    ASSERT_EQ(s.size(), 12);
    std::array<Foothold, 2> feet = StandingFeet();
    for (int k = 0; k < s.size(); ++k) {
      const PlacedHalfStep& now = s.half_steps[static_cast<size_t>(k)];
      EXPECT_EQ(now.half_step.kind, k % 2 == 0 ? HalfStepKind::kUp : HalfStepKind::kDown);
      if (k > 0) {
        const PlacedHalfStep& before = s.half_steps[static_cast<size_t>(k - 1)];
        EXPECT_LT(Difference(EndInW(before), StartInW(now)), 2e-15);
      }
      if (k % 2 == 1) {
        const Footstep& footstep = footsteps[static_cast<size_t>(k / 2)];
        feet[static_cast<size_t>(Index(footstep.side))] = footstep.X_WF;
        const WalkState end = EndInW(now);
        for (Side side : {Side::kLeft, Side::kRight}) {
          const Pose2 foot = FootPose(end, side);
          const Pose2 expected = feet[static_cast<size_t>(Index(side))].LevelPose();
          EXPECT_NEAR(foot.x, expected.x, 1e-15);
          EXPECT_NEAR(foot.y, expected.y, 1e-15);
          EXPECT_NEAR(foot.yaw, expected.yaw, 1e-15);
        }
        const Pose2 left = feet[0].LevelPose(), right = feet[1].LevelPose();
        EXPECT_NEAR(end[kComX], 0.5 * (left.x + right.x), 1e-15);
        EXPECT_NEAR(end[kWaistYaw], 0.5 * (left.yaw + right.yaw), 1e-15);
      }
    }
  }
}

TEST(MakeSequence, YawKeepsItsTurns) {
  // A foot that has turned by more than a full turn: the waist must not turn back.
  const std::array<Foothold, 2> start = {Foothold::Level({0, 0.105, 6.4}),
                                         Foothold::Level({0, -0.105, 6.4})};
  const HalfStepSequence s =
      MakeSequence(start, {{.side = Side::kLeft, .X_WF = Foothold::Level({0, 0.105, 6.6})}}, 0.24,
                   {}, std::make_shared<Lipm>());
  EXPECT_NEAR(EndInW(s.half_steps[1])[kWaistYaw], 6.5, 1e-14);
}

TEST(MakeSequence, CarriesTheHeightsOfFootholds) {
  const HalfStepSequence s =
      MakeSequence(StandingFeet(),
                   {{.side = Side::kRight, .X_WF = {Pose2{0.2, -0.105, 0}, 0.15}},
                    {.side = Side::kLeft, .X_WF = {Pose2{0.4, 0.105, 0}, 0.25}}},
                   0.24, {}, std::make_shared<Lipm>());
  const std::array<double, 4> support = {0.0, 0.0, 0.15, 0.15}, swing = {0.0, 0.15, 0.0, 0.25};
  for (size_t k = 0; k < 4; ++k) {
    const PlacedHalfStep& placed = s.half_steps[k];
    EXPECT_EQ(placed.X_WS.height, support[k]);
    EXPECT_EQ(placed.half_step.X_SF.height, swing[k] - support[k]);
    const WalkState x = k % 2 == 0 ? StartInW(placed) : EndInW(placed);
    EXPECT_EQ(x[FootIndex(placed.half_step.support) + 2], support[k]);
    EXPECT_DOUBLE_EQ(x[FootIndex(placed.half_step.swing()) + 2], swing[k]);
  }
}

TEST(MakeSequence, RefusesNoFootsteps) {
  EXPECT_THROW(MakeSequence(StandingFeet(), {}, 0.24, {}, std::make_shared<Lipm>()),
               std::logic_error);
}

TEST(SequenceSymmetry, MirroredAndMovedAreWhatTheMirroredAndMovedFootstepsGive) {
  SequenceDraw draw(6);
  for (int i = 0; i < 50; ++i) {
    std::vector<Footstep> footsteps = draw.Footsteps(4), mirrored = footsteps, moved = footsteps;
    const Pose2 X_VW = draw.Pose(3, 3);
    for (size_t k = 0; k < footsteps.size(); ++k) {
      mirrored[k].side = Opposite(footsteps[k].side);
      mirrored[k].X_WF = footsteps[k].X_WF.Mirrored();
      moved[k].X_WF = Foothold::Level(X_VW) * footsteps[k].X_WF;
    }
    const auto feet = StandingFeet();
    const HalfStepSequence plain =
        MakeSequence(feet, footsteps, 0.24, {}, std::make_shared<Lipm>());
    const std::array<Foothold, 2> feet_m = {feet[1].Mirrored(), feet[0].Mirrored()};
    const std::array<Foothold, 2> feet_v = {Foothold::Level(X_VW) * feet[0],
                                            Foothold::Level(X_VW) * feet[1]};
    for (const auto& [a, b] :
         {std::pair{Mirrored(plain),
                    MakeSequence(feet_m, mirrored, 0.24, {}, std::make_shared<Lipm>())},
          std::pair{Moved(X_VW, plain),
                    MakeSequence(feet_v, moved, 0.24, {}, std::make_shared<Lipm>())}}) {
      ASSERT_EQ(a.size(), b.size());
      for (size_t k = 0; k < a.half_steps.size(); ++k) {
        EXPECT_EQ(a.half_steps[k].half_step.support, b.half_steps[k].half_step.support);
        EXPECT_LT(Difference(StartInW(a.half_steps[k]), StartInW(b.half_steps[k])), 1e-14);
        EXPECT_LT(Difference(EndInW(a.half_steps[k]), EndInW(b.half_steps[k])), 1e-14);
      }
      for (size_t f = 0; f < 2; ++f) {
        EXPECT_LT((a.start[f].Planar().position() - b.start[f].Planar().position()).norm(), 1e-15);
      }
    }
  }
}

}  // namespace
}  // namespace halfstep
