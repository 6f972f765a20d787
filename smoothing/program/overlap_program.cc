#include "smoothing/program/overlap_program.h"

#include <algorithm>
#include <limits>
#include <string>

#include "smoothing/program/overlap_costs.h"
#include "smoothing/program/overlap_rows.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// z of `safest` lies between these slacks.
constexpr double kLeastZ = -10.0;

// `safest` raises the least slack far beyond what the other programs need to see.
WatchOptions Seeing(const ProgramOptions& options) {
  WatchOptions watch = options.watch;
  if (options.kind == ProgramKind::kSafest) watch.cutoff = std::max(watch.cutoff, 5.0);
  return watch;
}

}  // namespace

std::array<bool, kNumMarginFamilies> Raised() {
  std::array<bool, kNumMarginFamilies> raised{};
  for (const MarginFamily family : AllMarginFamilies()) {
    Nth(raised, family) = Traits(family).raised;
  }
  return raised;
}

std::string_view Name(ProgramKind kind) {
  switch (kind) {
    case ProgramKind::kFastest:
      return "fastest";
    case ProgramKind::kSmooth:
      return "smooth";
    case ProgramKind::kSafest:
      return "safest";
  }
  return "";
}

double CostOf(const HalfStepSequence& sequence, const HomotopyParameters& parameters,
              const ProgramOptions& options) {
  double cost = DurationOf(parameters);
  if (options.kind == ProgramKind::kFastest) return cost;
  const SuperposedWalk walk(sequence, parameters);
  cost += WeightedRoughness(walk, options.weights, nullptr);
  for (const WeightedWalkCost& own : options.own_costs) {
    if (own.weight != 0.0) cost += own.weight * own.cost->Evaluate(walk, nullptr);
  }
  return cost;
}

OverlapProgram::OverlapProgram(const HalfStepSequence& sequence, const MarginEvaluator& evaluator,
                               const ProgramOptions& options, double duration_limit,
                               const std::vector<FixedParameter>& fixed)
    : options_(options),
      duration_limit_(duration_limit),
      variables_(sequence, ParameterTable(sequence, fixed, options.parameters),
                 evaluator.scene().rests()),
      watched_(variables_, evaluator, Seeing(options)) {
  options_.watch = Seeing(options);
}

opt::Problem OverlapProgram::MakeProblem() const {
  opt::Problem problem;
  const Eigen::VectorXd initial = variables_.ToVariables(variables_.table().Start());
  const Eigen::VectorXd lower = variables_.lower(), upper = variables_.upper();
  Eigen::Index first = 0;
  for (const ParameterFamily family : AllParameterFamilies()) {
    Eigen::Index count = 0;
    while (first + count < variables_.size() &&
           variables_.at(static_cast<int>(first + count)).family == family) {
      ++count;
    }
    if (count == 0) continue;
    const bool scaled = family == ParameterFamily::kOverlap;
    problem.AddVariables({.name = std::string(Traits(family).name),
                          .unit = scaled ? "of its bound" : std::string(Traits(family).unit),
                          .initial = initial.segment(first, count),
                          .lower = lower.segment(first, count),
                          .upper = upper.segment(first, count)});
    first += count;
  }
  if (options_.kind == ProgramKind::kSafest) {
    problem.AddVariables({.name = "least_slack",
                          .unit = "of its family's scale",
                          .initial = Eigen::VectorXd::Zero(1),
                          .lower = Eigen::VectorXd::Constant(1, kLeastZ),
                          .upper = Eigen::VectorXd::Constant(1, options_.watch.cutoff)});
  }
  problem.AddConstraint(MakeSlackRows(*this));
  switch (options_.kind) {
    case ProgramKind::kFastest:
      problem.AddCost(MakeDurationCost(*this), 1.0);
      break;
    case ProgramKind::kSmooth:
      problem.AddCost(MakeDurationCost(*this), 1.0);
      problem.AddCost(MakeRoughnessCost(*this), 1.0);
      for (const WeightedWalkCost& own : options_.own_costs) {
        if (own.weight != 0.0) problem.AddCost(MakeOwnCost(*this, own.cost), own.weight);
      }
      break;
    case ProgramKind::kSafest:
      problem.AddConstraint(MakeDurationRow(*this));
      problem.AddCost(MakeLeastSlackCost(), 1.0);
      break;
  }
  return problem;
}

Eigen::VectorXd OverlapProgram::ToVariables(const HomotopyParameters& parameters) const {
  const Eigen::VectorXd x = variables_.ToVariables(parameters);
  if (options_.kind != ProgramKind::kSafest) return x;
  Eigen::VectorXd with_slack(x.size() + 1);
  with_slack << x, std::max(kLeastZ, watched_.LeastSlack(parameters, Raised()));
  return with_slack;
}

double OverlapProgram::Cost(const HomotopyParameters& parameters) const {
  if (options_.kind != ProgramKind::kSafest) {
    return CostOf(variables_.sequence(), parameters, options_);
  }
  constexpr double kRounding = 1e-9;  // [s]
  if (DurationOf(parameters) > duration_limit_ + kRounding) {
    return std::numeric_limits<double>::infinity();
  }
  return -watched_.LeastSlack(parameters, Raised());
}

}  // namespace halfstep
