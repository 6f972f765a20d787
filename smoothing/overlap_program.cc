#include "smoothing/overlap_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "smoothing/slack_rows.h"
#include "smoothing/superposed_walk.h"

namespace halfstep {
namespace {

using Family = HomotopyParameter::Family;

// How many half-steps away a parameter can still move an instant of a half-step.
constexpr int kBand = 4;
constexpr double kBoundSmoothing = 1e-3;  // [s] below the natural bound where both sides meet

class SlackBlock : public opt::ConstraintBlock {
 public:
  explicit SlackBlock(const OverlapProgram& program) : program_(program) {
    for (int row = 0; row < program.num_rows(); ++row) {
      for (int column = 0; column < program.num_variables(); ++column) {
        if (!program.InBand(row, column)) continue;
        pattern_.rows.push_back(row);
        pattern_.cols.push_back(column);
      }
    }
  }
  std::string name() const override { return "slack"; }
  std::string unit() const override { return "of its family's scale"; }
  int rows() const override { return program_.num_rows(); }
  const opt::SparsityPattern& pattern() const override { return pattern_; }
  Eigen::VectorXd lower() const override { return Eigen::VectorXd::Zero(rows()); }
  Eigen::VectorXd upper() const override {
    return Eigen::VectorXd::Constant(rows(), std::numeric_limits<double>::infinity());
  }
  void Evaluate(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> values) const override {
    values = program_.Slacks(x, nullptr);
  }
  void Jacobian(const Eigen::VectorXd& x, std::span<double> nonzeros) const override {
    Eigen::MatrixXd jacobian;
    program_.Slacks(x, &jacobian);
    for (size_t k = 0; k < nonzeros.size(); ++k) {
      nonzeros[k] = jacobian(pattern_.rows[k], pattern_.cols[k]);
    }
  }
  std::string RowName(int row) const override {
    return std::string(Name(static_cast<MarginFamily>(row % kNumMarginFamilies))) +
           " in half-step " + std::to_string(row / kNumMarginFamilies + 1);
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
  double Evaluate(const Eigen::VectorXd& x) const override { return program_.Duration(x); }
  void AddGradient(const Eigen::VectorXd& x, double weight,
                   Eigen::Ref<Eigen::VectorXd> gradient) const override {
    gradient += weight * program_.DurationGradient(x);
  }

 private:
  const OverlapProgram& program_;
};

}  // namespace

OverlapProgram::OverlapProgram(const HalfStepSequence& sequence, const MarginEvaluator& evaluator,
                               const ProgramOptions& options)
    : sequence_(sequence),
      evaluator_(evaluator),
      options_(options),
      planned_(PlannedMotion(sequence)) {
  for (const HomotopyParameter& parameter : AllParameters(sequence)) {
    if (parameter.family == Family::kOverlap ||
        (parameter.family == Family::kHeightScale && options.heights) ||
        (parameter.family == Family::kDuration && options.durations)) {
      variables_.push_back(parameter);
    }
  }
}

int OverlapProgram::IndexOf(const HomotopyParameter& parameter) const {
  const int overlaps = sequence_.num_junctions(), steps = sequence_.num_steps();
  switch (parameter.family) {
    case Family::kOverlap:
      return parameter.index;
    case Family::kHeightScale:
      return options_.heights ? overlaps + parameter.index : -1;
    case Family::kDuration:
      return options_.durations ? overlaps + (options_.heights ? steps : 0) + parameter.index : -1;
  }
  return -1;
}

OverlapProgram::Bound OverlapProgram::OverlapBound(int junction,
                                                   const std::vector<double>& durations) const {
  const size_t i = static_cast<size_t>(junction);
  double a = 1.0, b = 1.0;  // of T_i, of T_{i+1}
  if (KindOfJunction(junction) == JunctionKind::kUpDown) {
    a = 1.0 - sequence_.half_steps[i].half_step.shape.t2();
    b = sequence_.half_steps[i + 1].half_step.shape.t1();
  }
  const double u = a * durations[i], v = b * durations[i + 1];
  // (u + v)/2 − √((u − v)²/4 + ε²) ≤ min(u, v)
  const double half = 0.5 * (u - v);
  const double root = std::sqrt(half * half + kBoundSmoothing * kBoundSmoothing);
  return {0.5 * (u + v) - root, a * (0.5 - 0.5 * half / root), b * (0.5 + 0.5 * half / root)};
}

Eigen::VectorXd OverlapProgram::ToVariables(const HomotopyParameters& parameters) const {
  Eigen::VectorXd x(num_variables());
  HomotopyParameters copy = parameters;
  for (int v = 0; v < num_variables(); ++v) {
    const HomotopyParameter& parameter = variables_[static_cast<size_t>(v)];
    x[v] = parameter.in(copy);
    if (parameter.family == Family::kOverlap) {
      x[v] = std::clamp(x[v] / OverlapBound(parameter.index, parameters.durations).value, 0.0, 1.0);
    }
  }
  return x;
}

HomotopyParameters OverlapProgram::ToParameters(const Eigen::VectorXd& x) const {
  HomotopyParameters parameters = planned_;
  for (int v = num_variables() - 1; v >= 0; --v) {  // durations before the overlaps they bound
    const HomotopyParameter& parameter = variables_[static_cast<size_t>(v)];
    parameter.in(parameters) =
        parameter.family == Family::kOverlap
            ? std::clamp(x[v], 0.0, 1.0) * OverlapBound(parameter.index, parameters.durations).value
            : x[v];
  }
  return parameters;
}

double OverlapProgram::Duration(const Eigen::VectorXd& x) const {
  const HomotopyParameters parameters = ToParameters(x);
  double duration = 0.0;
  for (double T : parameters.durations) duration += T;
  for (double overlap : parameters.overlaps) duration -= overlap;
  return duration;
}

Eigen::VectorXd OverlapProgram::DurationGradient(const Eigen::VectorXd& x) const {
  const std::vector<double> durations = ToParameters(x).durations;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(num_variables());
  for (int i = 0; i < sequence_.size(); ++i) {
    const int T = IndexOf({Family::kDuration, i});
    if (T >= 0) gradient[T] += 1.0;
  }
  for (int i = 0; i < sequence_.num_junctions(); ++i) {
    const Bound bound = OverlapBound(i, durations);
    gradient[i] -= bound.value;
    const int before = IndexOf({Family::kDuration, i}), after = IndexOf({Family::kDuration, i + 1});
    if (before >= 0) gradient[before] -= x[i] * bound.before;
    if (after >= 0) gradient[after] -= x[i] * bound.after;
  }
  return gradient;
}

bool OverlapProgram::InBand(int row, int variable) const {
  const int half_step = row / kNumMarginFamilies;
  const HomotopyParameter& parameter = variables_[static_cast<size_t>(variable)];
  const int at = parameter.family == Family::kHeightScale ? 2 * parameter.index : parameter.index;
  return std::abs(at - half_step) <= kBand + 1;
}

void OverlapProgram::SlacksOfHalfStep(const Eigen::VectorXd& x, const SuperposedWalk& walk, int k,
                                      SlackEvaluator* slacks, Eigen::VectorXd* values,
                                      Eigen::MatrixXd* jacobian) const {
  const double rho = options_.sharpness;
  const bool last = k + 1 == walk.num_half_steps();
  const double stretch = (last ? walk.duration() : walk.start_of(k + 1)) - walk.start_of(k);
  std::array<double, kNumMarginFamilies> sums;
  sums.fill(std::exp(-rho * options_.cutoff));
  std::vector<Eigen::VectorXd> gradients(kNumMarginFamilies,
                                         Eigen::VectorXd::Zero(jacobian ? num_variables() : 0));
  InstantSlacks instant;
  for (int m = 0; m < options_.instants; ++m) {
    // The half-step's own stretch, until the next one begins: τ = u·(T_k − Δ_k).
    const double u = (m + 0.5) / options_.instants;
    std::vector<std::pair<HomotopyParameter, double>> moving = {{{Family::kDuration, k}, u}};
    if (!last) moving.push_back({{Family::kOverlap, k}, -u});
    slacks->At(walk, {k, u * stretch}, moving, jacobian != nullptr, &instant);
    for (size_t r = 0; r < instant.rows.size(); ++r) {
      const size_t family = static_cast<size_t>(instant.rows[r].family);
      const double weight = std::exp(-rho * std::max(instant.rows[r].slack, -10.0));
      sums[family] += weight;
      if (jacobian == nullptr) continue;
      for (size_t p = 0; p < instant.parameters.size(); ++p) {
        const double slope =
            weight * instant.gradient(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(p));
        const HomotopyParameter& parameter = instant.parameters[p];
        const int v = IndexOf(parameter);
        if (parameter.family != Family::kOverlap) {
          if (v >= 0) gradients[family][v] += slope;
          continue;
        }
        const Bound bound = OverlapBound(parameter.index, walk.parameters().durations);
        gradients[family][v] += slope * bound.value;
        const int before = IndexOf({Family::kDuration, parameter.index});
        const int after = IndexOf({Family::kDuration, parameter.index + 1});
        if (before >= 0) gradients[family][before] += slope * x[v] * bound.before;
        if (after >= 0) gradients[family][after] += slope * x[v] * bound.after;
      }
    }
  }
  for (size_t f = 0; f < kNumMarginFamilies; ++f) {
    const int row = k * kNumMarginFamilies + static_cast<int>(f);
    (*values)[row] = -std::log(sums[f]) / rho;
    if (jacobian) jacobian->row(row) = gradients[f].transpose() / sums[f];
  }
}

Eigen::VectorXd OverlapProgram::Slacks(const Eigen::VectorXd& x, Eigen::MatrixXd* jacobian) const {
  const SuperposedWalk walk(sequence_, ToParameters(x));
  SlackEvaluator slacks(evaluator_, options_.cutoff + 1.0);
  Eigen::VectorXd values(num_rows());
  if (jacobian) jacobian->setZero(num_rows(), num_variables());
  for (int k = 0; k < sequence_.size(); ++k) {
    SlacksOfHalfStep(x, walk, k, &slacks, &values, jacobian);
  }
  return values;
}

opt::Problem OverlapProgram::MakeProblem() const {
  opt::Problem problem;
  const auto add = [&](const char* name, const char* unit, size_t count, double initial,
                       double lower, double upper) {
    const Eigen::Index n = static_cast<Eigen::Index>(count);
    problem.AddVariables({.name = name,
                          .unit = unit,
                          .initial = Eigen::VectorXd::Constant(n, initial),
                          .lower = Eigen::VectorXd::Constant(n, lower),
                          .upper = Eigen::VectorXd::Constant(n, upper)});
  };
  add("overlap", "of its bound", planned_.overlaps.size(), 0.0, 0.0, 1.0);
  if (options_.heights) {
    add("height_scale", "", planned_.height_scales.size(), 1.0, options_.least_height_scale, 1.0);
  }
  if (options_.durations) {
    const Eigen::VectorXd planned = Eigen::Map<const Eigen::VectorXd>(
        planned_.durations.data(), static_cast<Eigen::Index>(planned_.durations.size()));
    problem.AddVariables({.name = "duration",
                          .unit = "s",
                          .initial = planned,
                          .lower = options_.least_duration * planned,
                          .upper = options_.most_duration * planned});
  }
  problem.AddConstraint(std::make_unique<SlackBlock>(*this));
  problem.AddCost(std::make_unique<DurationCost>(*this), 1.0);
  return problem;
}

}  // namespace halfstep
