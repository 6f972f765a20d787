#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <vector>

namespace halfstep {

/// Unit vectors of which no two are within a tolerance of each other, in the order in which they
/// were first seen. Ordered along a direction that no body's symmetry prefers, so that looking for
/// a known one is short.
class DistinctNormals {
 public:
  /// Directions that differ by less than `tolerance` [rad] count as one.
  explicit DistinctNormals(double tolerance) : tolerance_(tolerance) {}

  /// The index of the first one within the tolerance of `normal`; of `normal` itself, which is then
  /// kept, when there is none.
  size_t Add(const Eigen::Vector3d& normal) {
    const double along = normal.dot(Eigen::Vector3d(0.62349, 0.21773, 0.75091));
    size_t found = kept_.size();
    const auto end = places_.upper_bound(along + 1.01 * tolerance_);
    for (auto it = places_.lower_bound(along - 1.01 * tolerance_); it != end; ++it) {
      if (it->second >= found) continue;
      if ((kept_[it->second] - normal).squaredNorm() < tolerance_ * tolerance_) found = it->second;
    }
    if (found == kept_.size()) {
      kept_.push_back(normal);
      places_.emplace(along, found);
    }
    return found;
  }
  /// Unit vectors, in the order in which they were first seen.
  const std::vector<Eigen::Vector3d>& kept() const { return kept_; }

 private:
  const double tolerance_;
  std::vector<Eigen::Vector3d> kept_;
  std::multimap<double, size_t> places_;
};

}  // namespace halfstep
