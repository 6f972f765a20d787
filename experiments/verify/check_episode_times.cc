#include "experiments/verify/check_episode_times.h"

#include <algorithm>
#include <limits>

namespace halfstep::verify {
namespace {

constexpr double kSameTick = 1e-9;  // times that count the same ticks [s]

}  // namespace

void CheckEpisodeTimes(const EpisodeText& episode, const EpisodeManifest& manifest,
                       const LiveOptions& options, Findings* findings) {
  double latest = -std::numeric_limits<double>::infinity(), frame = latest;
  for (const WorldRow& row : episode.worlds) {
    latest = std::max(latest, row.known);
    frame = std::max(frame, row.known);
  }
  for (const PlanRow& row : episode.plans) latest = std::max(latest, row.handed_over);
  for (const GrantRow& row : episode.grants) latest = std::max(latest, row.t);
  for (const EventRow& row : episode.events) {
    // A half-step that begins within the tick is told before it does.
    const bool ahead = row.what == "begins" || row.what == "near";
    latest = std::max(latest, ahead ? row.t - options.period : row.t);
    if (row.what == "lost" || row.what == "measured") frame = std::max(frame, row.t);
  }
  // Of what was killed the last rows may be later than the last tick that was written down.
  const bool has_end = manifest.ending != "no_plan" && manifest.ending != "killed";
  if (has_end && !(latest <= manifest.end + kSameTick)) {
    findings->Disagree(
        Formatted("manifest.json: end_s is %.9g, but something was recorded at "
                  "%.9g s",
                  manifest.end, latest));
  }
  // Frames come at their times, each known after the delay, at a tick.
  const double next = frame + options.sensing.period + options.sensing.delay + options.period;
  const bool steady =
      has_end && options.sensing.source == "stand_in" && options.clock == "lockstep";
  if (steady && !(manifest.end <= next + kSameTick)) {
    findings->Disagree(
        Formatted("manifest.json: end_s is %.9g, but the last frame is known from "
                  "%.9g s on, and the next one by %.9g s",
                  manifest.end, frame, next));
  }
  const double first = episode.worlds.front().measured;
  // A client may have measured before the robot began to wait; the stand-in does not.
  const bool too_early =
      options.sensing.source == "stand_in" && !(first >= -manifest.waited - kSameTick);
  if (!(manifest.waited >= -kSameTick) || too_early) {
    findings->Disagree(
        Formatted("manifest.json: waited_s is %.9g, but world 0 was measured at "
                  "%.9g s",
                  manifest.waited, first));
  }
  findings->Say(Formatted("times: all that was recorded is within %.6g s", manifest.end));
}

}  // namespace halfstep::verify
