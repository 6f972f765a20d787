#pragma once

#include <array>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "experiments/live/executor.h"
#include "experiments/live/promise.h"
#include "experiments/live/replanner.h"
#include "experiments/live/sensor.h"
#include "experiments/live/walk_tail.h"
#include "experiments/live/world.h"
#include "wpg/geometry/side.h"

namespace halfstep {

/// Something that happened in an episode, in the order of time.
struct EpisodeEvent {
  double t = 0.0;      ///< [s]
  std::string what;    ///< as the column `event` of events.csv
  int version = 0;     ///< of the world that was known
  int walk = 0;        ///< index of the walk in execution
  int half_step = -1;  ///< that the event is about; −1: none
  std::string text;    ///< one line for people
};

/// A walk that was handed over.
struct ExecutedWalk {
  double t = 0.0;                              ///< when [s]; the first one at 0
  ProposalKind kind = ProposalKind::kChanged;  ///< why it was proposed
  std::string reason;                          ///< in words
  WalkTail tail;                               ///< the walk, from the step of first_changed on
  int first_changed = 0;                       ///< half-step; those before are the walk's before
  double asked = 0.0;                          ///< when the replanner began to work on it [s]
  double measured = 0.0;                       ///< t_m of the world that it was made for [s]
  double check_s = 0.0, plan_s = 0.0, smooth_s = 0.0;  ///< of the processor, computing [s]
  double effort = 0.0;                                 ///< of computing, as counted (Work::effort)
};

/// A permission to begin half-steps.
struct EpisodeGrant {
  double t = 0.0;  ///< from when on it counted [s]
  int walk = 0;    ///< index of the walk that it allows
  Grant grant;     ///< what may begin, and until when it may go on
};

/// A half-step that began.
struct BegunHalfStep {
  int half_step = 0;  ///< index in its walk
  int grant = 0;      ///< index of the grant that allowed it
};

/// How an episode ended.
enum class EpisodeEnding {
  kArrived,       ///< at rest in the goal, and nothing happens any more
  kStuck,         ///< at rest elsewhere when the time was up, and not by a command
  kTooLong,       ///< walking when the time was up
  kNoPlan,        ///< there was no walk to begin with
  kEnded,         ///< a client ended it, or the time was up when it rested as commanded
  kInterrupted,   ///< stopped from outside
  kFell,          ///< the simulated robot fell
  kUncontrolled,  ///< there were no more commands for the simulated robot
  kKilled,        ///< its process was killed: what is recorded was recovered
};
/// All of them.
inline constexpr std::array kEpisodeEndings = {
    EpisodeEnding::kArrived, EpisodeEnding::kStuck,        EpisodeEnding::kTooLong,
    EpisodeEnding::kNoPlan,  EpisodeEnding::kEnded,        EpisodeEnding::kInterrupted,
    EpisodeEnding::kFell,    EpisodeEnding::kUncontrolled, EpisodeEnding::kKilled};
/// As events.csv and manifests call it: "arrived".
std::string_view Name(EpisodeEnding ending);

/// The record of an episode.
struct Episode {
  EpisodeEnding ending = EpisodeEnding::kNoPlan;  ///< why the episode is over
  std::string message;                            ///< the same in words
  std::vector<World> worlds;                      ///< by version, as they became known
  std::vector<double> known;        ///< when each did [s]; at and before 0 those of the time waited
  std::vector<ExecutedWalk> walks;  ///< in the order of time
  std::vector<EpisodeGrant> grants;  ///< in the order of time
  std::vector<BegunHalfStep> begun;  ///< in the order of time
  std::vector<EpisodeEvent> events;  ///< in the order of time
  double waited = 0.0;       ///< before the first walk began, at t = 0; a time of the script [s]
  bool stopped = false;      ///< the last walk was cut after its half-step `begun.back()`
  double end = 0.0;          ///< [s]
  Promise promise{};         ///< whether it held (JudgePromise)
  double latest_tick = 0.0;  ///< by how much a tick of the wall clock came late at most [s]

  /// A walk, by index, from its first half-step on.
  WalkPlan Whole(size_t walk) const;
  /// The motion that was executed, which every walk of the record agrees with while it lasted.
  SuperposedWalk Executed() const;
};

/// What an episode shows of itself after each tick. `record` grows only: what was in it stays.
struct EpisodeTick {
  double now;                ///< [s]
  const Episode& record;     ///< of the episode so far
  const Executor& executor;  ///< the walk in execution
};

/// Callbacks of an episode, called in the thread that runs it; they must return quickly.
struct EpisodeHooks {
  std::function<void(const EpisodeTick&)> on_tick = {};  ///< called after each tick; may be empty
  /// Called at each look at the world before there is a walk, with the reason why not.
  std::function<void(const std::string& reason)> on_wait = {};
  /// Whether no half-step is to begin for the time being, so that the robot comes to rest.
  std::function<bool()> held = {};
  /// Why no foot may be lifted from this support foot for the time being, "": one may. An up
  /// half-step begins only then. Empty: feet carry when they are planned to.
  std::function<std::string(Side support)> waits = {};
  /// What the robot that executes the walk has felt since the last call; `t`, `version` and `walk`
  /// are filled in.
  std::function<std::vector<EpisodeEvent>()> felt = {};
  /// Whether the robot that executes the walk has fallen; then the episode ends.
  std::function<bool()> fallen = {};
  /// Why there are no more commands for the robot that executes the walk; then the episode ends.
  /// "": there are.
  std::function<std::string()> lost = {};
  std::stop_token stop = {};   ///< the robot comes to rest, then the episode ends, interrupted
  std::stop_token ended = {};  ///< the same, but that is how it was meant to end
};

/// Lets the robot walk from `start` by the config's clock lockstep: time stands still while the
/// replanner computes, and its budget is charged. The robot waits until there is a safe walk. The
/// same arguments give the same record, to the byte.
Episode RunLockstep(const Replanner& replanner, Sensor* sensor,
                    const std::array<Foothold, 2>& start, const EpisodeHooks& hooks);

/// The same by the wall clock: the replanner computes in a thread while the robot walks.
Episode RunWallClock(const Replanner& replanner, Sensor* sensor,
                     const std::array<Foothold, 2>& start, const EpisodeHooks& hooks);

}  // namespace halfstep
