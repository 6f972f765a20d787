#pragma once

#include <vector>

#include "planner/scene/scene.h"
#include "planner/search/footstep_planner.h"
#include "planner/search/half_step_query.h"
#include "planner/search/step_set.h"
#include "wpg/geometry/foothold.h"
#include "wpg/geometry/simple_polygon.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep {

/// Upright poles, and areas that no sole may touch.
struct FlatWorld {
  struct Pole {
    Eigen::Vector2d center;
    double radius;
  };
  std::vector<Pole> poles;
  std::vector<Eigen::Matrix2Xd> no_step;

  /// The same world for planners that look at a scene.
  Scene ToScene() const {
    Scene scene{
        .name = "flat world", .files = {}, .obstacles = {}, .no_step = no_step, .warnings = {}};
    for (const Pole& pole : poles) {
      Obstacle obstacle{.name = "pole " + std::to_string(scene.obstacles.size()),
                        .shape = Cylinder{pole.radius, 1.0}};
      obstacle.X_WO.translation() << pole.center, 0.5;
      scene.obstacles.push_back(obstacle);
    }
    return scene;
  }

  /// Seen in a mirror, the xz plane of W.
  FlatWorld Mirrored() const {
    FlatWorld mirrored = *this;
    for (Pole& pole : mirrored.poles) pole.center.y() *= -1.0;
    for (Eigen::Matrix2Xd& polygon : mirrored.no_step) {
      polygon.row(1) *= -1.0;
      polygon = polygon.rowwise().reverse().eval();
    }
    return mirrored;
  }
};

/// Stands in for swept volumes: a half-step is free when the soles at its place and at its via
/// point are off the poles, and the one that lands is off the areas.
class FlatQuery : public HalfStepQuery {
 public:
  FlatQuery(const StepSet& set, const FlatWorld& world) : set_(set), world_(world) {}

  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override {
    const Foothold X_WF = X_WS * set_.Placement(i, support);
    return OffPoles(X_WF.Planar()) && OffPoles(X_WS.Planar() * set_.Down(i, support).via()) &&
           OffAreas(X_WF.Planar());
  }
  bool UpIsFree(int i, Side support, const Foothold& X_WS) const override {
    const Foothold X_WF = X_WS * set_.Placement(i, support);
    return OffPoles(X_WS.Planar()) && OffPoles(X_WF.Planar() * set_.Up(i, support).via());
  }
  /// Of an up half-step from the start.
  bool StartIsFree(const HalfStep& up, const Foothold& X_WS) const {
    const Pose2 standing = X_WS.Planar(), lifted = (X_WS * up.X_SF).Planar();
    return OffPoles(standing) && OffPoles(lifted) && OffPoles(standing * up.via()) &&
           OffAreas(standing) && OffAreas(lifted);
  }

 private:
  static Eigen::Vector2d SoleSize() { return {0.24, 0.14}; }
  bool OffPoles(const Pose2& X_WF) const {
    for (const FlatWorld::Pole& pole : world_.poles) {
      const Eigen::Vector2d from_sole = X_WF.Inverse() * pole.center;
      const Eigen::Vector2d outside = (from_sole.cwiseAbs() - 0.5 * SoleSize()).cwiseMax(0.0);
      if (outside.norm() <= pole.radius) return false;
    }
    return true;
  }
  bool OffAreas(const Pose2& X_WF) const {
    if (world_.no_step.empty()) return true;
    const Eigen::Matrix2Xd sole = SoleCorners(X_WF, SoleSize());
    for (const Eigen::Matrix2Xd& polygon : world_.no_step) {
      if (PolygonsTouch(sole, polygon)) return false;
    }
    return true;
  }

  const StepSet& set_;
  FlatWorld world_;
};

/// A set for a robot of about HRP-2's size: feet 14 to 30 cm apart, steps up to `reach` [m] long,
/// turned inwards less than outwards.
inline StepSet PlausibleSet(double reach = 0.3) {
  return MakeStepSet({.x_min = -0.3, .x_max = 0.3, .y_min = -0.34, .y_max = -0.14}, {},
                     [reach](const HalfStep& half_step) {
                       const Foothold& X_SF = half_step.X_SF;
                       const double aside = Sign(half_step.swing()) * X_SF.y;
                       const double outwards = Sign(half_step.swing()) * X_SF.yaw;
                       return std::hypot(X_SF.x, 0.8 * (aside - 0.19)) <= reach && aside >= 0.13 &&
                              aside <= 0.36 && outwards >= -0.3;
                     });
}

inline Eigen::Matrix2Xd Rectangle(double x_min, double x_max, double y_min, double y_max) {
  Eigen::Matrix2Xd corners(2, 4);
  corners << x_min, x_max, x_max, x_min, y_min, y_min, y_max, y_max;
  return corners;
}

/// A band of `width` [m] that no sole may touch around a square of half edge `inner` [m].
inline FlatWorld Island(double inner, double width) {
  const double outer = inner + width;
  return {.poles = {},
          .no_step = {
              Rectangle(inner, outer, -outer, outer), Rectangle(-outer, -inner, -outer, outer),
              Rectangle(-inner, inner, inner, outer), Rectangle(-inner, inner, -outer, -inner)}};
}

/// A wall of poles along x = 1 m from y = −1.5 to 1.5 m, open where |y − gap_y| < gap/2.
inline FlatWorld WallWithGap(double gap_y, double gap) {
  FlatWorld world;
  for (int i = -30; i <= 30; ++i) {
    const double y = 0.05 * i;
    if (std::abs(y - gap_y) >= 0.5 * gap) world.poles.push_back({{1.0, y}, 0.03});
  }
  return world;
}

/// Asks for the first plan within 20 000 nodes, from feet side by side.
inline PlanRequest RequestTo(const Pose2& goal, const StepSet& set, const HalfStepQuery& query) {
  PlanRequest request{
      .start = {Foothold::Level({0.0, 0.1, 0.0}), Foothold::Level({0.0, -0.1, 0.0})},
      .goal = {},
      .set = set,
      .query = query};
  request.goal.X_WG = goal;
  request.stop = AnyOf({AtFirstPlan(), AfterNodes(20000)});
  return request;
}

}  // namespace halfstep
