#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/live/episode.h"
#include "experiments/live/episode_clock.h"
#include "experiments/live/executor.h"
#include "experiments/live/past_worlds.h"
#include "experiments/live/sensor.h"
#include "experiments/live/thinker.h"

namespace halfstep {

/// One episode, tick after tick: what is measured, what the replanner found, which half-steps
/// begin.
class EpisodeLoop {
 public:
  /// All are borrowed.
  EpisodeLoop(const Replanner& replanner, Sensor* sensor, Thinker* thinker, EpisodeClock* clock,
              const EpisodeHooks& hooks);

  /// Runs an episode from soles at rest at `start` (X_WF, by Index(Side)) until it ends.
  Episode Run(const std::array<Foothold, 2>& start);

 private:
  static constexpr double kRetry = 0.2;  // after a search that found no way [s]

  // Measures until there is a walk, and until it begins, at the time that is t = 0 from then on.
  Proposal Wait(const std::array<Foothold, 2>& start);
  // Takes in the frames that have arrived by now.
  void Sense(double now);
  void Advance(double now);
  // Why the robot cannot begin the next half-step; "": it can.
  std::string Awaited(double now) const;
  void Begins(int half_step);
  bool NeedsWork(double now);
  // DiffersClearly of a world that was looked at and the latest one. Found once for both: that
  // takes a look at every obstacle.
  struct Difference {
    std::shared_ptr<const World> from = {}, to = {};
    bool clear = false;
  };
  bool Differs(const std::shared_ptr<const World>& from, Difference* known) const;
  void Ask(double now);
  void Take(const Proposal& proposal, double now);
  void HandOver(const Proposal& proposal, double now);
  bool Ends(double now);
  // Whether the robot is to come to rest for good.
  bool IsToEnd() const { return hooks_.stop.stop_requested() || hooks_.ended.stop_requested(); }
  // Of a grant that counts from t on, half-steps of the whole walk.
  void Record(Grant grant, double t);
  void Know(double t);
  // Tells that another course is commanded than `before`, if it is.
  void TellCommand(double t, const std::shared_ptr<const Course>& before);
  // `half_step` as the executor counts them.
  void Tell(double t, const std::string& what, const std::string& text, int half_step = -1);
  int walk() const { return static_cast<int>(record_.walks.size()) - 1; }

  const Replanner& replanner_;
  const LiveOptions& options_;
  Sensor& sensor_;
  Thinker& thinker_;
  EpisodeClock& clock_;
  const EpisodeHooks& hooks_;
  Episode record_;
  std::shared_ptr<const World> world_;
  PastWorlds past_;
  std::optional<Executor> executor_;
  // Of the walk in execution.
  std::vector<bool> smoothed_;
  int robot_through_ = -1;
  std::shared_ptr<const Course> course_;
  int refused_ = 0;  // number of a list of footsteps
  bool held_ = false;
  std::string awaited_;
  // What the thinker does.
  bool thinking_ = false;
  bool hurried_ = false, hurried_before_ = false;  // this question, and the one before
  double asked_ = 0.0;
  double patience_ = 0.0;  // what an answer may take: the budget, or more after a late one [s]
  std::shared_ptr<const World> asked_about_;
  // What it is to do next.
  std::shared_ptr<const World> checked_;
  Difference from_asked_, from_checked_;
  bool again_ = true, stuck_ = false;
  double retry_ = 0.0;  // until the next search when one found no way [s]
  int tries_ = 0;       // to shorten the way
  int used_up_ = 0;     // as Situation says
};

}  // namespace halfstep
