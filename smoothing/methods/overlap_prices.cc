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

void AddMultipliers(const OverlapProgram& program, const HomotopyParameters& parameters,
                    std::vector<JunctionResult>* junctions) {
  constexpr double kActive = 0.05;
  const opt::Problem problem = program.MakeProblem();
  const Eigen::VectorXd x = program.ToVariables(parameters);
  const opt::Stationarity at = opt::EstimateMultipliers(
      problem, x, problem.Gradient(x), problem.Constraints(x), problem.Jacobian(x), kActive);
  for (size_t j = 0; j < junctions->size(); ++j) {
    JunctionResult& junction = (*junctions)[j];
    if (!junction.limited_by) continue;
    double sum = 0.0;
    for (int row = 0; row < program.watched().rows(); ++row) {
      const int after = program.watched().half_step_of(row) - static_cast<int>(j);
      const bool same = WatchedInstants::family_of(row) == Traits(junction.limited_by->family).row;
      if (same && (after == 0 || after == 1)) sum += std::abs(at.multipliers[row]);
    }
    junction.multiplier = sum;
  }
}

}  // namespace halfstep
