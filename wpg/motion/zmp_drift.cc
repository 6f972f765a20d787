#include "wpg/motion/zmp_drift.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/motion/rigid_motion.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// The waist's body, with the point below the CoM at the waist's height: it moves as the CoM.
RigidMotion WaistMotion(const RobotModel& robot, const IntervalMotion& motion,
                        const WalkThirds& thirds) {
  const double h = motion.half_width;
  const Vector3d z = Vector3d::UnitZ();
  const auto place = [](const WalkState& x) { return Vector3d(x[kComX], x[kComY], 0.0); };
  const Range third = thirds.of(kWaistYaw);
  RigidMotion waist;
  waist.turn = {motion.jet.first[kWaistYaw] * z, h * motion.second[kWaistYaw]};
  waist.turn1 = {motion.jet.second[kWaistYaw] * z, h * third.most()};
  waist.turn2 = {third.center * z, third.radius};
  waist.p3 = {place(thirds.center), place(thirds.radius).norm()};
  waist.p2 = {place(motion.jet.second), h * waist.p3.most()};
  waist.p1 = {place(motion.jet.first), h * std::min(place(motion.second).norm(), waist.p2.most())};
  waist.p = {place(motion.jet.value) + robot.waist_height * z, h * waist.p1.most()};
  waist.BoundTurned(h);
  return waist;
}

// Products of a body's inertia about its CoM, which turns with it: ‖R I Rᵀ − I‖ ≤ ‖R − 1‖·‖I‖.
class TurnedInertia {
 public:
  TurnedInertia(const Eigen::Matrix3d& about_com, double turned)
      : I_(about_com), norm_(about_com.norm()), change_(std::min(turned, 2.0) * norm_) {}
  VectorBall operator*(const VectorBall& x) const {
    return {I_ * x.center, norm_ * x.radius + change_ * x.most()};
  }

 private:
  const Eigen::Matrix3d& I_;
  double norm_, change_;
};

// d/dt of m (r − p) × (a + g ẑ) + I ω̇ + ω × I ω.
VectorBall MomentRate(const SpatialInertia& inertia, const RigidMotion& body, const Vector3d& pole,
                      double gravity) {
  const VectorBall arm = body.p - VectorBall{pole, 0.0}, up{Vector3d::UnitZ(), 0.0};
  const TurnedInertia I(inertia.about_com, body.turned);
  const VectorBall &w = body.turn, &w1 = body.turn1;
  const VectorBall Iw = I * w;
  return inertia.mass *
             (Cross(arm, body.p3) + Cross(body.p1, body.p2) + gravity * Cross(body.p1, up)) +
         I * body.turn2 + 2.0 * Cross(w, I * w1) - I * Cross(w, w1) + Cross(w1, Iw) +
         Cross(w, Cross(w, Iw));
}

// Adds a link: m (r − p) × a + I ω̇ + ω × I ω by how much it drifts,
// its weight's moment m (r − p) × g ẑ by its rate at m and half h² times the acceleration.
void AddLink(const MassDrift& link, const Vector3d& arm, double gravity, ZmpDrift* drift) {
  const double h = drift->half_width, most = link.MostAcceleration();
  drift->rate.center += link.mass * gravity * link.velocity.cross(Vector3d::UnitZ());
  drift->rest += link.mass * (0.5 * h * h * gravity * most + arm.norm() * link.p2 + link.p * most);
  drift->least_push -= link.mass * link.p2;
  drift->rest += link.moment;
}

}  // namespace

double ZmpDrift::Most() const {
  if (!(least_push > 0.0)) return std::numeric_limits<double>::infinity();
  return (half_width * (rate.center.head<2>().norm() + rate.radius) + rest) / least_push;
}

double ZmpDrift::Along(const Eigen::Vector2d& direction) const {
  if (!(least_push > 0.0)) return std::numeric_limits<double>::infinity();
  const Vector3d& n = rate.center;
  const double along = std::abs(direction.y() * n.x() - direction.x() * n.y()) + rate.radius;
  return (half_width * along + rest) / least_push;
}

ZmpDrift ZmpDrift::Over(const RobotModel& robot, const IntervalMotion& motion,
                        const WalkThirds& thirds, const RobotDrift& of_robot,
                        const RobotDynamics& at_m, double gravity) {
  const Vector3d& O = at_m.O();
  Vector3d pole(0, 0, 0);
  pole.head<2>() = *at_m.Zmp();
  const RigidMotion waist = WaistMotion(robot, motion, thirds);
  const SpatialInertia& of_waist = at_m.waist().inertia;
  const RigidMotion body = waist.At(O + of_waist.com - waist.p.center);
  ZmpDrift drift{.half_width = motion.half_width,
                 .rate = MomentRate(of_waist, body, pole, gravity),
                 .rest = 0.0,
                 .least_push = at_m.contact()[5] - of_waist.mass * body.p2.radius};
  for (const auto& leg : of_robot.link_masses) {
    for (const MassDrift& link : leg) AddLink(link, O + link.com - pole, gravity, &drift);
  }
  return drift;
}

}  // namespace halfstep
