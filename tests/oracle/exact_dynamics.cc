#include "tests/oracle/exact_dynamics.h"

#include <algorithm>

#include "wpg/nth.h"

namespace halfstep::oracle {
namespace {

const Real3 kUpward = {0, 0, 1};

// How a rigid body moves, with one of its points.
struct Moving {
  Real3 p{}, v{}, a{}, turn{}, turn1{};

  Moving At(const Real3& point) const {
    const Real3 d = point - p;
    Moving there = *this;
    there.p = point;
    there.v = v + Cross(turn, d);
    there.a = a + Cross(turn1, d) + Cross(turn, Cross(turn, d));
    return there;
  }
  Moving Turned(const Real3& axis, Real speed, Real acceleration) const {
    Moving body = *this;
    body.turn = turn + speed * axis;
    body.turn1 = turn1 + acceleration * axis + speed * Cross(turn, axis);
    return body;
  }
};

// Force, and moment about the origin, of a body in W.
std::array<Real3, 2> Asked(const BodyMass& mass, const Real33& R, const Real3& com,
                           const Moving& body) {
  const Moving of_com = body.At(com);
  const Real33 I = R * FromMatrix(mass.inertia) * Transposed(R);
  const Real3 force = Real(mass.mass) * (of_com.a + Real(kGravity) * kUpward);
  return {force, Cross(com, force) + I * body.turn1 + Cross(body.turn, I * body.turn)};
}

// How far a point is from a sole's rectangle; negative inside.
Real BeyondSole(const Real3& sole, Real yaw, const Eigen::Vector2d& size,
                const std::array<Real, 2>& p) {
  const Real c = Cos(yaw), s = Sin(yaw), x = p[0] - sole[0], y = p[1] - sole[1];
  const Real u = Absolute(c * x + s * y) - Real(size.x()) / 2;
  const Real v = Absolute(c * y - s * x) - Real(size.y()) / 2;
  if (u > 0 && v > 0) return Sqrt(u * u + v * v);
  return u > v ? u : v;
}

}  // namespace

ExactDynamics::ExactDynamics(const RobotModel& robot, const std::array<ExactLeg, 2>& legs,
                             const std::array<ClosedFormWalk::Quantities, 3>& x) {
  const auto& [value, first, second] = x;
  // Everything is seen from a point of the floor, so that a walk far away costs no digits.
  const Real33 R = Yawed(value[kWaistYaw]);
  const Real3 back = R * Real3{-Real(robot.com_x_B), 0, 0};
  const Real rate = first[kWaistYaw], rate1 = second[kWaistYaw];
  pole = Real3{value[kComX], value[kComY], 0} + back;
  Moving waist;
  waist.p = {0, 0, Real(robot.waist_height) + value[kWaistZ]};
  waist.turn = rate * kUpward;
  waist.turn1 = rate1 * kUpward;
  waist.v = Real3{first[kComX], first[kComY], first[kWaistZ]} + rate * Cross(kUpward, back);
  waist.a = Real3{second[kComX], second[kComY], second[kWaistZ]} + rate1 * Cross(kUpward, back) +
            rate * rate * Cross(kUpward, Cross(kUpward, back));
  const auto add = [](const std::array<Real3, 2>& asked, Real3* to_force, Real3* to_moment) {
    *to_force = *to_force + asked[0];
    *to_moment = *to_moment + asked[1];
  };
  add(Asked(robot.masses.waist, R, waist.p + R * From(robot.masses.waist.com), waist), &force,
      &moment);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side)), f = static_cast<size_t>(FootIndex(side));
    const Leg& leg = robot.legs[s];
    const ExactLeg& exact = legs[s];
    const Real3 sole = Real3{value[f], value[f + 1], value[f + 2]} - pole;
    Real33 before = kIdentity;
    Real3 moved{};
    for (size_t j = 0; j < 6; ++j) {
      Real3 axis = From(leg.joints[j].axis_B);
      axis = (1 / Norm(axis)) * axis;
      joints[s][j].axis = R * (before * axis);
      joints[s][j].point = waist.p + R * (before * From(leg.joints[j].point_B) + moved);
      before = exact.R[j];
      moved = exact.t[j];
    }
    const auto follow = [&](const Real6& q2) {
      std::array<Moving, 6> links;
      for (size_t j = 0; j < 6; ++j) {
        const Moving& parent = j == 0 ? waist : links[j - 1];
        links[j] = parent.At(joints[s][j].point).Turned(joints[s][j].axis, exact.speeds[j], q2[j]);
      }
      return links;
    };
    const Moving still = follow({})[5].At(sole);
    const Real3 turn1 = second[f + 3] * kUpward - still.turn1;
    const Real3 a = Real3{second[f], second[f + 1], second[f + 2]} - still.a;
    std::array<Real6, 6> J;
    for (size_t j = 0; j < 6; ++j) {
      const Real3 v = Cross(joints[s][j].axis, sole - joints[s][j].point);
      for (size_t k = 0; k < 3; ++k) {
        J[k][j] = joints[s][j].axis[k];
        J[k + 3][j] = v[k];
      }
    }
    accelerations[s] = Solved(J, {turn1[0], turn1[1], turn1[2], a[0], a[1], a[2]});
    const auto links = follow(accelerations[s]);
    for (size_t j = 0; j < 6; ++j) {
      const Eigen::Isometry3d& X_BL = leg.joints[j].X_BLink;
      const BodyMass& mass = robot.masses.links[s][j];
      const Real33 linear = FromMatrix(X_BL.linear());
      const Real3 com_B = linear * From(mass.com) + From(X_BL.translation());
      const Real3 com = waist.p + R * (exact.R[j] * com_B + exact.t[j]);
      const auto asked = Asked(mass, R * exact.R[j] * linear, com, links[j]);
      add(asked, &force, &moment);
      joints[s][j].turn = links[j].turn;
      joints[s][j].turn1 = links[j].turn1;
      joints[s][j].velocity = links[j].v;
      joints[s][j].acceleration = links[j].a;
      for (size_t i = 0; i <= j; ++i) add(asked, &joints[s][i].force, &joints[s][i].moment);
    }
  }
}

std::array<Real, 2> ExactDynamics::Zmp(Real height) const {
  return {pole[0] + (height * force[0] - moment[1]) / force[2],
          pole[1] + (height * force[1] + moment[0]) / force[2]};
}

Real ExactDynamics::YawMoment(Real height) const {
  const auto p = Zmp(height);
  return moment[2] - ((p[0] - pole[0]) * force[1] - (p[1] - pole[1]) * force[0]);
}

Real ExactDynamics::Torque(size_t leg, size_t joint, const Real3& on_foot,
                           const Real3& moment_on_foot) const {
  const Joint& its = joints[leg][joint];
  const Real3 left = its.force - on_foot;
  return Dot(its.axis, its.moment - moment_on_foot - Cross(its.point, left));
}

std::array<Real3, 2> OnRightFoot(const ExactDynamics& dynamics, const ClosedFormWalk::Quantities& x,
                                 const Eigen::Vector2d& sole_size) {
  std::array<Real, 2> distances{};
  std::array<Real3, 2> soles{};
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side)), f = static_cast<size_t>(FootIndex(side));
    soles[s] = {x[f], x[f + 1], x[f + 2]};
    const Real d = BeyondSole(soles[s], x[f + 3], sole_size, dynamics.Zmp(soles[s][2]));
    distances[s] = d > 0 ? d : Real(0);
  }
  const Real sum = distances[0] + distances[1];
  const Real share = sum > 0 ? distances[0] / sum : Real(0.5);
  // A couple λ(1 − λ) (f_z (c_R − c_L) − rise f_t) × ẑ besides.
  const Real3& f = dynamics.force;
  const Real3 between = soles[1] - soles[0];
  const Real3 factor =
      share * (1 - share) *
      (f[2] * Real3{between[0], between[1], 0} - between[2] * Real3{f[0], f[1], 0});
  return {share * f, share * dynamics.moment + Cross(factor, kUpward)};
}

Real NeededFriction(const ExactDynamics& dynamics, const ClosedFormWalk::Quantities& x, Side side,
                    const Eigen::Vector2d& sole_size) {
  const size_t f = static_cast<size_t>(FootIndex(side));
  const auto p = dynamics.Zmp(x[f + 2]);
  const Real c = Cos(x[f + 3]), s = Sin(x[f + 3]), dx = p[0] - x[f], dy = p[1] - x[f + 1];
  const Real u = Real(sole_size.x()) / 2 - Absolute(c * dx + s * dy);
  const Real v = Real(sole_size.y()) / 2 - Absolute(c * dy - s * dx);
  if (u < 0 || v < 0) return -1;
  const Real3& force = dynamics.force;
  return (Sqrt(force[0] * force[0] + force[1] * force[1]) +
          Absolute(dynamics.YawMoment(x[f + 2])) / (u > v ? u : v)) /
         force[2];
}

}  // namespace halfstep::oracle
