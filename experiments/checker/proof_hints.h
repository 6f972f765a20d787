#pragma once

#include <Eigen/Core>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace halfstep::checker {

/// What a proof hands over beside its statement. Nothing of it is believed, all of it is tested.
struct ProofHints {
  /// Vectors from a body b to a body a, in b's frame, each good from a time [s] to the next one's.
  using Directions = std::vector<std::pair<double, Eigen::Vector3d>>;
  /// Number of a family, and the two of a WalkStatement.
  using Statement = std::tuple<int, size_t, size_t>;

  bool told = false;               ///< all that there are; else those that are found are noted
  std::vector<double> times = {};  ///< ends of the intervals that sufficed [s], increasing
  std::map<Statement, Directions> directions = {};  ///< along which bodies are apart
  bool in_parts =
      false;  ///< an obstacle was taken by its triangles, of which nothing is handed over

  /// The direction at a time; 0: none is told.
  static Eigen::Vector3d At(const Directions& of, double t) {
    Eigen::Vector3d at(0, 0, 0);
    for (const auto& [from, direction] : of) {
      if (from > t) break;
      at = direction;
    }
    return at;
  }
  /// Notes one that was used.
  static void Note(double from, const Eigen::Vector3d& direction, Directions* of) {
    if (direction.isZero() || (!of->empty() && of->back().second == direction)) return;
    of->emplace_back(from, direction);
  }
};

}  // namespace halfstep::checker
