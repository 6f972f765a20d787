#include "experiments/control/push_watch.h"

#include <utility>

#include "experiments/control/dcm_controller.h"

namespace halfstep::control {
namespace {

// Of the DCM's error, as the controller dcm has it.
constexpr double kFilter = DcmOptions{}.filter;  // [s]

}  // namespace

PushWatch::PushWatch(const ControlledRobot& robot)
    : sole_size_(robot.model.sole_size), dcm_(robot.model, robot.ankle, kFilter) {}

std::optional<double> PushWatch::Look(const MeasuredState& measured, const PlannedState& then,
                                      double period) {
  dcm_.Sense(measured, then, period);
  const Eigen::Vector2d& off = dcm_.value();
  const Eigen::Vector3d off_B =
      then.X_WB.linear().transpose() * Eigen::Vector3d(off.x(), off.y(), 0);
  const double share = (off_B.head<2>().cwiseAbs().cwiseQuotient(sole_size_)).maxCoeff();
  const bool was_pushed = std::exchange(pushed_, share > (pushed_ ? kBack : kPushed));
  if (was_pushed || !pushed_) return std::nullopt;
  return off.norm();
}

}  // namespace halfstep::control
