#include "smoothing/program/overlap_rows.h"

#include <limits>
#include <string>
#include <vector>

#include "smoothing/program/overlap_costs.h"
#include "smoothing/program/overlap_program.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

class SlackBlock : public opt::ConstraintBlock {
 public:
  explicit SlackBlock(const OverlapProgram& program) : program_(program) {
    const int z = program.variables().size();
    raises_ = program.options().kind == ProgramKind::kSafest;
    for (int row = 0; row < rows(); ++row) {
      for (int variable : program.watched().band(program.watched().half_step_of(row))) {
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
  int rows() const override { return program_.watched().rows(); }
  const opt::SparsityPattern& pattern() const override { return pattern_; }
  Eigen::VectorXd lower() const override { return Eigen::VectorXd::Zero(rows()); }
  Eigen::VectorXd upper() const override {
    return Eigen::VectorXd::Constant(rows(), std::numeric_limits<double>::infinity());
  }
  void Evaluate(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> values) const override {
    Eigen::VectorXd slacks;
    program_.watched().Evaluate(x, &slacks, nullptr);
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
    program_.watched().Evaluate(x, &slacks, &band);
    values = Lowered(slacks, x);
    size_t from = 0, to = 0;
    for (int row = 0; row < rows(); ++row) {
      const size_t width = program_.watched().band(program_.watched().half_step_of(row)).size();
      for (size_t c = 0; c < width; ++c) nonzeros[to++] = band[from++];
      if (raises_ && IsRaised(row)) nonzeros[to++] = -1.0;
    }
  }
  std::string RowName(int row) const override {
    return std::string(Name(program_.watched().family_of(row))) + " in half-step " +
           std::to_string(program_.watched().half_step_of(row) + 1);
  }

 private:
  bool IsRaised(int row) const { return Traits(program_.watched().family_of(row)).raised; }

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

// `safest`: D stays within its limit, by a little more than solvers exceed their rows.
class DurationRow : public opt::ConstraintBlock {
 public:
  explicit DurationRow(const OverlapProgram& program) : program_(program) {
    const OverlapVariables& variables = program.variables();
    std::vector<bool> met(static_cast<size_t>(variables.size()));
    const HomotopyParameters start = variables.table().Start();
    const Eigen::VectorXd x = variables.ToVariables(start);
    for (const auto& [parameter, slope] : DurationGradient(variables.sequence())) {
      variables.Pull(parameter, slope, x, start,
                     [&met](int variable, double) { Nth(met, variable) = true; });
    }
    for (int v = 0; v < variables.size(); ++v) {
      if (!Nth(met, v)) continue;
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

}  // namespace

std::unique_ptr<opt::ConstraintBlock> MakeSlackRows(const OverlapProgram& program) {
  return std::make_unique<SlackBlock>(program);
}

std::unique_ptr<opt::ConstraintBlock> MakeDurationRow(const OverlapProgram& program) {
  return std::make_unique<DurationRow>(program);
}

}  // namespace halfstep
