#pragma once

#include <vector>

#include "experiments/control/tracking_controller.h"
#include "experiments/replay/reference_motion.h"

namespace halfstep::replay {

/// What is planned for each time of a motion, as controllers take it. Angles and speeds are those
/// of ReferenceMotion::TargetsAt. The whole robot's CoM, ZMP and torques, from all masses and
/// inertias (RobotDynamics), are those of the rows, with velocities and accelerations by
/// differences of neighbours, linear between rows; the first and the last row are at rest. Soles
/// may stand at different heights.
class PlannedStates {
 public:
  /// Precondition: masses are known. In rows where a leg does not reach or is stretched, torques
  /// and velocities are 0 and the ZMP is that of the walk's model, without tilt. Nothing is
  /// borrowed.
  PlannedStates(const RobotModel& robot, const ReferenceMotion& motion);

  double begin() const { return motion_.rows().front().t; }  ///< of the first row [s]
  control::PlannedState At(double t) const;  ///< before and after the motion: that of its ends

 private:
  // What the walk's model does not say.
  struct Whole {
    std::array<Vector6d, 2> torques{Vector6d::Zero(), Vector6d::Zero()};
    std::array<Eigen::Vector3d, 2> ankle_moments{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    Eigen::Vector3d com{0, 0, 0}, velocity{0, 0, 0};
    Eigen::Vector2d zmp{0, 0};  // in the plane z = 0
    Eigen::Vector2d tilt{0, 0};
    double force = 0.0;
    std::array<double, 2> levels{};
  };
  static Whole WholeOf(const RobotModel& robot, const std::vector<TrajectoryRow>& rows, size_t i);
  void FindLevels();  // fills Whole::levels

  const ReferenceMotion motion_;
  std::vector<Whole> whole_;
};

}  // namespace halfstep::replay
