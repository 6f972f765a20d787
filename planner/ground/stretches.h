#pragma once

#include <Eigen/Core>
#include <vector>

namespace halfstep {

/// A part of a segment, by the distance from its beginning [m]. Empty where from ≥ to.
struct Stretch {
  double from = 0.0, to = 0.0;  ///< where it begins and ends [m]
};

/// Parts of one segment. Those of at most kLeast, and gaps between parts of at most that, are none.
class Stretches {
 public:
  static constexpr double kLeast = 4e-9;  ///< [m]

  /// Adds a part, which may overlap others or be empty.
  void Add(const Stretch& part);
  /// Takes parts out.
  void Remove(const Stretches& others);
  /// The parts in order, longer than kLeast and as far from each other.
  const std::vector<Stretch>& parts() const { return parts_; }

 private:
  std::vector<Stretch> parts_;
};

/// The part of the segment begin + s·along, 0 ≤ s ≤ length, that lies in a closed convex polygon
/// (2×n, counter-clockwise). `along` has the length 1.
Stretch StretchWithin(const Eigen::Matrix2Xd& polygon, const Eigen::Vector2d& begin,
                      const Eigen::Vector2d& along, double length);

/// How far inside all edges' lines of a convex polygon (2×n, counter-clockwise) a point lies [m].
double DepthWithin(const Eigen::Matrix2Xd& polygon, const Eigen::Vector2d& point);

}  // namespace halfstep
