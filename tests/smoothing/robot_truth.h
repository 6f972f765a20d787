#pragma once

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "smoothing/walk/superposed_walk.h"
#include "tests/places.h"
#include "tests/smoothing/test_walks.h"
#include "tests/wpg/generated_robots.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/motion/posture.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep {

/// Shipped robots, one whose link frames are canted and two with offset legs.
inline std::vector<WholeRobot> WholeRobots() {
  std::vector<WholeRobot> robots;
  for (const std::string& name : kShippedRobots) {
    robots.push_back(LoadWholeRobot(InSources("wpg/robots/") + name + ".yaml"));
  }
  for (const GeneratedRobot& robot : {GeneratedRobots()[2], OffsetRobots()[0], OffsetRobots()[2]}) {
    robots.push_back(LoadWholeRobot(TemporaryRobot(robot).yaml_path()));
  }
  return robots;
}

/// The links of a URDF as point masses: six a link, on the principal axes of its inertia, that have
/// the link's mass, centre and inertia. Their motion is all that momentum needs, so nothing of the
/// dynamics under test is used.
class PointMasses {
 public:
  explicit PointMasses(const WholeRobot& whole) : whole_(whole) {
    for (size_t i = 0; i < whole.tree.urdf.links.size(); ++i) {
      const UrdfLink& link = whole.tree.urdf.links[i];
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(link.inertia);
      const Eigen::Vector3d moments = solver.eigenvalues();
      for (Eigen::Index k = 0; k < 3; ++k) {
        // ∫x² dm of the axis
        const double square = 0.5 * moments.sum() - moments[k];
        const double away = link.mass > 0 ? std::sqrt(std::max(0.0, 3 * square / link.mass)) : 0;
        for (const double sign : {-1.0, 1.0}) {
          points_.push_back(
              {i, link.mass / 6, link.com + sign * away * solver.eigenvectors().col(k)});
        }
      }
    }
  }

  /// Where the floor's force has no horizontal moment [m], by differences of eighth order of the
  /// points' places `step` [s] apart, when the quantities are `at(t)` at the time t.
  template <typename At>
  Eigen::Vector2d Zmp(const At& at, double step, double gravity) const {
    Eigen::Vector2d moment(0, 0);
    double force = 0;
    ForEachForce(at, step, gravity, [&](size_t, const auto& place, const Eigen::Vector3d& f) {
      moment += place.template head<2>() * f.z() - place.z() * f.template head<2>();
      force += f.z();
    });
    return moment / force;
  }

  /// The moment about `pole` [m] of what moves all that a leg's joint carries, against gravity too
  /// [N m], by the same differences.
  template <typename At>
  Eigen::Vector3d MomentBeyond(Side side, size_t joint, const Eigen::Vector3d& pole, const At& at,
                               double step, double gravity) const {
    const std::vector<bool> carried = LinksBeyond(side, joint);
    Eigen::Vector3d moment(0, 0, 0);
    ForEachForce(at, step, gravity, [&](size_t link, const auto& place, const Eigen::Vector3d& f) {
      if (carried[link]) moment += (place - pole).cross(f);
    });
    return moment;
  }

 private:
  struct Point {
    size_t link;
    double mass;
    Eigen::Vector3d at;  // in the link's frame
  };

  // Calls visit(link, place, force) for each point.
  template <typename At, typename Visit>
  void ForEachForce(const At& at, double step, double gravity, const Visit& visit) const {
    constexpr std::array<double, 5> kSecond = {-205.0 / 72, 8.0 / 5, -1.0 / 5, 8.0 / 315,
                                               -1.0 / 560};
    Eigen::Matrix3Xd here = Places(at(0.0)), a = kSecond[0] * here;
    for (int k = 1; k <= 4; ++k) {
      a += kSecond[static_cast<size_t>(k)] * (Places(at(k * step)) + Places(at(-k * step)));
    }
    a /= step * step;
    a.row(2).array() += gravity;
    for (size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Index c = static_cast<Eigen::Index>(i);
      visit(points_[i].link, Eigen::Vector3d(here.col(c)),
            Eigen::Vector3d(points_[i].mass * a.col(c)));
    }
  }

  std::vector<bool> LinksBeyond(Side side, size_t joint) const {
    const UrdfTree& urdf = whole_.tree.urdf;
    const LegJoint& of = whole_.model.legs[static_cast<size_t>(Index(side))].joints[joint];
    std::vector<bool> beyond(urdf.links.size(), false);
    for (size_t i = 0; i < urdf.links.size(); ++i) {  // after the links that they hang on
      if (urdf.links[i].joint < 0) continue;
      const UrdfJoint& above = urdf.joints[static_cast<size_t>(urdf.links[i].joint)];
      beyond[i] = above.name == of.name || beyond[static_cast<size_t>(above.parent)];
    }
    return beyond;
  }

  Eigen::Matrix3Xd Places(const WalkState& x) const {
    const Posture posture = SolvePosture(whole_.model, x);
    const auto X = whole_.tree.urdf.LinkPoses(
        JointAngles(whole_.model, whole_.tree, {posture.ik[0].q, posture.ik[1].q}));
    const Eigen::Isometry3d X_WRoot =
        posture.X_WB * X[static_cast<size_t>(whole_.tree.waist)].inverse();
    Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(points_.size()));
    for (size_t i = 0; i < points_.size(); ++i) {
      places.col(static_cast<Eigen::Index>(i)) = X_WRoot * X[points_[i].link] * points_[i].at;
    }
    return places;
  }

  const WholeRobot& whole_;
  std::vector<Point> points_;
};

}  // namespace halfstep
