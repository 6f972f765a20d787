// What the certificate is worth: how often it errs, and what it costs in seconds of walk. Prints
// the tables of notebooks-data/measurements.md, "Certificates". Not a test.
// Run: certificate_study walks [WALKS [SEED [ROBOT [all]]]] | dichotomy
// all: walks that move along every family of homotopy parameters, not along overlaps alone.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/places.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/smoothed.h"

namespace halfstep {
namespace {

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Least slack [its scale] of a walk, sampled every 0.05 ms wherever it is below 5 mm at 1 ms.
double LeastSlack(const MarginEvaluator& evaluator, const SuperposedWalk& walk,
                  MarginEvaluator::Scratch* scratch) {
  constexpr double kCoarse = 1e-3;
  constexpr int kFine = 20;
  constexpr double kNear = 0.5;
  const long n = static_cast<long>(std::ceil(walk.duration() / kCoarse));
  const double step = walk.duration() / static_cast<double>(n);
  const auto slack = [&](double t) {
    const MarginSet margins = evaluator.At(walk, walk.Locate(t), scratch);
    return evaluator.limits().Slack(WorstOf(margins, evaluator.limits()));
  };
  double least = 1e9, previous = 1e9;
  for (long i = 0; i <= n; ++i) {
    const double t = step * static_cast<double>(i);
    const double here = slack(t);
    least = std::min(least, here);
    if (i > 0 && std::min(here, previous) < kNear) {
      for (int k = 1; k < kFine; ++k) least = std::min(least, slack(t - step * k / kFine));
    }
    previous = here;
  }
  return least;
}

void Walks(long walks, unsigned seed, const std::string& name, bool all) {
  constexpr std::array<double, 5> kSpares = {0.0, 0.01, 0.03, 0.1, 0.3};  // of the scale
  constexpr std::array<const char*, 3> kKinds = {"cylinders", "clutter", "fence"};
  struct Row {
    long number = 0, certified = 0, undecided = 0, violated = 0;
  };
  std::array<std::array<Row, kSpares.size() + 1>, 4> table{};
  std::array<long, kNumMarginFamilies> refused{};
  const RobotModel robot = RobotNamed(name);
  MarginLimits limits;
  limits.demanded_of(MarginFamily::kFloor) *= std::min(1.0, LegScale(robot));
  limits.clearance_cap = 0.05;  // farther ones do not matter here
  WalkDraw draw(seed);
  long false_certified = 0, full = 0, plans = 0, bad_rows = 0, undecided_after_all = 0;
  double certify_s = 0, sample_s = 0;
  long half_steps = 0;
  for (long w = 0; w < walks;) {
    const size_t kind = static_cast<size_t>(w % 3);
    const double spare = kSpares[static_cast<size_t>(draw.Uniform(0, 5))];
    const auto drawn =
        DrawNearLimit(robot, static_cast<SceneKind>(kind), limits, spare, &draw, all);
    ++plans;
    if (!drawn) continue;
    ++w;
    const SuperposedWalk walk(drawn->sequence, drawn->parameters);
    half_steps += walk.num_half_steps();
    const MarginEvaluator evaluator(robot, drawn->scene, limits);
    const CertifiedFeasibility test(evaluator, {});
    const TimeSpan span{0.0, walk.duration()};
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    const double begin = Now();
    const Feasibility answer = test.Check(walk, span, &scratch);
    certify_s += Now() - begin;
    scratch = evaluator.MakeScratch();
    const double slack = LeastSlack(evaluator, walk, &scratch);
    const bool certified = answer.verdict == Verdict::kFeasible;
    false_certified += certified && slack < 0.0;
    undecided_after_all += answer.verdict == Verdict::kUndecided;
    if (certified) {
      Certificate certificate;
      test.Certify(walk, &scratch, &certificate);
      for (const CertificateRow& row : certificate) {
        bad_rows += !(row.margin.value - row.bound >= limits.demanded_of(row.family));
      }
      if (w % 10 == 0) {  // all of it at 0.05 ms
        ++full;
        const double start = Now();
        const SampledFeasibility dense(evaluator, 5e-5);
        false_certified += dense.Check(walk, span, &scratch).verdict != Verdict::kFeasible;
        sample_s += Now() - start;
      }
    }
    for (size_t d = 0; d <= kSpares.size(); ++d) {
      if (d < kSpares.size() ? slack < kSpares[d] - 1e-9 : slack >= 0.0) continue;
      for (size_t t : {kind, size_t{3}}) {
        Row& row = table[t][d];
        ++row.number;
        row.certified += certified;
        row.undecided += answer.verdict == Verdict::kUndecided;
        row.violated += answer.verdict == Verdict::kViolated;
      }
    }
    if (!certified) ++refused[static_cast<size_t>(answer.witness.family)];
    if (w % 100 == 0) {
      std::fprintf(stderr, "%ld walks, %ld falsely certified\n", w, false_certified);
    }
  }
  std::printf(
      "\n%s, seed %u: %ld walks (%ld half-steps; %ld plans drawn), falsely certified: %ld; "
      "%ld certified ones sampled every 0.05 ms throughout; rows that do not add up: %ld; "
      "certifying %.2f ms a half-step\n",
      name.c_str(), seed, walks, half_steps, plans, false_certified, full, bad_rows,
      1e3 * certify_s / static_cast<double>(half_steps));
  for (MarginFamily family : AllMarginFamilies()) {
    std::printf("refused for %s: %ld\n", std::string(Name(family)).c_str(),
                refused[static_cast<size_t>(family)]);
  }
  for (size_t t = 0; t < table.size(); ++t) {
    std::printf("%-10s %-16s %7s %9s %9s %8s %10s\n", t < 3 ? kKinds[t] : "all", "to spare [mm]",
                "walks", "certified", "undecided", "violated", "refused");
    for (size_t d = 0; d <= kSpares.size(); ++d) {
      const Row& row = table[t][d];
      const std::string spare =
          d < kSpares.size() ? std::to_string(10 * kSpares[d]).substr(0, 4) : "below 0";
      std::printf("%-10s >= %-13s %7ld %9ld %9ld %8ld %9.2f%%\n", "", spare.c_str(), row.number,
                  row.certified, row.undecided, row.violated,
                  100.0 * static_cast<double>(row.undecided + row.violated) /
                      static_cast<double>(std::max(1L, row.number)));
    }
  }
}

void Dichotomies() {
  std::printf("\n%-22s %9s | %9s %9s %8s | %9s %9s %8s | %8s  %s\n", "config", "planned", "sampled",
              "instants", "wall", "certified", "intervals", "wall", "longer", "whole walk again");
  for (const auto& path : YamlFiles(InSources("experiments/configs"))) {
    const Experiment e = Prepare(LoadConfig(path.string(), {}));
    const MarginEvaluator evaluator(e.robot, e.scene, e.config.smoothing.limits);
    const SampledFeasibility sampled(evaluator, 0.005);
    const CertifiedFeasibility certified(evaluator, e.config.smoothing.certification);
    const DichotomyOptions options = e.config.smoothing.options.Get(DichotomyGroup());
    std::array<SmoothingResult, 2> results;
    std::array<double, 2> durations, walls;
    for (size_t k = 0; k < 2; ++k) {
      const FeasibilityTest& test =
          k == 0 ? static_cast<const FeasibilityTest&>(sampled) : certified;
      walls[k] = 1e9;
      for (int repeat = 0; repeat < 3; ++repeat) {
        results[k] = Smoothed(Dichotomy, ProblemOf(e.sequence, test), options);
        walls[k] = std::min(walls[k], results[k].wall);
      }
      durations[k] = SuperposedWalk(e.sequence, results[k].parameters).duration();
    }
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    const SuperposedWalk walk(e.sequence, results[1].parameters);
    const Feasibility again = certified.Check(walk, {0.0, walk.duration()}, &scratch);
    const SuperposedWalk of_sampled(e.sequence, results[0].parameters);
    const Feasibility other = certified.Check(of_sampled, {0.0, of_sampled.duration()}, &scratch);
    constexpr std::array<const char*, 3> kVerdicts = {"certified", "violated", "undecided"};
    std::printf(
        "%-22s %7.3f s | %7.4f s %9ld %5.0f ms | %7.4f s %9ld %5.0f ms | %7.3f%%  %s; sampled "
        "one: %s\n",
        e.config.name.c_str(), SuperposedWalk(e.sequence, PlannedMotion(e.sequence)).duration(),
        durations[0], results[0].work.evaluated(), 1e3 * walls[0], durations[1],
        results[1].work.evaluated(), 1e3 * walls[1], 100 * (durations[1] / durations[0] - 1),
        kVerdicts[static_cast<size_t>(again.verdict)],
        kVerdicts[static_cast<size_t>(other.verdict)]);
    if (other.verdict != Verdict::kFeasible) {
      std::printf("%24s%s\n", "", evaluator.Describe(other.witness).c_str());
    }
  }
}

}  // namespace
}  // namespace halfstep

int main(int argc, char** argv) {
  const std::string part = argc > 1 ? argv[1] : "";
  const long number = argc > 2 ? std::atol(argv[2]) : 0;
  const unsigned seed = argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1;
  if (part == "walks") {
    const bool all = argc > 5 && std::string(argv[5]) == "all";
    halfstep::Walks(number > 0 ? number : 2000, seed, argc > 4 ? argv[4] : "hrp2", all);
  } else if (part == "dichotomy") {
    halfstep::Dichotomies();
  } else {
    std::fprintf(stderr,
                 "usage: certificate_study walks [WALKS [SEED [ROBOT [all]]]] | dichotomy\n");
    return 2;
  }
}
