#pragma once

#include <cmath>

#include "tests/problems/auto_blocks.h"
#include "tests/problems/problem_card.h"

namespace halfstep::testing {

/// Rosenbrock's valley within the unit disk; the optimum is where the valley leaves it.
inline ProblemCard RosenbrockDisk() {
  return {"RosenbrockDisk", "Optimum by Newton's method on the circle, 12 digits",
          ProblemBuilder(Vector({0, 0}))
              .Minimize([](const auto& x) {
                return 100.0 * (x[1] - x[0] * x[0]) * (x[1] - x[0] * x[0]) +
                       (1.0 - x[0]) * (1.0 - x[0]);
              })
              .Row(
                  "disk", -kInfinity, [](const auto& x) { return x[0] * x[0] + x[1] * x[1]; }, 1.0)
              .Build(),
          0.045674808719};
}

/// n variables in [0, 1], one row x_i² + x_{i+1}² ≤ r_i for each pair of neighbours, the cost cᵀx:
/// shaped like overlaps of a walk, start 0 feasible. Constructed backwards: x* and multipliers
/// λ > 0 are chosen, c = −Jᵀλ makes the convex program's first-order conditions hold there.
inline ProblemCard BandedLinear(int n = 50) {
  Eigen::VectorXd best(n), cost = Constant(n, 0.0);
  for (int i = 0; i < n; ++i) best[i] = 0.5 + 0.3 * std::sin(1.7 * i);
  ProblemBuilder builder(Constant(n, 0.0), Constant(n, 0.0), Constant(n, 1.0));
  for (int i = 0; i + 1 < n; ++i) {
    const double multiplier = 1.0 + 0.5 * std::cos(0.9 * i);
    cost[i] -= multiplier * 2.0 * best[i];
    cost[i + 1] -= multiplier * 2.0 * best[i + 1];
  }
  builder.Minimize([cost](const auto& x) {
    auto total = cost[0] * x[0];
    for (Eigen::Index j = 1; j < cost.size(); ++j) {
      total = total + cost[j] * x[static_cast<size_t>(j)];
    }
    return total;
  });
  for (int i = 0; i + 1 < n; ++i) {
    const size_t k = static_cast<size_t>(i);
    builder.Row("pair " + std::to_string(i), -kInfinity,
                [k](const auto& x) { return x[k] * x[k] + x[k + 1] * x[k + 1]; },
                best[i] * best[i] + best[i + 1] * best[i + 1], {i, i + 1});
  }
  return {"BandedLinear", "constructed", builder.Build(), cost.dot(best)};
}

/// The same band with ½‖x − a‖², every second row active: a = x* + Jᵀλ.
inline ProblemCard BandedQuadratic(int n = 50) {
  Eigen::VectorXd best(n);
  for (int i = 0; i < n; ++i) best[i] = 0.5 + 0.3 * std::sin(1.7 * i);
  Eigen::VectorXd target = best;
  for (int i = 0; i + 1 < n; i += 2) {
    target[i] += 0.5 * 2.0 * best[i];
    target[i + 1] += 0.5 * 2.0 * best[i + 1];
  }
  ProblemBuilder builder(Constant(n, 0.0));
  builder.Minimize([target](const auto& x) {
    auto total = 0.0 * x[0];
    for (Eigen::Index j = 0; j < target.size(); ++j) {
      const auto d = x[static_cast<size_t>(j)] - target[j];
      total = total + 0.5 * d * d;
    }
    return total;
  });
  for (int i = 0; i + 1 < n; ++i) {
    const size_t k = static_cast<size_t>(i);
    const double slack = i % 2 == 0 ? 0.0 : 0.3;
    builder.Row("pair " + std::to_string(i), -kInfinity,
                [k](const auto& x) { return x[k] * x[k] + x[k + 1] * x[k + 1]; },
                best[i] * best[i] + best[i + 1] * best[i + 1] + slack, {i, i + 1});
  }
  return {"BandedQuadratic", "constructed", builder.Build(), 0.5 * (best - target).squaredNorm()};
}

/// The unit disk and a half-plane that misses it.
inline opt::Problem InfeasibleProblem() {
  return ProblemBuilder(Vector({0, 0}), Constant(2, -10.0), Constant(2, 10.0))
      .Minimize([](const auto& x) { return x[0] + x[1]; })
      .Row(
          "disk", -kInfinity, [](const auto& x) { return x[0] * x[0] + x[1] * x[1]; }, 1.0)
      .Row("half-plane", 2.0, [](const auto& x) { return x[0] + 0.0; }, kInfinity, {0})
      .Build();
}

/// −x₀ − x₁ within a strip that reaches to infinity.
inline opt::Problem UnboundedProblem() {
  return ProblemBuilder(Vector({1, 1}))
      .Minimize([](const auto& x) { return -x[0] - x[1]; })
      .Row(
          "strip", -1.0, [](const auto& x) { return x[0] - x[1]; }, 1.0)
      .Build();
}

/// The logarithm of a negative start.
inline opt::Problem NanAtStart() {
  return ProblemBuilder(Vector({-1, -1}), Constant(2, -2.0), Constant(2, 2.0))
      .Minimize([](const auto& x) {
        using std::log;
        return log(x[0]) + x[1];
      })
      .Build();
}

/// A row that is not a number beyond x₀ = 1, with the cost pulling there.
inline ProblemCard NanOnTheWay() {
  return {"NanOnTheWay", "by hand: x = (0.91, 1)",
          ProblemBuilder(Vector({0, 0}), Constant(2, -4.0), Constant(2, 4.0))
              .Minimize([](const auto& x) {
                return (x[0] - 2.0) * (x[0] - 2.0) + (x[1] - 1.0) * (x[1] - 1.0);
              })
              .Row("root", 0.3,
                   [](const auto& x) {
                     using std::sqrt;
                     return sqrt(1.0 - x[0]);
                   },
                   kInfinity, {0})
              .Build(),
          1.09 * 1.09};
}

}  // namespace halfstep::testing
