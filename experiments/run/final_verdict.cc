#include "experiments/run/final_verdict.h"

#include <memory>

#include "smoothing/methods/run_smoother.h"
#include "smoothing/proof/stoppable_feasibility.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {
namespace {

// By the problem's proof, proving nothing twice.
Feasibility Judgement(const WalkProblem& problem, const CertifiedFeasibility& certifier,
                      const CertifiedWalk& certified, const SuperposedWalk& walk,
                      MarginEvaluator::Scratch* scratch) {
  const TimeSpan all{0.0, walk.duration()};
  const StopBranches branches = problem.test().stop_branches();
  if (certified.answer.verdict != Verdict::kFeasible || branches == StopBranches::kNone) {
    return certified.answer;
  }
  const StoppableFeasibility stoppable(std::make_shared<CertifiedFeasibility>(certifier), branches);
  return stoppable.CheckBranches(walk, all, scratch);
}

}  // namespace

void JudgeAtTheEnd(const WalkProblem& problem, const CertifiedFeasibility& certifier,
                   const std::stop_token& stop, Workers* workers, MethodRun* run) {
  if (opt::DidNotWork(run->result.ending) || !run->result.feasible) return;  // it claims nothing
  // RunSmoother has asked the samples. Between these others may tell otherwise, as the certificate
  // does.
  if (problem.test().evidence() == Evidence::kSampled) return;
  MarginEvaluator::Scratch scratch = problem.evaluator().MakeScratch();
  scratch.stop = stop;
  scratch.workers = workers;
  const SuperposedWalk walk(problem.sequence(), run->result.parameters);
  const Feasibility answer = Judgement(problem, certifier, run->certified, walk, &scratch);
  if (answer.verdict == Verdict::kFeasible || answer.stopped) return;
  run->result.message = UnprovedSentence(problem, answer, run->result);
  run->result.ending = opt::Ending::kFailed;
  run->result.feasible = false;
  run->result.accepted.reset();
}

}  // namespace halfstep
