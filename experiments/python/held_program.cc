#include "experiments/python/held_program.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "smoothing/proof/stretch_proofs.h"
#include "wpg/nth.h"

namespace halfstep::python {
namespace {

constexpr double kWatchEvery = 0.005;  // [s]
// As in smoothing/methods/overlap_optimizer.cc.
constexpr double kSharper = 1.5, kSofter = 0.75, kMostSharp = 3000.0;
// A solver's step over a simple bound that counts as rounding.
constexpr double kRounding = 1e-6;

std::vector<FixedParameter> FixedBy(const WalkSetting& setting, bool overlaps) {
  std::vector<FixedParameter> fixed = setting.problem.fixed();
  if (overlaps) return fixed;
  const HomotopyParameters start = setting.problem.Start();
  std::erase_if(fixed, [](const FixedParameter& f) {
    return f.parameter.family == ParameterFamily::kOverlap;
  });
  for (int i = 0; i < setting.problem.sequence().num_junctions(); ++i) {
    fixed.push_back({{ParameterFamily::kOverlap, i}, Nth(start.overlaps, i)});
  }
  return fixed;
}

ProgramOptions Watching(const WalkSetting& setting, ProgramOptions options) {
  options.watch.stop_branches = setting.problem.test().stop_branches();
  return options;
}

}  // namespace

HeldProgram::Use::Use(std::atomic<bool>* taken) : taken_(taken) {
  if (taken_->exchange(true)) {
    throw std::invalid_argument("the program is in use by another thread (valid: one for each)");
  }
}

HeldProgram::HeldProgram(std::shared_ptr<const WalkSetting> setting,
                         const HeldProgramOptions& options)
    : setting_(std::move(setting)),
      program_(setting_->problem.sequence(), setting_->problem.evaluator(),
               Watching(*setting_, options.program),
               options.duration_limit > 0.0 ? options.duration_limit
                                            : DurationOf(setting_->problem.Start()),
               FixedBy(*setting_, options.overlaps)) {
  problem_.emplace(program_.MakeProblem());
}

void HeldProgram::Forget() {
  at_.resize(0);
  constraints_.reset();
  jacobian_.reset();
}

Eigen::VectorXd HeldProgram::Within(const Eigen::VectorXd& x) const {
  const int n = problem_->num_variables();
  if (x.size() != n) {
    throw std::invalid_argument("x: " + std::to_string(x.size()) +
                                " numbers (valid: " + std::to_string(n) + ")");
  }
  if (!x.allFinite()) throw std::invalid_argument("x: not finite (valid: finite numbers)");
  return x.cwiseMax(problem_->lower()).cwiseMin(problem_->upper());
}

double HeldProgram::Cost(const Eigen::VectorXd& x) {
  const Eigen::VectorXd within = Within(x);
  const double cost = problem_->Cost(within);
  return within == x ? cost : cost + problem_->Gradient(within).dot(x - within);
}

Eigen::VectorXd HeldProgram::Gradient(const Eigen::VectorXd& x) {
  return problem_->Gradient(Within(x));
}

void HeldProgram::MoveTo(const Eigen::VectorXd& x) {
  const bool known = constraints_ || jacobian_;
  if (known && at_.size() == x.size() && at_ == x) return;
  Forget();
  within_ = Within(x);
  at_ = x;
}

void HeldProgram::EvaluateWithJacobian() {
  std::vector<double> nonzeros;
  Eigen::VectorXd values = problem_->ConstraintsWithJacobian(within_, &nonzeros);
  const opt::SparsityPattern& pattern = problem_->pattern();
  const Eigen::VectorXd beyond = at_ - within_;
  for (size_t k = 0; k < nonzeros.size(); ++k) {
    values[pattern.rows[k]] += nonzeros[k] * beyond[pattern.cols[k]];
  }
  constraints_ = std::move(values);
  jacobian_ = std::move(nonzeros);
}

const Eigen::VectorXd& HeldProgram::Constraints(const Eigen::VectorXd& x) {
  MoveTo(x);
  if (!constraints_) {
    if (within_ == at_) {
      constraints_ = problem_->Constraints(within_);
    } else {
      EvaluateWithJacobian();
    }
  }
  return *constraints_;
}

const std::vector<double>& HeldProgram::Jacobian(const Eigen::VectorXd& x) {
  MoveTo(x);
  if (!jacobian_) EvaluateWithJacobian();
  return *jacobian_;
}

HomotopyParameters HeldProgram::ToParameters(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd within = Within(x);
  for (int i = 0; i < problem_->num_variables(); ++i) {
    const double least = problem_->lower()[i], most = problem_->upper()[i];
    if (std::abs(x[i] - within[i]) <= kRounding * std::max(1.0, most - least)) continue;
    throw std::invalid_argument("x: " + problem_->VariableName(i) + " is " + std::to_string(x[i]) +
                                " (valid: " + std::to_string(least) + " … " + std::to_string(most) +
                                ")");
  }
  return program_.ToParameters(within);
}

void HeldProgram::SetSharpness(double sharpness) {
  program_.watched().SetSharpness(sharpness);
  Forget();
}

Refinement HeldProgram::Refine(const Eigen::VectorXd& x, const std::stop_token& stop) {
  const WalkProblem& walk_problem = setting_->problem;
  const bool safest = program_.options().kind == ProgramKind::kSafest;
  const SuperposedWalk walk(walk_problem.sequence(), ToParameters(x));
  Refinement result;
  const std::vector<double> least =
      program_.watched().Focus(walk, kWatchEvery, safest ? std::max(0.0, x.tail(1)[0]) : 0.0);
  result.least_slack = *std::ranges::min_element(least);
  MarginEvaluator::Scratch scratch = walk_problem.evaluator().MakeScratch();
  scratch.stop = stop;
  StretchProofs proofs(walk_problem.test(), walk_problem.sequence().size());
  const std::vector<Margin> refusals = proofs.Refusals(walk, &scratch);
  for (const Margin& refusal : refusals) {
    program_.watched().Learn(walk, refusal.at, refusal.stop_after >= 0);
  }
  result.proved = refusals.empty();
  if (!result.proved) result.sentence = walk_problem.evaluator().Describe(refusals.front());
  program_.watched().SetSharpness(
      std::min(kMostSharp, (result.proved ? kSharper : kSofter) * program_.watched().sharpness()));
  problem_.emplace(program_.MakeProblem());
  Forget();
  return result;
}

}  // namespace halfstep::python
