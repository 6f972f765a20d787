#include "smoothing/methods/smoothing_monitor.h"

#include <stdexcept>
#include <utility>

#include "smoothing/walk/parameter_complaint.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {

using opt::Ending;

MonitorOptions SmoothingMonitor::Part(double from, double to) const {
  MonitorOptions part{.stop = options_.stop,
                      .stop_proof = options_.stop_proof,
                      .effort = EffortLeft(),
                      .deadline = options_.deadline - Seconds(),
                      .workers = options_.workers};
  if (options_.progress) {
    part.progress = [this, from, to](double done) { Progress(from + (to - from) * done); };
  }
  return part;
}

void SmoothingMonitor::Begin(const WalkProblem& problem, const HomotopyParameters& start) {
  problem_ = problem;
  result_ = {};
  refusal_.clear();
  scratch_ = problem.evaluator().MakeScratch();
  scratch_->stop = options_.stop_proof;
  scratch_->workers = workers();
  result_.evidence = problem.test().evidence();
  for (int i = 0; i < problem.sequence().num_junctions(); ++i) {
    result_.junctions.push_back({.kind = KindOfJunction(i)});
  }
  start_ = start;
  accepted_.reset();
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
  accepted_ = AcceptedWalk(start);
  return true;
}

void SmoothingMonitor::BeginAccepted(const WalkProblem& problem, AcceptedWalk start) {
  Begin(problem, start.parameters());
  accepted_ = std::move(start);
}

void SmoothingMonitor::Count(const Work& work, long collision_queries) {
  result_.work += work;
  result_.collision_queries += collision_queries;
}

Work SmoothingMonitor::work() const {
  Work work = result_.work;
  if (scratch_) work += scratch_->work;
  return work;
}

Ending SmoothingMonitor::StopEnding() const {
  if (interrupted()) return Ending::kInterrupted;
  return cut_off() ? Ending::kDeadline : Ending::kLimit;
}

std::string SmoothingMonitor::StopReason() const {
  if (interrupted()) return "stopped from outside";
  return cut_off() ? Formatted("ended by the clock: the deadline of %g s passed", deadline())
                   : Formatted("the effort of %g was used", effort());
}

void SmoothingMonitor::Require(const HomotopyParameters& candidate) const {
  const std::string complaint = ComplaintAbout(problem_->sequence(), candidate);
  if (!complaint.empty()) throw std::invalid_argument(complaint);
  const HomotopyParameters start = problem_->Start();
  for (const FixedParameter& fixed : problem_->fixed()) {
    const double value = fixed.parameter.in(candidate), kept = fixed.parameter.in(start);
    if (value == kept) continue;
    throw std::invalid_argument(
        Formatted("%ss[%d]: %.17g (valid: %.17g, where the problem fixes it)",
                  std::string(Traits(fixed.parameter.family).name).c_str(), fixed.parameter.index,
                  value, kept));
  }
}

bool SmoothingMonitor::Propose(const HomotopyParameters& candidate) {
  Require(candidate);
  const double duration = SuperposedWalk(problem_->sequence(), candidate).duration();
  SmoothingIterate record{.candidate_duration = duration};
  if (duration < cost()) {
    Feasibility answer;
    if (const std::optional<AcceptedWalk> walk = Accept(candidate, &answer)) {
      record.accepted = true;
      record.lambda = 1.0;
      Adopt(*walk, duration, duration);
    } else {
      ++result_.raw_infeasible;
      if (answer.verdict == Verdict::kViolated) {
        record.candidate_worst_margin = problem_->limits().Slack(answer.witness);
      }
    }
  }
  const bool accepted = record.accepted;
  Record(std::move(record));
  return accepted;
}

std::optional<AcceptedWalk> SmoothingMonitor::Accept(const HomotopyParameters& candidate,
                                                     Feasibility* answer) {
  Require(candidate);
  const SuperposedWalk walk(problem_->sequence(), candidate);
  const Feasibility found = problem_->test().Check(walk, {0.0, walk.duration()}, scratch());
  if (answer != nullptr) *answer = found;
  if (found.verdict != Verdict::kFeasible) return std::nullopt;
  return AcceptedWalk(candidate);
}

void SmoothingMonitor::Adopt(const AcceptedWalk& walk, double cost, double duration) {
  if (cost < result_.cost && !result_.time_to_first_improvement) {
    result_.time_to_first_improvement = Seconds();
  }
  accepted_ = walk;
  result_.cost = cost;
  duration_ = duration;
  if (options_.on_incumbent) options_.on_incumbent(incumbent());
}

void SmoothingMonitor::Record(SmoothingIterate iterate) {
  iterate.wall = Seconds();
  iterate.instants = work().evaluated();
  iterate.effort = work().effort();
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
  result_.parameters = incumbent();
  result_.feasible = accepted_.has_value();
  result_.accepted = std::move(accepted_);
  accepted_.reset();
  const ParameterTable table = problem_->Parameters();
  result_.junctions.resize(static_cast<size_t>(problem_->sequence().num_junctions()));
  for (int i = 0; i < problem_->sequence().num_junctions(); ++i) {
    JunctionResult& junction = Nth(result_.junctions, i);
    junction.overlap = Nth(result_.parameters.overlaps, i);
    junction.upper_bound = NaturalOverlapBound(result_.parameters, i);
    junction.fixed = !table.free({ParameterFamily::kOverlap, i});
  }
  result_.ending = ending;
  result_.message = message;
  Count(scratch_->work, scratch_->bodies.queries);
  scratch_.reset();
  result_.wall = Seconds();
  return std::move(result_);
}

}  // namespace halfstep
