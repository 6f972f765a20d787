#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/live/episode.h"
#include "experiments/live/live_config.h"
#include "experiments/run/planning.h"

namespace halfstep {

/// What all episodes of a study have in common.
struct LiveStudy {
  LiveConfig base;
  Place place;
  BakedHalfSteps baked;
  std::array<Foothold, 2> start;
  int stops = 100;  ///< at random times, for each episode
};

/// How long it took until a walk with other footsteps was handed over, and of what that consists.
struct Latency {
  double whole = 0.0;              ///< from the measurement of its world to the hand-over [s]
  double age = 0.0;                ///< from that measurement to when work began [s]
  double answer = 0.0;             ///< from then to the hand-over; in lockstep what is charged [s]
  double check = 0.0, plan = 0.0;  ///< of computing [s]
  /// From the measurement that made the walk unsafe, when searches before this one found nothing;
  /// else as `whole` [s].
  double since_unsafe = 0.0;
};

/// What an answer of the replanner cost.
struct Answered {
  ProposalKind kind = ProposalKind::kSafe;
  Spent effort;         ///< as counted
  Spent seconds;        ///< of the processor [s]
  double asking = 0.0;  ///< in lockstep, the same of it all, with preparing its world [s]
};

/// What a study wants to know of one random episode.
struct StudiedEpisode {
  std::uint64_t seed = 0;
  EpisodeEnding ending = EpisodeEnding::kNoPlan;
  /// Whether a walk is found from the start to the last goal among the obstacles as they are in the
  /// end, with all that the robot must assume of them.
  bool reachable = false;
  bool rests = false;                   ///< what stays is taken to rest
  double waited = 0.0, duration = 0.0;  ///< [s]
  /// Of a walk that knew from the beginning how everything ends, exactly [s]; 0: there is none.
  double clairvoyant = 0.0;
  int changed = 0, stopped = 0, unsafe = 0;  ///< as EpisodeSummary
  double nearest = 0.0;                      ///< [m]
  std::string nearest_obstacle;
  bool excused = false;  ///< it touched an obstacle that had just broken its bounds
  bool pressed = false;  ///< an obstacle was put or carried against the robot, walking or at rest
  std::vector<Latency> latencies;
  std::vector<double> smoothing;  ///< computing of each walk with other overlaps [s]
  std::vector<Answered> answers;  ///< all of them
  std::vector<int> begun_meanwhile;
  int stops = 0, safe_stops = 0;  ///< at random times; those that are proved to their rest
  double longest_stop = 0.0;      ///< from a random time to the rest [s]
  double jump = 0.0;              ///< of value, first and second derivative where walks meet
  double residual = 0.0;          ///< of p = c − c̈/ω² [m]
  double cpu = 0.0;               ///< of walking, by the clock of the thread [s]
  std::vector<EpisodeEvent> events;

  bool arrived() const { return ending == EpisodeEnding::kArrived; }
  bool touched() const { return nearest <= 0.0; }
};

/// An episode as it was walked, without anything that examines it.
struct WalkedEpisode {
  Episode episode;
  std::string tables;  ///< SHA-256 of all its tables but timings.csv
  std::vector<Answered> answers;
};
/// Walks the episode of a seed.
WalkedEpisode WalkOnly(const LiveStudy& study, std::uint64_t seed);

/// Walks the episode of a seed and examines it.
StudiedEpisode WalkEpisode(const LiveStudy& study, std::uint64_t seed);

}  // namespace halfstep
