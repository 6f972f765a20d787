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

/// What every solve needs, whatever the library: evaluates on demand, remembers the last point,
/// counts evaluations, keeps the best point seen and what blocks throw, and checks the limits
/// before each evaluation. Not thread-safe; lives for one solve.
class SolveMonitor {
 public:
  /// What counts as an iteration.
  enum class Iterations {
    kTold,          ///< the adapter calls ReportIterate; Begin evaluates the Jacobian, too
    kImprovements,  ///< each point better than all before it is an iteration
  };

  /// Both are borrowed.
  SolveMonitor(const Problem& problem, const SolverOptions& options, Iterations iterations);

  /// Evaluates the start as iteration 0, whatever the limits. Returns false when its cost or
  /// constraints are not finite, a block threw or on_iterate stopped; Finish then says so.
  bool Begin(const Eigen::VectorXd& start);

  /// Each evaluates at x, unless x is the last point. Returns false, and leaves the output
  /// untouched, when stopped, when a block threw or when a value is not finite.
  bool Cost(const Eigen::VectorXd& x, double* cost);
  bool Gradient(const Eigen::VectorXd& x, Eigen::VectorXd* gradient);   ///< ∇f (n)
  bool Constraints(const Eigen::VectorXd& x, Eigen::VectorXd* values);  ///< g (m)
  /// Also evaluates the constraints when they are not known at x.
  bool Jacobian(const Eigen::VectorXd& x, std::vector<double>* nonzeros);

  /// Records that the next iteration ended at x. Returns false when the solver must stop.
  bool ReportIterate(const Eigen::VectorXd& x);

  /// Returns false once a limit, the stop token, on_iterate or an exception has asked to stop.
  bool MayGoOn();

  /// Adds to Solution::linear_algebra, after each factorization.
  void CountAlgebra(long multiplications) { counted_.linear_algebra += multiplications; }
  /// From now on each evaluation of the Jacobian adds `passes` times its declared non-zeros: what a
  /// library does with a Jacobian is not seen, and is taken for so many passes over it.
  void EstimateAlgebra(int passes) { passes_ = passes; }

  double RemainingTime() const;                                 ///< [s], inf without a deadline
  const Problem& problem() const { return problem_; }           ///< that is being solved
  const SolverOptions& options() const { return options_; }     ///< as the caller gave them
  int iterations() const { return iterations_; }                ///< so far
  bool saw_non_finite() const { return !non_finite_.empty(); }  ///< whether a value was not finite
  double highest_cost() const { return highest_cost_; }  ///< of finite ones seen; −inf: none yet
  /// Records an option in Solution::used_options.
  void Use(const std::string& option, const std::string& value) { used_[option] = value; }

  /// Ends the solve: the solver stopped at `final_x` and claims `claim`, which is checked. Makes
  /// the Solution.
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
  int passes_ = 0;  ///< over each Jacobian by a library
  int iterations_ = 0;
  double highest_cost_;
  std::string non_finite_;         ///< a sentence about the last value that was not finite
  std::optional<Ending> stopped_;  ///< by what asked to stop first
  std::string stop_message_;
  Solution counted_;  ///< counts, history and exception so far
  std::map<std::string, std::string> used_;
};

/// How an adapter's run ended, by the solver's own account. The claim is kConverged when the
/// solver's test of optimality held, and kFailed when only a weaker one or none did;
/// SolveMonitor::Finish judges it.
struct SolverEnd {
  Ending claim;         ///< kConverged or kFailed as above, or why it stopped early
  std::string message;  ///< the library's own words
  Eigen::VectorXd x;    ///< where it ended (n)
  /// For a later solve; null: the solver has none.
  std::shared_ptr<const WarmStart> warm_start = nullptr;
};

/// The frame of every Solver::Solve: refuses what the solver cannot take, projects and evaluates
/// the start, calls `run` if that went well, and judges the ending.
Solution MonitoredSolve(const Solver& solver, const Problem& problem, const Eigen::VectorXd& x0,
                        const SolverOptions& options, SolveMonitor::Iterations counting,
                        const std::function<SolverEnd(SolveMonitor&, const Eigen::VectorXd&)>& run);

}  // namespace halfstep::opt
