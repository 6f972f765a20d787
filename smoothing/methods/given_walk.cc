#include "smoothing/methods/given_walk.h"

#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

SmoothingResult TakeGivenWalk(const WalkProblem& problem,
                              const std::optional<HomotopyParameters>& given,
                              SmoothingMonitor& monitor) {
  const SuperposedWalk walk(problem.sequence(), given.value_or(problem.Start()));
  monitor.Begin(problem, walk.parameters());
  if (monitor.stopped()) {
    return monitor.Finish(opt::Ending::kNotRun,
                          monitor.StopReason() + " before the given walk was looked at");
  }
  const Feasibility answer = problem.test().Check(walk, {0.0, walk.duration()}, monitor.scratch());
  if (answer.stopped) {
    return monitor.Finish(opt::Ending::kInterrupted,
                          "stopped from outside while the given walk was looked at");
  }
  monitor.result().feasible = answer.verdict == Verdict::kFeasible;
  if (!monitor.result().feasible) {
    return monitor.Finish(opt::Ending::kFailed, "the given walk is not feasible: " +
                                                    problem.evaluator().Describe(answer.witness));
  }
  return monitor.Finish(opt::Ending::kConverged, "the walk that was given, unchanged");
}

}  // namespace halfstep
