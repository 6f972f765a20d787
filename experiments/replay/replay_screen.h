#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/replay/replay.h"
#include "experiments/replay/suggested_tube.h"

namespace halfstep::replay {

/// A walk that was played, and what is told of it.
struct Replayed {
  std::string method;  ///< of a run; "episode"
  /// What moved the robot, where that was asked for; then tracking errors are told.
  std::optional<std::string> controller = std::nullopt;
  double duration = 0.0;          ///< of the walk [s]
  double window = 0.0;            ///< of the drift [s]
  ReplayResult result;            ///< how it went
  std::vector<PushLimit> pushes;  ///< that were survived, where they were asked for
  std::optional<SuggestedTube> tube = std::nullopt;  ///< where it was asked for
  /// Names of the robot's bodies and soles, and of the obstacles and the ground's solids, by the
  /// indices of TouchRecord; no obstacles and solids:
  /// nothing is said of touches.
  std::vector<std::string> bodies, obstacles;
};

/// What `halfstep replay` prints of one walk: lines, each with its end.
std::string ReplayText(const Replayed& replayed);

/// What is told of one walk as the text of a JSON object.
std::string ReplayedJson(const Replayed& replayed);

/// The whole output of `halfstep replay --json`. `run` is the folder as it was named, `notes` are
/// sentences on obstacles that are simulated otherwise than the scene says.
std::string ReplayJson(const std::string& run, const std::vector<std::string>& notes,
                       const std::vector<Replayed>& all);

/// What a simulation proves: nothing.
inline constexpr const char* kReplayDisclaimer =
    "This is simulation: soft point contacts, servos without delay or friction, whose torque is\n"
    "limited with --torque-limits only, the URDF's masses with estimated inertias, an upper body\n"
    "without joints. It guarantees nothing about the robot, and its falls are not proofs either.";

}  // namespace halfstep::replay
