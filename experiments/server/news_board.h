#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "experiments/live/episode.h"

namespace halfstep {

/// What happened in an episode since one looked last, as values.
struct EpisodeNews {
  std::shared_ptr<const SweptVolumes> volumes;  ///< of the half-steps, once they are prepared
  std::optional<std::string> waiting;           ///< there is no walk yet: why
  std::vector<World> worlds;                    ///< that became known
  std::vector<double> known;                    ///< of each of them [s]
  std::vector<ExecutedWalk> walks;              ///< that were handed over
  std::vector<EpisodeGrant> grants;             ///< that were given
  std::vector<EpisodeEvent> events;             ///< that happened
  size_t first_walk = 0, first_grant = 0;       ///< the index of the first of these
  /// The motion in execution, and the number of walks until now; null before there is one.
  std::shared_ptr<const SuperposedWalk> executed;
  int first_half_step = 0;  ///< of the whole walk the one that the motion's 0 is
  size_t num_walks = 0;     ///< so far
  double now = 0.0;         ///< [s]
  /// Whether nothing more begins; whether a client holds the robot.
  bool stopped = false, held = false;
  std::vector<std::string> refusals;  ///< of what clients wanted
};

/// Hands the news of an episode from the thread that runs it to the one that tells clients. A mutex
/// is held for a swap only, so neither waits for the other.
class NewsBoard {
 public:
  /// `wake` is called, in the thread of the episode, when there is something where there was
  /// nothing.
  explicit NewsBoard(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Of the thread of the episode.
  void Wait(const std::string& reason);
  void Prepare(std::shared_ptr<const SweptVolumes> volumes);  ///< half-steps are prepared
  void Refuse(const std::string& sentence);                   ///< the episode cannot begin, and why
  void Tick(const EpisodeTick& tick, bool held);              ///< after each tick

  EpisodeNews Take();  ///< what is new; of the thread that tells it

 private:
  void Add(const std::function<void(EpisodeNews*)>& change);

  std::function<void()> wake_;
  // Of the thread of the episode: how much of the record was told.
  size_t worlds_ = 0, walks_ = 0, grants_ = 0, events_ = 0;
  std::shared_ptr<const SuperposedWalk> executed_;
  int first_half_step_ = 0;
  bool stopped_ = false;

  std::mutex mutex_;  // of what follows
  EpisodeNews news_;
  bool told_ = true;
};

}  // namespace halfstep
