#include "experiments/control/dcm_error.h"

#include <cmath>

#include "experiments/control/sole_loads.h"
#include "wpg/robot/gravity.h"

namespace halfstep::control {

using Eigen::Vector2d;
using Eigen::Vector3d;

DcmError::DcmError(const RobotModel& robot, const std::optional<JointSpring>& ankle, double filter)
    : robot_(robot),
      omega_(std::sqrt(kGravity / robot.com_height)),
      filter_(filter),
      bushes_{AnkleBush(robot.legs[0], ankle), AnkleBush(robot.legs[1], ankle)} {}

// By the planned moments of the ankles, and what the soles' loads are off.
void DcmError::Yield(const MeasuredState& measured, const PlannedState& then, double period) {
  const std::array<SoleLoad, 2> planned = SharedLoads(then, robot_.sole_size, then.zmp);
  for (size_t s = 0; s < 2; ++s) {
    const Vector2d ankle = bushes_[s].ankle().head<2>();
    const auto moment = [&ankle](const SoleLoad& load) -> Vector2d {
      const Vector2d arm = load.centre - ankle;
      return load.force * Vector2d(arm.y(), -arm.x());
    };
    const Vector3d then_S = then.X_WSole[s].linear().transpose() * then.ankle_moments[s];
    bushes_[s].Yield(then_S.head<2>() + moment(measured.loads[s]) - moment(planned[s]), period);
  }
}

EstimatedState DcmError::Sense(const MeasuredState& measured, const PlannedState& then,
                               double period) {
  Yield(measured, then, period);
  const EstimatedState state = EstimateState(robot_, measured, then, bushes_);
  const Vector3d off = state.com - then.com + (state.velocity - then.com_velocity) / omega_;
  value_ += period / (filter_ + period) * (off.head<2>() - value_);
  return state;
}

}  // namespace halfstep::control
