#pragma once

#include "experiments/live/live_config.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/findings.h"
#include "planner/scene/scene.h"

namespace halfstep::verify {

/// Whether worlds.csv and obstacles.csv are numbered as they must be: worlds 0, 1, 2, …, obstacles
/// in their order, names and areas of the scene, none twice in a world, numbers finite, quaternions
/// of length 1. The other checks of an episode need it.
bool CheckEpisodeNumbers(const EpisodeText& episode, const Scene& scene, Findings* findings);

/// Whether worlds became known in the order in which they were measured, none before that; whether
/// error, speed and horizon of each obstacle are those of config and scene (the drift alone for one
/// that has stayed where it is for sensing.rests_after_s); and whether `sound_since` is the
/// earliest world that no later one contradicts, by the measured places. A world contradicts an
/// earlier one when a point of an obstacle is farther from where it was than both errors and its
/// speed then allow, or when an obstacle or a no-step area is there that was not. Precondition:
/// CheckEpisodeNumbers() returned true.
void CheckEpisodeWorlds(const EpisodeText& episode, const LiveOptions& options, const Scene& scene,
                        Findings* findings);

/// An upper bound of how far a point of an obstacle, within `radius` of its frame's origin, is at
/// one measured place from where it is at another [m].
double Moved(const ObstacleRow& from, const ObstacleRow& to, double radius);

/// The scene as world `version` knows it: obstacles with their measurements (ObstacleMotion), and
/// the no-step areas that are there. Preconditions: as above; there is such a world.
Scene SceneOfWorld(const EpisodeText& episode, const Scene& scene, size_t version);

}  // namespace halfstep::verify
