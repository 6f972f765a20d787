#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <stop_token>
#include <vector>

namespace halfstep {

/// How far a planner has come.
struct PlanProgress {
  std::int64_t nodes = 0;                                 ///< so far
  std::int64_t queries = 0;                               ///< of half-steps, so far
  double cost = std::numeric_limits<double>::infinity();  ///< of the best plan; ∞: none yet
  std::int64_t nodes_since_improvement = 0;  ///< since a plan got better; 0 while there is none
  std::int64_t samples = 0;                  ///< of a random tree that came to no node, so far
  double proofs = 0.0;  ///< effort of queries that prove what they answer (PlanRequest::proofs)
  /// Whether there is one.
  bool has_plan() const { return cost < std::numeric_limits<double>::infinity(); }

  /// Nodes, queries and samples in one unit, that of Work::effort: 1 is about a second of one core
  /// of 2026. Source: planner/README.md, "Termination".
  double effort() const {
    return proofs +
           1e-6 * (kNode * static_cast<double>(nodes) + kQuery * static_cast<double>(queries) +
                   kSample * static_cast<double>(samples));
  }
  static constexpr double kNode = 15.0;    ///< what a node takes [µs]
  static constexpr double kQuery = 1.0;    ///< what a query takes [µs]
  static constexpr double kSample = 15.0;  ///< what a sample takes that came to no node [µs]
};

/// Why a planner shall stop.
enum class StopReason {
  kGoOn,
  kEnough,       ///< the plan is good enough
  kBudget,       ///< nodes or effort are used up
  kClock,        ///< a time has come: where the search was then is not the same twice
  kInterrupted,  ///< stopped on request
};

/// Asked before every node. A value that can be copied; reasons are combined with AnyOf.
using Termination = std::function<StopReason(const PlanProgress&)>;

/// The time now [s], from an arbitrary origin; never goes backwards. The libraries read no clock of
/// their own.
using Clock = std::function<double()>;

/// kClock when `clock` shows `end` [s] or more.
Termination AtTime(Clock clock, double end);
/// kBudget after that many nodes; 0: at once.
Termination AfterNodes(std::int64_t nodes);
/// kBudget when PlanProgress::effort is that or more.
Termination AfterEffort(double effort);
/// kEnough when there is a plan.
Termination AtFirstPlan();
/// kEnough when there is a plan and that many nodes did not improve it.
Termination WhenNotImprovedFor(std::int64_t nodes);
/// kEnough when there is a plan, and PlanProgress::effort is that or more and three times what it
/// was when it was first asked with a plan.
Termination WhenPlannedAfter(double effort);
/// kInterrupted when a stop was requested.
Termination OnRequest(std::stop_token token);
/// The first answer of them other than kGoOn.
Termination AnyOf(std::vector<Termination> terminations);

}  // namespace halfstep
