#include "experiments/plot/support_band.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/geometry/support_polygon.h"

namespace halfstep::plot {
namespace {

// Of the polygon less `demanded` on each side, on the line where coordinate 1 − k is `other`.
SupportBand Section(const SupportPolygon& polygon, int k, double other, double demanded) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  SupportBand band{-kInfinity, kInfinity};
  for (int i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon.corner(i), b = polygon.corner((i + 1) % polygon.size());
    if ((b - a).norm() < 1e-9) continue;
    // The polygon is to the left of its edges: outwards · p ≤ limit.
    const Eigen::Vector2d outwards = Eigen::Vector2d(b.y() - a.y(), a.x() - b.x()).normalized();
    const double rest = outwards.dot(a) - demanded - outwards[1 - k] * other;
    if (std::abs(outwards[k]) < 1e-12) {
      if (rest < 0.0) return {std::nan(""), std::nan("")};
    } else if (outwards[k] > 0.0) {
      band.high = std::min(band.high, rest / outwards[k]);
    } else {
      band.low = std::max(band.low, rest / outwards[k]);
    }
  }
  return band.low <= band.high ? band : SupportBand{std::nan(""), std::nan("")};
}

}  // namespace

std::vector<SupportBand> SupportBands(const PlottedWalk& walk, const Eigen::Vector2d& sole_size,
                                      int k, double demanded) {
  const std::vector<Pose2> left = walk.Soles(Side::kLeft), right = walk.Soles(Side::kRight);
  const std::vector<bool> on_left = walk.Stands(Side::kLeft), on_right = walk.Stands(Side::kRight);
  const std::vector<double> other = walk.rows.Numbers(k == 0 ? "zmp_y_m" : "zmp_x_m");
  std::vector<SupportBand> bands;
  for (size_t i = 0; i < left.size(); ++i) {
    const SupportPolygon polygon = on_left[i] && on_right[i]
                                       ? SupportPolygon(left[i], right[i], sole_size)
                                       : SupportPolygon(on_left[i] ? left[i] : right[i], sole_size);
    bands.push_back(Section(polygon, k, other[i], demanded));
  }
  return bands;
}

}  // namespace halfstep::plot
