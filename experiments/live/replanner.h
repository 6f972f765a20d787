#pragma once

#include <array>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "experiments/live/executor.h"
#include "experiments/live/live_config.h"
#include "experiments/live/safety.h"
#include "experiments/live/world.h"
#include "planner/search/footstep_planner.h"
#include "planner/swept/swept_volumes.h"
#include "smoothing/walk/splice.h"

namespace halfstep {

struct PreparedWorld;

/// What a replanner is asked about: a walk in execution, and the world.
struct Situation {
  WalkPlan plan;
  std::vector<bool> smoothed;  ///< by junction: its overlap was found already
  Grant grant;                 ///< what is proved of it
  int robot_through = -1;      ///< what does not depend on the world is proved up to this half-step
  int begun = 0;               ///< the latest half-step that has begun
  bool stopped = false;        ///< nothing more begins unless a successor is handed over
  double now = 0.0;            ///< [s]
  double hand_over = 0.0;      ///< a successor is taken at this time at the earliest [s]
  std::shared_ptr<const World> world;
  bool shorten = false;  ///< when nothing else is to be done, look for a shorter way
  int used_up = 0;       ///< proposals in a row until now whose searches used up all nodes in vain
};

enum class ProposalKind {
  kSafe,       ///< the walk stays, and is safe
  kResumed,    ///< the walk goes on after a stop, as it was planned
  kChanged,    ///< other footsteps, around what is in the way or to another goal
  kShortened,  ///< other footsteps, since they are fewer
  kSmoothed,   ///< other overlaps
  kUnsafe,     ///< there is no safe way on that was found: what is granted is executed
};
inline constexpr std::array kProposalKinds = {ProposalKind::kSafe,     ProposalKind::kResumed,
                                              ProposalKind::kChanged,  ProposalKind::kShortened,
                                              ProposalKind::kSmoothed, ProposalKind::kUnsafe};
std::string_view Name(ProposalKind kind);

/// What a replanner found.
struct Proposal {
  ProposalKind kind = ProposalKind::kSafe;
  std::string reason = {};  ///< in words
  WalkPlan plan = {};       ///< a successor, or the walk itself
  std::vector<bool> smoothed = {};
  int robot_through = -1;
  int first_changed = -1;  ///< half-step; −1: none
  Grant grant = {};
  PlanResult planned = {};                             ///< the last search
  std::int64_t nodes = 0;                              ///< of all searches
  double check_s = 0.0, plan_s = 0.0, smooth_s = 0.0;  ///< where the time went [s]
};

/// Looks at a walk that is being executed, in this order of urgency: which half-steps are safe in
/// the world as it is known now; if not all, or if the walk does not end in the goal: other
/// footsteps from the last safe junction that can still be changed; else: overlaps of what has not
/// begun; else: fewer footsteps. A proposal is made as soon as the next half-steps of it are
/// proved; the next proposal proves the others. All searches of a proposal share the nodes of the
/// config's `planner.max_nodes`: what a proposal costs is bounded. When they were used up in vain,
/// the next search begins at another junction. Immutable; the same situation and the same state of
/// `random` give the same proposal.
class Replanner {
 public:
  /// `volumes` is borrowed. Clearances of volumes are those that the config demands.
  Replanner(const RobotModel& robot, const LiveConfig& config, const SweptVolumes& volumes);

  std::shared_ptr<const PreparedWorld> Prepare(const World& world) const;

  /// `among` is prepared of the situation's world.
  Proposal Propose(const Situation& situation, const PreparedWorld& among,
                   std::mt19937_64& random) const;

  /// A walk from the soles `start` to the goal of the world, with `junctions` of its overlaps
  /// found; the proposal is kUnsafe without a plan.
  Proposal Begin(const std::array<Footprint, 2>& start, const PreparedWorld& world, int junctions,
                 std::mt19937_64& random) const;

  const RobotModel& robot() const { return robot_; }
  const LiveConfig& config() const { return config_; }

 private:
  bool Arrives(const WalkPlan& plan, const World& world) const;
  PlanResult Plan(const std::array<Footprint, 2>& stance, const std::optional<StepState>& in_air,
                  const PreparedWorld& among, std::int64_t max_nodes,
                  std::mt19937_64& random) const;
  // Proves the walk of the proposal up to half-step `last` as far as it is not proved yet, and
  // grants it. Returns what refused it.
  std::optional<Margin> Prove(const Situation& situation, const SuperposedWalk& walk, int last,
                              const PreparedWorld& among, Proposal* proposal) const;
  // Other footsteps after half-step `junction`; false when there are none that are safe.
  bool Change(const Situation& situation, const WalkPlan& plan, int junction,
              const PreparedWorld& among, std::mt19937_64& random, Proposal* proposal) const;
  // The overlaps of the next junctions that were not found yet, no more than `ahead` behind
  // `begun`; false when there are none.
  bool Smooth(double from, int begun, int ahead, const PreparedWorld& among,
              Proposal* proposal) const;
  // A way with fewer footsteps, where one is found.
  void Shorten(const Situation& situation, const PreparedWorld& among, std::mt19937_64& random,
               Proposal* proposal) const;
  // Half-steps after which other footsteps may follow, best first.
  std::vector<int> Junctions(const Situation& situation, const SuperposedWalk& walk, int through,
                             bool arrives) const;

  RobotModel robot_;
  LiveConfig config_;
  const SweptVolumes& volumes_;
  SafetyCheck alone_;  // without obstacles
};

}  // namespace halfstep
