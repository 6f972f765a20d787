#pragma once

#include <array>
#include <optional>
#include <vector>

#include "experiments/verify/described_walk.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/findings.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// What all walks of an episode have in common, by its config.
struct EpisodeWalkFrame {
  const RobotModel& robot;        ///< that walks
  std::array<Foothold, 2> start;  ///< soles, by Index(Side)
  HalfStep half_step;             ///< what all have in common
  const Scene& scene;             ///< whose ground bears the soles
};

/// The walks of an episode. Borrows the robot.
struct EpisodeWalks {
  std::vector<WalkPlan> parts;  ///< by number: from EpisodeWalkText::first on
  std::vector<int> sizes;       ///< half-steps of each, with those before its part
  WalkPlan planned;             ///< the last one, whole
  /// The same; none when one of them describes no walk: then the other checks cannot be made.
  std::optional<DescribedWalk> last;
};

/// Makes the walks that the tables of walks/NNN describe, each with the walk before it up to where
/// its own begin, and checks that they are walks: footsteps at the height of a level that bears
/// them, soles at their beginning where config.yaml or the walk before has them, rows that fit the
/// footsteps, overlaps within their natural bounds by starts and durations, also with the half-step
/// of the walk before; one height scale and support point a step, numbers of footsteps and
/// durations as in plans.csv, which are handed over in order, the first at 0.
EpisodeWalks CheckEpisodeWalks(const EpisodeText& episode, const EpisodeWalkFrame& frame,
                               Findings* findings);

/// Whether each walk takes over from the one before without changing what has begun: half-steps
/// that begin before plans.csv's handed_over_s are the same in both (place, shape, duration,
/// height, support point, start, to 1e-9), and the next one begins no earlier than that in the
/// successor. Where the older walk would have begun it earlier, events.csv says that the robot had
/// stopped. When a half-step of begun.csv begins is what the last walk says, so all walks since
/// agree on it.
void CheckSuccessors(const EpisodeText& episode, const EpisodeWalks& all, Findings* findings);

}  // namespace halfstep::verify
