#include "smoothing/methods/whole_proof.h"

namespace halfstep {

bool HoldsWhole(const WalkProblem& problem, const HomotopyParameters& parameters,
                SmoothingMonitor& monitor) {
  const SuperposedWalk walk(problem.sequence(), parameters);
  MarginEvaluator::Scratch scratch = problem.evaluator().MakeScratch();
  scratch.stop = monitor.scratch()->stop;
  scratch.workers = monitor.workers();
  const TimeSpan all{0.0, walk.duration()};
  return problem.test().Check(walk, all, &scratch).verdict == Verdict::kFeasible;
}

void KeepWhatHolds(const WalkProblem& problem, const AcceptedWalk& before, double cost,
                   SmoothingMonitor& monitor) {
  const HomotopyParameters& now = monitor.incumbent();
  if (now == before.parameters() || HoldsWhole(problem, now, monitor)) return;
  monitor.Adopt(before, cost, DurationOf(before.parameters()));
}

}  // namespace halfstep
