// How an episode waits for its first walk.

#include <algorithm>
#include <utility>
#include <vector>

#include "experiments/live/episode_loop.h"

namespace halfstep {

Proposal EpisodeLoop::Wait(const std::array<Foothold, 2>& start) {
  std::mt19937_64 random(static_cast<std::uint64_t>(replanner_.config().experiment.seed));
  std::vector<World> worlds;
  PastWorlds past;
  std::optional<World> tried;
  constexpr double kPause = 1.0;  // after a search, when the world is much the same [s]
  Proposal first{.kind = ProposalKind::kUnsafe, .reason = "nothing was measured"};
  double origin = 0.0, lead = clock_.passes() ? patience_ : 0.0, pause = kPause;
  clock_.Begin();
  for (long frame = 0; first.kind == ProposalKind::kUnsafe; ++frame) {
    // A search may have taken the time of many frames.
    frame = std::max(frame, static_cast<long>(clock_.Time(0.0) / options_.sensing.period));
    const double now = static_cast<double>(frame) * options_.sensing.period;
    if (now > options_.longest || IsToEnd()) break;
    clock_.WaitUntil(now);
    if (hooks_.on_wait) hooks_.on_wait(first.reason);
    while (std::optional<Frame> taken = sensor_.Next(now)) {
      if (!taken->world) continue;
      World& measured = *taken->world;
      if (!worlds.empty()) {
        measured = Updated(worlds.back(), past, std::move(measured), options_).world;
      }
      past.Add(measured);
      worlds.push_back(std::move(measured));
    }
    if (worlds.empty()) continue;
    if (tried) {
      // In a world that is much the same a search finds what another did not, but not often.
      const bool differs = DiffersClearly(*tried, worlds.back());
      if (now < tried->measured_at + (differs ? kRetry : pause)) continue;
      pause = differs ? kPause : 2.0 * pause;
    }
    tried = worlds.back();
    origin = now + lead;
    world_ = std::make_shared<const World>(Since(worlds.back(), origin));
    // Overlaps are found while the robot walks, unless time stands still.
    const int junctions = clock_.passes() ? 0 : options_.smooth_ahead;
    first = replanner_.Begin(start, *replanner_.Prepare(*world_), junctions, random);
    const double ready = clock_.Time(now);
    if (clock_.passes()) lead = std::max(patience_, 1.5 * (ready - now));
    if (first.kind == ProposalKind::kUnsafe || ready <= origin) continue;
    // It should have begun already.
    first = {.kind = ProposalKind::kUnsafe, .reason = "to find a walk took too long"};
    tried.reset();
  }
  if (first.kind != ProposalKind::kUnsafe) clock_.WaitUntil(origin);
  clock_.Begin();
  sensor_.Begin(origin);
  record_.waited = origin;
  // What obstacles may do at t = 0 follows from where they were before.
  for (World& world : worlds) {
    record_.worlds.push_back(Since(std::move(world), origin));
    record_.known.push_back(record_.worlds.back().measured_at);
    past_.Add(record_.worlds.back());
  }
  return first;
}

}  // namespace halfstep
