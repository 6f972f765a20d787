#include "smoothing/program/overlap_program.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <string>

namespace halfstep {
namespace {

using Family = HomotopyParameter::Family;

// z of `safest` lies between these slacks.
constexpr double kLeastZ = -10.0;

class SlackBlock : public opt::ConstraintBlock {
 public:
  explicit SlackBlock(const OverlapProgram& program) : program_(program) {
    const int z = program.variables().size();
    raises_ = program.options().kind == ProgramKind::kSafest;
    for (int row = 0; row < rows(); ++row) {
      for (int variable : program.table().band(program.table().half_step_of(row))) {
        pattern_.rows.push_back(row);
        pattern_.cols.push_back(variable);
      }
      if (!raises_ || !IsRaised(row)) continue;
      pattern_.rows.push_back(row);
      pattern_.cols.push_back(z);
    }
  }
  std::string name() const override { return "slack"; }
  std::string unit() const override { return "of its family's scale"; }
  int rows() const override { return program_.table().rows(); }
  const opt::SparsityPattern& pattern() const override { return pattern_; }
  Eigen::VectorXd lower() const override { return Eigen::VectorXd::Zero(rows()); }
  Eigen::VectorXd upper() const override {
    return Eigen::VectorXd::Constant(rows(), std::numeric_limits<double>::infinity());
  }
  void Evaluate(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> values) const override {
    Eigen::VectorXd slacks;
    program_.table().Evaluate(x, &slacks, nullptr);
    values = Lowered(slacks, x);
  }
  void Jacobian(const Eigen::VectorXd& x, std::span<double> nonzeros) const override {
    Eigen::VectorXd values(rows());
    EvaluateWithJacobian(x, values, nonzeros);
  }
  void EvaluateWithJacobian(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> values,
                            std::span<double> nonzeros) const override {
    Eigen::VectorXd slacks;
    std::vector<double> band;
    program_.table().Evaluate(x, &slacks, &band);
    values = Lowered(slacks, x);
    size_t from = 0, to = 0;
    for (int row = 0; row < rows(); ++row) {
      const size_t width = program_.table().band(program_.table().half_step_of(row)).size();
      for (size_t c = 0; c < width; ++c) nonzeros[to++] = band[from++];
      if (raises_ && IsRaised(row)) nonzeros[to++] = -1.0;
    }
  }
  std::string RowName(int row) const override {
    return std::string(Name(SlackTable::family_of(row))) + " in half-step " +
           std::to_string(program_.table().half_step_of(row) + 1);
  }

 private:
  static bool IsRaised(int row) { return Traits(SlackTable::family_of(row)).raised; }

  // Raised slacks less z.
  Eigen::VectorXd Lowered(Eigen::VectorXd slacks, const Eigen::VectorXd& x) const {
    for (int row = 0; raises_ && row < rows(); ++row) {
      if (IsRaised(row)) slacks[row] -= x[x.size() - 1];
    }
    return slacks;
  }

  const OverlapProgram& program_;
  bool raises_ = false;
  opt::SparsityPattern pattern_;
};

// `safest` raises the least slack far beyond what the other programs need to see.
SlackTableOptions Seeing(const ProgramOptions& options) {
  SlackTableOptions table = options.table;
  if (options.kind == ProgramKind::kSafest) table.cutoff = std::max(table.cutoff, 5.0);
  return table;
}

// ∂D/∂parameter.
ParameterGradient DurationGradient(const HalfStepSequence& sequence) {
  ParameterGradient gradient;
  for (int i = 0; i < sequence.size(); ++i) gradient.push_back({{Family::kDuration, i}, 1.0});
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    gradient.push_back({{Family::kOverlap, i}, -1.0});
  }
  return gradient;
}

Eigen::VectorXd Pulled(const OverlapVariables& variables, const ParameterGradient& gradient,
                       const Eigen::VectorXd& x) {
  const std::vector<double> durations = variables.ToParameters(x).durations;
  Eigen::VectorXd pulled = Eigen::VectorXd::Zero(x.size());
  for (const auto& [parameter, slope] : gradient) {
    variables.Pull(parameter, slope, x, durations,
                   [&](int variable, double value) { pulled[variable] += value; });
  }
  return pulled;
}

// `safest`: D stays within its limit, by a little more than solvers exceed their rows.
class DurationRow : public opt::ConstraintBlock {
 public:
  explicit DurationRow(const OverlapProgram& program) : program_(program) {
    for (int v = 0; v < program.variables().size(); ++v) {
      if (program.variables().at(v).family == Family::kHeightScale) continue;
      pattern_.rows.push_back(0);
      pattern_.cols.push_back(v);
    }
  }
  std::string name() const override { return "duration"; }
  std::string unit() const override { return "s"; }
  int rows() const override { return 1; }
  const opt::SparsityPattern& pattern() const override { return pattern_; }
  Eigen::VectorXd lower() const override {
    return Eigen::VectorXd::Constant(1, -std::numeric_limits<double>::infinity());
  }
  Eigen::VectorXd upper() const override {
    constexpr double kReserve = 1e-4;
    return Eigen::VectorXd::Constant(1, (1.0 - kReserve) * program_.duration_limit());
  }
  void Evaluate(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> values) const override {
    values[0] = DurationOf(program_.ToParameters(x));
  }
  void Jacobian(const Eigen::VectorXd& x, std::span<double> nonzeros) const override {
    const Eigen::VectorXd gradient =
        Pulled(program_.variables(), DurationGradient(program_.variables().sequence()), x);
    for (size_t k = 0; k < nonzeros.size(); ++k) nonzeros[k] = gradient[pattern_.cols[k]];
  }

 private:
  const OverlapProgram& program_;
  opt::SparsityPattern pattern_;
};

class DurationCost : public opt::CostTerm {
 public:
  explicit DurationCost(const OverlapProgram& program) : program_(program) {}
  std::string name() const override { return "duration"; }
  std::string unit() const override { return "s"; }
  double Evaluate(const Eigen::VectorXd& x) const override {
    return DurationOf(program_.ToParameters(x));
  }
  void AddGradient(const Eigen::VectorXd& x, double weight,
                   Eigen::Ref<Eigen::VectorXd> gradient) const override {
    gradient +=
        weight * Pulled(program_.variables(), DurationGradient(program_.variables().sequence()), x);
  }

 private:
  const OverlapProgram& program_;
};

class EffortCost : public opt::CostTerm {
 public:
  explicit EffortCost(const OverlapProgram& program) : program_(program) {}
  std::string name() const override { return "effort"; }
  std::string unit() const override { return "s"; }
  double Evaluate(const Eigen::VectorXd& x) const override {
    const SuperposedWalk walk(program_.variables().sequence(), program_.ToParameters(x));
    return WeightedEffort(walk, program_.options().weights, nullptr);
  }
  void AddGradient(const Eigen::VectorXd& x, double weight,
                   Eigen::Ref<Eigen::VectorXd> gradient) const override {
    const SuperposedWalk walk(program_.variables().sequence(), program_.ToParameters(x));
    ParameterGradient slopes;
    WeightedEffort(walk, program_.options().weights, &slopes);
    gradient += weight * Pulled(program_.variables(), slopes, x);
  }

 private:
  const OverlapProgram& program_;
};

class WorstSlackCost : public opt::CostTerm {
 public:
  std::string name() const override { return "minus least slack"; }
  std::string unit() const override { return "of its family's scale"; }
  double Evaluate(const Eigen::VectorXd& x) const override { return -x[x.size() - 1]; }
  void AddGradient(const Eigen::VectorXd& x, double weight,
                   Eigen::Ref<Eigen::VectorXd> gradient) const override {
    gradient[x.size() - 1] -= weight;
  }
};

}  // namespace

std::array<bool, kNumMarginFamilies> Raised() {
  std::array<bool, kNumMarginFamilies> raised{};
  for (const MarginFamily family : AllMarginFamilies()) {
    raised[static_cast<size_t>(family)] = Traits(family).raised;
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

double DurationOf(const HomotopyParameters& parameters) {
  return std::accumulate(parameters.durations.begin(), parameters.durations.end(), 0.0) -
         std::accumulate(parameters.overlaps.begin(), parameters.overlaps.end(), 0.0);
}

OverlapProgram::OverlapProgram(const HalfStepSequence& sequence, const MarginEvaluator& evaluator,
                               const ProgramOptions& options, double duration_limit)
    : options_(options),
      duration_limit_(duration_limit),
      variables_(sequence, options.heights, options.durations),
      table_(variables_, evaluator, Seeing(options)) {
  options_.table = Seeing(options);
}

opt::Problem OverlapProgram::MakeProblem() const {
  opt::Problem problem;
  const HomotopyParameters planned = PlannedMotion(variables_.sequence());
  const auto add = [&](const char* name, const char* unit, const std::vector<double>& initial,
                       const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    problem.AddVariables({.name = name,
                          .unit = unit,
                          .initial = Eigen::Map<const Eigen::VectorXd>(
                              initial.data(), static_cast<Eigen::Index>(initial.size())),
                          .lower = lower,
                          .upper = upper});
  };
  const Eigen::Index junctions = static_cast<Eigen::Index>(planned.overlaps.size());
  add("overlap", "of its bound", planned.overlaps, Eigen::VectorXd::Zero(junctions),
      Eigen::VectorXd::Ones(junctions));
  if (options_.heights) {
    const Eigen::Index steps = static_cast<Eigen::Index>(planned.height_scales.size());
    add("height_scale", "", planned.height_scales,
        Eigen::VectorXd::Constant(steps, options_.least_height_scale),
        Eigen::VectorXd::Ones(steps));
  }
  if (options_.durations) {
    const Eigen::VectorXd T = Eigen::Map<const Eigen::VectorXd>(
        planned.durations.data(), static_cast<Eigen::Index>(planned.durations.size()));
    add("duration", "s", planned.durations, options_.least_duration * T,
        options_.most_duration * T);
  }
  if (options_.kind == ProgramKind::kSafest) {
    add("least_slack", "of its family's scale", {0.0}, Eigen::VectorXd::Constant(1, kLeastZ),
        Eigen::VectorXd::Constant(1, options_.table.cutoff));
  }
  problem.AddConstraint(std::make_unique<SlackBlock>(*this));
  switch (options_.kind) {
    case ProgramKind::kFastest:
      problem.AddCost(std::make_unique<DurationCost>(*this), 1.0);
      break;
    case ProgramKind::kSmooth:
      problem.AddCost(std::make_unique<DurationCost>(*this), 1.0);
      problem.AddCost(std::make_unique<EffortCost>(*this), 1.0);
      break;
    case ProgramKind::kSafest:
      problem.AddConstraint(std::make_unique<DurationRow>(*this));
      problem.AddCost(std::make_unique<WorstSlackCost>(), 1.0);
      break;
  }
  return problem;
}

Eigen::VectorXd OverlapProgram::ToVariables(const HomotopyParameters& parameters) const {
  const Eigen::VectorXd x = variables_.ToVariables(parameters);
  if (options_.kind != ProgramKind::kSafest) return x;
  Eigen::VectorXd with_slack(x.size() + 1);
  with_slack << x, std::max(kLeastZ, table_.LeastSlack(parameters, Raised()));
  return with_slack;
}

double OverlapProgram::Cost(const HomotopyParameters& parameters) const {
  const double duration = DurationOf(parameters);
  switch (options_.kind) {
    case ProgramKind::kFastest:
      return duration;
    case ProgramKind::kSmooth:
      return duration + WeightedEffort(SuperposedWalk(variables_.sequence(), parameters),
                                       options_.weights, nullptr);
    case ProgramKind::kSafest:
      constexpr double kRounding = 1e-9;  // [s]
      if (duration > duration_limit_ + kRounding) return std::numeric_limits<double>::infinity();
      return -table_.LeastSlack(parameters, Raised());
  }
  return std::numeric_limits<double>::infinity();
}

void AddRandomPoints(const OverlapProgram& program, int count, unsigned seed,
                     std::vector<HomotopyParameters>* points) {
  std::mt19937_64 random(seed);
  const opt::Problem problem = program.MakeProblem();
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXd x(problem.num_variables());
    for (Eigen::Index v = 0; v < x.size(); ++v) {
      x[v] = std::uniform_real_distribution<double>(problem.lower()[v], problem.upper()[v])(random);
    }
    points->push_back(program.ToParameters(x));
  }
}

}  // namespace halfstep
