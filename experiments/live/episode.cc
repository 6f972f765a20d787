#include "experiments/live/episode.h"

#include "experiments/live/episode_loop.h"
#include "experiments/live/thinker.h"

namespace halfstep {

std::string_view Name(EpisodeEnding ending) {
  switch (ending) {
    case EpisodeEnding::kArrived:
      return "arrived";
    case EpisodeEnding::kStuck:
      return "stuck";
    case EpisodeEnding::kTooLong:
      return "too_long";
    case EpisodeEnding::kNoPlan:
      return "no_plan";
    case EpisodeEnding::kEnded:
      return "ended";
    case EpisodeEnding::kInterrupted:
      return "interrupted";
    case EpisodeEnding::kFell:
      return "fell";
    case EpisodeEnding::kUncontrolled:
      return "uncontrolled";
    case EpisodeEnding::kKilled:
      return "killed";
  }
  return "";
}

WalkPlan Episode::Whole(size_t walk) const {
  WalkPlan whole;
  for (size_t k = 0; k <= walk; ++k) Join(walks.at(k).tail, &whole);
  return whole;
}

SuperposedWalk Episode::Executed() const {
  const SuperposedWalk walk = Whole(walks.size() - 1).Walk();
  return stopped ? walk.StopBranch(begun.back().half_step) : walk;
}

Episode RunLockstep(const Replanner& replanner, Sensor* sensor,
                    const std::array<Foothold, 2>& start, const EpisodeHooks& hooks) {
  const auto seed = static_cast<std::uint64_t>(replanner.config().experiment.seed);
  LockstepThinker thinker(replanner, seed);
  EpisodeClock clock;
  return EpisodeLoop(replanner, sensor, &thinker, &clock, hooks).Run(start);
}

Episode RunWallClock(const Replanner& replanner, Sensor* sensor,
                     const std::array<Foothold, 2>& start, const EpisodeHooks& hooks) {
  const auto seed = static_cast<std::uint64_t>(replanner.config().experiment.seed);
  ThreadThinker thinker(replanner, seed);
  WallClock clock;
  Episode episode = EpisodeLoop(replanner, sensor, &thinker, &clock, hooks).Run(start);
  episode.latest_tick = clock.latest();
  return episode;
}

}  // namespace halfstep
