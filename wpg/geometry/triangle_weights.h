#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace halfstep {

/// Weights, not negative and of sum 1, of the point of segment ab that is nearest to the origin;
/// the third is 0.
inline std::array<double, 3> SegmentWeights(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? std::clamp(-a.dot(ab) / length2, 0.0, 1.0) : 0.0;
  return {1 - t, t, 0};
}

/// The same for triangle abc. Source: [Ericson2005] §5.1.5.
inline std::array<double, 3> TriangleWeights(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                             const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a;
  const double d1 = -ab.dot(a), d2 = -ac.dot(a);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = -ab.dot(b), d4 = -ac.dot(b);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return SegmentWeights(a, b);
  const double d5 = -ab.dot(c), d6 = -ac.dot(c);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const auto [s, t, unused] = SegmentWeights(a, c);
    return {s, 0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const auto [s, t, unused] = SegmentWeights(b, c);
    return {0, s, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

}  // namespace halfstep
