#include "smoothing/program/overlap_costs.h"

#include <string>
#include <utility>

#include "smoothing/program/overlap_program.h"

namespace halfstep {
namespace {

using Family = HomotopyParameter::Family;

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

class RoughnessCost : public opt::CostTerm {
 public:
  explicit RoughnessCost(const OverlapProgram& program) : program_(program) {}
  std::string name() const override { return "roughness"; }
  std::string unit() const override { return "s"; }
  double Evaluate(const Eigen::VectorXd& x) const override {
    const SuperposedWalk walk(program_.variables().sequence(), program_.ToParameters(x));
    return WeightedRoughness(walk, program_.options().weights, nullptr);
  }
  void AddGradient(const Eigen::VectorXd& x, double weight,
                   Eigen::Ref<Eigen::VectorXd> gradient) const override {
    const SuperposedWalk walk(program_.variables().sequence(), program_.ToParameters(x));
    ParameterGradient slopes;
    WeightedRoughness(walk, program_.options().weights, &slopes);
    gradient += weight * Pulled(program_.variables(), slopes, x);
  }

 private:
  const OverlapProgram& program_;
};

class OwnCost : public opt::CostTerm {
 public:
  OwnCost(const OverlapProgram& program, std::shared_ptr<const WalkCost> cost)
      : program_(program), cost_(std::move(cost)) {}
  std::string name() const override { return cost_->name(); }
  std::string unit() const override { return "1/(" + cost_->unit() + ") s"; }
  double Evaluate(const Eigen::VectorXd& x) const override {
    return cost_->Evaluate(WalkAt(x), nullptr);
  }
  void AddGradient(const Eigen::VectorXd& x, double weight,
                   Eigen::Ref<Eigen::VectorXd> gradient) const override {
    ParameterGradient slopes;
    cost_->Evaluate(WalkAt(x), &slopes);
    gradient += weight * Pulled(program_.variables(), slopes, x);
  }

 private:
  SuperposedWalk WalkAt(const Eigen::VectorXd& x) const {
    return {program_.variables().sequence(), program_.ToParameters(x)};
  }

  const OverlapProgram& program_;
  const std::shared_ptr<const WalkCost> cost_;
};

class LeastSlackCost : public opt::CostTerm {
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
  const HomotopyParameters at = variables.ToParameters(x);
  Eigen::VectorXd pulled = Eigen::VectorXd::Zero(x.size());
  for (const auto& [parameter, slope] : gradient) {
    variables.Pull(parameter, slope, x, at,
                   [&](int variable, double value) { pulled[variable] += value; });
  }
  return pulled;
}

std::unique_ptr<opt::CostTerm> MakeDurationCost(const OverlapProgram& program) {
  return std::make_unique<DurationCost>(program);
}

std::unique_ptr<opt::CostTerm> MakeRoughnessCost(const OverlapProgram& program) {
  return std::make_unique<RoughnessCost>(program);
}

std::unique_ptr<opt::CostTerm> MakeOwnCost(const OverlapProgram& program,
                                           std::shared_ptr<const WalkCost> cost) {
  return std::make_unique<OwnCost>(program, std::move(cost));
}

std::unique_ptr<opt::CostTerm> MakeLeastSlackCost() { return std::make_unique<LeastSlackCost>(); }

}  // namespace halfstep
