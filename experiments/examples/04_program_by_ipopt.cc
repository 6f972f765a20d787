// 04: overlaps, foot heights and durations of a whole walk, chosen together by a solver.
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

using namespace halfstep;

int main() {
  const std::string solver = "ipopt";
  const ExperimentConfig config = LoadConfig((DataFolder() / "configs/bar_8cm.yaml").string(),
                                             {{"smoothing.optimizer.heights", "true"},
                                              {"smoothing.optimizer.durations", "true"},
                                              {"smoothing.optimizer.effort", "2"}});
  const WalkProblem problem = ProblemOf(Prepare(config));
  if (!opt::MakeSolver(solver)->available()) {
    std::printf("%s\n", opt::MakeSolver(solver)->WhyUnavailable().c_str());
    return 0;
  }
  SmoothingMonitor monitor;
  const SmoothingResult result =
      Methods::Standard().Find(solver).Smooth(problem, config.smoothing.options, monitor);
  std::printf("%s: %s\n%.3f s, %s\n", solver.c_str(), result.message.c_str(), result.cost,
              std::string(Name(result.evidence)).c_str());
}
