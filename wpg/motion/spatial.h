#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "wpg/robot/robot_masses.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

// Spatial vectors, all about one fixed point O and in the axes of W. A motion is (ω, velocity of
// the body's point that is just at O), its acceleration the componentwise derivative of that; a
// force is (moment about O, force). Source: [Featherstone2008] ch. 2.

/// The matrix of the cross product: CrossMatrix(a)·b = a × b (3×3).
inline Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d A;
  A << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return A;
}

/// The six numbers of both halves.
inline Vector6d Spatial(const Eigen::Vector3d& upper, const Eigen::Vector3d& lower) {
  Vector6d x;  // not by <<, which compilers do not inline: a tenth of the dynamics' time
  x.head<3>() = upper;
  x.tail<3>() = lower;
  return x;
}

/// v ×: how a motion `m` that is carried along by `v` changes.
inline Vector6d CrossMotion(const Vector6d& v, const Vector6d& m) {
  const Eigen::Vector3d w = v.head<3>(), u = v.tail<3>(), mw = m.head<3>(), mu = m.tail<3>();
  return Spatial(w.cross(mw), w.cross(mu) + u.cross(mw));
}

/// v ×*: how a force `f` that is carried along by `v` changes.
inline Vector6d CrossForce(const Vector6d& v, const Vector6d& f) {
  const Eigen::Vector3d w = v.head<3>(), u = v.tail<3>(), n = f.head<3>(), l = f.tail<3>();
  return Spatial(w.cross(n) + u.cross(l), w.cross(l));
}

/// A rigid body's inertia about O in the axes of W.
struct SpatialInertia {
  double mass = 0.0;                                    ///< [kg]
  Eigen::Vector3d com{0, 0, 0};                         ///< from O [m]
  Eigen::Matrix3d about_com = Eigen::Matrix3d::Zero();  ///< [kg m²]

  SpatialInertia() = default;
  /// Of a body whose frame is at X_OBody.
  SpatialInertia(const BodyMass& body, const Eigen::Isometry3d& X_OBody)
      : mass(body.mass),
        com(X_OBody * body.com),
        about_com(X_OBody.linear() * body.inertia * X_OBody.linear().transpose()) {}

  /// The momentum of a twist v.
  Vector6d operator*(const Vector6d& v) const {
    const Eigen::Vector3d w = v.head<3>();
    const Eigen::Vector3d momentum = mass * (v.tail<3>() + w.cross(com));
    return Spatial(about_com * w + com.cross(momentum), momentum);
  }

  /// The same as a matrix (6×6).
  Matrix6d Matrix() const {
    const Eigen::Matrix3d C = mass * CrossMatrix(com);
    Matrix6d I;
    I.topLeftCorner<3, 3>() = about_com + C * CrossMatrix(com).transpose();
    I.topRightCorner<3, 3>() = C;
    I.bottomLeftCorner<3, 3>() = -C;
    I.bottomRightCorner<3, 3>() = mass * Eigen::Matrix3d::Identity();
    return I;
  }
};

}  // namespace halfstep
