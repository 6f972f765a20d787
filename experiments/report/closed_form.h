#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "wpg/motion/half_step_sequence.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What the page needs to evaluate the closed form of walks on the same footsteps by itself:
/// half-steps in S with their places X_WS [m, rad], the families of half_steps.csv, the LIPM and
/// the robot's posture over it. What a family is of a half-step stands there under its column.
/// Places to 12 digits. Null where the model is no LIPM: the page knows no other.
nlohmann::json ClosedFormJson(const RobotModel& robot, const HalfStepSequence& sequence);

/// The homotopy parameters of a method's folder, exactly as its half_steps.csv and overlaps.csv
/// have them, by PluralOf() of their families; those of forms and footsteps where the walk has its
/// own. Throws InputError as ReadParameters.
nlohmann::json ParametersJson(const std::filesystem::path& folder,
                              const HalfStepSequence& sequence);

}  // namespace halfstep
