// 03: the paper's smoother, and a proof for every instant of what it found.
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

using namespace halfstep;

int main() {
  const WalkProblem problem =
      ProblemOf(Prepare(LoadConfig((DataFolder() / "configs/bar_8cm.yaml").string(), {})));
  SmoothingMonitor monitor;
  const SmoothingResult result = Dichotomy(problem, {}, monitor);
  std::printf("dichotomy: %s; %.3f s instead of %.3f s\n", result.message.c_str(), result.cost,
              DurationOf(problem.Start()));

  const CertifiedFeasibility certifier(problem.evaluator(), {});
  MarginEvaluator::Scratch scratch = problem.evaluator().MakeScratch();
  Certificate certificate;
  const Feasibility answer = certifier.Certify(
      SuperposedWalk(problem.sequence(), result.parameters), &scratch, &certificate);
  std::printf("certified: %s, by %zu rows\n", answer.verdict == Verdict::kFeasible ? "yes" : "no",
              certificate.size());
  return answer.verdict == Verdict::kFeasible ? 0 : 1;
}
