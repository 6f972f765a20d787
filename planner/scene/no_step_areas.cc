#include "planner/scene/no_step_areas.h"

#include <algorithm>

#include "wpg/geometry/simple_polygon.h"

namespace halfstep {

NoStepAreas::NoStepAreas(const Scene& scene, const Eigen::Matrix2Xd& sole_outline)
    : outline_(sole_outline) {
  for (const Eigen::Vector2d& corner : outline_.colwise()) reach_ = std::max(reach_, corner.norm());
  for (const Eigen::Matrix2Xd& polygon : scene.no_step) {
    const Eigen::Vector2d center = polygon.rowwise().mean();
    areas_.push_back({polygon, center, (polygon.colwise() - center).colwise().norm().maxCoeff()});
  }
}

NoStepAreas::Nearest NoStepAreas::NearestTo(const Pose2& X_WF) const {
  Nearest nearest;
  if (empty()) return nearest;
  const Eigen::Matrix2Xd outline = (X_WF.rotation() * outline_).colwise() + X_WF.position();
  for (size_t i = 0; i < areas_.size(); ++i) {
    const Area& area = areas_[i];
    // Circles that are farther apart than what was found; the factor is for rounding.
    const double circles = (area.center - X_WF.position()).norm();
    if (circles > (area.radius + reach_ + std::max(0.0, nearest.distance)) * (1 + 1e-9)) continue;
    const double distance = PolygonDistance(outline, area.polygon);
    if (distance < nearest.distance) nearest = {distance, static_cast<int>(i)};
  }
  return nearest;
}

bool NoStepAreas::Clears(const Pose2& X_WF, double distance) const {
  if (empty()) return true;
  const Eigen::Matrix2Xd outline = (X_WF.rotation() * outline_).colwise() + X_WF.position();
  return std::all_of(areas_.begin(), areas_.end(), [&](const Area& area) {
    const double circles = (area.center - X_WF.position()).norm();
    if (circles > (area.radius + reach_ + distance) * (1 + 1e-9)) return true;
    return distance > 0.0 ? PolygonDistance(outline, area.polygon) >= distance
                          : !PolygonsTouch(outline, area.polygon);
  });
}

}  // namespace halfstep
