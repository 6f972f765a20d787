#pragma once

#include "experiments/config/experiment.h"
#include "experiments/live/episode.h"
#include "experiments/live/promise.h"
#include "experiments/live/true_world.h"

namespace halfstep {

/// Whether the promise of an episode held: each frame is compared with the worlds that were not
/// void, and, where `truth` is known, what is true is compared with the world of the half-step
/// under way each kLook, while the robot moves. `truth` is in times of the walk (TrueWorld::Since);
/// null: nobody knows; `judged_by` says which. `place`: with the spare boxes.
Promise JudgePromise(const Episode& episode, const TrueWorld* truth, const Place& place,
                     const LiveOptions& options);

}  // namespace halfstep
