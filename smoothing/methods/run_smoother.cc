#include "smoothing/methods/run_smoother.h"

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "smoothing/walk/parameter_complaint.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

// "" where there is a walk of the problem with the result's parameters and tables can tell of it.
std::string Misfit(const WalkProblem& problem, const SmoothingResult& result) {
  const int junctions = problem.sequence().num_junctions();
  if (std::ssize(result.junctions) != junctions) {
    return std::to_string(result.junctions.size()) + " junctions where the walk has " +
           std::to_string(junctions);
  }
  return ComplaintAbout(problem.sequence(), result.parameters);
}

// What the monitor kept, or the start.
SmoothingResult Broken(const WalkProblem& problem, const std::string& message,
                       SmoothingMonitor& monitor) {
  if (monitor.under_way()) {
    SmoothingResult kept = monitor.Finish(opt::Ending::kFailed, message);
    if (Misfit(problem, kept).empty()) return kept;
  }
  monitor.Begin(problem, problem.Start());
  return monitor.Finish(opt::Ending::kFailed, message);
}

SmoothingResult Judged(const WalkProblem& problem, SmoothingResult result,
                       SmoothingMonitor& monitor) {
  if (result.accepted && result.accepted->parameters() == result.parameters) return result;
  result.accepted.reset();
  result.feasible = false;
  if (opt::DidNotWork(result.ending)) return result;
  SmoothingMonitor judge(monitor.Part(1.0, 1.0));
  judge.Begin(problem, problem.Start());
  Feasibility answer;
  try {
    result.accepted = judge.Accept(result.parameters, &answer);
  } catch (const std::invalid_argument& moved) {
    result.ending = opt::Ending::kFailed;
    result.message = std::string("its walk moves what is fixed: ") + moved.what();
    return result;
  }
  result.feasible = result.accepted.has_value();
  if (result.feasible || answer.stopped) return result;
  // Who returns what it was started from, and says so, claims nothing.
  const bool start = result.parameters == problem.Start();
  if (start && result.ending == opt::Ending::kNoImprovement) return result;
  result.message = UnprovedSentence(problem, answer, result);
  result.ending = opt::Ending::kFailed;
  return result;
}

}  // namespace

std::string UnprovedSentence(const WalkProblem& problem, const Feasibility& answer,
                             const SmoothingResult& result) {
  const char* found = answer.verdict == Verdict::kViolated ? "is violated" : "could not be decided";
  return std::string("the walk that it returned as ") + std::string(opt::Name(result.ending)) +
         " " + found + ": " + problem.evaluator().Describe(answer.witness) +
         "; it said: " + result.message;
}

SmoothingResult RunSmoother(const Smoother& smoother, const WalkProblem& problem,
                            const MethodOptions& options, SmoothingMonitor& monitor) {
  SmoothingResult result;
  try {
    result = smoother.Smooth(problem, options, monitor);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    return Broken(problem, std::string("it threw: ") + error.what(), monitor);
  } catch (...) {
    return Broken(problem, "it threw something that is no std::exception", monitor);
  }
  const std::string misfit = Misfit(problem, result);
  if (!misfit.empty())
    return Broken(problem, "it returned no walk of this plan: " + misfit, monitor);
  return Judged(problem, std::move(result), monitor);
}

}  // namespace halfstep
