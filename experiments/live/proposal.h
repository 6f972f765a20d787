#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/live/executor.h"
#include "experiments/live/world.h"
#include "planner/search/footstep_planner.h"
#include "smoothing/walk/splice.h"

namespace halfstep {

/// What a replanner is asked about: a walk in execution, and the world.
struct Situation {
  WalkPlan plan;  ///< the walk in execution, or its RecentPart: from here half-steps count
  int first = 0;  ///< of the walk's half-steps the one that the plan's 0 is, for words
  std::vector<bool> smoothed;  ///< by junction: its overlap was found already
  Grant grant;                 ///< what is proved of it
  int robot_through = -1;      ///< what does not depend on the world is proved up to this half-step
  int begun = 0;               ///< the latest half-step that has begun
  bool stopped = false;        ///< nothing more begins unless a successor is handed over
  double now = 0.0;            ///< [s]
  double hand_over = 0.0;      ///< a successor is taken at this time at the earliest [s]
  std::shared_ptr<const World> world;         ///< the latest that is known; not null
  std::shared_ptr<const Course> course = {};  ///< that the walk was planned for; null: the goal
  int refused = 0;       ///< number of a list of footsteps that was refused; 0: none
  bool shorten = false;  ///< when nothing else is to be done, look for a shorter way
  int used_up = 0;       ///< proposals in a row until now whose searches used up all nodes in vain
  std::stop_token hurry = {};  ///< requested: nothing is begun that only improves a safe walk
};

/// What kind of answer a replanner gives.
enum class ProposalKind {
  kSafe,       ///< the walk stays, and is safe
  kResumed,    ///< the walk goes on after a stop, as it was planned
  kChanged,    ///< other footsteps, around what is in the way or to another goal
  kShortened,  ///< other footsteps, since they are fewer
  kSmoothed,   ///< other overlaps
  kCommanded,  ///< other footsteps, one by one as they were commanded
  kUnsafe,     ///< there is no safe way on that was found: what is granted is executed
};
/// All of them.
inline constexpr std::array kProposalKinds = {ProposalKind::kSafe,     ProposalKind::kResumed,
                                              ProposalKind::kChanged,  ProposalKind::kShortened,
                                              ProposalKind::kSmoothed, ProposalKind::kCommanded,
                                              ProposalKind::kUnsafe};
/// As walks.csv calls it: "changed".
std::string_view Name(ProposalKind kind);

/// What an answer took, by part.
struct Spent {
  double check = 0.0;                                   ///< finding what is safe
  double plan = 0.0;                                    ///< looking for footsteps
  double smooth = 0.0;                                  ///< looking for overlaps
  double all() const { return check + plan + smooth; }  ///< of the three
};

/// What a replanner found.
struct Proposal {
  ProposalKind kind = ProposalKind::kSafe;    ///< what is proposed
  std::string reason = {};                    ///< in words
  WalkPlan plan = {};                         ///< a successor, or the walk itself
  std::vector<bool> smoothed = {};            ///< of `plan`, as in Situation
  int robot_through = -1;                     ///< of `plan`, as in Situation
  int first_changed = -1;                     ///< half-step; −1: none
  Grant grant = {};                           ///< what is proved of `plan`
  std::shared_ptr<const Course> course = {};  ///< of `plan`, as in Situation
  bool refuses = false;                       ///< the footsteps that are commanded
  Spent effort = {};                          ///< as Work::effort()
  PlanResult planned = {};                    ///< the last search
  std::int64_t nodes = 0;                     ///< of all searches
  Spent seconds = {};                         ///< of the processor [s]
};

}  // namespace halfstep
