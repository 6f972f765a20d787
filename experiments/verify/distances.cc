#include "experiments/verify/distances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "experiments/verify/floor_distances.h"
#include "wpg/geometry/pose2.h"
#include "wpg/ground/ground.h"
#include "wpg/nth.h"

namespace halfstep::verify {

namespace {

// A top so far above a sole counts as at it [m]. Source: smoothing/README.md, "Solids of the
// ground".
constexpr double kAtSole = 1e-8;

ConvexBody PrismOf(const GroundSolid& solid) {
  const Eigen::Index n = solid.polygon.cols();
  ConvexBody prism;
  prism.vertices.resize(3, 2 * n);
  prism.vertices.topRows<2>() << solid.polygon, solid.polygon;
  prism.vertices.row(2).head(n).setConstant(solid.bottom);
  prism.vertices.row(2).tail(n).setConstant(solid.top);
  return prism;
}

std::vector<Obstacle> ObstaclesOf(const Ground& ground) {
  std::vector<Obstacle> obstacles;
  for (const GroundSolid& solid : ground.Solids()) {
    obstacles.push_back({.name = solid.name, .shape = PrismOf(solid)});
  }
  return obstacles;
}

// Seen from above, in the sole frame.
ConvexBody Flattened(const RobotBody& body, const Leg& leg) {
  const Eigen::Isometry3d X_SoleBody = leg.X_BSole.inverse() * leg.joints[5].X_BLink;
  ConvexBody flat;
  flat.vertices = (X_SoleBody.linear() * body.shape.vertices).colwise() + X_SoleBody.translation();
  flat.vertices.row(2).setZero();
  flat.disc_radius = body.shape.disc_radius + body.shape.ball_radius;
  return flat;
}

}  // namespace

Distances::Distances(const RobotModel& robot, const Scene& scene, const Tube& tube)
    : robot_(robot),
      scene_(scene),
      of_ground_(std::make_shared<const std::vector<Obstacle>>(ObstaclesOf(*scene.ground))),
      ways_(tube, robot) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const RobotBody& body : robot.bodies) bodies_.emplace_back(body.shape);
  const auto add = [&](const Obstacle& obstacle) {
    std::visit([this](const auto& shape) { obstacles_.emplace_back(BodyOf(shape)); },
               obstacle.shape);
    const Solid& solid = obstacles_.back();
    paths_.emplace_back(obstacle, solid.center().norm() + solid.radius());
    const ObstacleMotion& motion = obstacle.motion;
    const bool still = motion.waypoints.empty() && motion.error == 0 && motion.speed == 0;
    (still ? still_ : others_).push_back(obstacles_.size() - 1);
    if (still) boxes.push_back(BoxOf(solid, obstacle.X_WO));
  };
  std::ranges::for_each(scene.obstacles, add);
  std::ranges::for_each(*of_ground_, add);
  for (const RobotBody& body : robot.bodies) {
    if (of_ground_->empty() || !verify::IsOnFoot(body)) continue;
    Nth(flat_feet_, body.leg).emplace_back(Flattened(body, Nth(robot.legs, body.leg)));
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

bool Distances::MustKeepOff(size_t body, size_t obstacle,
                            const std::array<double, 2>& soles) const {
  const size_t first = scene_.obstacles.size();
  const RobotBody& of = robot_.bodies[body];
  return obstacle < first || !verify::IsOnFoot(of) ||
         scene_.ground->Solids()[obstacle - first].top > Nth(soles, of.leg) + kAtSole;
}

double Distances::SoleFromSolid(int side, const Eigen::Vector4d& sole, size_t obstacle) {
  const Eigen::Isometry3d X_WSole = ToIsometry({sole[0], sole[1], sole[3]}, sole[2]);
  double least = std::numeric_limits<double>::infinity();
  for (const Solid& part : Nth(flat_feet_, side)) {
    ++queries_;
    least = std::min(
        least, Solid::Distance(part, X_WSole, obstacles_[obstacle], Eigen::Isometry3d::Identity()));
  }
  return least;
}

double Distances::FromAll(size_t body, const Placement& at, double t, double enough) {
  std::array<double, 2> soles{};
  for (size_t side = 0; side < 2; ++side) {
    soles[side] = (at.X_WB * at.X_BLink[side][6]).translation().z();
  }
  double least = std::numeric_limits<double>::infinity();
  for (const size_t o : Near(Around(body, at), enough)) {
    if (!MustKeepOff(body, o, soles)) continue;
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
  return robot_.bodies[body].name + " - " + scene_.NameOf(static_cast<int>(obstacle));
}

std::string Distances::NameOfPair(size_t a, size_t b) const {
  return robot_.bodies[a].name + " - " + robot_.bodies[b].name;
}

}  // namespace halfstep::verify
