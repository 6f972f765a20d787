// Footsteps that are moved: where soles stand, what stays, and what a move bears on.

#include "smoothing/walk/footstep_families.h"

#include <gtest/gtest.h>

#include "smoothing/walk/superposed_walk.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/lipm.h"
#include "wpg/motion/moved_footsteps.h"

namespace halfstep {
namespace {

constexpr std::array<ParameterFamily, 3> kMoves = {
    ParameterFamily::kFootstepX, ParameterFamily::kFootstepY, ParameterFamily::kFootstepYaw};

// Where the soles stand when all half-steps are done, and before each of them.
std::vector<std::array<Foothold, 2>> Stances(const HalfStepSequence& sequence) {
  std::vector<std::array<Foothold, 2>> stances = {sequence.start};
  for (const auto& [half_step, X_WS, rest] : sequence.half_steps) {
    std::array<Foothold, 2> soles;
    soles[static_cast<size_t>(Index(half_step.support))] = X_WS;
    soles[static_cast<size_t>(Index(half_step.swing()))] = X_WS * half_step.X_SF;
    stances.push_back(soles);
  }
  return stances;
}

double Apart(const Pose2& a, const Pose2& b) {
  return std::max((a.position() - b.position()).norm(), std::abs(a.yaw - b.yaw));
}

TEST(MovedFootsteps, SolesStandWhereTheMovesSay) {
  WalkDraw draw(70);
  for (int i = 0; i < 100; ++i) {
    const HalfStepSequence sequence = draw.Sequence(5);
    std::vector<Pose2> moves(5);
    for (Pose2& move : moves) {
      if (draw.Uniform(0, 1) < 0.5) {
        move = {draw.Uniform(-0.1, 0.1), draw.Uniform(-0.1, 0.1), draw.Uniform(-0.3, 0.3)};
      }
    }
    const auto planned = Stances(sequence), moved = Stances(WithFootstepsMoved(sequence, moves));
    std::array<Pose2, 2> by;  // of each foot, where it stands
    for (size_t k = 0; k < sequence.half_steps.size(); ++k) {
      const size_t swing = static_cast<size_t>(Index(sequence.half_steps[k].half_step.swing()));
      if (k % 2 == 1) by[swing] = moves[k / 2];
      for (const size_t foot : {0, 1}) {
        EXPECT_LT(
            Apart(moved[k + 1][foot].LevelPose(), planned[k + 1][foot].LevelPose() * by[foot]),
            1e-13);
      }
    }
  }
}

TEST(MovedFootsteps, WhatDoesNotStandOnThemStaysToTheBit) {
  WalkDraw draw(71);
  const HalfStepSequence sequence = draw.Sequence(6);
  std::vector<Pose2> moves(6);
  moves[2] = {0.01, -0.02, 0.1};
  const HalfStepSequence moved = WithFootstepsMoved(sequence, moves);
  const std::vector<HalfStepFootsteps> on = FootstepsOf(sequence);
  for (size_t k = 0; k < 12; ++k) {
    const auto &a = sequence.half_steps[k], &b = moved.half_steps[k];
    const bool stands = on[k].support == 2 || on[k].swing == 2;
    EXPECT_EQ(stands, k >= 5 && k <= 8) << k;
    EXPECT_EQ(a.half_step == b.half_step && a.X_WS == b.X_WS, !stands) << k;
  }
  EXPECT_THROW(WithFootstepsMoved(sequence, {5, Pose2{}}), std::logic_error);
}

// A walk does not depend on how its frame lies: moves are seen from the planned footsteps.
TEST(MovedFootsteps, TurnAndMirrorWithThePlan) {
  WalkDraw draw(72);
  for (int i = 0; i < 50; ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const HomotopyParameters parameters = draw.Parameters(sequence, 0.1, 0.9);
    const Pose2 X_VW{draw.Uniform(-2, 2), draw.Uniform(-2, 2), draw.Uniform(-3, 3)};
    const SuperposedWalk walk(sequence, parameters), turned(Moved(X_VW, sequence), parameters);
    const SuperposedWalk mirrored(Mirrored(sequence), Mirrored(parameters));
    const double t = draw.Uniform(0, walk.duration());
    const WalkState x = walk.At(t).value;
    EXPECT_LT(Largest(turned.At(t).value - Transformed(Foothold::Level(X_VW), x)), 1e-12);
    EXPECT_LT(Largest(mirrored.At(t).value - Mirrored(x)), 1e-12);
  }
}

TEST(FootstepFamilies, TheLastFootstepOfEachFootStays) {
  WalkDraw draw(73);
  const HalfStepSequence sequence = draw.Sequence(5);
  ParameterChoice choice{.footsteps = true};
  choice.bound("most_footstep_y_m") = 0.02;
  const ParameterTable table(sequence, {}, choice);
  for (const ParameterFamily family : kMoves) {
    for (int step = 0; step < 5; ++step) EXPECT_EQ(table.free({family, step}), step < 3) << step;
  }
  EXPECT_EQ(table.row({ParameterFamily::kFootstepY, 1}).lower, -0.02);
  EXPECT_EQ(table.row({ParameterFamily::kFootstepY, 1}).upper, 0.02);
  const ParameterTable none(sequence, {}, {});
  EXPECT_FALSE(none.free({ParameterFamily::kFootstepX, 0}));
}

// A foot that steps twice in a row stands on footsteps for other half-steps than the families say.
TEST(FootstepFamilies, AFootThatStepsTwiceStays) {
  std::vector<Footstep> footsteps;
  for (const Side side :
       {Side::kRight, Side::kLeft, Side::kLeft, Side::kRight, Side::kLeft, Side::kRight}) {
    footsteps.push_back({.side = side, .X_WF = Foothold::Level({0.0, 0.105 * Sign(side), 0.0})});
  }
  const HalfStepSequence sequence =
      MakeSequence({Foothold::Level({0, 0.105, 0}), Foothold::Level({0, -0.105, 0})}, footsteps,
                   0.24, HalfStepShape{}, std::make_shared<Lipm>());
  const ParameterTable table(sequence, {}, {.footsteps = true});
  const std::vector<bool> free = {false, false, true, true, false, false};
  for (int step = 0; step < 6; ++step) {
    EXPECT_EQ(table.free({ParameterFamily::kFootstepX, step}), free[static_cast<size_t>(step)]);
  }
}

}  // namespace
}  // namespace halfstep
