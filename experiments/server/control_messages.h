#pragma once

#include <nlohmann/json.hpp>

#include "experiments/control/controllers.h"

namespace halfstep {

/// What an episode tells the client that controls its simulated robot; keys: README.md. Numbers are
/// those of the simulation to the last bit.

/// What is known of the robot.
nlohmann::json ControlledMessage(const control::ControlledRobot& robot);
/// Question `number`, from 1 on: what is commanded for next.t?
nlohmann::json ControlMessage(long number, const control::MeasuredState& measured,
                              const control::PlannedState& then, const control::PlannedState& next);

}  // namespace halfstep
