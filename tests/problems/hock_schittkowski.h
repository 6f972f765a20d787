#pragma once

#include <cmath>

#include "tests/problems/auto_blocks.h"
#include "tests/problems/problem_card.h"

// Source of all: [Hock1981], by problem number; statement, start and optimum as there. Starts
// outside the bounds are projected by the solvers.

namespace halfstep::testing {

inline constexpr char kHockSchittkowski[] = "Hock and Schittkowski 1981";

/// Rosenbrock's valley with one bound.
inline ProblemCard Hs1() {
  return {"HS1", kHockSchittkowski,
          ProblemBuilder(Vector({-2, 1}), Vector({-kInfinity, -1.5}), Constant(2, kInfinity))
              .Minimize([](const auto& x) {
                const auto a = x[1] - x[0] * x[0], b = 1.0 - x[0];
                return 100.0 * a * a + b * b;
              })
              .Build(),
          0.0};
}

/// A quadratic cost on a parabola (equality).
inline ProblemCard Hs6() {
  return {"HS6", kHockSchittkowski,
          ProblemBuilder(Vector({-1.2, 1}))
              .Minimize([](const auto& x) { return (1.0 - x[0]) * (1.0 - x[0]); })
              .Row(
                  "parabola", 0.0, [](const auto& x) { return 10.0 * (x[1] - x[0] * x[0]); }, 0.0)
              .Build(),
          0.0};
}

/// A logarithm on a quartic curve (equality).
inline ProblemCard Hs7() {
  return {"HS7", kHockSchittkowski,
          ProblemBuilder(Vector({2, 2}))
              .Minimize([](const auto& x) {
                using std::log;
                return log(1.0 + x[0] * x[0]) - x[1];
              })
              .Row(
                  "curve", 4.0,
                  [](const auto& x) {
                    const auto a = 1.0 + x[0] * x[0];
                    return a * a + x[1] * x[1];
                  },
                  4.0)
              .Build(),
          -std::sqrt(3.0)};
}

inline ProblemCard Hs24() {
  const double root = std::sqrt(3.0);
  return {"HS24", kHockSchittkowski,
          ProblemBuilder(Vector({1, 0.5}), Constant(2, 0.0), Constant(2, kInfinity))
              .Minimize([root](const auto& x) {
                return ((x[0] - 3.0) * (x[0] - 3.0) - 9.0) * x[1] * x[1] * x[1] / (27.0 * root);
              })
              .NonNegative("a", [root](const auto& x) { return x[0] / root - x[1]; })
              .NonNegative("b", [root](const auto& x) { return x[0] + root * x[1]; })
              .NonNegative("c", [root](const auto& x) { return 6.0 - x[0] - root * x[1]; })
              .Build(),
          -1.0};
}

/// Beale's convex quadratic program.
inline ProblemCard Hs35() {
  return {"HS35", kHockSchittkowski,
          ProblemBuilder(Constant(3, 0.5), Constant(3, 0.0), Constant(3, kInfinity))
              .Minimize([](const auto& x) {
                return 9.0 - 8.0 * x[0] - 6.0 * x[1] - 4.0 * x[2] + 2.0 * x[0] * x[0] +
                       2.0 * x[1] * x[1] + x[2] * x[2] + 2.0 * x[0] * x[1] + 2.0 * x[0] * x[2];
              })
              .NonNegative("plane", [](const auto& x) { return 3.0 - x[0] - x[1] - 2.0 * x[2]; })
              .Build(),
          1.0 / 9.0};
}

/// Box of the largest volume.
inline ProblemCard Hs36() {
  return {
      "HS36", kHockSchittkowski,
      ProblemBuilder(Constant(3, 10.0), Constant(3, 0.0), Vector({20, 11, 42}))
          .Minimize([](const auto& x) { return -x[0] * x[1] * x[2]; })
          .NonNegative("girth", [](const auto& x) { return 72.0 - x[0] - 2.0 * x[1] - 2.0 * x[2]; })
          .Build(),
      -3300.0};
}

/// Rosen and Suzuki.
inline ProblemCard Hs43() {
  return {"HS43", kHockSchittkowski,
          ProblemBuilder(Constant(4, 0.0))
              .Minimize([](const auto& x) {
                return x[0] * x[0] + x[1] * x[1] + 2.0 * x[2] * x[2] + x[3] * x[3] - 5.0 * x[0] -
                       5.0 * x[1] - 21.0 * x[2] + 7.0 * x[3];
              })
              .NonNegative("a",
                           [](const auto& x) {
                             return 8.0 - x[0] * x[0] - x[1] * x[1] - x[2] * x[2] - x[3] * x[3] -
                                    x[0] + x[1] - x[2] + x[3];
                           })
              .NonNegative("b",
                           [](const auto& x) {
                             return 10.0 - x[0] * x[0] - 2.0 * x[1] * x[1] - x[2] * x[2] -
                                    2.0 * x[3] * x[3] + x[0] + x[3];
                           })
              .NonNegative("c",
                           [](const auto& x) {
                             return 5.0 - 2.0 * x[0] * x[0] - x[1] * x[1] - x[2] * x[2] -
                                    2.0 * x[0] + x[1] + x[3];
                           })
              .Build(),
          -44.0};
}

/// A ball within a box.
inline ProblemCard Hs65() {
  return {
      "HS65", kHockSchittkowski,
      ProblemBuilder(Vector({-5, 5, 0}), Vector({-4.5, -4.5, -5}), Vector({4.5, 4.5, 5}))
          .Minimize([](const auto& x) {
            return (x[0] - x[1]) * (x[0] - x[1]) +
                   (x[0] + x[1] - 10.0) * (x[0] + x[1] - 10.0) / 9.0 + (x[2] - 5.0) * (x[2] - 5.0);
          })
          .NonNegative("ball",
                       [](const auto& x) { return 48.0 - x[0] * x[0] - x[1] * x[1] - x[2] * x[2]; })
          .Build(),
      0.9535288567};
}

/// Equality, inequality and bounds together.
inline ProblemCard Hs71() {
  return {
      "HS71", kHockSchittkowski,
      ProblemBuilder(Vector({1, 5, 5, 1}), Constant(4, 1.0), Constant(4, 5.0))
          .Minimize([](const auto& x) { return x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]; })
          .Row(
              "product", 25.0, [](const auto& x) { return x[0] * x[1] * x[2] * x[3]; }, kInfinity)
          .Row(
              "sphere", 40.0,
              [](const auto& x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]; },
              40.0)
          .Build(),
      17.0140173};
}

/// A convex quadratic program.
inline ProblemCard Hs76() {
  return {"HS76", kHockSchittkowski,
          ProblemBuilder(Constant(4, 0.5), Constant(4, 0.0), Constant(4, kInfinity))
              .Minimize([](const auto& x) {
                return x[0] * x[0] + 0.5 * x[1] * x[1] + x[2] * x[2] + 0.5 * x[3] * x[3] -
                       x[0] * x[2] + x[2] * x[3] - x[0] - 3.0 * x[1] + x[2] - x[3];
              })
              .NonNegative("a", [](const auto& x) { return 5.0 - x[0] - 2.0 * x[1] - x[2] - x[3]; })
              .NonNegative(
                  "b", [](const auto& x) { return 4.0 - 3.0 * x[0] - x[1] - 2.0 * x[2] + x[3]; })
              .NonNegative("c", [](const auto& x) { return x[1] + 4.0 * x[2] - 1.5; })
              .Build(),
          -4.681818182};
}

}  // namespace halfstep::testing
