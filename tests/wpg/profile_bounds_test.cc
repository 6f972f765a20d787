#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "wpg/motion/half_step_tracks.h"
#include "wpg/motion/lipm.h"
#include "wpg/motion/rest_to_rest.h"
#include "wpg/motion/smoothstep.h"

namespace halfstep {
namespace {

double Uniform(std::mt19937& random, double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(random);
}

// A window of σ that may reach beyond [0, 1], from 10⁻⁴ long.
struct Window {
  explicit Window(std::mt19937& random)
      : from(Uniform(random, -0.2, 1.1)), to(from + std::pow(10.0, Uniform(random, -4, 0))) {}
  double from, to;
  template <typename Function>
  double Sup(const Function& f) const {
    constexpr int kInstants = 200;
    double sup = 0.0;
    for (int i = 0; i <= kInstants; ++i) {
      sup = std::max(sup, std::abs(f(from + (to - from) * i / kInstants)));
    }
    return sup;
  }
};

TEST(ProfileBounds, SmoothstepSecondIsExact) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const Window window(random);
    const double begin = Uniform(random, -0.1, 0.8);
    const Smoothstep step{begin, begin + Uniform(random, 0.05, 1.0)};
    const double sup = window.Sup([&](double x) { return step.At(x).ss; });
    const double bound = step.SecondBound(window.from, window.to);
    const double scale = 6.0 / ((step.end - step.begin) * (step.end - step.begin));
    ASSERT_LE(sup, bound + 1e-13 * scale) << window.from << " " << window.to;
    ASSERT_LE(bound, sup + 0.01 * scale);  // 200 instants miss the extremum by no more
  }
}

TEST(ProfileBounds, SmoothstepSecondOfOneInstant) {
  const Smoothstep step{0.2, 0.9};
  for (double x = 0.0; x <= 1.0; x += 0.0625) {
    EXPECT_GE(step.SecondBound(x, x), std::abs(step.At(x).ss) * (1 - 1e-14)) << x;
  }
}

TEST(ProfileBounds, RampedStepIsASmoothstepAtHalfAndItsBoundsAreExact) {
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    const Window window(random);
    const double begin = Uniform(random, -0.1, 0.8);
    const RampedStep step{begin, begin + Uniform(random, 0.05, 1.0), Uniform(random, 0.1, 0.5)};
    const double width = step.end - step.begin;
    const double scale = 6.0 / (width * width * step.ramp);
    const double sup = window.Sup([&](double x) { return step.At(x).ss; });
    const double bound = step.SecondBound(window.from, window.to);
    ASSERT_LE(sup, bound + 1e-13 * scale) << window.from << " " << window.to;
    ASSERT_LE(bound, sup + 0.02 * scale);
    const Range third = step.ThirdRange(window.from, window.to);
    const double sharp = 60.0 / (width * width * width * step.ramp * step.ramp);
    double low = 1e300, high = -1e300;
    for (int k = 0; k <= 400; ++k) {
      const double x = step.At(window.from + (window.to - window.from) * k / 400).sss;
      low = std::min(low, x);
      high = std::max(high, x);
    }
    ASSERT_GE(low, third.center - third.radius - 1e-12 * sharp);
    ASSERT_LE(high, third.center + third.radius + 1e-12 * sharp);
    const Smoothstep plain{step.begin, step.end};
    const double x = Uniform(random, -0.2, 2.0);
    ASSERT_EQ((RampedStep{step.begin, step.end}.At(x).ss), plain.At(x).ss);
  }
}

TEST(ProfileBounds, RampedStepGoesSteadilyInTheMiddleAndJoinsItsPieces) {
  for (const double ramp : {0.1, 0.3, 0.49}) {
    const RampedStep step{0.2, 0.9, ramp};
    const double speed = 15.0 / (15.0 - 14.0 * ramp) / 0.7;
    for (const double x : {step.steady_begin() + 1e-9, 0.55, step.steady_end() - 1e-9}) {
      EXPECT_NEAR(step.At(x).s, speed, 1e-12) << ramp;
      EXPECT_NEAR(step.At(x).ss, 0.0, 1e-12);
    }
    for (const double seam : {0.2, step.steady_begin(), step.steady_end(), 0.9}) {
      const UnitJet before = step.At(seam - 1e-9), after = step.At(seam + 1e-9);
      EXPECT_NEAR(before.value, after.value, 1e-8);
      EXPECT_NEAR(before.s, after.s, 1e-5);
      EXPECT_NEAR(before.ss, after.ss, 1e-4);
    }
    for (double x = 0.0; x < 1.1; x += 0.01) {
      EXPECT_NEAR(step.At(x).value + step.At(1.1 - x).value, 1.0, 1e-14);  // antisymmetric
      const double h = 1e-6, slope = (step.At(x + h).value - step.At(x - h).value) / (2 * h);
      EXPECT_NEAR(step.At(x).s, slope, 1e-8);
    }
  }
}

TEST(ProfileBounds, RestToRestSecondsHoldAndTheShiftIsExact) {
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    const RestToRest profile(std::exp(Uniform(random, std::log(0.5), std::log(60.0))),
                             Uniform(random, 0.01, 0.5),
                             i % 2 == 0 ? 1.0 : Uniform(random, 0.1, 1.0));
    // The CoM's bound takes the pre-bump to go backward.
    ASSERT_GT(profile.bump(), 0.0);
    const Window window(random);
    const double com = window.Sup([&](double x) { return profile.Com(x).ss; });
    ASSERT_LE(com, profile.ComSecondBound() * (1 + 1e-9));
    const double zmp = window.Sup([&](double x) { return profile.Zmp(x).ss; });
    const double bound = profile.ZmpSecondBound(window.from, window.to);
    ASSERT_LE(zmp, bound * (1 + 1e-9) + 1e-9) << window.from << " " << window.to;
  }
}

TEST(ProfileBounds, HalfStepSecondsHoldInLocalTime) {
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    const double shift = Uniform(random, 0.01, 0.5);
    const double longest = std::min(0.3, 0.9 * 0.5 * (1 - shift));
    const HalfStepShape shape{.shift = shift,
                              .foot_delay = Uniform(random, 0.0, longest),
                              .bump_ramp = i % 3 == 0 ? 1.0 : Uniform(random, 0.1, 1.0),
                              .foot_ramp = Uniform(random, 0.1, 0.5),
                              .lift_share = Uniform(random, 0.2, 1.0)};
    const HalfStepKind kind = i % 2 == 0 ? HalfStepKind::kUp : HalfStepKind::kDown;
    const double duration = Uniform(random, 0.4, 4.0);
    HalfStep half_step{.kind = kind, .duration = duration, .shape = shape};
    half_step.X_SF = Foothold::Level({0.2, -0.2, 0.3});
    const HalfStepTracks tracks(half_step, Lipm());
    const Window window(random);
    WalkState bounds = WalkState::Zero();
    tracks.AddSecondBounds(window.from * duration, window.to * duration, &bounds);
    for (int quantity : {kComX, kZmpX, kWaistYaw, kRightX, kRightZ}) {
      const double sup =
          window.Sup([&](double x) { return tracks.At(x * duration).second[quantity]; });
      ASSERT_LE(sup, bounds[quantity] * (1 + 1e-9) + 1e-9)
          << quantity << " on [" << window.from << ", " << window.to << "]";
    }
  }
}

// Regression: an interval that ends at a knot took the piece beyond it along where rounding put its
// end behind the knot.
TEST(ProfileBounds, ThirdsOfAnIntervalThatEndsAtAKnotAreNotThoseBeyond) {
  const HalfStepTracks up({.duration = 0.75, .shape = {.foot_delay = 0.2}}, Lipm());
  const double knot = up.horizontal_begin();
  const auto farthest = [&](double to, double time) {
    WalkThirds thirds;
    up.AddThirdRanges(knot - 1e-4, to, time, &thirds);
    return thirds.of(kRightY).most();
  };
  // What a time that is off by 1e-15 s does to the second derivative is there all the same.
  for (const double to : {knot, std::nextafter(knot, 1.0), knot + 5e-16}) {
    EXPECT_LT(farthest(to, 1e-15), 1e-4) << to - knot;
    EXPECT_GT(farthest(to, 1e-15), 0.0) << to - knot;
  }
  EXPECT_GT(farthest(knot + 1e-14, 1e-15), 1.0);
}

}  // namespace
}  // namespace halfstep
