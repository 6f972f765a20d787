#pragma once

#include <vector>

#include "experiments/config/experiment.h"
#include "tests/wpg/sequence_draw.h"

namespace halfstep {

/// Steps of 10 cm straight on, in the half-steps of an experiment.
inline HalfStepSequence StraightWalk(const Experiment& e, int steps) {
  std::vector<Footstep> footsteps;
  for (int i = 1; i <= steps; ++i) {
    const Side side = i % 2 == 0 ? Side::kLeft : Side::kRight;
    footsteps.push_back(
        {.side = side, .X_WF = Foothold::Level({0.1 * i, Sign(side) * 0.105, 0.0})});
  }
  const HalfStep& like = e.sequence.half_steps.front().half_step;
  return MakeSequence(StandingFeet(), footsteps, like.via_lateral, like.shape, e.sequence.model);
}

}  // namespace halfstep
