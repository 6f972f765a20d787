#pragma once

#include <Eigen/Core>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "opt/problem/problem.h"
#include "opt/solvers/solution.h"
#include "opt/solvers/solver.h"
#include "opt/solvers/solver_options.h"

namespace halfstep::opt {

/// All that one solve has in common, whatever the library: evaluates on demand, remembers the last
/// point, counts, keeps the best point seen and what blocks throw, and looks at the limits before
/// each evaluation. Not thread-safe; lives for one solve.
class SolveMonitor {
 public:
  enum class Iterations {
    kTold,          ///< the adapter calls ReportIterate; it starts with derivatives
    kImprovements,  ///< each point better than all before it is an iteration
  };

  SolveMonitor(const Problem& problem, const SolverOptions& options, Iterations iterations);

  /// Evaluates the start, whatever the limits, as iteration 0. False: it has no finite cost and
  /// constraints, a block threw or on_iterate stopped; Finish then says so.
  bool Begin(const Eigen::VectorXd& start);

  /// False, with the result untouched, when stopped, when the block threw or when a value is not
  /// finite. An x like the last one is not evaluated again.
  bool Cost(const Eigen::VectorXd& x, double* cost);
  bool Gradient(const Eigen::VectorXd& x, Eigen::VectorXd* gradient);
  bool Constraints(const Eigen::VectorXd& x, Eigen::VectorXd* values);
  /// Evaluates the constraints with it when they are not known at x.
  bool Jacobian(const Eigen::VectorXd& x, std::vector<double>* nonzeros);

  /// The next iteration ended at x. False: stop.
  bool ReportIterate(const Eigen::VectorXd& x);

  /// False once anything asks to stop: limits, stop token, on_iterate, an exception.
  bool MayGoOn();

  double RemainingTime() const;  ///< [s], inf without a deadline
  const Problem& problem() const { return problem_; }
  const SolverOptions& options() const { return options_; }
  int iterations() const { return iterations_; }
  bool saw_non_finite() const { return !non_finite_.empty(); }
  double highest_cost() const { return highest_cost_; }  ///< finite ones seen; −inf before any
  /// For Solution::used_options.
  void Use(const std::string& option, const std::string& value) { used_[option] = value; }

  /// The solver ended at `final_x` and claims `claim`; what is true of it goes into the Solution.
  Solution Finish(Ending claim, std::string message, const Eigen::VectorXd& final_x);

 private:
  struct Point {
    Eigen::VectorXd x;
    std::optional<double> cost;
    std::optional<Eigen::VectorXd> constraints, gradient;
    std::optional<std::vector<double>> jacobian;
    Violation violation;
    bool complete = false;  ///< cost and constraints are there and finite

    bool feasible(double tolerance) const { return complete && violation.amount <= tolerance; }
  };

  double Wall() const;
  void MoveTo(const Eigen::VectorXd& x);
  bool EvaluateCost();
  bool EvaluateConstraints();
  void KeepConstraints(Eigen::VectorXd values);
  void Consider();
  bool Better(const Point& a, const Point& b) const;
  void Stop(Ending ending, const std::string& message);
  /// Runs `evaluate`; what it throws is kept and stops the monitor.
  bool Guard(const std::function<void()>& evaluate);
  void CountIterate(const Point& point);
  /// Estimates stationarity and multipliers at the best point. False: it could not be evaluated.
  bool EstimateStationarity(Solution* solution);
  void Judge(Ending claim, const std::string& message, const Point& end, Solution* solution);

  const Problem& problem_;
  const SolverOptions& options_;
  const Iterations counting_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  Point point_, best_;
  bool beginning_ = false;  ///< the start is evaluated whatever the limits
  int points_ = 0;
  int iterations_ = 0;
  double highest_cost_;
  std::string non_finite_;         ///< a sentence about the last value that was not finite
  std::optional<Ending> stopped_;  ///< by what asked to stop first
  std::string stop_message_;
  Solution counted_;  ///< counts, history and exception so far
  std::map<std::string, std::string> used_;
};

/// How an adapter's run ended, in the solver's own opinion. A test of optimality that held is
/// kConverged, a weaker one or none at all kFailed: SolveMonitor says what is true of it.
struct SolverEnd {
  Ending claim;
  std::string message;
  Eigen::VectorXd x;
  std::shared_ptr<const WarmStart> warm_start = nullptr;
};

/// The frame of every Solver::Solve: refuses what the solver cannot take, projects and evaluates
/// the start, calls `run` if that went well, and judges the ending.
Solution MonitoredSolve(const Solver& solver, const Problem& problem, const Eigen::VectorXd& x0,
                        const SolverOptions& options, SolveMonitor::Iterations counting,
                        const std::function<SolverEnd(SolveMonitor&, const Eigen::VectorXd&)>& run);

}  // namespace halfstep::opt
