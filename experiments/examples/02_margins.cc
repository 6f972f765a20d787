// 02: how far inside each limit a walk is at an instant.
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

#include "wpg/nth.h"

using namespace halfstep;

int main() {
  const Experiment experiment =
      Prepare(LoadConfig((DataFolder() / "configs/bar_8cm.yaml").string(), {}));
  const WalkProblem problem = ProblemOf(experiment);
  const SuperposedWalk walk(problem.sequence(), problem.Start());
  MarginEvaluator::Scratch scratch = problem.evaluator().MakeScratch();

  const double t = 5.0;
  const MarginSet margins = problem.evaluator().At(walk, walk.Locate(t), &scratch);
  std::printf("margins at t = %.1f s of %.1f s\n", t, walk.duration());
  for (const MarginFamily family : problem.evaluator().families()) {
    const Margin& margin = Nth(margins, family);
    std::printf("%-15s %9.4f %-6s %s\n", std::string(Name(family)).c_str(), margin.value,
                std::string(Unit(family)).c_str(), problem.evaluator().Subject(margin).c_str());
  }
}
