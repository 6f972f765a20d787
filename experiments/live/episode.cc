#include "experiments/live/episode.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

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
    case EpisodeEnding::kInterrupted:
      return "interrupted";
  }
  return "";
}

SuperposedWalk Episode::Executed() const {
  const SuperposedWalk walk = walks.back().plan.Walk();
  return stopped ? walk.StopBranch(begun.back().half_step) : walk;
}

Episode RunLockstep(const Replanner& replanner, const TrueWorld& truth,
                    const std::array<Footprint, 2>& start, const EpisodeHooks& hooks) {
  const auto seed = static_cast<std::uint64_t>(replanner.config().experiment.seed);
  LockstepThinker thinker(replanner, seed);
  return EpisodeLoop(
             replanner, truth, &thinker, [](double) {}, hooks)
      .Run(start);
}

Episode RunWallClock(const Replanner& replanner, const TrueWorld& truth,
                     const std::array<Footprint, 2>& start, const EpisodeHooks& hooks) {
  using Clock = std::chrono::steady_clock;
  const auto seed = static_cast<std::uint64_t>(replanner.config().experiment.seed);
  ThreadThinker thinker(replanner, seed);
  std::optional<Clock::time_point> begin;
  double latest = 0.0;
  const auto tick = [&](double now) {
    if (!begin) begin = Clock::now();
    const auto due =
        *begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(now));
    std::this_thread::sleep_until(due);
    latest = std::max(latest, std::chrono::duration<double>(Clock::now() - due).count());
  };
  Episode episode = EpisodeLoop(replanner, truth, &thinker, tick, hooks).Run(start);
  episode.latest_tick = latest;
  return episode;
}

}  // namespace halfstep
