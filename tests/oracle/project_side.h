#pragma once

#include <string>

#include "smoothing/margins/margin.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/oracle/closed_form_walk.h"
#include "tests/oracle/walk_truth.h"

namespace halfstep::oracle {

/// The plan as the project takes it.
HalfStepSequence ToSequence(const WalkPlan& plan);
HomotopyParameters ToParameters(const WalkPlan& plan);
/// What the project demands, as the oracle takes it.
Demands ToDemands(const MarginLimits& limits, double friction);
Tube ToTube(const PlainTube& tube);

/// Writes a shipped robot's file into a folder, beside links to what it names, with a limit for the
/// torque of every leg joint (where its files have none) and for the acceleration of every other
/// one, so that there are all families of margins. Returns its path.
std::string WriteJudgedRobot(const std::string& name, const std::string& folder);

}  // namespace halfstep::oracle
