#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/live/episode.h"
#include "experiments/live/episode_touch.h"
#include "experiments/live/true_world.h"
#include "wpg/robot/not_covered.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The numbers that tell how an episode went.
struct EpisodeSummary {
  std::string ending;                                         ///< Name(EpisodeEnding)
  double waited = 0.0;                                        ///< before the walk began [s]
  double duration = 0.0;                                      ///< [s]
  int half_steps = 0;                                         ///< that began
  int changed = 0, shortened = 0, smoothed = 0, resumed = 0;  ///< successors that were handed over
  /// How often: no successor, a world contradicted, a stop, no safe way.
  int refused = 0, contradicted = 0, stops = 0, unsafe = 0;
  int early = 0, late = 0;  ///< contacts of feet, in physics
  /// From when the world that asked for it was measured to the hand-over, of each walk with other
  /// footsteps [s]; half-steps that began meanwhile, before the first changed one.
  std::vector<double> latencies;
  std::vector<int> begun_meanwhile;     ///< the same walks in the same order
  std::vector<NotCovered> not_covered;  ///< what the episode's proofs do not speak of
  /// Sampled every 5 ms; none when it is not known where obstacles truly were.
  std::optional<Approach> nearest;
};

/// `truth`: in times of the walk (TrueWorld::Since); null when clients measured, so that it is not
/// known.
EpisodeSummary Summarize(const Episode& episode, const TrueWorld* truth, const RobotModel& robot);

/// What `halfstep live` prints; the same as one JSON object.
std::string SummaryScreen(const Episode& episode, const EpisodeSummary& summary,
                          const std::string& folder);
/// The same numbers as one JSON object.
std::string SummaryJson(const Episode& episode, const EpisodeSummary& summary,
                        const std::string& folder);

}  // namespace halfstep
