#include "experiments/replay/tracking_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "experiments/replay/ranks.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep::replay {

TrackingError TrackingErrorOf(const Simulation& robot, const ReferenceMotion& motion, double t,
                              const Eigen::Vector3d& shift) {
  const TrajectoryRow planned = motion.RowAt(t);
  const std::array<Vector6d, 2> q = robot.Measure().q, wanted = motion.TargetsAt(t).q;
  TrackingError error;
  error.waist = (robot.X_WB().translation() - planned.waist.head<3>() - shift).norm();
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto s = static_cast<size_t>(Index(side));
    const Eigen::Isometry3d X = robot.X_WSole(side);
    const double yaw = Atan2(X(1, 0), X(0, 0)) - planned.soles[s][3];
    error.foot =
        std::max(error.foot, (X.translation() - planned.soles[s].head<3>() - shift).norm());
    error.foot_yaw = std::max(error.foot_yaw, std::abs(std::remainder(yaw, 2 * std::numbers::pi)));
    error.joint = std::max(error.joint, (q[s] - wanted[s]).cwiseAbs().maxCoeff());
  }
  return error;
}

TrackingErrors::TrackingErrors(const std::vector<TrackingError>& errors) {
  for (double TrackingError::*const part : {&TrackingError::foot, &TrackingError::foot_yaw,
                                            &TrackingError::waist, &TrackingError::joint}) {
    std::vector<double> values;
    for (const TrackingError& error : errors) values.push_back(error.*part);
    std::tie(most.*part, largest.*part) = MostAndLargest(std::move(values));
  }
}

}  // namespace halfstep::replay
