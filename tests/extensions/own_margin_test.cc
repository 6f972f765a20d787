// A margin of one's own is demanded, proved and followed as those that are built in.

#include "smoothing/margins/own_margin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/run/smoothing_of.h"
#include "opt/problem/derivative_check.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/program/overlap_program.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/extensions/com_speed.h"
#include "tests/places.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

double FastestCom(const SuperposedWalk& walk) {
  double fastest = 0.0;
  for (double t = 0.0; t < walk.duration(); t += 1e-3) {
    fastest = std::max(fastest, walk.At(t).first.segment<2>(kComX).norm());
  }
  return fastest;
}

Methods WithComSpeed() {
  Methods methods = Methods::Standard();
  methods.AddMargin(std::make_shared<ComSpeedStatement>());
  return methods;
}

ExperimentConfig Load(const std::vector<YamlOverride>& overrides, const Methods& methods) {
  return LoadConfig(InSources("experiments/configs/fig3_two_half_steps.yaml"), overrides,
                    {methods});
}

class OwnMarginTest : public testing::Test {
 protected:
  Experiment experiment_ = Prepare(Load({}, WithComSpeed()));
  WalkProblem problem_ = ProblemOf(experiment_);

  SmoothingResult Smoothed(const std::string& method) const {
    SmoothingMonitor monitor;
    return Methods::Standard().Find(method).Smooth(problem_, experiment_.config.smoothing.options,
                                                   monitor);
  }
};

TEST_F(OwnMarginTest, HoldsForEveryWalkThatIsFound) {
  for (const char* method : {"dichotomy", "halfstep/sqp"}) {
    const SmoothingResult result = Smoothed(method);
    ASSERT_TRUE(result.feasible) << result.message;
    const SuperposedWalk walk(problem_.sequence(), result.parameters);
    EXPECT_LE(FastestCom(walk), kComSpeedLimit) << method;
    EXPECT_GT(FastestCom(walk), 0.9 * kComSpeedLimit) << method << ": it does not matter";
  }
}

TEST_F(OwnMarginTest, HasItsRowsInTheCertificate) {
  const SuperposedWalk walk(problem_.sequence(), Smoothed("dichotomy").parameters);
  const CertifiedFeasibility certifier(problem_.evaluator(), {});
  MarginEvaluator::Scratch scratch = problem_.evaluator().MakeScratch();
  Certificate certificate;
  ASSERT_EQ(certifier.Certify(walk, &scratch, &certificate).verdict, Verdict::kFeasible);
  double covered = 0.0;
  for (const CertificateRow& row : certificate) {
    if (row.family != MarginFamily::kOwn) continue;
    covered += row.end - row.begin;
    EXPECT_EQ(row.count, 1);
    EXPECT_GE(row.margin.value - row.bound, 0.0);
  }
  EXPECT_NEAR(covered, walk.duration(), 1e-9);
}

TEST_F(OwnMarginTest, IsRefusedByNameWhenMoreIsDemanded) {
  experiment_.config.smoothing.limits.demanded_of(MarginFamily::kOwn) = 2.4;  // 0.01 m/s are left
  const WalkProblem strict = ProblemOf(experiment_);
  MarginEvaluator::Scratch scratch = strict.evaluator().MakeScratch();
  const SuperposedWalk walk(strict.sequence(), strict.Start());
  const Feasibility answer = strict.test().Check(walk, {0.0, walk.duration()}, &scratch);
  EXPECT_EQ(answer.verdict, Verdict::kViolated);
  EXPECT_THAT(strict.evaluator().Describe(answer.witness),
              testing::HasSubstr("own of CoM's speed"));
}

TEST_F(OwnMarginTest, RowsHaveItsDerivatives) {
  ProgramOptions options;
  options.parameters.durations = true;
  const OverlapProgram program(problem_.sequence(), problem_.evaluator(), options, 0.0);
  const opt::Problem problem = program.MakeProblem();
  Eigen::VectorXd x = program.ToVariables(problem_.Start());
  x = 0.5 * x + 0.5 * (0.7 * problem.lower() + 0.3 * problem.upper());
  const auto rows = [&](const Eigen::VectorXd& at) { return problem.Constraints(at); };
  Eigen::MatrixXd jacobian = problem.DenseJacobian(x);
  EXPECT_TRUE(CheckJacobian(rows, x, jacobian, 1e-5).Passed(1e-5))
      << CheckJacobian(rows, x, jacobian, 1e-5).Describe();
  bool there = false;
  for (int row = 0; row < problem.num_constraints(); ++row) {
    if (problem.RowName(row).find("own") == std::string::npos) continue;
    there = true;
    if (jacobian.row(row).norm() < 1e-6) continue;
    Eigen::MatrixXd wrong = jacobian;  // the check would see it
    wrong.row(row) *= 1.1;
    EXPECT_FALSE(CheckJacobian(rows, x, wrong, 1e-5).Passed(1e-5));
  }
  EXPECT_TRUE(there);
}

TEST_F(OwnMarginTest, IsThereOnlyForThoseWhoAddIt) {
  const std::vector<YamlOverride> demanded = {{"smoothing.margins.own", "2"}};
  EXPECT_EQ(Load(demanded, WithComSpeed()).smoothing.limits.demanded_of(MarginFamily::kOwn), 2.0);
  EXPECT_THROW(Load(demanded, Methods::Standard()), InputError);
  const WalkProblem without = ProblemOf(Prepare(Load({}, Methods::Standard())));
  EXPECT_THAT(without.evaluator().families(), testing::Not(testing::Contains(MarginFamily::kOwn)));
  EXPECT_THAT(problem_.evaluator().families(), testing::Contains(MarginFamily::kOwn));
  const MarginEvaluator other = problem_.evaluator().WithLimits({});  // stays what it judges
  EXPECT_EQ(other.limits().own.size(), 1u);
}

}  // namespace
}  // namespace halfstep
