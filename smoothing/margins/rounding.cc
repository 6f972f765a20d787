#include "smoothing/margins/rounding.h"

#include "wpg/robot/gravity.h"
#include "wpg/robot/reference_leg.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

constexpr double kOfWeight = 2.5e-9;  // of m·g·ℓ: 1e-6 N m for HRP-2

}  // namespace

Rounding::Rounding(const RobotModel& robot)
    : zmp(1e-9 * LegLengthOf(robot) / kLegOfHrp2),
      torque(kOfWeight * robot.mass * kGravity * LegLengthOf(robot)),
      friction(1e-9),
      acceleration(1e-6 * kLegOfHrp2 / LegLengthOf(robot)) {}

}  // namespace halfstep
