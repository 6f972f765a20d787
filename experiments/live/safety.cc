#include "experiments/live/safety.h"

#include <algorithm>

namespace halfstep {
namespace {

std::vector<MarginFamily> Families(bool of_world) {
  std::vector<MarginFamily> families;
  for (const MarginFamily family : AllMarginFamilies()) {
    if (DependsOnWorld(family) == of_world) families.push_back(family);
  }
  return families;
}

}  // namespace

bool DependsOnWorld(MarginFamily family) {
  return family == MarginFamily::kClearance || family == MarginFamily::kNoStep;
}

SafetyCheck::SafetyCheck(const RobotModel& robot, const Scene& scene,
                         const ExperimentConfig& config)
    : evaluator_(robot, scene, config.smoothing.limits), options_(config.smoothing.certification) {}

Safety SafetyCheck::AmongObstacles(const SuperposedWalk& walk, int first, int last, double since,
                                   const Known& known) const {
  return Prove(walk, first, last, since, Families(true), known);
}

Safety SafetyCheck::OfRobot(const SuperposedWalk& walk, int first, int last,
                            const Known& known) const {
  const double since = first < walk.num_half_steps() ? walk.start_of(first) : walk.duration();
  return Prove(walk, first, last, since, Families(false), known);
}

// Half-step j is safe when the walk keeps the margins until t_{j+1}, and its stop branch after
// that.
Safety SafetyCheck::Prove(const SuperposedWalk& walk, int first, int last, double since,
                          const std::vector<MarginFamily>& families, const Known& known) const {
  const CertifiedFeasibility test(evaluator_, options_, {.since = since, .families = families});
  MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
  Safety safety{.through = first - 1, .refused_by = {}};
  const int n = walk.num_half_steps();
  for (int j = first; j <= std::min(last, n - 1); ++j) {
    if (known && known(j)) {
      safety.through = j;
      continue;
    }
    const double next = j + 1 < n ? walk.start_of(j + 1) : walk.duration();
    Feasibility answer{.verdict = Verdict::kFeasible, .evidence = {}, .witness = {}};
    if (next > since) {
      answer = test.Check(walk, {std::max(walk.start_of(j), since), next}, &scratch);
    }
    if (answer.verdict == Verdict::kFeasible && walk.end_of(j) > std::max(next, since)) {
      const double begin = std::max(next, since);
      answer = test.Check(walk.StopBranch(j), {begin, walk.end_of(j)}, &scratch);
    }
    if (answer.verdict != Verdict::kFeasible) {
      safety.refused_by = answer.witness;
      return safety;
    }
    safety.through = j;
  }
  return safety;
}

}  // namespace halfstep
