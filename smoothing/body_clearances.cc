#include "smoothing/body_clearances.h"

#include <algorithm>

#include "planner/separation.h"

namespace halfstep {

BodyClearances::BodyClearances(const RobotModel& robot, const Scene& scene)
    : robot_(robot), world_(scene) {
  for (const RobotBody& body : robot_.bodies) shapes_.emplace_back(body.shape);
}

BodyClearances::Scratch BodyClearances::MakeScratch() const {
  Scratch scratch;
  scratch.bodies.resize(shapes_.size());
  scratch.pair_normals_W.assign(robot_.self_pairs.size(), Eigen::Vector3d::Zero());
  scratch.centers_W.resize(shapes_.size());
  scratch.lateral.resize(shapes_.size());
  return scratch;
}

void BodyClearances::Place(const Posture& posture, Scratch* scratch) const {
  const Eigen::Vector3d y_W = posture.X_WB.linear().col(1);
  for (size_t b = 0; b < shapes_.size(); ++b) {
    const RobotBody& body = robot_.bodies[b];
    const Eigen::Isometry3d& X = posture.OfBody(body);
    scratch->centers_W[b] = X * shapes_[b].center();
    if (body.leg < 0) continue;
    // The least y of a left body, the greatest of a right one.
    const double inward = body.leg == Index(Side::kLeft) ? -1.0 : 1.0;
    const Eigen::Vector3d direction = inward * (X.linear().transpose() * y_W);
    scratch->lateral[b] =
        inward * (Support(body.shape, direction) + inward * y_W.dot(X.translation()));
  }
}

double BodyClearances::QuickBound(size_t a, size_t b, const Scratch& scratch) const {
  const double spheres = (scratch.centers_W[a] - scratch.centers_W[b]).norm() -
                         shapes_[a].radius() - shapes_[b].radius();
  const int leg_a = robot_.bodies[a].leg, leg_b = robot_.bodies[b].leg;
  if (leg_a < 0 || leg_b < 0 || leg_a == leg_b) return spheres;
  const double gap = scratch.lateral[a] - scratch.lateral[b];
  return std::max(spheres, leg_a == Index(Side::kLeft) ? gap : -gap);
}

std::optional<Margin> BodyClearances::FirstBelow(const Posture& posture, double obstacle_clearance,
                                                 double self_clearance, Scratch* scratch) const {
  for (size_t b = 0; b < shapes_.size(); ++b) {
    const Eigen::Isometry3d& X_WBody = posture.OfBody(robot_.bodies[b]);
    ++scratch->queries;
    if (world_.Clears(shapes_[b], X_WBody, obstacle_clearance, &scratch->bodies[b])) continue;
    const auto nearest =
        world_.FindNearest(shapes_[b], X_WBody, std::max(obstacle_clearance, 1e-6));
    return Margin{.family = MarginFamily::kClearance,
                  .value = nearest.separation.distance,
                  .subject = static_cast<int>(b),
                  .other = nearest.obstacle};
  }
  Place(posture, scratch);
  for (size_t p = 0; p < robot_.self_pairs.size(); ++p) {
    const auto [i, j] = robot_.self_pairs[p];
    const size_t a = static_cast<size_t>(i), b = static_cast<size_t>(j);
    if (QuickBound(a, b, *scratch) >= self_clearance) continue;
    const Eigen::Isometry3d& X_Wa = posture.OfBody(robot_.bodies[a]);
    const Eigen::Isometry3d& X_Wb = posture.OfBody(robot_.bodies[b]);
    ++scratch->queries;
    if (ClearsAlongCached(shapes_[a], X_Wa, shapes_[b], X_Wb, self_clearance,
                          &scratch->pair_normals_W[p])) {
      continue;
    }
    return Margin{.family = MarginFamily::kSelfClearance,
                  .value = Separate(shapes_[a], X_Wa, shapes_[b], X_Wb).distance,
                  .subject = i,
                  .other = j};
  }
  return std::nullopt;
}

Margin BodyClearances::NearestObstacle(const Posture& posture, double horizon,
                                       Scratch* scratch) const {
  Margin nearest{.family = MarginFamily::kClearance, .value = horizon};
  for (size_t b = 0; b < shapes_.size(); ++b) {
    ++scratch->queries;
    const auto found = world_.FindNearest(shapes_[b], posture.OfBody(robot_.bodies[b]),
                                          std::max(nearest.value, 1e-9));
    if (found.obstacle < 0 || found.separation.distance >= nearest.value) continue;
    nearest.value = found.separation.distance;
    nearest.subject = static_cast<int>(b);
    nearest.other = found.obstacle;
  }
  return nearest;
}

Margin BodyClearances::NearestPair(const Posture& posture, double horizon, Scratch* scratch) const {
  Margin nearest{.family = MarginFamily::kSelfClearance, .value = horizon};
  Place(posture, scratch);
  for (const auto& [i, j] : robot_.self_pairs) {
    const size_t a = static_cast<size_t>(i), b = static_cast<size_t>(j);
    if (QuickBound(a, b, *scratch) >= nearest.value) continue;
    ++scratch->queries;
    const double distance = Separate(shapes_[a], posture.OfBody(robot_.bodies[a]), shapes_[b],
                                     posture.OfBody(robot_.bodies[b]))
                                .distance;
    if (distance >= nearest.value) continue;
    nearest.value = distance;
    nearest.subject = i;
    nearest.other = j;
  }
  return nearest;
}

}  // namespace halfstep
