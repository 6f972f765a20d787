// What a program adds is named in configs beside what is built in.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "experiments/config/experiment_config.h"
#include "experiments/run/smoothing_of.h"
#include "opt/adapters/function_solver.h"
#include "opt/adapters/solver_registry.h"
#include "opt/problem/derivative_check.h"
#include "planner/search/planners.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/program/overlap_program.h"
#include "smoothing/program/walk_cost.h"
#include "tests/places.h"
#include "tests/scenarios/load_experiment.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

class PlanAsItIs : public Smoother {
 public:
  explicit PlanAsItIs(std::string meaning) : meaning_(std::move(meaning)) {}
  std::string name() const override { return "mine/plan"; }
  std::string meaning() const override { return meaning_; }
  SmoothingResult Smooth(const WalkProblem& problem, const MethodOptions&,
                         SmoothingMonitor& monitor) const override {
    if (!monitor.BeginFeasibly(problem, problem.Start())) return monitor.Refusal();
    return monitor.Finish(opt::Ending::kConverged, "the plan");
  }

 private:
  const std::string meaning_;
};

ExperimentConfig WithOptions(const std::vector<YamlOverride>& overrides,
                             const Methods& methods = Methods::Standard()) {
  return LoadConfig(InSources("experiments/configs/fig3_two_half_steps.yaml"), overrides,
                    {methods});
}

TEST(OwnMethods, AreNamedByConfigs) {
  EXPECT_THROW(WithOptions({{"smoothing.methods", "[mine/plan]"}}), InputError);
  Methods methods = Methods::Standard();
  methods.Add(std::make_shared<PlanAsItIs>("first"));
  const Experiment experiment =
      Prepare(WithOptions({{"smoothing.methods", "[mine/plan]"}}, methods));
  SmoothingMonitor monitor;
  const SmoothingResult result =
      methods.Find("mine/plan")
          .Smooth(ProblemOf(experiment), experiment.config.smoothing.options, monitor);
  EXPECT_EQ(result.message, "the plan");
  methods.Add(std::make_shared<PlanAsItIs>("second"));
  EXPECT_EQ(methods.Find("mine/plan").meaning(), "second");
  EXPECT_EQ(experiment.config.smoothing.known.Find("mine/plan").meaning(), "first");
  EXPECT_EQ(std::ranges::count(methods.Names(), "mine/plan"), 1);
  EXPECT_EQ(std::ranges::count(Methods::Standard().Names(), "mine/plan"), 0);
}

class Dichotomous : public PlanAsItIs {
 public:
  using PlanAsItIs::PlanAsItIs;
  std::string name() const override { return "dichotomy"; }
};

TEST(OwnMethods, HaveNoNameOfOneThatIsBuiltIn) {
  Methods methods = Methods::Standard();
  EXPECT_THROW(methods.Add(std::make_shared<Dichotomous>("")), std::invalid_argument);
  EXPECT_EQ(methods.Names(), Methods::Standard().Names());
}

TEST(OwnSolver, IsAMethod) {
  const auto make = [] {
    return opt::MakeFunctionSolver(
        "mine/stay", [](opt::SolveMonitor&, const Eigen::VectorXd& x0) { return x0; });
  };
  Methods methods = Methods::Standard();
  methods.AddSolver(make());
  methods.AddSolver(make());
  EXPECT_EQ(methods.own_solvers().size(), 1u);
  EXPECT_EQ(std::ranges::count(methods.Names(), "mine/stay"), 1);
  const Experiment experiment = Prepare(WithOptions(
      {{"smoothing.methods", "[mine/stay]"}, {"smoothing.optimizer.start", "dichotomy"}}, methods));
  SmoothingMonitor monitor;
  const SmoothingResult result =
      methods.Find("mine/stay")
          .Smooth(ProblemOf(experiment), experiment.config.smoothing.options, monitor);
  EXPECT_TRUE(result.feasible);
  EXPECT_EQ(result.ending, opt::Ending::kNoImprovement);
  for (const std::string& built_in : opt::SolverNames()) {
    EXPECT_THROW(methods.AddSolver(opt::MakeSolver(built_in)), std::invalid_argument) << built_in;
  }
}

TEST(OwnSolver, WhatThrowsIsToldAndNotBelieved) {
  const auto solver = opt::MakeFunctionSolver(
      "mine/throws", [](opt::SolveMonitor&, const Eigen::VectorXd&) -> Eigen::VectorXd {
        throw std::runtime_error("no more");
      });
  opt::Problem problem;
  problem.AddVariables({.name = "x",
                        .unit = "",
                        .initial = Eigen::VectorXd::Zero(1),
                        .lower = Eigen::VectorXd::Constant(1, -1),
                        .upper = Eigen::VectorXd::Constant(1, 1)});
  const opt::Solution solution = solver->Solve(problem, Eigen::VectorXd::Zero(1), {});
  EXPECT_THAT(solution.message, HasSubstr("no more"));
}

class NoPlan : public FootstepPlanner {
 public:
  PlanResult Plan(const PlanRequest&, std::mt19937_64&) const override {
    PlanResult result;
    result.status = PlanStatus::kNoPlan;
    result.sentence = "mine finds none";
    return result;
  }
};

TEST(OwnPlanner, IsNamedByConfigs) {
  const PlannerFactory make = [](const Scene&, const PlannerOptions&) {
    return std::make_unique<NoPlan>();
  };
  Planners planners = Planners::Standard();
  EXPECT_THROW(planners.Add({"rrt", "", make}), std::invalid_argument);
  planners.Add({"mine/none", "first", make});
  planners.Add({"mine/none", "second", make});
  EXPECT_EQ(std::ranges::count(planners.Names(), "mine/none"), 1);
  EXPECT_EQ(planners.all().back().meaning, "second");
  EXPECT_NE(dynamic_cast<NoPlan*>(planners.Make("mine/none", {}).get()), nullptr);
  EXPECT_THROW(planners.Make("mine/other", {}), std::logic_error);
  EXPECT_EQ(std::ranges::count(Planners::Standard().Names(), "mine/none"), 0);

  const std::string config = InSources("experiments/configs/plan_bar_8cm.yaml");
  const std::vector<YamlOverride> named = {{"planner.name", "mine/none"}};
  EXPECT_THROW(LoadConfig(config, named), InputError);
  const PlannerConfig planner = LoadConfig(config, named, {.planners = planners}).planner;
  EXPECT_NE(dynamic_cast<NoPlan*>(planner.known.Make(planner.name, {}).get()), nullptr);
}

// Σ T², so that a long half-step costs more than two short ones.
class LongHalfSteps : public WalkCost {
 public:
  std::string name() const override { return "long_half_steps"; }
  std::string meaning() const override { return "of Σ T²"; }
  std::string unit() const override { return "1/s"; }
  double Evaluate(const SuperposedWalk& walk, ParameterGradient* gradient) const override {
    double sum = 0.0;
    for (int i = 0; i < walk.num_half_steps(); ++i) {
      const double T = walk.parameters().durations[static_cast<size_t>(i)];
      sum += T * T;
      if (gradient) gradient->push_back({{ParameterFamily::kDuration, i}, 2.0 * T});
    }
    return sum;
  }
};

TEST(OwnCosts, AreWeightsOfTheProgramSmooth) {
  const std::vector<YamlOverride> weighed = {{"smoothing.optimizer.program", "smooth"},
                                             {"smoothing.optimizer.durations", "true"},
                                             {"smoothing.optimizer.weights.long_half_steps", "3"}};
  EXPECT_THROW(WithOptions(weighed), InputError);
  Methods methods = Methods::Standard();
  methods.AddCost(std::make_shared<LongHalfSteps>());
  methods.AddCost(std::make_shared<LongHalfSteps>());
  EXPECT_EQ(methods.own_costs().size(), 1u);
  EXPECT_EQ(WithOptions({}, methods)
                .smoothing.options.Get(OptimizerGroup())
                .options.program.own_costs.front()
                .weight,
            0.0);
  const Experiment experiment = Prepare(WithOptions(weighed, methods));
  const WalkProblem walk = ProblemOf(experiment);
  const ProgramOptions options =
      experiment.config.smoothing.options.Get(OptimizerGroup()).options.program;
  const OverlapProgram program(walk.sequence(), walk.evaluator(), options, 0.0);
  ProgramOptions without = options;
  without.own_costs.clear();
  const OverlapProgram plain(walk.sequence(), walk.evaluator(), without, 0.0);
  const HomotopyParameters start = walk.Start();
  EXPECT_NEAR(program.Cost(start) - plain.Cost(start),
              3.0 * LongHalfSteps().Evaluate(SuperposedWalk(walk.sequence(), start), nullptr),
              1e-12);

  const opt::Problem problem = program.MakeProblem();
  const Eigen::VectorXd x = 0.6 * problem.lower() + 0.4 * problem.upper();
  const auto cost = [&](const Eigen::VectorXd& at) {
    return Eigen::VectorXd::Constant(1, problem.Cost(at));
  };
  const Eigen::MatrixXd gradient = problem.Gradient(x).transpose();
  EXPECT_TRUE(CheckJacobian(cost, x, gradient).Passed(1e-7));
  EXPECT_FALSE(CheckJacobian(cost, x, 1.01 * gradient).Passed(1e-7));

  // A config that is written and read back keeps it.
  ExperimentConfig written = experiment.config;
  const std::string text = WriteYaml([&](Fields& fields) { DeclareFields(fields, &written); });
  EXPECT_THAT(text, HasSubstr("long_half_steps: 3"));
}

}  // namespace
}  // namespace halfstep
