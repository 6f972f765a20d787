#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "smoothing/methods/accepted_walk.h"
#include "smoothing/methods/smoothing_result.h"
#include "smoothing/methods/stopwatch.h"
#include "smoothing/methods/walk_problem.h"
#include "wpg/workers.h"

namespace halfstep {

/// What the caller of a smoother may ask of it while it works.
struct MonitorOptions {
  std::function<void(double)> progress = {};  ///< called with the fraction done
  std::stop_token stop = {};                  ///< ends the search; what was found stays
  std::stop_token stop_proof = {};            ///< comes later; also ends a proof that is under way
  /// Work after which the search ends (Work::effort). A proof that is under way then is finished.
  double effort = std::numeric_limits<double>::infinity();
  /// An emergency stop [s], counted from when the monitor is made: what it ends is not the same
  /// twice.
  double deadline = std::numeric_limits<double>::infinity();
  /// Threads that may be used beside the caller's, by one search at a time; null: none. What a
  /// search finds does not depend on them.
  std::shared_ptr<Workers> workers = {};
  /// Called with every new incumbent, by the caller's thread or, while that waits, by a worker.
  std::function<void(const HomotopyParameters&)> on_incumbent = {};
};

/// Keeps what one call of a smoother found so far: the incumbent, which is feasible in the sense of
/// the problem's test, the candidates and the work; knows when to stop. At any moment Finish()
/// makes the result of it, so smoothers differ in how they search only. Only a walk that was judged
/// becomes the incumbent: Propose() asks the test. Its clock starts when it is made.
class SmoothingMonitor {
 public:
  SmoothingMonitor() : SmoothingMonitor(MonitorOptions{}) {}
  /// How long it may take, and whom to tell.
  explicit SmoothingMonitor(MonitorOptions options) : options_(std::move(options)) {}
  /// Options for a smoother that is called within this one: it has the effort that is left, stops
  /// with this one, and its progress is reported as the part [from, to] of this one's.
  MonitorOptions Part(double from, double to) const;

  /// The search ends at this effort at the latest, and at this deadline [s].
  void LimitTo(double effort, double deadline = std::numeric_limits<double>::infinity()) {
    options_.effort = std::min(options_.effort, effort);
    options_.deadline = std::min(options_.deadline, deadline);
  }

  /// Forgets everything and begins at `start`.
  void Begin(const WalkProblem& problem, const HomotopyParameters& start);
  /// Begins and checks whether the walk of `start` keeps every margin for all its time. Returns
  /// false when it does not or the check was stopped; the result is then Refusal().
  bool BeginFeasibly(const WalkProblem& problem, const HomotopyParameters& start);
  /// The same for a start that the problem's test has accepted: nothing is checked.
  void BeginAccepted(const WalkProblem& problem, AcceptedWalk start);
  /// The result when BeginFeasibly returned false: the start, not feasible; `also` is added to the
  /// message.
  SmoothingResult Refusal(opt::Ending ending = opt::Ending::kNotRun, const std::string& also = "") {
    return Finish(ending, refusal_ + also);
  }

  /// Whether the search is to end: its effort is used, the caller asked for it, or the deadline has
  /// passed.
  bool stopped() const { return cut_off() || EffortLeft() <= 0.0; }
  /// Whether it is to end at a moment that no work tells: by the caller, or by the clock.
  bool cut_off() const { return interrupted() || Seconds() >= options_.deadline; }
  bool interrupted() const { return options_.stop.stop_requested(); }  ///< the caller asked for it
  std::stop_token stop() const { return options_.stop; }               ///< of the caller
  Workers* workers() const { return options_.workers.get(); }  ///< of the caller; null: none
  /// How a search ends that stopped() ended, and the words for it.
  opt::Ending StopEnding() const;
  std::string StopReason() const;  ///< the same in words, for the result's message
  double Seconds() const { return stopwatch_.Seconds(); }  ///< since the monitor was made [s]
  double deadline() const { return options_.deadline; }    ///< since then [s]; +∞: none
  double effort() const { return options_.effort; }        ///< after which it ends; +∞: none
  /// What is left of it.
  double EffortLeft() const { return options_.effort - work().effort(); }
  /// Tells the caller which fraction ∈ [0, 1] is done.
  void Progress(double done) const {
    if (options_.progress) options_.progress(done);
  }

  /// Tells the caller which part of the effort is used.
  void ShowEffort() const { Progress(std::min(1.0, work().effort() / options_.effort)); }

  /// To be handed to every check of the problem's test; it counts their work.
  MarginEvaluator::Scratch* scratch() { return &*scratch_; }
  /// Adds work that scratch() did not count.
  void Count(const Work& work, long collision_queries);
  /// Adds the work of another search that was part of this one.
  void Count(const SmoothingResult& part) { Count(part.work, part.collision_queries); }
  Work work() const;  ///< done so far

  /// The best walk that was accepted; none: not even the start.
  const std::optional<AcceptedWalk>& accepted() const { return accepted_; }
  /// Its parameters, or those of the start.
  const HomotopyParameters& incumbent() const {
    return accepted() ? accepted()->parameters() : start_;
  }
  double cost() const { return result_.cost; }   ///< of the incumbent, by the program [s]
  double duration() const { return duration_; }  ///< of the incumbent [s]

  /// For methods that look for short walks: makes `candidate` the incumbent if it lasts shorter
  /// than the incumbent and the problem's test accepts it for all its time; records it either way.
  /// Returns whether it did. Throws std::invalid_argument for parameters that are out of bounds, or
  /// move what the problem fixes.
  bool Propose(const HomotopyParameters& candidate);
  /// Asks the problem's test about the whole walk of `candidate`. None: it is refused, and
  /// `answer`, unless null, says why. Throws as Propose() does.
  std::optional<AcceptedWalk> Accept(const HomotopyParameters& candidate,
                                     Feasibility* answer = nullptr);
  /// Makes a walk that was accepted the incumbent. `cost`: by the program of the method. `duration`
  /// [s] is that of the walk.
  void Adopt(const AcceptedWalk& walk, double cost, double duration);
  /// Records that the start turned out not to be feasible, so that whatever was adopted is an
  /// improvement.
  void DropStart() { begun_ = std::numeric_limits<double>::infinity(); }
  /// Records a candidate. The caller has filled what it knows; this fills time, work and what
  /// concerns the incumbent.
  void Record(SmoothingIterate iterate);

  /// The result so far, for smoothers to add to: junctions, candidates … Which walk it has, and
  /// whether that is feasible, is the monitor's to say, whatever is written there.
  SmoothingResult& result() { return result_; }

  /// Makes the result, with this ending and message.
  SmoothingResult Finish(opt::Ending ending, const std::string& message);
  /// Whether it has begun and not finished.
  bool under_way() const { return scratch_.has_value(); }
  /// The same, but when the incumbent costs no less than the start, any ending but kNotRun becomes
  /// kNoImprovement, and `no_gain` is added to the message.
  SmoothingResult FinishAgainstStart(opt::Ending ending, const std::string& message,
                                     const std::string& no_gain);

 private:
  void Require(const HomotopyParameters& candidate) const;

  MonitorOptions options_;
  Stopwatch stopwatch_;
  std::optional<WalkProblem> problem_;
  std::optional<MarginEvaluator::Scratch> scratch_;
  SmoothingResult result_;
  HomotopyParameters start_;
  std::optional<AcceptedWalk> accepted_;
  double begun_ = 0.0;     // what the start costs
  double duration_ = 0.0;  // of the incumbent
  std::string refusal_;
};

}  // namespace halfstep
