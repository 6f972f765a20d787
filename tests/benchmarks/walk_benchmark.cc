// What one half-step costs. Run: build/release/tests/walk_benchmark --benchmark_repetitions=7
// --benchmark_report_aggregates_only=true.

#include <benchmark/benchmark.h>

#include "experiments/config/experiment.h"
#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/margins/slack_evaluator.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "tests/places.h"
#include "tests/smoothing/smoothed.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/posture.h"

namespace halfstep {
namespace {

Experiment Load(const std::string& name) {
  return Prepare(LoadConfig(InSources("experiments/configs/") + name + ".yaml", {}));
}

// Instants that go through the walk again and again.
class Instants {
 public:
  explicit Instants(const SuperposedWalk& walk) : walk_(walk), period_(walk.duration() / 997) {}
  LocalTime Next() {
    i_ = (i_ + 1) % 998;
    return walk_.Locate(period_ * i_);
  }

 private:
  const SuperposedWalk& walk_;
  double period_;
  int i_ = 0;
};

void WalkAndJoints(benchmark::State& state) {
  const Experiment e = Load("bar_8cm");
  const SuperposedWalk walk(e.sequence, Overlapped(e.sequence, 0.7));
  Instants instants(walk);
  for (auto _ : state) {
    const WalkJet jet = walk.At(instants.Next());
    benchmark::DoNotOptimize(SolvePosture(e.robot, jet.value));
  }
}
BENCHMARK(WalkAndJoints);

void WalkAndJointsWithDerivatives(benchmark::State& state) {
  const Experiment e = Load("bar_8cm");
  const SuperposedWalk walk(e.sequence, Overlapped(e.sequence, 0.7));
  Instants instants(walk);
  std::vector<WalkSensitivity> sensitivities;
  for (auto _ : state) {
    const LocalTime at = instants.Next();
    const WalkJet jet = walk.At(at);
    Posture posture = SolvePosture(e.robot, jet.value);
    benchmark::DoNotOptimize(SolveJointSpeeds(e.robot, jet, &posture));
    walk.Sensitivities(at, &sensitivities);
    benchmark::DoNotOptimize(sensitivities.data());
  }
}
BENCHMARK(WalkAndJointsWithDerivatives);

// Calls `ask` at one instant after the other.
template <typename Ask>
void AskMargins(benchmark::State& state, const Ask& ask) {
  const Experiment e = Load("bar_8cm");
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const SuperposedWalk walk(e.sequence, Overlapped(e.sequence, 0.6));
  Instants instants(walk);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  for (auto _ : state) {
    benchmark::DoNotOptimize(ask(evaluator, walk, instants.Next(), &scratch));
  }
}

void MarginVerdict(benchmark::State& state) {
  AskMargins(state, [](const MarginEvaluator& evaluator, const auto&... at) {
    return evaluator.FirstViolation(at...);
  });
}
BENCHMARK(MarginVerdict);

void MarginValues(benchmark::State& state) {
  AskMargins(state, [](const MarginEvaluator& evaluator, const auto&... at) {
    return evaluator.At(at...);
  });
}
BENCHMARK(MarginValues);

// Instants as an overlap program asks for them, all parameters moved.
void AskSlacks(benchmark::State& state, bool gradient) {
  const Experiment e = Load("bar_8cm");
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  HomotopyParameters fast = PlannedMotion(e.sequence);
  for (double& duration : fast.durations) duration *= 0.5;
  for (int i = 0; i < e.sequence.num_junctions(); ++i) {
    fast.overlaps[static_cast<size_t>(i)] = 0.7 * NaturalOverlapBound(fast, i);
  }
  const SuperposedWalk walk(e.sequence, fast);
  Instants instants(walk);
  SlackEvaluator slacks(evaluator, 1.8);
  InstantSlacks instant;
  double rows = 0.0;
  for (auto _ : state) {
    slacks.At(walk, instants.Next(), {}, gradient, &instant);
    rows += static_cast<double>(instant.rows.size());
  }
  state.counters["rows"] = benchmark::Counter(rows, benchmark::Counter::kAvgIterations);
}

void NearRows(benchmark::State& state) { AskSlacks(state, false); }
BENCHMARK(NearRows);

void NearRowsWithDerivatives(benchmark::State& state) { AskSlacks(state, true); }
BENCHMARK(NearRowsWithDerivatives);

void MarginPass(benchmark::State& state) {
  const Experiment e = Load("bar_8cm");
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const SampledFeasibility test(evaluator, 0.005);
  const SuperposedWalk walk(e.sequence, PlannedMotion(e.sequence));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  for (auto _ : state) {
    benchmark::DoNotOptimize(test.Check(walk, {0.0, walk.duration()}, &scratch));
  }
  state.counters["per_half_step_s"] =
      benchmark::Counter(e.sequence.size(), benchmark::Counter::kIsIterationInvariantRate |
                                                benchmark::Counter::kInvert);
}
BENCHMARK(MarginPass)->Unit(benchmark::kMillisecond);

void DichotomyFine(benchmark::State& state, const char* name) {
  const Experiment e = Load(name);
  const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
  const SampledFeasibility test(evaluator, 0.005);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        Smoothed(Dichotomy, ProblemOf(e.sequence, test), {.tolerance = 0.001}));
  }
  state.counters["per_half_step_s"] =
      benchmark::Counter(e.sequence.size(), benchmark::Counter::kIsIterationInvariantRate |
                                                benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(DichotomyFine, bar_8cm, "bar_8cm")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(DichotomyFine, fig4_raw_sequence, "fig4_raw_sequence")
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace halfstep
