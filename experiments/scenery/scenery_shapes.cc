#include "experiments/scenery/scenery_shapes.h"

#include <cmath>
#include <numbers>

#include "experiments/scenery/scenery_readers.h"
#include "wpg/elementary.h"
#include "wpg/files/text.h"

namespace halfstep {

std::string SizeMistake(double size) {
  return Formatted("a size of %g m (valid: 1e-06 … 1000)", size);
}

std::optional<Eigen::Isometry3d> PoseOf(const Eigen::Vector3d& p, const Eigen::Vector4d& xyzw) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = p;
  if (xyzw.isZero(0.0)) return X;
  const double length = xyzw.norm();
  if (!(std::abs(length - 1.0) <= 0.01)) return std::nullopt;
  X.linear() =
      Eigen::Quaterniond(xyzw[3], xyzw[0], xyzw[1], xyzw[2]).normalized().toRotationMatrix();
  return X;
}

std::optional<PointAndNormal> PlaneOf(const Eigen::Vector4d& abcd) {
  const double length = abcd.head<3>().norm();
  if (!(length > 1e-9)) return std::nullopt;
  const Eigen::Vector3d normal = abcd.head<3>() / length;
  return PointAndNormal{normal, -abcd[3] / length * normal};
}

OwnMesh ConeMesh(double radius, double length) {
  constexpr int kSides = 64;
  OwnMesh mesh{Eigen::Matrix3Xd(3, kSides + 2), Eigen::Matrix3Xi(3, 2 * kSides)};
  const double outer = radius / Cos(std::numbers::pi / kSides) * (1 + 1e-12);
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    const int next = (i + 1) % kSides;
    mesh.vertices.col(i) << outer * Cos(angle), outer * Sin(angle), -0.5 * length;
    mesh.triangles.col(2 * i) << i, next, kSides;
    mesh.triangles.col(2 * i + 1) << next, i, kSides + 1;
  }
  mesh.vertices.col(kSides) << 0, 0, 0.5 * length;
  mesh.vertices.col(kSides + 1) << 0, 0, -0.5 * length;
  return mesh;
}

}  // namespace halfstep
