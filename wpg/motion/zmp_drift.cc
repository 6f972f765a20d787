#include "wpg/motion/zmp_drift.h"

#include <cmath>

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Products of a body's inertia about its CoM, which turns with it, over the interval.
class TurnedInertia {
 public:
  TurnedInertia(const Eigen::Matrix3d& about_com, double turned) : I_(about_com) {
    // ‖R I Rᵀ − I‖ ≤ ‖R − 1‖ (λ_max − λ_min), and a norm is at least λ_max.
    norm_ = about_com.norm();
    change_ = std::min(turned, 2.0) * norm_;
  }
  VectorBall operator*(const VectorBall& x) const {
    return {I_ * x.center, norm_ * x.radius + change_ * x.most()};
  }

 private:
  const Eigen::Matrix3d& I_;
  double norm_, change_;
};

// Adds what a body of the given inertia at m contributes to the moment's rate about O + `pole`, and
// to the push.
void Add(const SpatialInertia& inertia, const RigidMotion& link, const Vector3d& O,
         const Vector3d& pole, double gravity, ZmpDrift* drift) {
  if (!(inertia.mass > 0.0)) return;
  const RigidMotion body = link.At(O + inertia.com - link.p.center);
  const VectorBall arm = body.p - VectorBall{O + pole, 0.0}, up{Vector3d::UnitZ(), 0.0};
  drift->moment_rate +=
      inertia.mass * (Cross(arm, body.p3) + Cross(body.p1, body.p2) + gravity * Cross(body.p1, up));
  drift->least_push += inertia.mass * (gravity + body.p2.center.z() - body.p2.radius);
  // d/dt (I ω̇ + ω × I ω)
  const TurnedInertia I(inertia.about_com, body.turned);
  const VectorBall &w = body.turn, &w1 = body.turn1;
  const VectorBall Iw = I * w, Iw1 = I * w1;
  drift->moment_rate += I * body.turn2 + 2.0 * Cross(w, Iw1) - I * Cross(w, w1) + Cross(w1, Iw) +
                        Cross(w, Cross(w, Iw));
}

}  // namespace

double ZmpDrift::Along(const Eigen::Vector2d& direction) const {
  const Vector3d& n = moment_rate.center;
  const double rate = std::abs(direction.y() * n.x() - direction.x() * n.y()) + moment_rate.radius;
  return half_width * rate / least_push;
}

std::optional<ZmpDrift> ZmpDrift::Over(const RobotModel& robot, const IntervalMotion& motion,
                                       const WalkThirds& thirds, const RobotDynamics& at_m,
                                       double gravity) {
  const auto motions = LinkMotions::Over(robot, motion, thirds, at_m);
  if (!motions) return std::nullopt;
  Vector3d pole(0, 0, 0);
  pole.head<2>() = *at_m.Zmp() - at_m.O().head<2>();
  ZmpDrift drift{.half_width = motion.half_width, .moment_rate = {}, .least_push = 0.0};
  Add(at_m.waist().inertia, motions->waist, at_m.O(), pole, gravity, &drift);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto& links = motions->links[static_cast<size_t>(Index(side))];
    for (size_t j = 0; j < 6; ++j) {
      Add(at_m.leg(side)[j].inertia, links[j], at_m.O(), pole, gravity, &drift);
    }
  }
  if (!(drift.least_push > 0.0) || !std::isfinite(drift.moment_rate.radius)) return std::nullopt;
  return drift;
}

}  // namespace halfstep
