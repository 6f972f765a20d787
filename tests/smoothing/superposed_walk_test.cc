#include "smoothing/walk/superposed_walk.h"
#include "smoothing/walk/footstep_families.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "opt/problem/derivative_check.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

WalkJet operator-(const WalkJet& a, const WalkJet& b) {
  return {a.value - b.value, a.first - b.first, a.second - b.second};
}

// Directions of W in a moved frame V.
WalkState Rotated(const Pose2& X_VW, const WalkState& x_W) {
  WalkState x_V = x_W;
  for (int i : {kComX, kZmpX, kLeftX, kRightX}) {
    x_V.segment<2>(i) = X_VW.rotation() * x_W.segment<2>(i);
  }
  return x_V;
}

TEST(SuperposedWalk, CoMAndZmpSatisfyTheLipmAtRandomInstants) {
  WalkDraw draw(20);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    for (int k = 0; k < 100; ++k) {
      const WalkJet x = walk.At(draw.Uniform(0, walk.duration()));
      for (int axis = 0; axis < 2; ++axis) {
        const int c = kComX + axis, p = kZmpX + axis;
        const double zmp =
            x.value[c] - x.second[c] / std::pow(dynamic_cast<const Lipm&>(walk.model()).omega(), 2);
        worst = std::max(worst, std::abs(zmp - x.value[p]));
      }
    }
  }
  EXPECT_LT(worst, 1e-12);
  RecordProperty("worst_1e18", static_cast<int>(1e18 * worst));
}

TEST(SuperposedWalk, DerivativesInTimeAgreeWithDifferences) {
  WalkDraw draw(21);
  double worst = 0;
  int checked = 0;
  for (int i = 0; i < 100; ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    for (int k = 0; k < Draws(30); ++k) {
      const double t = draw.Uniform(0, walk.duration());
      if (NearKnot(walk, t, 3e-4)) continue;
      ++checked;
      const auto function = [&](const Eigen::VectorXd& dt) -> Eigen::VectorXd {
        const WalkJet x = walk.At(t + dt[0]);
        Eigen::VectorXd both(2 * kNumQuantities);
        both << x.value, x.first;
        return both;
      };
      const WalkJet x = walk.At(t);
      Eigen::VectorXd slope(2 * kNumQuantities);
      slope << x.first, x.second;
      const auto report = CheckJacobian(function, Eigen::VectorXd::Zero(1), slope);
      worst = std::max(worst, report.worst_error);
    }
  }
  EXPECT_GT(checked, Draws(2000));
  EXPECT_LT(worst, 1e-8);
  RecordProperty("worst_1e15", static_cast<int>(1e15 * worst));
}

TEST(SuperposedWalk, BeginsAndEndsAtRest) {
  WalkDraw draw(22);
  for (int i = 0; i < 300; ++i) {
    const HalfStepSequence sequence = draw.Sequence(3);
    const HomotopyParameters parameters = draw.ExtremeParameters(sequence);
    const SuperposedWalk walk(sequence, parameters);
    const HalfStepSequence placed = WithFootsteps(sequence, parameters);
    const PlacedHalfStep &first = placed.half_steps.front(), &last = placed.half_steps.back();
    const WalkState from = Transformed(first.X_WS, first.half_step.Start());
    const WalkState to = Transformed(last.X_WS, last.half_step.End());
    for (double inside : {0.0, 1e-9}) {
      for (const auto& [t, x] : {std::pair{inside, from}, {walk.duration() - inside, to}}) {
        const WalkJet jet = walk.At(t);
        EXPECT_LT(Largest(jet.value - x), 1e-12);
        EXPECT_LT((jet.value.segment<2>(kComX) - jet.value.segment<2>(kZmpX)).norm(), 1e-12);
        EXPECT_LT(Largest(jet.first), 1e-12);
      }
    }
    // Times outside are clamped to the walk.
    EXPECT_LT(Largest(walk.At(-1.0).value - from), 1e-14);
    EXPECT_LT(Largest(walk.At(walk.duration() + 1).value - to), 1e-14);
  }
}

TEST(SuperposedWalk, IsC1EverywhereAndZmpC2) {
  WalkDraw draw(23);
  for (int i = 0; i < 100; ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    const double e = 1e-9;
    for (double t : Knots(walk)) {
      const WalkJet before = walk.At(t - e), after = walk.At(t + e);
      const double second = std::max(Largest(before.second), Largest(after.second));
      EXPECT_LT(Largest(after.value - before.value - 2 * e * before.first), 1e-13);
      EXPECT_LT(Largest(after.first - before.first), 1e-13 + 3 * e * second);
      // Third derivatives are at most 60·(length/(0.03·0.8 s)³).
      EXPECT_LT(Largest(after.second - before.second), 2 * e * 60 * 0.5 / std::pow(0.024, 3));
    }
  }
}

TEST(SuperposedWalk, WithoutOverlapItIsTheConcatenationOfIsolatedHalfSteps) {
  WalkDraw draw(24);
  for (int i = 0; i < 50; ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const SuperposedWalk walk(sequence, PlannedMotion(sequence));
    double start = 0;
    for (int k = 0; k < sequence.size(); ++k) {
      const auto& [h, X_WS, rest] = sequence.half_steps[static_cast<size_t>(k)];
      const HalfStepTracks tracks(h, *sequence.model);
      EXPECT_NEAR(walk.start_of(k), start, 1e-13);
      for (int n = 0; n < 20; ++n) {
        const double tau = n == 0 ? 0 : n == 1 ? h.duration : draw.Uniform(0, h.duration);
        const WalkJet isolated = tracks.At(tau), x = walk.At({k, tau});
        EXPECT_LT(Largest(x.value - Transformed(X_WS, isolated.value)), 4e-15);
        // The seams are where they are to 1e-15 s: third derivatives times that.
        EXPECT_LT(Largest(x.first - Rotated(X_WS.Planar(), isolated.first)), 1e-13);
        EXPECT_LT(Largest(x.second - Rotated(X_WS.Planar(), isolated.second)), 1e-11);
      }
      start += h.duration;
    }
    EXPECT_NEAR(walk.duration(), start, 1e-13);
  }
}

// At rest, with all of it from half-steps that end: the waist is over the lower sole with both feet
// standing, and over the support sole at the via point.
TEST(SuperposedWalk, TheWaistStandsOverTheLowerSole) {
  WalkDraw draw(31, 0.15);
  for (int i = 0; i < Draws(100); ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    HomotopyParameters parameters = draw.Parameters(sequence, 0.0, 0.0);
    const SuperposedWalk walk(sequence, parameters);
    for (int k = 0; k < walk.num_half_steps(); ++k) {
      const HalfStep& half_step = walk.half_step(k);
      const WalkState end = walk.At(walk.end_of(k)).value;
      const double left = end[kLeftZ], right = end[kRightZ], crouch = half_step.shape.crouch;
      const double support = half_step.support == Side::kLeft ? left : right;
      const bool up = half_step.kind == HalfStepKind::kUp;
      EXPECT_NEAR(support, walk.X_WS(k).height, 1e-14);
      EXPECT_NEAR(end[kWaistZ], (up ? support : std::min(left, right)) - crouch, 1e-14);
      const double swing = half_step.swing() == Side::kLeft ? left : right;
      EXPECT_NEAR(swing - support, up ? half_step.via_height : half_step.X_SF.height, 1e-14);
      // It moves only where the swing foot stands lower.
      const double begins = walk.At(walk.start_of(k)).value[kWaistZ];
      if (half_step.X_SF.height >= 0.0) {
        EXPECT_NEAR(begins, end[kWaistZ], 1e-14);
      }
    }
  }
}

TEST(SuperposedWalk, RefusesAViaPointBelowAFootstep) {
  const auto sequence = [](double via_height) {
    const Foothold tread{Pose2{0.2, -0.105, 0}, 0.1};
    return MakeSequence(StandingFeet(),
                        {{.side = Side::kRight, .X_WF = tread, .via_height = via_height}}, 0.24, {},
                        std::make_shared<Lipm>());
  };
  HomotopyParameters parameters = PlannedMotion(sequence(0.2));
  EXPECT_NO_THROW(SuperposedWalk(sequence(0.2), parameters));
  EXPECT_THROW(SuperposedWalk(sequence(0.099), PlannedMotion(sequence(0.099))), std::logic_error);
  parameters.height_scales[0] = 0.499;
  EXPECT_THROW(SuperposedWalk(sequence(0.2), parameters), std::logic_error);
  EXPECT_EQ(ParameterTable(sequence(0.2), {}, EveryFamily())
                .row({ParameterFamily::kHeightScale, 0})
                .lower,
            0.5);
}

TEST(SuperposedWalk, WithoutOverlapOnASupportSoleAtTheOriginItIsTheHalfStepBitForBit) {
  WalkDraw draw(25);
  for (int i = 0; i < 100; ++i) {
    const std::array<Foothold, 2> start = {Foothold::Level({}), Foothold::Level({0, -0.21, 0})};
    const Foothold X_WF = Foothold::Level(
        {draw.Uniform(-0.1, 0.2), draw.Uniform(-0.3, -0.2), draw.Uniform(-0.3, 0.3)});
    const HalfStepSequence sequence = MakeSequence(start, {{.side = Side::kRight, .X_WF = X_WF}},
                                                   0.24, {}, std::make_shared<Lipm>());
    const SuperposedWalk walk(sequence, PlannedMotion(sequence));
    for (int k = 0; k < 2; ++k) {
      const HalfStep& h = sequence.half_steps[static_cast<size_t>(k)].half_step;
      const HalfStepTracks tracks(h, *sequence.model);
      for (int n = 0; n <= 20; ++n) {
        const double tau = h.duration * n / 20;
        const WalkJet isolated = tracks.At(tau), x = walk.At({k, tau});
        EXPECT_EQ(x.value, isolated.value);
        EXPECT_EQ(x.first, isolated.first);
        EXPECT_EQ(x.second, isolated.second);
      }
    }
  }
}

TEST(SuperposedWalk, StartsEndsAndDurationFollowTheFormulaInOrder) {
  WalkDraw draw(26);
  for (int i = 0; i < 200; ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const HomotopyParameters p = draw.ExtremeParameters(sequence);
    const SuperposedWalk walk(sequence, p);
    double start = 0;
    for (int k = 0; k < sequence.size(); ++k) {
      const size_t s = static_cast<size_t>(k);
      EXPECT_NEAR(walk.start_of(k), start, 1e-13);
      EXPECT_NEAR(walk.end_of(k), start + p.durations[s], 1e-13);
      if (k > 0) {
        EXPECT_GE(walk.start_of(k), walk.start_of(k - 1) - 1e-13);
        EXPECT_GE(walk.end_of(k), walk.end_of(k - 1) - 1e-13);
      }
      if (k + 1 < sequence.size()) start += p.durations[s] - p.overlaps[s];
    }
    EXPECT_NEAR(walk.duration(), start + p.durations.back(), 1e-13);
  }
}

// The sum of the definition, over all half-steps whether under way or not.
TEST(SuperposedWalk, IsTheSumOverAllHalfSteps) {
  WalkDraw draw(27);
  for (int i = 0; i < 100; ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const HomotopyParameters parameters = draw.ExtremeParameters(sequence);
    const SuperposedWalk walk(sequence, parameters);
    const HalfStepSequence placed = WithFootsteps(sequence, parameters);
    for (int n = 0; n < 30; ++n) {
      const double t = draw.Uniform(0, walk.duration());
      WalkJet sum;
      for (int k = 0; k < sequence.size(); ++k) {
        auto [h, X_WS, rest] = placed.half_steps[static_cast<size_t>(k)];
        h.duration = parameters.durations[static_cast<size_t>(k)];
        h.via_height *= parameters.height_scales[static_cast<size_t>(k / 2)];
        h.shape.support_point = parameters.support_points[static_cast<size_t>(k / 2)];
        h.via_lateral = parameters.of(ParameterFamily::kViaLateral)[static_cast<size_t>(k / 2)];
        h.shape.foot_ramp = parameters.of(ParameterFamily::kFootRamp)[static_cast<size_t>(k)];
        h.shape.foot_delay = parameters.of(ParameterFamily::kFootDelay)[static_cast<size_t>(k)];
        h.shape.lift_share = parameters.of(ParameterFamily::kLiftShare)[static_cast<size_t>(k)];
        h.via_along = parameters.of(ParameterFamily::kViaAlong)[static_cast<size_t>(k / 2)];
        h.shape.shift = parameters.zmp_shifts[static_cast<size_t>(k)];
        h.shape.bump_ramp = parameters.of(ParameterFamily::kZmpBumpRamp)[static_cast<size_t>(k)];
        const HalfStepTracks tracks(h, *sequence.model);
        const WalkJet own = tracks.At(t - walk.start_of(k));
        const WalkState from = Transformed(X_WS, h.Start());
        if (k == 0) sum.value = from;
        sum.value += Transformed(X_WS, own.value) - from;
        sum.first += Rotated(X_WS.Planar(), own.first);
        sum.second += Rotated(X_WS.Planar(), own.second);
      }
      EXPECT_LT(Largest(walk.At(t).value - sum.value), 1e-13);
      EXPECT_LT(Largest(walk.At(t).first - sum.first), 1e-11);
      EXPECT_LT(Largest(walk.At(t).second - sum.second), 1e-9);
    }
  }
}

TEST(SuperposedWalk, AllNamesOfAnInstantGiveTheSameWalk) {
  WalkDraw draw(28);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    for (int n = 0; n < 30; ++n) {
      const double t = draw.Uniform(0, walk.duration());
      const LocalTime located = walk.Locate(t);
      EXPECT_GE(located.tau, 0.0);
      EXPECT_NEAR(walk.Absolute(located), t, 1e-13);
      if (located.half_step + 1 < walk.num_half_steps()) {
        EXPECT_LT(t, walk.start_of(located.half_step + 1));
      }
      const WalkJet x = walk.At(located);
      const double scale = 1 + 1e-2 * Largest(x.first) + 1e-4 * Largest(x.second);
      const bool near_knot = NearKnot(walk, t, 1e-12);
      for (int k = 0; k < walk.num_half_steps(); ++k) {
        const LocalTime named{k, t - walk.start_of(k)};
        const WalkJet y = walk.At(named);
        worst = std::max(worst, Largest(x.value - y.value) / scale);
        EXPECT_LT(Largest(x - y), 1e-12 * (1 + 100 * Largest(x)));
        if (near_knot) continue;
        EXPECT_EQ(walk.StepInAir(located), walk.StepInAir(named));
        for (Side side : {Side::kLeft, Side::kRight}) {
          EXPECT_EQ(walk.InAir(located, side), walk.InAir(named, side));
        }
      }
    }
  }
  EXPECT_LT(worst, 1e-13);
}

TEST(SuperposedWalk, MirroredAndMovedSequencesWalkMirroredAndMoved) {
  WalkDraw draw(33);
  for (int i = 0; i < 100; ++i) {
    const HalfStepSequence sequence = draw.Sequence(4);
    const HomotopyParameters parameters = draw.ExtremeParameters(sequence);
    const Pose2 X_VW = draw.Pose(2, 3);
    const SuperposedWalk walk(sequence, parameters);
    const SuperposedWalk mirrored(Mirrored(sequence), Mirrored(parameters));
    const SuperposedWalk moved(Moved(X_VW, sequence), parameters);
    EXPECT_EQ(walk.duration(), mirrored.duration());
    EXPECT_EQ(walk.duration(), moved.duration());
    for (int n = 0; n < 30; ++n) {
      const double t = draw.Uniform(0, walk.duration());
      const WalkJet x = walk.At(t), m = mirrored.At(t), v = moved.At(t);
      EXPECT_EQ(m.value, Mirrored(x.value));
      EXPECT_EQ(m.first, Mirrored(x.first));
      EXPECT_EQ(m.second, Mirrored(x.second));
      EXPECT_LT(Largest(v.value - Transformed(Foothold::Level(X_VW), x.value)), 1e-14);
      EXPECT_LT(Largest(v.first - Rotated(X_VW, x.first)), 1e-13);
      EXPECT_LT(Largest(v.second - Rotated(X_VW, x.second)), 1e-14 * (100 + Largest(x.second)));
    }
  }
}

TEST(SuperposedWalk, RefusesParametersOutOfBounds) {
  const HalfStepSequence sequence = WalkDraw(34).Sequence(2);
  HomotopyParameters parameters = Overlapped(sequence, 1.0);
  parameters.overlaps[1] += 1e-6;
  EXPECT_THROW(SuperposedWalk(sequence, parameters), std::logic_error);
}

// By absolute times, as the header defines them.
TEST(SuperposedWalk, FeetAreInTheAirAndMoveHorizontallyWhenTheHalfStepsSaySo) {
  WalkDraw draw(71);
  int in_air = 0, horizontal = 0;
  for (int i = 0; i < Draws(200); ++i) {
    const HalfStepSequence sequence = draw.Sequence(3);
    const SuperposedWalk walk(sequence, draw.ExtremeParameters(sequence));
    for (int k = 0; k < 20; ++k) {
      const double t = draw.Uniform(0, walk.duration());
      if (NearKnot(walk, t, 1e-6)) continue;
      const LocalTime at = walk.Locate(t);
      int step_in_air = -1;
      for (int step = 0; step < 3; ++step) {
        const int up = 2 * step, down = up + 1;
        const HalfStepTracks &u = walk.tracks(up), &d = walk.tracks(down);
        const double up_begin = walk.start_of(up), down_begin = walk.start_of(down);
        if (t > up_begin + u.t2() && t < down_begin + d.t1()) step_in_air = step;
        const double from = std::min(up_begin + u.horizontal_begin(), down_begin);
        const double to = std::max(down_begin + d.horizontal_end(), walk.end_of(up));
        EXPECT_EQ(walk.MovesHorizontally(step, at), t > from && t < to);
        horizontal += t > from && t < to;
      }
      EXPECT_EQ(walk.StepInAir(at), step_in_air);
      for (Side foot : {Side::kLeft, Side::kRight}) {
        EXPECT_EQ(walk.InAir(at, foot),
                  step_in_air >= 0 && walk.half_step(2 * step_in_air).swing() == foot);
      }
      in_air += step_in_air >= 0;
      // One sole carries while a foot is in the air: the ZMP's margin is that of its rectangle.
      const Eigen::Vector2d size(0.2, 0.1);
      const WalkState x = walk.At(at).value;
      const SupportPolygon polygon = SupportAt(walk, at, x, size);
      const SupportPolygon expected =
          step_in_air >= 0
              ? SupportPolygon(walk.X_WS(2 * step_in_air).Planar(), size)
              : SupportPolygon(FootPose(x, Side::kLeft), FootPose(x, Side::kRight), size);
      const Eigen::Vector2d p = x.segment<2>(kZmpX);
      EXPECT_EQ(polygon.Margin(p), expected.Margin(p));
    }
  }
  EXPECT_GT(in_air, Draws(200));
  EXPECT_GT(horizontal, Draws(200));
}

}  // namespace
}  // namespace halfstep
