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

bool DependsOnWorld(MarginFamily family) { return Traits(family).scope == MarginScope::kScene; }

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

// Half-step j is safe when the walk that is cut after it is, from its beginning to its end: until
// half-step j + 1 begins that is the walk itself.
Safety SafetyCheck::Prove(const SuperposedWalk& walk, int first, int last, double since,
                          const std::vector<MarginFamily>& families, const Known& known) const {
  const CertifiedFeasibility test(evaluator_, options_, {.since = since, .families = families});
  MarginEvaluator::Scratch scratch = evaluator_.MakeScratch();
  Safety safety{.through = first - 1, .refused_by = {}};
  for (int j = first; j <= std::min(last, walk.num_half_steps() - 1); ++j) {
    const TimeSpan span{std::max(walk.start_of(j), since), walk.end_of(j)};
    if (span.end > span.begin && !(known && known(j))) {
      const Feasibility answer = test.Check(walk.StopBranch(j), span, &scratch);
      if (answer.verdict != Verdict::kFeasible) {
        safety.refused_by = answer.witness;
        break;
      }
    }
    safety.through = j;
  }
  safety.work = scratch.work;
  return safety;
}

}  // namespace halfstep
