// Intervals hold what they claim, against numbers of 64 bits of precision.
#include "experiments/checker/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "experiments/checker/curves.h"

namespace halfstep::checker {
namespace {

using Wide = long double;

class Draws {
 public:
  double Number() {
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    std::uniform_int_distribution<int> size(-30, 10);
    return std::ldexp(share(random_), size(random_));
  }
  Interval Some() {
    const double a = Number(), b = random_() % 3 == 0 ? a : Number();
    return {std::min(a, b), std::max(a, b)};
  }
  double Within(const Interval& a) {
    const double share = std::uniform_real_distribution<double>(0.0, 1.0)(random_);
    return std::clamp(a.lo + share * (a.hi - a.lo), a.lo, a.hi);
  }

 private:
  std::mt19937_64 random_{7};
};

int Misses(const std::function<Interval(const Interval&, const Interval&)>& of,
           const std::function<Wide(Wide, Wide)>& truth) {
  Draws draws;
  int misses = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Interval a = draws.Some(), b = draws.Some();
    const Interval result = of(a, b);
    const Wide exact = truth(draws.Within(a), draws.Within(b));
    if (exact < result.lo || exact > result.hi) ++misses;
  }
  return misses;
}

TEST(Interval, HoldsTheExactResult) {
  EXPECT_EQ(Misses([](auto a, auto b) { return a + b; }, [](Wide x, Wide y) { return x + y; }), 0);
  EXPECT_EQ(Misses([](auto a, auto b) { return a - b; }, [](Wide x, Wide y) { return x - y; }), 0);
  EXPECT_EQ(Misses([](auto a, auto b) { return a * b; }, [](Wide x, Wide y) { return x * y; }), 0);
  EXPECT_EQ(Misses([](auto a, auto b) { return a / (Square(b) + Interval(0.5)); },
                   [](Wide x, Wide y) { return x / (y * y + 0.5L); }),
            0);
  EXPECT_EQ(Misses([](auto a, auto) { return Sqrt(Square(a)); },
                   [](Wide x, Wide) { return std::sqrt(x * x); }),
            0);
  EXPECT_EQ(Misses([](auto a, auto) { return SinCosOf(a).sin; },
                   [](Wide x, Wide) { return std::sin(x); }),
            0);
  EXPECT_EQ(Misses([](auto a, auto) { return SinCosOf(a).cos; },
                   [](Wide x, Wide) { return std::cos(x); }),
            0);
}

// What is not rounded outwards does not hold it.
TEST(Interval, WithoutRoundingTheResultIsMissed) {
  EXPECT_GT(Misses([](auto a, auto b) { return Interval(a.lo + b.lo, a.hi + b.hi); },
                   [](Wide x, Wide y) { return x + y; }),
            100);
  EXPECT_GT(Misses([](auto a, auto) { return Interval(SinCos(a.lo).sin, SinCos(a.hi).sin); },
                   [](Wide x, Wide) { return std::sin(x); }),
            100);
}

/// Positions, velocities and accelerations of one joint at random knots.
Trajectory Drawn(Interpolation interpolation) {
  Draws draws;
  Trajectory drawn;
  drawn.interpolation = interpolation;
  drawn.joints = {"joint"};
  drawn.times = {0.25};
  for (int k = 0; k < 12; ++k) drawn.times.push_back(drawn.times.back() + 0.01 + 0.1 * (k % 5));
  for (Eigen::MatrixXd* row : {&drawn.q, &drawn.v, &drawn.a}) {
    row->resize(1, std::ssize(drawn.times));
    for (double& x : row->reshaped()) x = draws.Number();
  }
  return drawn;
}

// The polynomial through both knots, by its textbook formula.
Wide TruthOf(const Trajectory& of, double t, int order) {
  Eigen::Index k = 0;
  while (k + 2 < std::ssize(of.times) && t > of.times[static_cast<size_t>(k + 1)]) ++k;
  const Wide h = Wide(of.times[static_cast<size_t>(k + 1)]) - of.times[static_cast<size_t>(k)];
  const Wide s = Wide(t) - of.times[static_cast<size_t>(k)];
  const Wide q0 = of.q(0, k), q1 = of.q(0, k + 1), d = q1 - q0;
  std::array<Wide, 6> c = {q0, d / h, 0, 0, 0, 0};
  if (of.interpolation != Interpolation::kLinear) {
    const Wide v0 = of.v(0, k), v1 = of.v(0, k + 1);
    if (of.interpolation == Interpolation::kCubic) {
      c = {q0, v0, (3 * d / h - 2 * v0 - v1) / h, (v0 + v1 - 2 * d / h) / (h * h), 0, 0};
    } else {
      const Wide a0 = of.a(0, k), a1 = of.a(0, k + 1), h2 = h * h;
      c = {q0,
           v0,
           a0 / 2,
           (20 * d - (8 * v1 + 12 * v0) * h - (3 * a0 - a1) * h2) / (2 * h2 * h),
           (-30 * d + (14 * v1 + 16 * v0) * h + (3 * a0 - 2 * a1) * h2) / (2 * h2 * h2),
           (12 * d - 6 * (v1 + v0) * h + (a1 - a0) * h2) / (2 * h2 * h2 * h)};
    }
  }
  Wide value = 0;
  for (int i = 5; i >= order; --i) {
    Wide factor = 1;
    for (int m = 0; m < order; ++m) factor *= static_cast<Wide>(i - m);
    value = value * s + factor * c[static_cast<size_t>(i)];
  }
  return value;
}

TEST(Curves, HoldTheCurveOnEveryInterval) {
  std::mt19937_64 random(3);
  for (const Interpolation one :
       {Interpolation::kLinear, Interpolation::kCubic, Interpolation::kQuintic}) {
    const Trajectory drawn = Drawn(one);
    const Curves curves(drawn);
    std::uniform_real_distribution<double> time(curves.begin(), curves.end());
    int misses = 0, loose = 0;
    for (int i = 0; i < 3000; ++i) {
      double from = time(random), to = i % 3 == 0 ? from : time(random);
      if (from > to) std::swap(from, to);
      for (int order = 0; order < 3; ++order) {
        const Interval range = curves.Range(0, order, from, to);
        for (int n = 0; n <= 4; ++n) {
          const double t = std::clamp(from + 0.25 * n * (to - from), from, to);
          const Wide x = TruthOf(drawn, t, order);
          const Wide rounding = 1e-15L * (1 + std::abs(x));  // of the textbook's formula
          if (x < range.lo - rounding || x > range.hi + rounding) ++misses;
        }
        if (from == to && range.hi - range.lo > 1e-9 * (1.0 + range.Magnitude())) ++loose;
      }
    }
    EXPECT_EQ(misses, 0) << Name(one);
    EXPECT_EQ(loose, 0) << Name(one);
  }
}

TEST(Curves, BoundsOfLinearPiecesAreTheirKnots) {
  const Trajectory drawn = Drawn(Interpolation::kLinear);
  const Curves curves(drawn);
  const Interval all = curves.Range(0, 0, curves.begin(), curves.end());
  EXPECT_EQ(all.lo, drawn.q.minCoeff());
  EXPECT_EQ(all.hi, drawn.q.maxCoeff());
  EXPECT_NE(curves.Jump(0, 3), Interval(0.0));
  EXPECT_EQ(Curves(Drawn(Interpolation::kCubic)).Jump(0, 3), Interval(0.0));
}

}  // namespace
}  // namespace halfstep::checker
