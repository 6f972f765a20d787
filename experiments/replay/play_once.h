#pragma once

#include <string>

#include "experiments/replay/replay_screen.h"
#include "experiments/replay/seeded_replay.h"

namespace halfstep::replay {

/// The simulated robot on which a walk is played once, undisturbed but for the floor, which is that
/// of seed 1.
Simulation RobotOfOnce(const ReplaySetup& setup, const ReferenceMotion& motion);
/// Plays it there; `controller`, `pushes` and `tube` are left as they are.
Replayed PlayOnce(const ReplaySetup& setup, const std::string& method,
                  const ReferenceMotion& motion);

}  // namespace halfstep::replay
