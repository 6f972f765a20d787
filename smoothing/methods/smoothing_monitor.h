#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>

#include "smoothing/methods/smoothing_result.h"
#include "smoothing/methods/stopwatch.h"
#include "smoothing/methods/walk_problem.h"

namespace halfstep {

/// What whoever calls a smoother may ask of it while it works.
struct MonitorOptions {
  std::function<void(double)> progress = {};  ///< told the fraction that is done
  std::stop_token stop = {};                  ///< ends the search; what was found stays
  std::stop_token stop_proof = {};            ///< comes later; also ends a proof that is under way
  double deadline = std::numeric_limits<double>::infinity();  ///< of the search [s]
  /// Told every new incumbent.
  std::function<void(const HomotopyParameters&)> on_incumbent = {};
};

/// Keeps what one call of a smoother found so far: the incumbent, which is feasible in the sense of
/// the problem's test, the candidates and the effort; knows when to stop. At any moment Finish()
/// makes the result of it, so smoothers differ in how they search only.
class SmoothingMonitor {
 public:
  SmoothingMonitor() : SmoothingMonitor(MonitorOptions{}) {}
  explicit SmoothingMonitor(MonitorOptions options) : options_(std::move(options)) {}
  /// For a smoother within this one: stops with it; its progress is a part of this one's.
  MonitorOptions Part(double from, double to) const;

  /// Forgets what there is and begins at `start`. The problem is borrowed until Finish().
  void Begin(const WalkProblem& problem, const HomotopyParameters& start);
  /// Begins and asks whether the start, "the planned motion", keeps every margin for all its time.
  /// False: it does not, or that was stopped, and Refusal() is the result.
  bool BeginFeasibly(const WalkProblem& problem, const HomotopyParameters& start,
                     const std::string& what);
  SmoothingResult Refusal() { return Finish(opt::Ending::kNotRun, refusal_, ""); }

  bool stopped() const { return options_.stop.stop_requested(); }
  std::stop_token stop() const { return options_.stop; }
  double Seconds() const { return stopwatch_.Seconds(); }
  double Remaining() const { return options_.deadline - Seconds(); }  ///< to the deadline [s]
  void Progress(double done) const {
    if (options_.progress) options_.progress(done);
  }

  /// For every question to the problem's test.
  MarginEvaluator::Scratch* scratch() { return &*scratch_; }
  /// Effort elsewhere.
  void Count(long instants, long collision_queries);
  void Count(const SmoothingResult& part) { Count(part.instants, part.collision_queries); }
  long instants() const { return result_.instants + scratch_->instants; }

  const HomotopyParameters& incumbent() const { return result_.parameters; }
  double cost() const { return result_.cost; }
  double duration() const { return duration_; }  ///< of the incumbent [s]
  /// Makes the incumbent what was found feasible at that cost. `duration` [s] of its walk.
  void Adopt(const HomotopyParameters& parameters, double cost, double duration);
  /// The start turned out not to be feasible: whatever was adopted is an improvement.
  void DropStart() { begun_ = std::numeric_limits<double>::infinity(); }
  /// Notes a candidate of which the caller has filled what it knows; time, effort and the
  /// incumbent's part are filled here.
  void Record(SmoothingIterate iterate);

  /// What else there is to say: junctions, evidence …
  SmoothingResult& result() { return result_; }

  /// The result, how it ended and why. When the incumbent costs no less than the start, kNotRun
  /// apart, the ending is kNoImprovement, and `no_gain` is added to the message.
  SmoothingResult Finish(opt::Ending ending, const std::string& message,
                         const std::string& no_gain);

 private:
  MonitorOptions options_;
  Stopwatch stopwatch_;
  const WalkProblem* problem_ = nullptr;
  std::optional<MarginEvaluator::Scratch> scratch_;
  SmoothingResult result_;
  double begun_ = 0.0;     // what the start costs
  double duration_ = 0.0;  // of the incumbent
  std::string refusal_;
};

}  // namespace halfstep
