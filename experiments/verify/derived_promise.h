#pragma once

#include "experiments/live/live_config.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/episode_truth.h"
#include "experiments/verify/promise_text.h"
#include "planner/scene/scene.h"

namespace halfstep::verify {

/// What an episode's promise is judged by.
struct PromiseRecord {
  const EpisodeText& episode;     ///< numbers that name rows of other tables name one
  const DescribedWalk* executed;  ///< null: there is no walk
  double end;                     ///< of the episode [s]
  const Scene& scene;             ///< with the boxes to spare
  const LiveOptions& options;     ///< of the config
};

/// Whether the promise held, derived from measured places, grants and the walk that was executed
/// alone. `truth`: null when nobody knows. `status` and `judged_by` are left.
PromiseText DerivePromise(const PromiseRecord& record, const EpisodeTruth* truth);

/// How many obstacles and areas of a world contradict one before it that was not void.
long Contradictions(const PromiseRecord& record, size_t world);

}  // namespace halfstep::verify
