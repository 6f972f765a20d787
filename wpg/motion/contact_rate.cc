#include "wpg/motion/contact_rate.h"

#include <algorithm>

#include "wpg/motion/leg_motion.h"
#include "wpg/nth.h"
#include "wpg/rounded.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Products of a body's inertia about its CoM, which turns with it: ‖R I Rᵀ − I‖ ≤ ‖R − 1‖·‖I‖, and
// R I Rᵀ has the norm of I.
class TurnedInertia {
 public:
  TurnedInertia(const Eigen::Matrix3d& about_com, double turned)
      : I_(about_com),
        norm_(about_com.norm()),
        change_((std::min(turned, 2.0) + 16.0 * kRoundoff) * norm_) {}
  VectorBall operator*(const VectorBall& x) const {
    return {I_ * x.center, norm_ * x.radius + change_ * x.center.norm()};
  }

 private:
  const Eigen::Matrix3d& I_;
  double norm_, change_;
};

}  // namespace

// d/dt of m (r − p) × (a + g ẑ) + I ω̇ + ω × I ω, and of m (a + g ẑ).
void ContactRate::Add(const SpatialInertia& inertia, const RigidMotion& com, const Vector3d& p,
                      double gravity) {
  const VectorBall arm = com.p - VectorBall{p, 0.0}, up{Vector3d::UnitZ(), 0.0};
  const TurnedInertia I(inertia.about_com, com.turned);
  const VectorBall &w = com.turn, &w1 = com.turn1;
  const VectorBall Iw = I * w;
  moment +=
      inertia.mass * (Cross(arm, com.p3) + Cross(com.p1, com.p2) + gravity * Cross(com.p1, up)) +
      I * com.turn2 + 2.0 * Cross(w, I * w1) - I * Cross(w, w1) + Cross(w1, Iw) +
      Cross(w, Cross(w, Iw));
  force += inertia.mass * com.p3;
}

ContactRate ContactRate::Raised(double by) const {
  ContactRate raised = *this;
  const Vector3d arm = by * Vector3d(tilt.x(), tilt.y(), 1.0);
  raised.moment = moment - Cross({arm, 0.0}, force);
  raised.off.moment += arm.norm() * off.force;
  return raised;
}

std::optional<ContactRate> ContactRate::Over(const RobotModel& robot, const IntervalMotion& motion,
                                             const WalkThirds& thirds, const RobotDrift& of_robot,
                                             const RobotDynamics& at_m, double gravity,
                                             double height) {
  if (!of_robot.rounding.known) return std::nullopt;
  Vector3d p(0, 0, height);
  p.head<2>() = *at_m.Zmp(height);
  ContactRate rate{.half_width = motion.half_width,
                   .moment = {},
                   .force = {},
                   .tilt = at_m.Tilt(),
                   .off = of_robot.rounding.OfContact(at_m, p - at_m.O())};
  rate.off.moment += at_m.contact()[5] * PlaceOfZmpRounding(at_m, p);
  const auto add = [&](const RobotDynamics::Body& body, const RigidMotion& its_motion) {
    const Vector3d com = at_m.O() + body.inertia.com;
    rate.Add(body.inertia, its_motion.At(com - its_motion.p.center), p, gravity);
  };
  const RigidMotion waist = MotionOfWaist(robot, motion, thirds);
  add(at_m.waist(), waist);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const LegDrift& drift = Nth(of_robot.legs, Index(side));
    const auto leg = LegMotion::Over(side, motion, waist, MotionOfSole(motion, thirds, side), drift,
                                     at_m, of_robot.rounding, gravity);
    if (!leg) return std::nullopt;
    for (size_t j = 0; j < 6; ++j) add(at_m.leg(side)[j], leg->links[j]);
  }
  return rate;
}

}  // namespace halfstep
