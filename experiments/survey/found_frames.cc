#include "experiments/survey/found_frames.h"

#include <Eigen/Geometry>
#include <array>

#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Directions nearer to an axis are that axis [rad]: the waist's z, and its y.
constexpr double kUpright = 0.5, kSideways = 0.02;

}  // namespace

Vector3d Snapped(const Vector3d& direction, double angle) {
  for (int i = 0; i < 3; ++i) {
    const Vector3d axis = Vector3d::Unit(i) * (direction[i] < 0 ? -1.0 : 1.0);
    if (direction.dot(axis) > Cos(angle)) return axis;
  }
  return direction;
}

Matrix3d FindWaistRotation(const UrdfTree& urdf, const FoundLegs& legs) {
  const auto X = urdf.LinkPoses(std::vector<double>(urdf.joints.size(), 0.0));
  const Isometry3d X_WaistRoot = Nth(X, legs.waist).inverse();
  const auto origin = [&](int joint) {
    return Vector3d(X_WaistRoot * Nth(X, Nth(urdf.joints, joint).child).translation());
  };
  const std::array<Vector3d, 2> hips{origin(legs.joints[0][2]), origin(legs.joints[1][2])};
  const std::array<Vector3d, 2> feet{origin(legs.joints[0][5]), origin(legs.joints[1][5])};
  const Vector3d up = Snapped((hips[0] + hips[1] - feet[0] - feet[1]).normalized(), kUpright);
  Vector3d left = hips[0] - hips[1];
  left = (left - left.dot(up) * up).normalized();
  Matrix3d R;
  R.col(2) = up;
  R.col(1) = Snapped(left, kSideways);
  R.col(0) = R.col(1).cross(R.col(2));
  return R;
}

}  // namespace halfstep
