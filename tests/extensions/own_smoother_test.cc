// What a method of a user's own says is believed no further than it was judged.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <concepts>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "experiments/run/complete_manifest.h"
#include "experiments/run/experiment_run.h"
#include "experiments/run/smoothing_of.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/run_smoother.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/places.h"
#include "tests/scenarios/load_experiment.h"
#include "wpg/files/input_error.h"
#include "wpg/files/regular_file.h"

namespace halfstep {
namespace {

using nlohmann::json;
using opt::Ending;
using testing::AllOf;
using testing::HasSubstr;

using Search = std::function<SmoothingResult(const WalkProblem&, SmoothingMonitor&)>;

class Own : public Smoother {
 public:
  Own(std::string name, Search search) : name_(std::move(name)), search_(std::move(search)) {}
  std::string name() const override { return name_; }
  std::string meaning() const override { return "of a test"; }
  SmoothingResult Smooth(const WalkProblem& problem, const MethodOptions&,
                         SmoothingMonitor& monitor) const override {
    return search_(problem, monitor);
  }

 private:
  const std::string name_;
  const Search search_;
};

// Overlaps at their natural bounds: far from feasible.
HomotopyParameters Bold(const WalkProblem& problem) {
  HomotopyParameters bold = problem.Start();
  for (int i = 0; i < problem.sequence().num_junctions(); ++i) {
    bold.overlaps[static_cast<size_t>(i)] = NaturalOverlapBound(bold, i);
  }
  return bold;
}

// Says of an infeasible walk that it is feasible, in every field that it can write.
SmoothingResult Lie(const WalkProblem& problem, SmoothingMonitor& monitor) {
  EXPECT_TRUE(monitor.BeginFeasibly(problem, problem.Start()));
  monitor.result().parameters = Bold(problem);
  monitor.result().feasible = true;
  SmoothingResult result = monitor.Finish(Ending::kConverged, "trust me");
  EXPECT_EQ(result.parameters, problem.Start());  // the monitor has its own
  result.parameters = Bold(problem);
  result.feasible = true;
  return result;
}

// Has an infeasible walk accepted by a test that demands nothing of it.
SmoothingResult AskALaxTest(const WalkProblem& problem, SmoothingMonitor& monitor) {
  MarginLimits lax = problem.limits();
  for (const MarginFamily family : AllMarginFamilies()) lax.demanded_of(family) = -1e9;
  const WalkProblem other(problem.sequence(),
                          problem.test().Over(problem.evaluator().WithLimits(lax)));
  EXPECT_TRUE(monitor.BeginFeasibly(other, problem.Start()));
  EXPECT_TRUE(monitor.Propose(Bold(problem)));
  return monitor.Finish(Ending::kConverged, "proved, in a way");
}

SmoothingResult RunOf(const Search& search) {
  static const WalkProblem problem = ProblemOf(LoadExperiment("fig3_two_half_steps"));
  SmoothingMonitor monitor;
  return RunSmoother(Own("mine/own", search), problem, {}, monitor);
}

template <typename Walk>
concept Adoptable = requires(SmoothingMonitor monitor, Walk walk) {
  monitor.Adopt(walk, 1.0, 1.0);
};

TEST(OwnSmoother, HasNoWayToAdoptAWalkThatNobodyJudged) {
  static_assert(Adoptable<AcceptedWalk>);
  static_assert(!Adoptable<HomotopyParameters>);
  static_assert(!std::is_constructible_v<AcceptedWalk, HomotopyParameters>);
  static_assert(!std::is_default_constructible_v<AcceptedWalk>);
}

TEST(OwnSmoother, ProposesAndOnlyWhatIsProvedCounts) {
  const SmoothingResult result = RunOf([](const WalkProblem& problem, SmoothingMonitor& monitor) {
    EXPECT_TRUE(monitor.BeginFeasibly(problem, problem.Start()));
    EXPECT_FALSE(monitor.Propose(Bold(problem)));
    HomotopyParameters near = problem.Start();
    near.overlaps[0] = 0.1;
    EXPECT_TRUE(monitor.Propose(near));
    EXPECT_FALSE(monitor.Propose(problem.Start())) << "it is longer";
    near.overlaps[0] = 1e3;
    EXPECT_THROW((void)monitor.Propose(near), std::logic_error);
    return monitor.Finish(Ending::kConverged, "done");
  });
  EXPECT_EQ(result.ending, Ending::kConverged) << result.message;
  EXPECT_TRUE(result.feasible);
  EXPECT_DOUBLE_EQ(result.cost, 3.9);
  ASSERT_EQ(result.iterates.size(), 3u);
  EXPECT_TRUE(result.iterates[0].candidate_worst_margin);
  EXPECT_TRUE(result.iterates[1].accepted);
}

TEST(OwnSmoother, MayNotMoveWhatTheProblemFixes) {
  const Experiment experiment = LoadExperiment("fig3_two_half_steps");
  const std::vector<FixedParameter> fixed = {{{ParameterFamily::kOverlap, 0}, 0.05}};
  const WalkProblem whole = ProblemOf(experiment);
  const WalkProblem problem(experiment.sequence, whole.test().Over(whole.evaluator()), fixed);
  SmoothingMonitor monitor;
  const SmoothingResult result =
      RunSmoother(Own("mine/own",
                      [](const WalkProblem& given, SmoothingMonitor& within) {
                        EXPECT_TRUE(within.BeginFeasibly(given, given.Start()));
                        HomotopyParameters moved = given.Start();
                        moved.overlaps[0] = 0.1;
                        (void)within.Propose(moved);
                        return within.Finish(Ending::kConverged, "moved");
                      }),
                  problem, {}, monitor);
  EXPECT_EQ(result.ending, Ending::kFailed);
  EXPECT_THAT(result.message, HasSubstr("overlaps[0]: 0.1"));
  EXPECT_EQ(result.parameters.overlaps[0], 0.05);
}

TEST(OwnSmoother, AWalkThatItReturnsUnjudgedIsJudged) {
  const SmoothingResult result = RunOf(Lie);
  EXPECT_EQ(result.ending, Ending::kFailed);
  EXPECT_FALSE(result.feasible);
  EXPECT_FALSE(result.accepted);
  EXPECT_THAT(result.message,
              AllOf(HasSubstr("returned as converged is violated: "), HasSubstr("trust me")));
}

TEST(OwnSmoother, WhatIsNoWalkAtAllIsTheStart) {
  const SmoothingResult result = RunOf([](const WalkProblem&, SmoothingMonitor&) {
    SmoothingResult nothing;
    nothing.ending = Ending::kConverged;
    nothing.feasible = true;
    return nothing;
  });
  EXPECT_EQ(result.ending, Ending::kFailed);
  EXPECT_THAT(result.message, HasSubstr("no walk of this plan"));
  EXPECT_EQ(DurationOf(result.parameters), 4.0);
}

TEST(OwnSmoother, ThatThrowsKeepsWhatWasAccepted) {
  const SmoothingResult result =
      RunOf([](const WalkProblem& problem, SmoothingMonitor& monitor) -> SmoothingResult {
        const WalkProblem its_own = problem;  // gone when it has thrown
        EXPECT_TRUE(monitor.BeginFeasibly(its_own, its_own.Start()));
        HomotopyParameters near = its_own.Start();
        near.overlaps[0] = 0.1;
        EXPECT_TRUE(monitor.Propose(near));
        throw std::runtime_error("no more");
      });
  EXPECT_EQ(result.ending, Ending::kFailed);
  EXPECT_EQ(result.message, "it threw: no more");
  EXPECT_TRUE(result.feasible);
  EXPECT_DOUBLE_EQ(DurationOf(result.parameters), 3.9);
  const SmoothingResult at_once =
      RunOf([](const WalkProblem&, SmoothingMonitor&) -> SmoothingResult { throw 3; });
  EXPECT_EQ(at_once.ending, Ending::kFailed);
  EXPECT_EQ(DurationOf(at_once.parameters), 4.0);
  EXPECT_THROW(RunOf([](const WalkProblem&, SmoothingMonitor&) -> SmoothingResult {
                 throw InputError({"a key is wrong"});
               }),
               InputError);
}

// The whole of a run: what it writes of liars and of those that throw, beside what works.
TEST(OwnSmoother, ALieOrAnExceptionShowsInTheRunAndTheOthersAreWritten) {
  Methods methods = Methods::Standard();
  methods.Add(std::make_shared<Own>("mine/lies", Lie));
  methods.Add(std::make_shared<Own>("mine/lax", AskALaxTest));
  methods.Add(std::make_shared<Own>("mine/throws",
                                    [](const WalkProblem&, SmoothingMonitor&) -> SmoothingResult {
                                      throw std::runtime_error("no more");
                                    }));
  const std::string config = InSources("experiments/configs/fig3_two_half_steps.yaml");
  const RunHooks hooks{.progress = [](const std::string&, double) {}, .stop = {}};
  ExperimentRun run(
      LoadConfig(config, {{"smoothing.methods", "[mine/throws, mine/lies, mine/lax, dichotomy]"}},
                 {methods}),
      hooks);
  run.Smooth(hooks);
  run.Certify({});
  const std::filesystem::path place = testing::TempDir() + "/own_smoother_run";
  RunFolder folder(place, /*overwrite=*/true);
  run.Write(&folder);
  CompleteManifest(run.experiment().robot, run.experiment().scene, &folder);
  folder.Publish();

  const json manifest = json::parse(ReadRegularFile((place / "manifest.json").string(), 1 << 20));
  const std::vector<std::vector<std::string>> expected = {{"raw", "converged", "certified"},
                                                          {"mine/throws", "failed", "certified"},
                                                          {"mine/lies", "failed", "violated"},
                                                          {"mine/lax", "failed", "violated"},
                                                          {"dichotomy", "converged", "certified"}};
  ASSERT_EQ(manifest["methods"].size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    const json& method = manifest["methods"][i];
    SCOPED_TRACE(method.dump());
    EXPECT_EQ(method["name"], expected[i][0]);
    EXPECT_EQ(method["status"], expected[i][1]);
    EXPECT_EQ(method["verdict"], expected[i][2]);
    EXPECT_EQ(method["judged_by"], "certified");
    EXPECT_FALSE(method.contains("evidence"));
  }
  EXPECT_THAT(manifest["methods"][3]["message"].get<std::string>(),
              AllOf(HasSubstr("is violated: "), HasSubstr("proved, in a way")));
  for (const char* method : {"mine_throws", "mine_lies", "mine_lax", "dichotomy"}) {
    EXPECT_TRUE(std::filesystem::exists(place / method / "certificate.json")) << method;
  }
}

}  // namespace
}  // namespace halfstep
