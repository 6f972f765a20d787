#include "wpg/motion/foot_friction.h"

#include <algorithm>
#include <limits>

#include "wpg/rounded.h"

namespace halfstep {
namespace {

using Eigen::Vector2d;

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kNoEdge = 1e-9;     // [m] shorter edges have no direction
constexpr double kAlongEdge = 1e-8;  // [m] by which points p ± ρu near an edge along u come nearer
constexpr double kArithmetic = 1.0 + 256.0 * kRoundoff;  // for the arithmetic of what is needed

// About the vertical axis, of a force in the plane at the end of an arm.
double YawMoment(const Vector2d& arm, const Vector2d& force) {
  return arm.x() * force.y() - arm.y() * force.x();
}

}  // namespace

std::optional<FootFriction> FootFriction::Of(const RobotDynamics& dynamics,
                                             const SupportPolygon& polygon, double height) {
  const auto zmp = dynamics.Zmp(height);
  if (!zmp || !(polygon.Margin(*zmp) > 0.0)) return std::nullopt;
  FootFriction friction(dynamics, polygon, *zmp, height);
  for (int i = 0; i < polygon.size(); ++i) {
    const Vector2d edge = polygon.corner((i + 1) % polygon.size()) - polygon.corner(i);
    if (edge.norm() < kNoEdge) continue;
    const Reach reach = friction.ReachAlong(edge.normalized());
    if (reach.distance <= friction.reach_.distance) continue;
    friction.reach_ = reach;
    friction.along_ = edge.normalized();
  }
  return friction;
}

std::optional<FootFriction> FootFriction::OnLevels(const RobotDynamics& dynamics,
                                                   const WalkState& x,
                                                   const StandingHeights& heights,
                                                   const Vector2d& sole_size) {
  const auto left = dynamics.Zmp(heights.of(Side::kLeft)),
             right = dynamics.Zmp(heights.of(Side::kRight));
  if (!left || !right) return std::nullopt;
  const Pose2 X_WL = FootPose(x, Side::kLeft), X_WR = FootPose(x, Side::kRight);
  const SoleSection section = SoleSection::Widest(X_WL, X_WR, sole_size, {*left, *right});
  if (!(section.room > 0.0)) return std::nullopt;
  const double height = heights.of(Side::kLeft) + section.share * heights.rise();
  FootFriction friction(dynamics, SupportPolygon::Section(X_WL, X_WR, sole_size, section.share),
                        *dynamics.Zmp(height), height);
  friction.around_ = SoleSection::kAround;
  friction.along_ = section.along;
  friction.reach_ = {section.room, section.normal};
  return friction;
}

FootFriction::FootFriction(const RobotDynamics& dynamics, const SupportPolygon& polygon,
                           const Vector2d& zmp, double height)
    : dynamics_(dynamics),
      polygon_(polygon),
      zmp_(zmp),
      pull_(dynamics.contact().segment<2>(3)),
      turn_(dynamics.contact()[2] - YawMoment(zmp - dynamics.O().head<2>(), pull_)),
      push_(dynamics.contact()[5]),
      height_(height) {}

template <typename Visit>
void FootFriction::ForEachReach(const Vector2d& direction, const Visit& visit) const {
  for (int i = 0; i < polygon_.size(); ++i) {
    const Vector2d a = polygon_.corner(i), edge = polygon_.corner((i + 1) % polygon_.size()) - a;
    if (edge.norm() < kNoEdge) continue;
    const Vector2d inward = Vector2d(-edge.y(), edge.x()).normalized();
    const double share = std::max(std::abs(inward.dot(direction)), around_);
    if (share < 1e-9) continue;  // what goes on along u goes nearly along the edge
    visit(Reach{inward.dot(zmp_ - a) / share, inward / share});
  }
}

FootFriction::Reach FootFriction::ReachAlong(const Vector2d& direction) const {
  Reach least{std::numeric_limits<double>::infinity(), {0, 0}};
  ForEachReach(direction, [&](const Reach& reach) {
    if (reach.distance < least.distance) least = reach;
  });
  return least;
}

Vector6d FootFriction::Gradient() const {
  const double pull = pull_.norm(), distance = reach_.distance;
  const double by_turn = (turn_ < 0.0 ? -1.0 : 1.0) / distance;
  // turn_ = n_z − (p − O) × pull.
  const Vector2d by_zmp = by_turn * Vector2d(-pull_.y(), pull_.x()) -
                          std::abs(turn_) / (distance * distance) * reach_.normal;
  const Vector2d arm = zmp_ - dynamics_.O().head<2>();
  Vector6d gradient = dynamics_.ZmpGradient(by_zmp, height_);
  gradient[2] += by_turn;
  gradient.segment<2>(3) += by_turn * Vector2d(arm.y(), -arm.x());
  if (pull > 0.0) gradient.segment<2>(3) += pull_ / pull;
  gradient[5] -= needed();
  return gradient / push_;
}

// It may leave by an edge along u as well, and then nothing suffices.
bool FootFriction::StaysInside(const ZmpDrift& zmp, double soles_off) const {
  for (int i = 0; i < polygon_.size(); ++i) {
    const Vector2d a = polygon_.corner(i), edge = polygon_.corner((i + 1) % polygon_.size()) - a;
    if (edge.norm() < kNoEdge) continue;
    const Vector2d inward = Vector2d(-edge.y(), edge.x()).normalized();
    if (!(inward.dot(zmp_ - a) > zmp.Along(inward) + soles_off + kAlongEdge)) return false;
  }
  return true;
}

// Corners that are cut off by edges without direction.
double FootFriction::LeftOut() const {
  for (int i = 0; i < polygon_.size(); ++i) {
    if ((polygon_.corner((i + 1) % polygon_.size()) - polygon_.corner(i)).norm() < kNoEdge) {
      return kNoEdge;
    }
  }
  return 0.0;
}

// The moment's is about O.
double FootFriction::TurnRounding() const {
  const double arm = (zmp_ - dynamics_.O().head<2>()).norm();
  return 16.0 * kRoundoff * (std::abs(dynamics_.contact()[2]) + arm * pull_.norm());
}

double FootFriction::Drift(const RobotDrift& robot, const ZmpDrift& zmp, double soles_off) const {
  soles_off += LeftOut();
  double reach = kNone;
  ForEachReach(along_, [&](const Reach& at_m) {
    const double length = at_m.normal.norm();
    reach = std::min(reach, at_m.distance - length * (zmp.Along(at_m.normal / length) + soles_off));
  });
  if (!(reach > 0.0) || !(zmp.least_push > 0.0) || !StaysInside(zmp, soles_off)) return kNone;
  Eigen::Vector3d below(0, 0, 0);
  below.head<2>() = zmp_ - dynamics_.O().head<2>();
  const double pull = pull_.norm() + robot.ForceDrift();
  const double turn =
      std::abs(turn_) + TurnRounding() + robot.YawMomentDrift(below) + zmp.Most() * pull;
  return (pull + turn / reach) / zmp.least_push * kArithmetic - needed();
}

double FootFriction::Drift(const ContactRate& rate, double soles_off) const {
  soles_off += LeftOut();
  const double h = rate.half_width;
  const ZmpDrift zmp = ZmpDrift::At(rate, push_);
  if (!StaysInside(zmp, soles_off)) return kNone;
  const Vector2d pull_rate = rate.force.center.head<2>();
  const double least_push = zmp.least_push, force_off = rate.force.radius;
  // At m it is at most zmp_off from p, then p + τ·(way + what is at most way_off), |τ| ≤ h.
  const double zmp_off = rate.off.moment / least_push;
  const Vector2d way = Vector2d(-rate.moment.center.y(), rate.moment.center.x()) / push_;
  const double way_off = (rate.moment.radius + way.norm() * (push_ - least_push)) / least_push;
  // The yaw moment about it is turn + τ·(turn_rate + what is at most turn_off).
  const double turn_rate = rate.moment.center.z() - YawMoment(way, pull_);
  const double turn_off = rate.moment.radius + way_off * pull_.norm() +
                          h * (way.norm() + way_off) * (pull_rate.norm() + force_off);
  const double turn_at_m = TurnRounding() + rate.off.moment +
                           16.0 * kRoundoff * h * std::abs(turn_rate) +
                           (zmp_off + h * (way.norm() + way_off)) * rate.off.force +
                           zmp_off * (pull_.norm() + h * (pull_rate.norm() + force_off));
  double most = 0.0;
  ForEachReach(along_, [&](const Reach& at_m) {
    // The points' distance is at least ρ + τ ρ'.
    const double off = at_m.normal.norm() * (h * way_off + zmp_off + soles_off);
    const double distance = at_m.distance - off;
    const double distance_rate = at_m.normal.dot(way);
    const double least = distance - h * std::abs(distance_rate);
    if (!(least > 0.0)) {
      most = kNone;
      return;
    }
    for (const double sign : {-1.0, 1.0}) {
      const double moment = sign * turn_ + h * turn_off + turn_at_m;
      const double moment_rate = sign * turn_rate;
      const double bend = h * h * std::abs(distance_rate) *
                          std::abs(distance_rate * moment - moment_rate * distance) /
                          (least * least * least);
      for (const double tau : {-h, h}) {
        const double pull = (pull_ + tau * pull_rate).norm() + h * force_off + rate.off.force;
        const double turn = (moment + tau * moment_rate) / (distance + tau * distance_rate);
        const double push = push_ + tau * rate.force.center.z() - h * force_off - rate.off.force;
        most = std::max(most, (pull + turn + bend) / push);
      }
    }
  });
  return most * kArithmetic - needed();
}

}  // namespace halfstep
