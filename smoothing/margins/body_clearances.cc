#include "smoothing/margins/body_clearances.h"

#include <algorithm>

#include "planner/collision/separation.h"
#include "smoothing/margins/body_heights.h"

namespace halfstep {
namespace {

constexpr double kFarAway = 1.0;  // [m] beyond what is demanded: more than any refused distance

}  // namespace

BodyClearances::BodyClearances(const RobotModel& robot, const Scene& scene)
    : robot_(robot), world_(scene) {
  for (const RobotBody& body : robot_.bodies) shapes_.emplace_back(body.shape);
  for (const auto& [i, j] : robot_.self_pairs) {
    const size_t a = static_cast<size_t>(i), b = static_cast<size_t>(j);
    const int leg_a = robot_.bodies[a].leg, leg_b = robot_.bodies[b].leg;
    const bool both = leg_a >= 0 && leg_b >= 0 && leg_a != leg_b;
    const int legs = !both ? 0 : leg_a == Index(Side::kLeft) ? 1 : -1;
    quick_.push_back({a, b, shapes_[a].radius() + shapes_[b].radius(), legs});
  }
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

double BodyClearances::QuickBound(size_t pair, const Scratch& scratch) const {
  const Quick& quick = quick_[pair];
  const double spheres =
      (scratch.centers_W[quick.a] - scratch.centers_W[quick.b]).norm() - quick.radii;
  if (quick.legs == 0) return spheres;
  return std::max(spheres, quick.legs * (scratch.lateral[quick.a] - scratch.lateral[quick.b]));
}

double BodyClearances::Above(size_t b, const Posture& posture, double sinks) const {
  const RobotBody& body = robot_.bodies[b];
  if (!has_solids() || !IsOnFoot(body)) return CollisionWorld::kAllSolids;
  return Nth(posture.X_WSole, body.leg).translation().z() - sinks + kSoleRounding;
}

bool BodyClearances::BodyClears(size_t body, const Posture& posture, double t, double clearance,
                                Scratch* scratch, double half_width, double sinks) const {
  ++scratch->queries;
  return world_.Clears(shapes_[body], posture.OfBody(robot_.bodies[body]), t, clearance,
                       &scratch->bodies[body], half_width, Above(body, posture, sinks));
}

bool BodyClearances::Separates(size_t pair, const Posture& posture, double clearance,
                               Scratch* scratch) const {
  const auto [i, j] = robot_.self_pairs[pair];
  const size_t a = static_cast<size_t>(i), b = static_cast<size_t>(j);
  ++scratch->queries;
  return ClearsAlongCached(shapes_[a], posture.OfBody(robot_.bodies[a]), shapes_[b],
                           posture.OfBody(robot_.bodies[b]), clearance,
                           &scratch->pair_normals_W[pair]);
}

CollisionWorld::Nearest BodyClearances::NearestTo(size_t body, const Posture& posture, double t,
                                                  double cap, Scratch* scratch, double half_width,
                                                  double sinks) const {
  ++scratch->queries;
  return world_.FindNearest(shapes_[body], posture.OfBody(robot_.bodies[body]), t,
                            std::max(cap, 1e-9), half_width, Above(body, posture, sinks));
}

Separation BodyClearances::SeparationOf(size_t pair, const Posture& posture,
                                        Scratch* scratch) const {
  const auto [i, j] = robot_.self_pairs[pair];
  const size_t a = static_cast<size_t>(i), b = static_cast<size_t>(j);
  ++scratch->queries;
  return Separate(shapes_[a], posture.OfBody(robot_.bodies[a]), shapes_[b],
                  posture.OfBody(robot_.bodies[b]));
}

Margin BodyClearances::OfBody(size_t body, const Posture& posture, double t, double cap,
                              Scratch* scratch, double half_width, double sinks) const {
  const auto nearest = NearestTo(body, posture, t, cap, scratch, half_width, sinks);
  Margin margin{
      .family = MarginFamily::kClearance, .value = cap, .subject = static_cast<int>(body)};
  // Within a half-width, an obstacle that is beyond the cap now may be the one that matters.
  if (nearest.obstacle >= 0 && (half_width > 0.0 || nearest.margin < cap)) {
    margin.value = nearest.margin;
    margin.other = nearest.obstacle;
  }
  return margin;
}

Margin BodyClearances::OfPair(size_t pair, const Posture& posture, double cap,
                              Scratch* scratch) const {
  const auto [i, j] = robot_.self_pairs[pair];
  Margin margin{.family = MarginFamily::kSelfClearance, .value = cap, .subject = i, .other = j};
  if (QuickBound(pair, *scratch) >= cap) return margin;
  margin.value = std::min(cap, SeparationOf(pair, posture, scratch).distance);
  return margin;
}

std::optional<Margin> BodyClearances::FirstBodyBelow(const Posture& posture, double t,
                                                     double clearance, Scratch* scratch) const {
  for (size_t b = 0; b < num_bodies(); ++b) {
    if (!BodyClears(b, posture, t, clearance, scratch)) {
      return OfBody(b, posture, t, clearance + kFarAway, scratch);
    }
  }
  return std::nullopt;
}

std::optional<Margin> BodyClearances::FirstPairBelow(const Posture& posture, double clearance,
                                                     Scratch* scratch) const {
  Place(posture, scratch);
  for (size_t p = 0; p < num_pairs(); ++p) {
    if (!PairClears(p, posture, clearance, scratch)) {
      return OfPair(p, posture, clearance + kFarAway, scratch);
    }
  }
  return std::nullopt;
}

Margin BodyClearances::NearestObstacle(const Posture& posture, double t, double cap,
                                       Scratch* scratch) const {
  Margin nearest{.family = MarginFamily::kClearance, .value = cap};
  for (size_t b = 0; b < num_bodies(); ++b) {
    const Margin margin = OfBody(b, posture, t, nearest.value, scratch);
    if (margin.value < nearest.value) nearest = margin;
  }
  return nearest;
}

Margin BodyClearances::NearestPair(const Posture& posture, double cap, Scratch* scratch) const {
  Margin nearest{.family = MarginFamily::kSelfClearance, .value = cap};
  Place(posture, scratch);
  for (size_t p = 0; p < num_pairs(); ++p) {
    const Margin margin = OfPair(p, posture, nearest.value, scratch);
    if (margin.value < nearest.value) nearest = margin;
  }
  return nearest;
}

}  // namespace halfstep
