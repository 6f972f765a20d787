#include "wpg/motion/zmp_drift.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/motion/leg_drift.h"
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

// Adds a link, whose drift is that of its CoM: m (r − p) × a + I ω̇ + ω × I ω by how much it drifts,
// its weight's moment m (r − p) × g ẑ by its rate at m and half h² times the acceleration.
void AddLink(const RobotDynamics::Body& link, const RigidDrift& of_com, const Vector3d& arm,
             double gravity, ZmpDrift* drift) {
  const SpatialInertia& inertia = link.inertia;
  const double mass = inertia.mass, h = drift->half_width;
  const Vector3d turn = link.velocity.head<3>(), &com = inertia.com;
  const Vector3d v = link.velocity.tail<3>() + turn.cross(com);
  const Vector3d a = link.acceleration.tail<3>() + link.acceleration.head<3>().cross(com) +
                     turn.cross(v) - gravity * Vector3d::UnitZ();
  drift->rate.center += mass * gravity * v.cross(Vector3d::UnitZ());
  const double most = a.norm() + of_com.p2;
  drift->rest += mass * (0.5 * h * h * gravity * most + arm.norm() * of_com.p2 + of_com.p * most);
  drift->least_push -= mass * of_com.p2;

  const double norm = inertia.about_com.norm(), change = std::min(of_com.turned, 2.0) * norm;
  const double fastest = of_com.fastest();
  drift->rest += norm * of_com.turn1 + change * (of_com.acceleration + of_com.turn1) +
                 of_com.turn * norm * fastest +
                 of_com.speed * (norm * of_com.turn + change * fastest);
}

}  // namespace

double ZmpDrift::Along(const Eigen::Vector2d& direction) const {
  if (!(least_push > 0.0)) return std::numeric_limits<double>::infinity();
  const Vector3d& n = rate.center;
  const double along = std::abs(direction.y() * n.x() - direction.x() * n.y()) + rate.radius;
  return (half_width * along + rest) / least_push;
}

ZmpDrift ZmpDrift::Over(const RobotModel& robot, const IntervalMotion& motion,
                        const WalkThirds& thirds, const RobotDynamics& at_m, double gravity) {
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
  const RigidDrift on_waist = DriftOfWaist(robot, motion, thirds);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const LegDrift leg =
        LegDrift::Over(side, motion, on_waist, DriftOfSole(motion, thirds, side), at_m);
    for (size_t j = 0; j < 6; ++j) {
      const RobotDynamics::Body& link = at_m.leg(side)[j];
      if (!(link.inertia.mass > 0.0)) continue;
      const Vector3d com = O + link.inertia.com;
      AddLink(link, leg.links[j].At((com - leg.points[j]).norm()), com - pole, gravity, &drift);
    }
  }
  return drift;
}

}  // namespace halfstep
