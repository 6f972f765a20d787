#include "smoothing/methods/shortened_start.h"

#include <algorithm>
#include <vector>

#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kFactor = 0.9;      // from one trial to the next
constexpr double kTolerated = -0.3;  // of a row: the solver's first steps mend it
constexpr int kMendings = 3;

// The least row of each half-step at x.
std::vector<double> LeastRows(const OverlapProgram& program, const Eigen::VectorXd& x) {
  const WatchedInstants& watched = program.watched();
  Eigen::VectorXd values;
  watched.Evaluate(x, &values, nullptr);
  std::vector<double> least(static_cast<size_t>(program.variables().sequence().size()), 1.0);
  for (int row = 0; row < watched.rows(); ++row) {
    double& of_half_step = Nth(least, watched.half_step_of(row));
    of_half_step = std::min(of_half_step, values[row]);
  }
  return least;
}

}  // namespace

HomotopyParameters ShortenedStart(const OverlapProgram& program, const HomotopyParameters& from) {
  const OverlapVariables& variables = program.variables();
  const Eigen::VectorXd begin = variables.ToVariables(from), lower = variables.lower();
  const size_t n = from.durations.size();
  // x with the durations of each half-step times its factor.
  const auto at = [&](const std::vector<double>& factors) {
    Eigen::VectorXd x = begin;
    for (int v = 0; v < variables.size(); ++v) {
      if (variables.at(v).family != ParameterFamily::kDuration) continue;
      x[v] = std::max(lower[v], begin[v] * Nth(factors, variables.at(v).index));
    }
    return x;
  };
  std::vector<double> factors(n, 1.0);
  std::vector<bool> stays(n, false);
  for (double factor = kFactor;; factor *= kFactor) {
    const Eigen::VectorXd x = at(std::vector<double>(n, factor));
    if (x == at(std::vector<double>(n, factor / kFactor)))
      break;  // all are as short as they may be
    const std::vector<double> least = LeastRows(program, x);
    for (size_t k = 0; k < n; ++k) {
      if (least[k] >= kTolerated) continue;
      for (size_t i = k > 0 ? k - 1 : 0; i < std::min(n, k + 2); ++i) stays[i] = true;
    }
    for (size_t k = 0; k < n; ++k) {
      if (!stays[k]) factors[k] = factor;
    }
    if (std::ranges::find(stays, false) == stays.end()) break;
  }
  // Where short half-steps meet long ones.
  for (int mending = 0; mending < kMendings; ++mending) {
    const std::vector<double> least = LeastRows(program, at(factors));
    bool mended = false;
    std::vector<double> longer = factors;
    for (size_t k = 0; k < n; ++k) {
      if (least[k] >= kTolerated) continue;
      for (size_t i = k > 0 ? k - 1 : 0; i < std::min(n, k + 2); ++i) {
        longer[i] = std::min(1.0, factors[i] / kFactor);
      }
      mended = true;
    }
    if (!mended) break;
    factors = longer;
  }
  return variables.ToParameters(at(factors));
}

}  // namespace halfstep
