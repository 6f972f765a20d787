#pragma once

#include <Eigen/Core>
#include <vector>

namespace halfstep::replay {

/// How far the sole that carries is from where it is planned to be.
struct DriftSample {
  double t = 0.0;                  ///< [s]
  Eigen::Vector3d drift{0, 0, 0};  ///< simulated less planned: x, y in W [m], yaw [rad]
};

/// The drift of a simulated walk over its support feet.
struct SupportDrift {
  Eigen::Vector3d at_end{0, 0, 0};   ///< x, y in W [m], yaw [rad]
  Eigen::Vector3d largest{0, 0, 0};  ///< of each by itself, without sign
  double largest_shift = 0.0;        ///< on the floor [m]
  /// The largest change of the shift on the floor between two instants that are no farther apart
  /// than the window [m].
  double within_window = 0.0;
};

/// Samples are in the order of time; without any the drift is 0. `window` is in [s].
SupportDrift DriftOf(const std::vector<DriftSample>& samples, double window);

}  // namespace halfstep::replay
