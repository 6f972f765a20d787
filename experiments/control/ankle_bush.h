#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "experiments/control/joint_spring.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::control {

/// How the bush between a leg's last joint and its foot gives way: it turns the foot about the
/// sole's x and y through the origin of that joint's frame.
class AnkleBush {
 public:
  /// No spring: a rigid ankle.
  AnkleBush(const Leg& leg, const std::optional<JointSpring>& spring);

  /// Lets a moment of the foot on the ankle [N m], in the sole's frame, act for a time [s].
  void Yield(const Eigen::Vector2d& moment, double time);

  const Eigen::Vector2d& turn() const { return turn_; }  ///< of the foot [rad]
  /// The ankle's place in the sole's frame at rest [m].
  const Eigen::Vector3d& ankle() const { return ankle_; }
  /// From the sole where the joints' angles alone have it to the sole as it is, `after` seconds
  /// when it keeps turning as fast.
  Eigen::Isometry3d X_RestSole(double after = 0.0) const;

 private:
  std::optional<JointSpring> spring_;
  Eigen::Vector3d ankle_;
  Eigen::Vector2d turn_{0, 0}, speed_{0, 0};  // [rad], [rad/s]
};

}  // namespace halfstep::control
