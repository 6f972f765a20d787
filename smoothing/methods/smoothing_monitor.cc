#include "smoothing/methods/smoothing_monitor.h"

#include <utility>

namespace halfstep {

using opt::Ending;

MonitorOptions SmoothingMonitor::Part(double from, double to) const {
  MonitorOptions part{.stop = options_.stop,
                      .stop_proof = options_.stop_proof,
                      .deadline = Remaining(),
                      .workers = options_.workers};
  if (options_.progress) {
    part.progress = [this, from, to](double done) { Progress(from + (to - from) * done); };
  }
  return part;
}

void SmoothingMonitor::Begin(const WalkProblem& problem, const HomotopyParameters& start) {
  problem_ = &problem;
  result_ = {};
  refusal_.clear();
  scratch_ = problem.evaluator().MakeScratch();
  scratch_->stop = options_.stop_proof;
  scratch_->workers = workers();
  result_.evidence = problem.test().evidence();
  for (int i = 0; i < problem.sequence().num_junctions(); ++i) {
    result_.junctions.push_back({.kind = KindOfJunction(i)});
  }
  result_.parameters = start;
  begun_ = result_.cost = duration_ = DurationOf(start);
}

bool SmoothingMonitor::BeginFeasibly(const WalkProblem& problem, const HomotopyParameters& start) {
  Begin(problem, start);
  const SuperposedWalk walk(problem.sequence(), start);
  begun_ = result_.cost = duration_ = walk.duration();
  const Feasibility answer = problem.test().Check(walk, {0.0, walk.duration()}, scratch());
  if (answer.stopped) {
    refusal_ = "stopped from outside before the start was looked at";
    return false;
  }
  if (answer.verdict != Verdict::kFeasible) {
    const bool planned = start == PlannedMotion(problem.sequence());
    refusal_ = std::string(planned ? "the planned motion" : "the start") +
               " is not feasible: " + problem.evaluator().Describe(answer.witness);
    return false;
  }
  result_.feasible = true;
  return true;
}

void SmoothingMonitor::BeginKnownFeasible(const WalkProblem& problem,
                                          const HomotopyParameters& start) {
  Begin(problem, start);
  result_.feasible = true;
}

void SmoothingMonitor::Count(long instants, long collision_queries) {
  result_.instants += instants;
  result_.collision_queries += collision_queries;
}

void SmoothingMonitor::Adopt(const HomotopyParameters& parameters, double cost, double duration) {
  if (cost < result_.cost && !result_.time_to_first_improvement) {
    result_.time_to_first_improvement = Seconds();
  }
  result_.parameters = parameters;
  result_.cost = cost;
  result_.feasible = true;
  duration_ = duration;
  if (options_.on_incumbent) options_.on_incumbent(parameters);
}

void SmoothingMonitor::Record(SmoothingIterate iterate) {
  iterate.wall = Seconds();
  iterate.instants = instants();
  iterate.incumbent_duration = duration_;
  iterate.incumbent_cost = result_.cost;
  result_.iterates.push_back(std::move(iterate));
}

SmoothingResult SmoothingMonitor::FinishAgainstStart(Ending ending, const std::string& message,
                                                     const std::string& no_gain) {
  const bool gained = result_.cost < begun_;
  if (ending == Ending::kNotRun || gained) return Finish(ending, message);
  return Finish(Ending::kNoImprovement, message + no_gain);
}

SmoothingResult SmoothingMonitor::Finish(Ending ending, const std::string& message) {
  const ParameterTable table = problem_->Parameters();
  for (int i = 0; i < problem_->sequence().num_junctions(); ++i) {
    const size_t at = static_cast<size_t>(i);
    JunctionResult& junction = result_.junctions[at];
    junction.overlap = result_.parameters.overlaps[at];
    junction.upper_bound = NaturalOverlapBound(result_.parameters, i);
    junction.fixed = !table.free({ParameterFamily::kOverlap, i});
  }
  result_.ending = ending;
  result_.message = message;
  Count(scratch_->instants, scratch_->bodies.queries);
  scratch_.reset();
  result_.wall = Seconds();
  return std::move(result_);
}

}  // namespace halfstep
