#include "experiments/verify/distances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace halfstep::verify {

Distances::Distances(const RobotModel& robot, const Scene& scene, const Tube& tube)
    : robot_(robot), scene_(scene), ways_(tube, robot) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const RobotBody& body : robot.bodies) bodies_.emplace_back(body.shape);
  for (const Obstacle& obstacle : scene.obstacles) {
    std::visit([this](const auto& shape) { obstacles_.emplace_back(BodyOf(shape)); },
               obstacle.shape);
    const Solid& solid = obstacles_.back();
    paths_.emplace_back(obstacle, solid.center().norm() + solid.radius());
    const ObstacleMotion& motion = obstacle.motion;
    const bool still = motion.waypoints.empty() && motion.error == 0 && motion.speed == 0;
    (still ? still_ : others_).push_back(obstacles_.size() - 1);
    if (still) boxes.push_back(BoxOf(solid, obstacle.X_WO));
  }
  around_still_ = BoxIndex(std::move(boxes));
}

// What the boxes along the axes of W around the solid's own box and around its ball share.
Eigen::AlignedBox3d Distances::BoxOf(const Solid& solid, const Eigen::Isometry3d& X_WS) {
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner) {
    box.extend(X_WS * Eigen::Vector3d(((corner & 1) ? solid.upper() : solid.lower()).x(),
                                      ((corner & 2) ? solid.upper() : solid.lower()).y(),
                                      ((corner & 4) ? solid.upper() : solid.lower()).z()));
  }
  const Eigen::Vector3d center = X_WS * solid.center();
  const Eigen::Vector3d radius = Eigen::Vector3d::Constant(solid.radius());
  box = box.intersection(Eigen::AlignedBox3d(center - radius, center + radius));
  const Eigen::Vector3d rounding = Eigen::Vector3d::Constant(1e-12 * (1 + center.norm()));
  return {box.min() - rounding, box.max() + rounding};
}

Eigen::AlignedBox3d Distances::Around(size_t body, const Placement& at) const {
  return BoxOf(bodies_[body], at.OfBody(robot_.bodies[body]));
}

std::vector<size_t> Distances::Near(const Eigen::AlignedBox3d& box_W, double reach) const {
  // A hair more, so that rounding leaves out nothing that is just within reach.
  const double taken = ways_.bodies.empty() ? 0.0 : *std::ranges::max_element(ways_.bodies);
  const Eigen::Vector3d grown = Eigen::Vector3d::Constant(std::max(reach + taken, 0.0) + 1e-9);
  std::vector<size_t> near;
  for (const size_t i : around_still_.Meeting({box_W.min() - grown, box_W.max() + grown})) {
    near.push_back(still_[i]);
  }
  near.insert(near.end(), others_.begin(), others_.end());
  std::ranges::sort(near);
  return near;
}

double Distances::FromAll(size_t body, const Placement& at, double t, double enough) {
  double least = std::numeric_limits<double>::infinity();
  for (const size_t o : Near(Around(body, at), enough)) {
    least = std::min(least, FromObstacle(body, o, at, t, std::min(least, enough)).distance);
  }
  return least;
}

// Bounding spheres, and each one's sphere against the other's box.
double Distances::QuickBound(const Solid& a, const Eigen::Isometry3d& X_a, const Solid& b,
                             const Eigen::Isometry3d& X_b) {
  const Eigen::Vector3d of_a = X_a * a.center(), of_b = X_b * b.center();
  const auto to_box = [](const Eigen::Vector3d& p, const Solid& box) {
    return (box.lower() - p).cwiseMax(p - box.upper()).cwiseMax(0.0).norm();
  };
  const double a_to_b = to_box(X_b.inverse(Eigen::Isometry) * of_a, b) - a.radius();
  const double b_to_a = to_box(X_a.inverse(Eigen::Isometry) * of_b, a) - b.radius();
  return std::max({a_to_b, b_to_a, (of_a - of_b).norm() - a.radius() - b.radius()});
}

Distances::Result Distances::FromObstacle(size_t body, size_t obstacle, const Placement& at,
                                          double t, double enough) {
  const Eigen::Isometry3d X_WB = at.OfBody(robot_.bodies[body]);
  const Eigen::Isometry3d X_WO = paths_[obstacle].At(t);
  const double taken = paths_[obstacle].Uncertainty(t) + ways_.bodies[body];
  const double quick = QuickBound(bodies_[body], X_WB, obstacles_[obstacle], X_WO) - taken;
  if (quick >= enough) return {quick, false};
  ++queries_;
  return {Solid::Distance(bodies_[body], X_WB, obstacles_[obstacle], X_WO) - taken, true};
}

double Distances::ObstacleChange(size_t obstacle, double from, double to) const {
  const ObstaclePath& path = paths_[obstacle];
  const Eigen::Vector3d& middle = obstacles_[obstacle].center();
  return (path.At(to) * middle - path.At(from) * middle).norm() +
         std::abs(path.Uncertainty(to) - path.Uncertainty(from));
}

Distances::Result Distances::OfPair(size_t a, size_t b, const Placement& at, double enough) {
  const Eigen::Isometry3d X_Ba = at.OfBody_B(robot_.bodies[a]),
                          X_Bb = at.OfBody_B(robot_.bodies[b]);
  const double taken = ways_.nearer(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  const double quick = QuickBound(bodies_[a], X_Ba, bodies_[b], X_Bb) - taken;
  if (quick >= enough) return {quick, false};
  ++queries_;
  return {Solid::Distance(bodies_[a], X_Ba, bodies_[b], X_Bb) - taken, true};
}

double Distances::NearestObstacle(const Placement& at, double t, double cap) {
  double least = cap;
  for (size_t b = 0; b < bodies_.size(); ++b) least = std::min(least, FromAll(b, at, t, least));
  return least;
}

double Distances::NearestPair(const Placement& at, double cap) {
  double least = cap;
  for (const auto& [a, b] : robot_.self_pairs) {
    const Result pair = OfPair(static_cast<size_t>(a), static_cast<size_t>(b), at, least);
    least = std::min(least, pair.distance);
  }
  return least;
}

std::string Distances::NameOfObstaclePair(size_t body, size_t obstacle) const {
  return robot_.bodies[body].name + " - " + scene_.obstacles[obstacle].name;
}

std::string Distances::NameOfPair(size_t a, size_t b) const {
  return robot_.bodies[a].name + " - " + robot_.bodies[b].name;
}

}  // namespace halfstep::verify
