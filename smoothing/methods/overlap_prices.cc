#include "smoothing/methods/overlap_prices.h"

#include <cmath>
#include <limits>

#include "opt/problem/stationarity.h"
#include "smoothing/margins/slack_evaluator.h"

namespace halfstep {

void AddPrices(const SuperposedWalk& walk, const MarginEvaluator& evaluator,
               std::vector<JunctionResult>* junctions) {
  constexpr double kNear = 1.0;    // of the scale: what refused is nearly tight in the walk itself
  constexpr double kSteep = 1e-3;  // [1/s] below it the margin does not depend on the overlap
  SlackEvaluator slacks(evaluator, kNear);
  InstantSlacks instant;
  for (size_t j = 0; j < junctions->size(); ++j) {
    JunctionResult& junction = (*junctions)[j];
    junction.price.reset();
    if (!junction.limited_by || junction.limited_by->stop_after >= 0) continue;
    slacks.At(walk, junction.limited_by->at, {}, true, &instant);
    const HomotopyParameter overlap{HomotopyParameter::Family::kOverlap, static_cast<int>(j)};
    double least = std::numeric_limits<double>::infinity(), slope = 0.0;
    for (size_t r = 0; r < instant.rows.size(); ++r) {
      if (instant.rows[r].family != junction.limited_by->family) continue;
      if (instant.rows[r].slack >= least) continue;
      least = instant.rows[r].slack;
      slope = instant.Slope(r, overlap);
    }
    if (slope < -kSteep) junction.price = -1.0 / slope;
  }
}

namespace {

// Rows nearer to their bound than this count as active [of their scale].
constexpr double kActive = 0.05;

// By how much each row changes at most within the bounds of the variables, to first order.
Eigen::VectorXd ReachOfRows(const opt::Problem& problem, const std::vector<double>& jacobian) {
  Eigen::VectorXd reach = Eigen::VectorXd::Zero(problem.num_constraints());
  const Eigen::VectorXd widths = problem.upper() - problem.lower();
  for (size_t k = 0; k < jacobian.size(); ++k) {
    reach[problem.pattern().rows[k]] += std::abs(jacobian[k]) * widths[problem.pattern().cols[k]];
  }
  return reach;
}

}  // namespace

long AddMultipliers(const OverlapProgram& program, const HomotopyParameters& parameters,
                    std::vector<JunctionResult>* junctions) {
  const opt::Problem problem = program.MakeProblem();
  const Eigen::VectorXd x = program.ToVariables(parameters);
  const Eigen::VectorXd rows = problem.Constraints(x);
  std::vector<double> jacobian = problem.Jacobian(x);
  // A row that stays where it is whatever the variables do holds nothing. Its derivatives are those
  // of instants that hardly count in it, and what is left of the cost's gradient, divided by so
  // little, would be its multiplier.
  const Eigen::VectorXd reach = ReachOfRows(problem, jacobian);
  for (size_t k = 0; k < jacobian.size(); ++k) {
    if (!(reach[problem.pattern().rows[k]] >= kActive)) jacobian[k] = 0.0;
  }
  const opt::Stationarity at =
      opt::EstimateMultipliers(problem, x, problem.Gradient(x), rows, jacobian, kActive);
  for (size_t j = 0; j < junctions->size(); ++j) {
    JunctionResult& junction = (*junctions)[j];
    if (!junction.limited_by) continue;
    double sum = 0.0;
    bool active = false, moves = false;
    for (int row = 0; row < program.watched().rows(); ++row) {
      const int after = program.watched().half_step_of(row) - static_cast<int>(j);
      const bool same = program.watched().family_of(row) == Traits(junction.limited_by->family).row;
      if (!same || after < 0 || after > 1) continue;
      sum += std::abs(at.multipliers[row]);
      if (rows[row] - problem.constraint_lower()[row] > kActive) continue;
      active = true;
      moves = moves || reach[row] >= kActive;
    }
    // No walk becomes shorter by more than it lasts.
    const bool determined = (moves || !active) && sum <= DurationOf(parameters);
    junction.multiplier = determined ? sum : std::numeric_limits<double>::quiet_NaN();
  }
  return at.multiplications;
}

}  // namespace halfstep
