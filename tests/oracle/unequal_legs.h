#pragma once

#include <string>

namespace halfstep::oracle {

/// What a control's oracle does not know of the right leg. It takes the left one's lengths,
/// mirrored, and of all else what the shipped robot has.
enum class Unknown {
  kNothing,
  kLengths,
  kAxes,
  kAngleLimits,
  kSpeedLimits,
  kTorques,
  kAccelerations,
  kMasses,
  kFeet,  ///< where the sole is in the foot, and the foot's body
};

struct UnequalLegs {
  unsigned seed = 0;
  /// Also hip and ankle axes that miss each other, by up to 5 mm for a robot of HRP-2's size, so
  /// that the legs have no closed form.
  bool offset = false;
  Unknown unknown = Unknown::kNothing;
};

/// Writes a shipped robot (WriteJudgedRobot) whose legs are drawn apart from each other: for a
/// robot of HRP-2's size, places of hip, knee and ankle by up to 5 mm aside and 10 mm along the
/// leg, every axis turned by up to 1°, limits of angles up to 3° tighter, of speeds up to 15 %,
/// torques and accelerations up to 20 % more or less, masses 10 %, soles up to 4 mm elsewhere and
/// 3 % higher in feet up to 8 % larger. Both soles' common rectangle is smaller by up to a tenth.
/// It stands with level soles side by side. Returns its YAML file's path.
std::string WriteUnequalRobot(const std::string& name, const UnequalLegs& drawn,
                              const std::string& folder);

/// The robot that a study is named: a shipped one, or NAME-unequal or NAME-offset, the one of that
/// kind with seed 1. Returns its file's path; `folder` gets the files of one that is drawn.
std::string StudiedRobot(const std::string& name, const std::string& folder);

}  // namespace halfstep::oracle
