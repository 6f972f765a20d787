#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "planner/search/goal_region.h"
#include "planner/search/half_step_query.h"
#include "planner/search/half_step_times.h"
#include "planner/search/step_cost.h"
#include "planner/search/step_set.h"
#include "planner/search/termination.h"
#include "wpg/geometry/foothold.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// The answer of a full check of the walk that a plan makes; a bool converts to it.
struct Acceptance {
  bool accepted = true;       ///< whether the walk is as wanted
  int refused_footstep = -1;  ///< index of the footstep whose step is to blame; −1: not known
  /// `refused` has a meaning only when the answer is no.
  Acceptance(bool yes, int refused = -1)  // NOLINT: a plain bool is an answer
      : accepted(yes), refused_footstep(refused) {}
};

/// The foot `support` stands at X_WS and carries, the other one is at its via point.
struct StepState {
  Foothold X_WS;               ///< where the foot that carries stands, in W
  Side support = Side::kLeft;  ///< that foot
  int form = 0;                ///< the waist's height, of StepSet::forms
  friend bool operator==(const StepState&, const StepState&) = default;
};

/// A planning problem. What it refers to is borrowed for the call of Plan.
struct PlanRequest {
  std::array<Foothold, 2> start;  ///< soles in W by Index(Side), standing
  /// Where a walk is replanned with one foot in the air: the walk begins here, and `start` only
  /// says what the default workspace is around. The first footstep is that foot's.
  std::optional<StepState> in_air = {};
  GoalRegion goal;             ///< where the walk shall end
  const StepSet& set;          ///< not empty
  const HalfStepQuery& query;  ///< of the same set
  /// Where obstacles move: when half-steps are free of these, while `query` answers for what rests.
  /// Plans then have times, and what is minimized is the walk's duration: a second counts as much
  /// as a second of the set's half-steps. Preconditions: the planner knows time, the elements cost
  /// the same, and no foot is in the air (std::logic_error). Null: `query` answers for all.
  const HalfStepTimes* times = nullptr;
  StepCost cost = {};  ///< what is minimized
  /// Heights of the ground's levels, ascending, on one of which each sole stands [m]. Empty: all is
  /// at the height of the start, unless there is `ground`.
  std::vector<double> levels = {};
  /// In place of `levels`, where elements have no height of their own but land on the ground under
  /// them: the height [m] at which the ground bears a sole at X_WF, seen from above, for who stands
  /// at the height `from` [m]; NaN: it bears none there. Empty: heights are those of the set.
  std::function<double(const Pose2& X_WF, double from)> ground = {};
  /// Supporting soles' centres stay inside [m]. None: 2 m around the start and the goal.
  std::optional<Eigen::AlignedBox2d> workspace = {};
  /// Whether an up half-step from the start, which is in no set, is free: its support sole stands
  /// at X_WS. Empty: it always is.
  std::function<bool(const HalfStep&, const Foothold& X_WS)> start_is_free = {};
  /// Asked about each plan before it is returned, best first. Empty: every plan is accepted.
  std::function<Acceptance(const std::vector<Footstep>&)> accepts = {};
  int max_refusals = 20;  ///< refusals after which planning ends with kRefused
  /// Effort of the proofs that `query` made so far, where these take longer than a query of volumes
  /// (PlanProgress::kQuery). Empty: none.
  std::function<double()> proofs = {};
  Termination stop = {};  ///< empty: only when the planner ends by itself
  Clock clock = {};       ///< for the times of the result only; empty: they are NaN
};

/// How planning ended.
enum class PlanStatus {
  kNotRun,
  kSolved,        ///< there is a plan
  kNoPlan,        ///< everything was searched, at the planner's resolution
  kStartBlocked,  ///< no foot can leave the floor
  kBudget,        ///< nodes, effort or time were used up before a plan was found
  kInterrupted,   ///< stopped before a plan was found
  kRefused,       ///< there were plans, but `accepts` refused them
};
/// As manifests call it: "solved".
std::string_view Name(PlanStatus status);

/// What a planner found, and its work.
struct [[nodiscard]] PlanResult {
  PlanStatus status = PlanStatus::kNotRun;       ///< how it ended
  std::string sentence = "Plan was not called";  ///< the same for people
  /// Ends with both feet on the floor. Empty when the start is a goal, and without a plan.
  std::vector<Footstep> footsteps;
  std::vector<int> elements;  ///< of the set, one per footstep
  /// Of the plan, by PlanRequest::cost; ∞ without one.
  double cost = std::numeric_limits<double>::infinity();
  bool exhausted = false;  ///< the search ended by itself: a longer budget changes nothing
  StopReason stop = StopReason::kGoOn;  ///< what ended it, when `exhausted` is false
  std::int64_t nodes = 0;    ///< states that a planner keeps or expands, over all its searches
  std::int64_t queries = 0;  ///< of half-steps: DownIsFree and UpIsFree
  std::int64_t samples = 0;  ///< of random trees that came to no node
  /// All three in one unit (PlanProgress::effort).
  double effort() const {
    return PlanProgress{.nodes = nodes, .queries = queries, .samples = samples}.effort();
  }
  int refusals = 0;  ///< plans that `accepts` refused
  double time_to_first = std::numeric_limits<double>::quiet_NaN();  ///< plan, by the clock [s]
  double time = std::numeric_limits<double>::quiet_NaN();           ///< in all [s]
};

/// Finds footsteps from a stance into a goal region. Every half-step of a plan between the first
/// up half-step (start_is_free) and the last down half-step was called free by the query.
/// State: pose and side of the supporting foot, the other one at its via point. Edge: the down
/// half-step of an element, then its up half-step; the last edge of a plan lacks the up half-step.
/// Immutable: the same request and the same state of `random` give the same plan, unless `stop`
/// looks at a clock.
class FootstepPlanner {
 public:
  virtual ~FootstepPlanner() = default;
  /// Preconditions (std::logic_error): finite start, valid goal, set not empty.
  virtual PlanResult Plan(const PlanRequest& request, std::mt19937_64& random) const = 0;
  /// Whether it plans from level to level; if not, all has to be at one height.
  virtual bool knows_levels() const { return true; }
  /// Whether it plans in time (PlanRequest::times).
  virtual bool knows_time() const { return false; }
};

}  // namespace halfstep
