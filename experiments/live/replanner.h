#pragma once

#include <array>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/live/course_steps.h"
#include "experiments/live/free_half_steps.h"
#include "experiments/live/live_config.h"
#include "experiments/live/proposal.h"
#include "experiments/live/remembered_half_steps.h"
#include "experiments/live/safety.h"

namespace halfstep {

class NearRest;
struct PreparedWorld;

/// Looks at a walk that is being executed, in this order of urgency: which half-steps are safe in
/// the world as it is known now; if not all, or if the walk does not end in the goal, or does not
/// go on as it was commanded: other footsteps from the last safe junction that can still be
/// changed; else: overlaps of what has not begun; else: fewer footsteps. A proposal is made as soon
/// as the next half-steps of it are proved; the next proposal proves the others. All searches of a
/// proposal share the nodes of the config's `planner.max_nodes`: what a proposal costs is bounded.
/// When they were used up in vain, the next search begins at another junction. Immutable; the same
/// situation and the same state of `random` give the same proposal.
class Replanner {
 public:
  /// Of the place the robot and the ground count; what worlds hold is measured. Half-steps are
  /// called free by `volumes`, which is borrowed; its clearances are those that the config demands,
  /// and its set is what CertifiedHalfSteps() proved of this robot with this config.
  Replanner(const Place& place, const LiveConfig& config, const SweptVolumes& volumes);
  /// The same with half-steps that are called free by their proofs.
  Replanner(const Place& place, const LiveConfig& config);

  /// What questions about a world need, ready to be asked by several threads.
  std::shared_ptr<const PreparedWorld> Prepare(std::shared_ptr<const World> world) const;
  /// The same of a copy of the world.
  std::shared_ptr<const PreparedWorld> Prepare(const World& world) const {
    return Prepare(std::make_shared<const World>(world));
  }

  /// `among` is prepared of the situation's world.
  Proposal Propose(const Situation& situation, const PreparedWorld& among,
                   std::mt19937_64& random) const;

  /// A walk from the soles `start` to the goal of the world, or as it was commanded, with
  /// `junctions` of its overlaps found; the proposal is kUnsafe without a plan.
  Proposal Begin(const std::array<Foothold, 2>& start, const PreparedWorld& world, int junctions,
                 std::mt19937_64& random) const;

  const RobotModel& robot() const { return robot_; }    ///< the robot that walks
  const LiveConfig& config() const { return config_; }  ///< of the episode

 private:
  bool Arrives(const WalkPlan& plan, const World& world) const;
  // A refusal in words that name the half-step of the whole walk.
  std::string Describe(const Situation& s, const PreparedWorld& among, Margin refused) const;
  // `near`: of the first half-step, null: none. `rests`: before it the robot rests, so that there
  // is time to prove half-steps themselves where volumes are in the way.
  PlanResult Plan(const std::array<Foothold, 2>& stance, const std::optional<StepState>& in_air,
                  const PreparedWorld& among, const GoalRegion& goal, const NearRest* near,
                  bool rests, std::int64_t max_nodes, std::mt19937_64& random) const;
  PlanResult Search(const std::array<Foothold, 2>& stance, const std::optional<StepState>& in_air,
                    const PreparedWorld& among, const GoalRegion& goal, const NearRest* near,
                    const HalfStepQuery& query, std::int64_t max_nodes,
                    std::mt19937_64& random) const;
  // Proves the walk of the proposal up to half-step `last` as far as it is not proved yet, and
  // grants it. Returns what refused it. `near`, here and below: of the half-step that begins, or
  // began, at rest near an obstacle; null: none.
  std::optional<Margin> Prove(const Situation& situation, const SuperposedWalk& walk, int last,
                              const PreparedWorld& among, const NearRest* near,
                              Proposal* proposal) const;
  // Of a walk that is safe and arrives: going on, overlaps, or fewer footsteps.
  void Improve(const Situation& situation, const PreparedWorld& among, const NearRest* near,
               std::mt19937_64& random, Proposal* proposal) const;
  // Other footsteps after the first of the junctions where there are safe ones.
  void ChangeAnywhere(const Situation& situation, const std::vector<int>& junctions,
                      const PreparedWorld& among, const NearRest* near, std::mt19937_64& random,
                      Proposal* proposal) const;
  // Other footsteps after half-step `junction`; false when there are none that are safe.
  bool Change(const Situation& situation, const WalkPlan& plan, int junction,
              const PreparedWorld& among, const NearRest* near, std::mt19937_64& random,
              Proposal* proposal) const;
  // A search from half-step `junction` of a plan on to `goal`, with the nodes that are left.
  PlanResult PlanAfter(const Situation& situation, const WalkPlan& plan, int junction,
                       const PreparedWorld& among, const GoalRegion& goal, const NearRest* near,
                       std::mt19937_64& random, Proposal* proposal) const;
  // Takes these footsteps after half-step `junction`, of which the first `at_once` half-steps are
  // proved. Returns what refuses them; then the proposal stays as it is, but for what it cost.
  std::optional<Margin> Splice(const Situation& situation, const WalkPlan& plan, int junction,
                               const std::vector<Footstep>& footsteps, int at_once,
                               const PreparedWorld& among, const NearRest* near,
                               Proposal* proposal) const;
  // The same walk with overlaps, where all of it is proved; else what refuses it.
  std::optional<Margin> Start(const std::array<Foothold, 2>& start,
                              const std::vector<Footstep>& footsteps, const PreparedWorld& among,
                              const NearRest* near, int junctions, Proposal* proposal) const;

  // Of courses that are commanded (replanner_course.cc).
  Gait GaitOf(const WalkPlan& plan, const std::vector<bool>& smoothed) const;
  // The footsteps of a course that no list is, where `kept` [s] of the walk to come stays.
  CourseSteps StepsAhead(const Course& course, const Gait& gait, const Standing& standing,
                         double kept) const;
  // Those of a list, from where the feet stand on; fewer where the ground does not bear one.
  std::vector<Footstep> Listed(const Course& course, std::array<Foothold, 2> feet) const;
  // Whether what is planned of a walk along the course ends too soon.
  bool RunsShort(const Situation& situation, const Proposal& proposal, const Course& course) const;
  // As Change, along the course.
  bool Follow(const Situation& situation, const WalkPlan& plan, int junction, const Course& course,
              const PreparedWorld& among, const NearRest* near, std::mt19937_64& random,
              Proposal* proposal) const;
  // The same for a list of footsteps.
  bool FollowList(const Situation& situation, const WalkPlan& plan, int junction,
                  const Course& course, const PreparedWorld& among, const NearRest* near,
                  Proposal* proposal) const;
  Proposal BeginAlong(const std::array<Foothold, 2>& start, const PreparedWorld& among,
                      const NearRest* near, int junctions, std::mt19937_64& random) const;
  // A way with fewer footsteps, where one is found.
  void Shorten(const Situation& situation, const PreparedWorld& among, const NearRest* near,
               std::mt19937_64& random, Proposal* proposal) const;
  // Half-steps after which other footsteps may follow, best first.
  std::vector<int> Junctions(const Situation& situation, const SuperposedWalk& walk, int through,
                             bool arrives) const;

  RobotModel robot_;
  LiveConfig config_;
  FreeHalfSteps half_steps_;
  SafetyCheck alone_;  // without obstacles
  // Whether half-steps of the set are proved to keep all that `alone_` asks: they are on the floor
  // that they were proved on, or one that is no more slippery.
  bool set_is_proved_ = false;
  mutable RememberedHalfSteps proved_alone_;
  double width_;  // between the soles' centres where the feet stand side by side [m]
};

}  // namespace halfstep
