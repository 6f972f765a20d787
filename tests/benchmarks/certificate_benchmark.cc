// What a certificate costs. Run: build/release/tests/certificate_benchmark
// --benchmark_repetitions=5 --benchmark_report_aggregates_only=true. Figures are quoted in
// notebooks-data/measurements.md, "Certificates".

#include <benchmark/benchmark.h>

#include <map>
#include <memory>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/smoothed.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

constexpr int kHalfSteps = 40;

// HRP-2 walks 20 steps in a slight curve, smoothed as far as obstacles on both sides of its way
// allow, certified.
struct SmoothedWalk {
  explicit SmoothedWalk(int obstacles) {
    const RobotModel robot = Hrp2();
    const double y = 0.5 * robot.standing_width;
    std::array<Foothold, 2> feet = {Foothold::Level({0, y, 0}), Foothold::Level({0, -y, 0})};
    const std::array<Foothold, 2> start = feet;
    std::vector<Footstep> footsteps;
    for (int i = 0; i < kHalfSteps / 2; ++i) {
      const Side side = i % 2 == 0 ? Side::kRight : Side::kLeft;
      Foothold& foot = feet[static_cast<size_t>(Index(side))];
      const Foothold& support = feet[static_cast<size_t>(Index(Opposite(side)))];
      foot =
          support * Foothold::Level({0.12, Sign(side) * 2 * y, side == Side::kLeft ? 0.05 : 0.0});
      footsteps.push_back({.side = side, .X_WF = foot, .via_height = 0.15, .duration = 2.0});
    }
    sequence = MakeSequence(start, footsteps, 0.24, {.shift = 0.05, .foot_delay = 0.1},
                            std::make_shared<Lipm>(robot.com_height));
    const SuperposedWalk planned(sequence, PlannedMotion(sequence));
    WalkDraw draw(3);
    Scene scene;
    while (static_cast<int>(scene.obstacles.size()) < obstacles) {
      const SceneKind kind = static_cast<SceneKind>(scene.obstacles.size() % 3);
      scene.obstacles.push_back(DrawScene(planned, kind, 1, &draw).obstacles[0]);
      const MarginEvaluator among(robot, scene, {});
      MarginEvaluator::Scratch scratch = among.MakeScratch();
      const bool beside = SampledFeasibility(among, 0.01)
                              .Check(planned, {0.0, planned.duration()}, &scratch)
                              .verdict == Verdict::kFeasible;
      if (!beside) scene.obstacles.pop_back();
    }
    evaluator = std::make_unique<MarginEvaluator>(robot, scene, MarginLimits{});
    const CertifiedFeasibility test(*evaluator, {});
    walk = std::make_unique<SuperposedWalk>(
        sequence, Smoothed(Dichotomy, ProblemOf(sequence, test), {}).parameters);
  }

  HalfStepSequence sequence;
  std::unique_ptr<MarginEvaluator> evaluator;
  std::unique_ptr<SuperposedWalk> walk;
};

const SmoothedWalk& Among(int obstacles) {
  static std::map<int, SmoothedWalk> walks;
  return walks.try_emplace(obstacles, obstacles).first->second;
}

void Report(benchmark::State& state, const SmoothedWalk& among, long instants) {
  using benchmark::Counter;
  state.counters["instants"] =
      static_cast<double>(instants) / static_cast<double>(state.iterations());
  state.counters["walk_s"] = among.walk->duration();
  state.counters["per_half_step_s"] =
      Counter(kHalfSteps, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

// The whole walk, by a test of feasibility.
void CheckAll(benchmark::State& state, const SmoothedWalk& among, const FeasibilityTest& test) {
  long instants = 0;
  for (auto _ : state) {
    MarginEvaluator::Scratch scratch = among.evaluator->MakeScratch();
    const Feasibility answer = test.Check(*among.walk, {0.0, among.walk->duration()}, &scratch);
    if (answer.verdict != Verdict::kFeasible) state.SkipWithError("not feasible");
    instants += scratch.work.evaluated();
  }
  Report(state, among, instants);
}

void CertifyWalk(benchmark::State& state) {
  const SmoothedWalk& among = Among(static_cast<int>(state.range(0)));
  CheckAll(state, among, CertifiedFeasibility(*among.evaluator, {}));
}
BENCHMARK(CertifyWalk)->Arg(0)->Arg(1)->Arg(10)->Arg(50)->Unit(benchmark::kMillisecond);

void SampleWalk5ms(benchmark::State& state) {
  const SmoothedWalk& among = Among(static_cast<int>(state.range(0)));
  CheckAll(state, among, SampledFeasibility(*among.evaluator, 0.005));
}
BENCHMARK(SampleWalk5ms)->Arg(0)->Arg(1)->Arg(10)->Arg(50)->Unit(benchmark::kMillisecond);

// With the rows of the certificate file: values, not only verdicts.
void CertificateRows(benchmark::State& state) {
  const SmoothedWalk& among = Among(static_cast<int>(state.range(0)));
  const CertifiedFeasibility test(*among.evaluator, {});
  Certificate certificate;
  long instants = 0;
  for (auto _ : state) {
    MarginEvaluator::Scratch scratch = among.evaluator->MakeScratch();
    benchmark::DoNotOptimize(test.Certify(*among.walk, &scratch, &certificate));
    instants += scratch.work.evaluated();
  }
  Report(state, among, instants);
  state.counters["rows"] = static_cast<double>(certificate.size());
}
BENCHMARK(CertificateRows)->Arg(50)->Unit(benchmark::kMillisecond);

// One overlap changed: only its span, junction after junction.
void CertifyOneWindow(benchmark::State& state) {
  const SmoothedWalk& among = Among(static_cast<int>(state.range(0)));
  const CertifiedFeasibility test(*among.evaluator, {});
  MarginEvaluator::Scratch scratch = among.evaluator->MakeScratch();
  const SuperposedWalk& walk = *among.walk;
  int junction = 0;
  for (auto _ : state) {
    const TimeSpan span{walk.start_of(junction + 1), walk.end_of(junction)};
    benchmark::DoNotOptimize(test.Check(walk, span, &scratch));
    junction = (junction + 1) % (kHalfSteps - 1);
  }
  state.counters["instants"] =
      static_cast<double>(scratch.work.evaluated()) / static_cast<double>(state.iterations());
}
BENCHMARK(CertifyOneWindow)->Arg(1)->Arg(10)->Arg(50)->Unit(benchmark::kMillisecond);

// The floor: one bound of the motion (walk, joints, their speeds, the bounds), and one instant of a
// sampled check, beside each other.
void BoundMotion(benchmark::State& state) {
  const SmoothedWalk& among = Among(1);
  const MotionBounds bounds(among.evaluator->robot());
  IntervalMotion motion;
  double t = 0.0;
  for (auto _ : state) {
    BoundMotion(bounds, *among.walk, t, t + 0.02, &motion);
    benchmark::DoNotOptimize(motion.bounded);
    t = t + 0.04 < among.walk->duration() ? t + 0.02 : 0.0;
  }
}
BENCHMARK(BoundMotion)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace halfstep
