#include "opt/problem/stationarity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace halfstep::opt {
namespace {

/// An active row or bound: its gradient and the signs its multiplier may take.
struct Active {
  double* multiplier;
  double least, most;
  double square = 0.0;                          ///< ‖gradient‖²
  std::vector<std::pair<int, double>> entries;  ///< variable, derivative
};

std::pair<double, double> Signs(double value, double lower, double upper, double activity) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool low = value - lower <= activity * std::max(1.0, std::abs(lower));
  const bool high = upper - value <= activity * std::max(1.0, std::abs(upper));
  return {std::isfinite(lower) && low ? -kInfinity : 0.0,
          std::isfinite(upper) && high ? kInfinity : 0.0};
}

}  // namespace

Stationarity EstimateMultipliers(const Problem& problem, const Eigen::VectorXd& x,
                                 const Eigen::VectorXd& gradient,
                                 const Eigen::VectorXd& constraints,
                                 const std::vector<double>& jacobian, double activity) {
  constexpr int kMostSweeps = 5000;
  constexpr double kEnough = 1e-10;  // largest change of the residual vector in a sweep, relative
  Stationarity result;
  result.multipliers = Eigen::VectorXd::Zero(problem.num_constraints());
  result.bound_multipliers = Eigen::VectorXd::Zero(problem.num_variables());

  std::vector<Active> active(static_cast<size_t>(problem.num_constraints()));
  for (int i = 0; i < problem.num_constraints(); ++i) {
    Active& row = active[static_cast<size_t>(i)];
    row.multiplier = &result.multipliers[i];
    std::tie(row.least, row.most) = Signs(constraints[i], problem.constraint_lower()[i],
                                          problem.constraint_upper()[i], activity);
  }
  for (size_t k = 0; k < jacobian.size(); ++k) {
    Active& row = active[static_cast<size_t>(problem.pattern().rows[k])];
    row.square += jacobian[k] * jacobian[k];
    row.entries.emplace_back(problem.pattern().cols[k], jacobian[k]);
  }
  for (int j = 0; j < problem.num_variables(); ++j) {
    const auto [least, most] = Signs(x[j], problem.lower()[j], problem.upper()[j], activity);
    active.push_back({&result.bound_multipliers[j], least, most, 1.0, {{j, 1.0}}});
  }
  // A derivative of rounding alone would get any multiplier.
  constexpr double kRounding = 1e-9;
  double steepest = 0.0;
  for (const Active& a : active) steepest = std::max(steepest, a.square);
  std::erase_if(active, [&](const Active& a) {
    return (a.least == 0.0 && a.most == 0.0) || !(a.square > kRounding * kRounding * steepest);
  });

  const double scale = std::max(1.0, gradient.lpNorm<Eigen::Infinity>());
  Eigen::VectorXd rest = gradient;
  long entries = 0;
  for (const Active& a : active) entries += static_cast<long>(a.entries.size());
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    result.multiplications += 2 * entries;
    double change = 0.0;
    for (Active& a : active) {
      double slope = 0.0;
      for (const auto& [j, derivative] : a.entries) slope += derivative * rest[j];
      const double updated = std::clamp(*a.multiplier - slope / a.square, a.least, a.most);
      const double step = updated - *a.multiplier;
      *a.multiplier = updated;
      for (const auto& [j, derivative] : a.entries) rest[j] += step * derivative;
      change = std::max(change, std::abs(step) * std::sqrt(a.square));
    }
    if (change <= kEnough * scale) break;
  }
  result.residual = rest.lpNorm<Eigen::Infinity>() / scale;
  return result;
}

}  // namespace halfstep::opt
