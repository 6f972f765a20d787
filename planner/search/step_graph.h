#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "planner/search/footstep_planner.h"
#include "wpg/geometry/foothold.h"
#include "wpg/nth.h"

namespace halfstep {

/// The states between a stance and a goal, and the elements that lead from one to the next: what
/// all planners of one request search. Counts the queries that it makes.
/// k is always the place of an element in elements().
class StepGraph {
 public:
  /// Uses only `elements` of the set. The request is borrowed. Precondition: where the request has
  /// neither levels nor ground, all is at one height, and with ground the elements are
  /// (std::logic_error).
  StepGraph(const PlanRequest& request, std::vector<int> elements);

  /// Indices into the set; k counts in this list.
  const std::vector<int>& elements() const { return elements_; }
  int size() const { return static_cast<int>(elements_.size()); }  ///< number of elements
  double cost(int k) const { return Nth(costs_, k); }              ///< of one step by element k
  const StepReach& reach() const { return reach_; }                ///< how far steps go
  const GoalRegion& goal() const { return request_.goal; }         ///< of the request
  /// Where supporting soles stay, in W [m].
  const Eigen::AlignedBox2d& workspace() const { return workspace_; }

  /// The states after an up half-step from the start that is free: none, one or two
  /// of each height of the waist. With a foot in
  /// the air already: that state.
  std::vector<StepState> FreeStarts() const;

  /// What a walk that begins with one of these costs before its first footstep: nothing upright;
  /// where the waist comes down in that up half-step, twice what an element costs more that changes
  /// the height, so that plans come down where they have to.
  double StartCost(const StepState& start) const {
    const bool comes_down = !request_.in_air && start.form > 0;
    return comes_down ? 2.0 * (StepCost::kChangeOfHeight - 1.0) * reach_.least_cost() : 0.0;
  }

  /// Where element k lands from a state, X_WF, at the exact height of the level where there is one;
  /// the height is NaN where PlanRequest::ground bears no sole there.
  Foothold Landing(const StepState& from, int k) const;
  /// The state after that landing and its up half-step.
  StepState After(const StepState& from, int k) const { return After(from, k, Landing(from, k)); }
  /// The same where Landing() is known.
  StepState After(const StepState& from, int k, const Foothold& X_WF) const {
    return {X_WF, Opposite(from.support), changes_.empty() ? from.form : Nth(changes_, k).to};
  }
  /// Whether element k begins at the waist's height of a state; else its half-steps are not free.
  bool Fits(const StepState& from, int k) const {
    return changes_.empty() || Nth(changes_, k).from == from.form;
  }
  /// Landing() of all elements at once: exactly the same poses, but with PlanRequest::ground, where
  /// heights are NaN until they are looked up, by Settled().
  void Landings(const StepState& from, std::vector<Foothold>* X_WF) const;
  /// Whether Landings() leaves heights out.
  bool looks_up_heights() const { return static_cast<bool>(request_.ground); }
  /// One of Landings() from a state, with its height.
  Foothold Settled(const StepState& from, const Foothold& X_WF) const {
    return looks_up_heights() ? Foothold(X_WF.Planar(), HeightAt(X_WF.Planar(), from)) : X_WF;
  }

  /// Whether a half-step of element k is free; a forbidden down half-step is not.
  bool DownIsFree(const StepState& from, int k);
  /// The same of its up half-step, after landing.
  bool UpIsFree(const StepState& from, int k);
  /// Whether landing there ends the walk.
  bool IsGoal(const StepState& from, const Foothold& X_WF) const {
    return goal().ContainsLanding(Opposite(from.support), X_WF, from.X_WS);
  }

  /// Lower bounds of the footsteps from a state to the goal: the least integer, and a number below
  /// it that falls steadily towards the goal.
  int LeastSteps(const StepState& from) const;
  /// The number that falls steadily.
  double SteadySteps(const StepState& from) const;

  /// From now on element k is not free from that state.
  void Forbid(const StepState& from, int k);
  bool IsForbidden(const StepState& from, int k) const;  ///< whether Forbid() was called so
  std::int64_t queries() const { return queries_; }      ///< of half-steps, so far
  /// Counts queries that were made elsewhere on behalf of the same planning.
  void AddQueries(std::int64_t more) { queries_ += more; }

  /// Whether there is a level at that height [m], somewhere; true where all is at one height. With
  /// PlanRequest::ground: whether the height was found.
  bool IsLevel(double height) const {
    if (looks_up_heights()) return !std::isnan(height);
    return request_.levels.empty() || std::ranges::binary_search(request_.levels, height);
  }
  /// Whether the ground bears a sole there (HalfStepQuery::Bears).
  bool Bears(const Foothold& X_WF) const { return request_.query.Bears(X_WF); }

 private:
  // A height, or that of the level that it is of.
  double OnLevel(double height) const;
  // By PlanRequest::ground.
  double HeightAt(const Pose2& X_WF, const StepState& from) const {
    return request_.ground(X_WF, from.X_WS.height);
  }

  struct Edge {
    StepState from;
    int k;
    friend bool operator==(const Edge&, const Edge&) = default;
  };
  const PlanRequest& request_;
  std::vector<int> elements_;
  std::vector<double> costs_;                        // by k
  std::array<std::vector<Foothold>, 2> placements_;  // by support and k
  std::vector<StepSet::Change> changes_;             // by k; empty: all are of one form
  StepReach reach_;
  Eigen::AlignedBox2d workspace_;
  std::vector<Edge> forbidden_;
  std::int64_t queries_ = 0;
};

/// Every element of a set.
std::vector<int> AllElements(const StepSet& set);

}  // namespace halfstep
