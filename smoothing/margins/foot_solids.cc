#include "smoothing/margins/foot_solids.h"

#include <algorithm>

#include "wpg/elementary.h"
#include "wpg/geometry/simple_polygon.h"
#include "wpg/nth.h"
#include "wpg/robot/sole_outline.h"

namespace halfstep {

double SolidGap::Distance() const {
  return beside > 0.0 && above > 0.0 ? Hypot(beside, above) : std::max(beside, above);
}

FootSolids::FootSolids(const RobotModel& robot, const Scene& scene) {
  if (scene.ground->Solids().empty()) return;
  outline_ = FootOutline(robot);
  for (const Eigen::Vector2d& corner : outline_.colwise()) reach_ = std::max(reach_, corner.norm());
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const GroundSolid& solid : scene.ground->Solids()) {
    const Eigen::Vector2d center = solid.polygon.rowwise().mean();
    solids_.push_back({solid.polygon, solid.top, solid.bottom, center,
                       (solid.polygon.colwise() - center).colwise().norm().maxCoeff()});
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector2d& p : solid.polygon.colwise()) {
      box.extend(Eigen::Vector3d(p.x(), p.y(), solid.bottom));
      box.extend(Eigen::Vector3d(p.x(), p.y(), solid.top));
    }
    boxes.push_back(box);
  }
  tree_ = BoundsTree(boxes, 4);
}

double FootSolids::Beside(const Pose2& X_WF, const Solid& solid) const {
  const Eigen::Matrix2Xd outline = (X_WF.rotation() * outline_).colwise() + X_WF.position();
  return PolygonDistance(outline, solid.polygon);
}

void FootSolids::Near(const Foothold& X_WF, double cap, std::vector<SolidGap>* gaps) const {
  gaps->clear();
  const Pose2 planar = X_WF.Planar();
  tree_.ForEachNear({X_WF.x, X_WF.y, X_WF.height}, reach_ + cap, [&](int32_t i) {
    const Solid& solid = Nth(solids_, i);
    SolidGap gap{.solid = i};
    gap.above = std::max(X_WF.height - solid.top, solid.bottom - X_WF.height);
    if (gap.above >= cap) return;
    // Circles that are farther apart; the factor is for rounding.
    const double circles = (solid.center - planar.position()).norm();
    if (circles > (solid.radius + reach_ + cap) * (1 + 1e-9)) return;
    gap.beside = Beside(planar, solid);
    if (gap.Distance() < cap) gaps->push_back(gap);
  });
  std::ranges::sort(*gaps, {}, &SolidGap::solid);
}

Eigen::Vector4d FootSolids::Gradient(const Foothold& X_WF, const SolidGap& gap) const {
  // The distance of two polygons is smooth but where another pair of features becomes the nearest,
  // so differences tell its slope to some nine digits.
  constexpr double kStep = 1e-6;
  const Solid& solid = Nth(solids_, gap.solid);
  const bool both = gap.beside > 0.0 && gap.above > 0.0;
  const double distance = gap.Distance();
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
  if (both || gap.beside >= gap.above) {
    const double share = both ? gap.beside / distance : 1.0;
    const auto slope = [&](double dx, double dy, double dyaw) {
      const Pose2 ahead{X_WF.x + dx, X_WF.y + dy, X_WF.yaw + dyaw};
      const Pose2 behind{X_WF.x - dx, X_WF.y - dy, X_WF.yaw - dyaw};
      return share * (Beside(ahead, solid) - Beside(behind, solid)) / (2.0 * kStep);
    };
    gradient[0] = slope(kStep, 0.0, 0.0);
    gradient[1] = slope(0.0, kStep, 0.0);
    gradient[3] = slope(0.0, 0.0, kStep);
  }
  if (both || gap.above > gap.beside) {
    const bool over = X_WF.height - solid.top >= solid.bottom - X_WF.height;
    gradient[2] = (over ? 1.0 : -1.0) * (both ? gap.above / distance : 1.0);
  }
  return gradient;
}

}  // namespace halfstep
