#include "smoothing/methods/given_walk.h"

#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

SmoothingResult TakeGivenWalk(const WalkProblem& problem,
                              const std::optional<HomotopyParameters>& given,
                              SmoothingMonitor& monitor) {
  const SuperposedWalk walk(problem.sequence(), given.value_or(problem.Start()));
  monitor.Begin(problem, walk.parameters());
  Feasibility answer;
  const std::optional<AcceptedWalk> accepted = monitor.Accept(walk.parameters(), &answer);
  if (answer.stopped) {
    return monitor.Finish(opt::Ending::kInterrupted,
                          "stopped from outside while the given walk was looked at");
  }
  if (!accepted) {
    return monitor.Finish(opt::Ending::kFailed, "the given walk is not feasible: " +
                                                    problem.evaluator().Describe(answer.witness));
  }
  monitor.Adopt(*accepted, monitor.cost(), monitor.duration());
  return monitor.Finish(opt::Ending::kConverged, "the walk that was given, unchanged");
}

}  // namespace halfstep
