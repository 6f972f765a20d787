#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/control/contact_watch.h"
#include "experiments/control/push_watch.h"
#include "experiments/live/episode.h"
#include "experiments/live/true_world.h"
#include "experiments/replay/replay_screen.h"
#include "experiments/replay/seeded_replay.h"
#include "wpg/geometry/pose2.h"

namespace halfstep::replay {

/// How the walk of a simulated robot went.
struct PhysicalOutcome {
  Replayed replayed;               ///< without rows when there was no walk
  std::vector<std::string> notes;  ///< on obstacles, as SimulatedObstacles has them
  std::vector<Push> pushes;        ///< EpisodeRobot::pushes
  bool in_goal = false;            ///< whether its soles truly stand in the goal at the end
  /// How far the goal then is, as seen from the support foot, from where it was measured last: what
  /// the robot takes the goal's place to be is off by that [m].
  double goal_off = 0.0;
  /// The nearest that a simulated sole which carries more than the other came to a no-step area
  /// that was there [m]; negative: it stood on one, that deep. Looked at each period.
  double no_step = std::numeric_limits<double>::infinity();
  std::string lost;  ///< EpisodePhysics::lost()
};

/// The robot of an episode in physics, and what happens to it.
struct EpisodeRobot {
  ReplaySetup setup;  ///< its obstacles do not count, nor plates of its relief
  std::optional<std::string> controller = {};  ///< Replayed::controller
  std::vector<Push> pushes = {};               ///< of the waist, one after the other
};

/// A simulated robot that executes an episode while it goes on, in MuJoCo, among obstacles that are
/// where the script says. Frames: W is that of the walk, in which the robot is where it believes to
/// be; U is that of the world, in which the simulated robot strays from its walk. At t = 0 both are
/// the same.
class EpisodePhysics {
 public:
  /// `truth`: what happens by the script; how the robot strays is simulated. Precondition:
  /// WhyNoSimulation() is "".
  EpisodePhysics(EpisodeRobot robot, const TrueWorld& truth, const LiveOptions& options);

  /// Plays the period that begins at a tick, for EpisodeHooks::on_tick. What begins in it has been
  /// decided by then. A robot that has fallen, or gets no more commands, stays as it is.
  void Play(const EpisodeTick& tick);
  /// Whether the waist leans by more than PlayOptions::fallen_tilt.
  bool fallen() const { return !rows_.empty() && rows_.back().fallen; }
  /// Why its controller commands no more (ControllerLost); "": it does.
  const std::string& lost() const { return lost_; }
  /// What the robot felt since the last call: events `early` and `late` (ContactWatch), and
  /// `pushed` when its DCM has left the plan so far that no foot is lifted.
  std::vector<EpisodeEvent> TakeFelt() { return std::exchange(felt_, {}); }
  /// Why no foot may be lifted from this support foot, by what was measured last: it does not
  /// carry, or the robot was pushed. "": one may.
  std::string Waits(Side support) const;
  /// The pose X_WU of the world, as seen from the sole that carries more, at a time that has been
  /// played [s]: there the simulated sole is the planned one. It jumps when another sole takes up
  /// the load. Before the walk it is the identity.
  Pose2 WorldAt(double t) const;
  /// The world as this robot sees it. Borrows this object.
  TrueWorld SeenByRobot() const;

  /// To be called when the episode is over. A robot that rests is left standing for
  /// PlayOptions::hold first, and may fall then.
  PhysicalOutcome Finish(const Episode& episode);

 private:
  // Rows about the period that begins then, and from the oldest measurement on that arrives in it
  // to the last command; in it the slopes are those of the walk.
  ReferenceMotion MotionAbout(const SuperposedWalk& walk, double begin) const;
  void Begin(const ReferenceMotion& motion, double waited);
  void Feel(const SuperposedWalk& walk);
  void FeelPush(const control::MeasuredState& measured);
  double NoStepAt(double t, const Pose2& X_US) const;
  // Until the controller is lost.
  void Advance(const SuperposedWalk& walk, double begin, double waited);
  void PlayPeriod(const SuperposedWalk& walk, double begin);
  // The motion that was executed, a row each period.
  ReferenceMotion Executed(const SuperposedWalk& walk, double end) const;

  EpisodeRobot robot_;
  TrueWorld truth_;  // in U, by the time of the script
  PlayOptions options_;
  control::ContactWatch contacts_;
  std::vector<EpisodeEvent> felt_;
  std::shared_ptr<const PlannedStates> plan_;  // none without a controller
  control::PushWatch pushes_;
  std::string lost_;
  std::optional<TrueWorld> since_;  // by the time of the walk
  std::optional<Player> player_;
  std::vector<ReplayRow> rows_;
  double no_step_ = std::numeric_limits<double>::infinity();
  std::vector<Pose2> worlds_;  // X_WU at the end of each period, the first at t = 0
};

}  // namespace halfstep::replay
