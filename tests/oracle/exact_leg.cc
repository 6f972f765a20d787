#include "tests/oracle/exact_leg.h"

#include "wpg/nth.h"

namespace halfstep::oracle {
namespace {

struct Placed {
  std::array<Real3, 6> axis, point;
};

Placed Place(const Leg& leg, ExactLeg* exact) {
  Placed placed;
  Real33 R = kIdentity;
  Real3 t{};
  for (size_t i = 0; i < 6; ++i) {
    Real3 axis = From(leg.joints[i].axis_B);
    axis = (1 / Norm(axis)) * axis;
    const Real3 point = From(leg.joints[i].point_B);
    placed.axis[i] = R * axis;
    placed.point[i] = R * point + t;
    R = R * Rotation(axis, exact->q[i]);
    t = placed.point[i] - R * point;
    exact->R[i] = R;
    exact->t[i] = t;
  }
  return placed;
}

// Waist in W: place, velocity, yaw and yaw rate.
struct Waist {
  Waist(const RobotModel& robot, const ClosedFormWalk::Quantities& x,
        const ClosedFormWalk::Quantities& v)
      : R(Yawed(x[kWaistYaw])), rate(v[kWaistYaw]) {
    const Real3 back = R * Real3{-Real(robot.com_x_B), 0, 0};
    place = Real3{x[kComX], x[kComY], Real(robot.waist_height) + x[kWaistZ]} + back;
    velocity = Real3{v[kComX], v[kComY], v[kWaistZ]} + rate * Cross({0, 0, 1}, back);
  }
  Real33 R;
  Real3 place, velocity;
  Real rate;
};

}  // namespace

ExactLeg SolveExactLeg(const RobotModel& robot, Side side, const ClosedFormWalk::Quantities& value,
                       const ClosedFormWalk::Quantities& rate, const Vector6d& near) {
  const Leg& leg = Nth(robot.legs, Index(side));
  const size_t f = static_cast<size_t>(FootIndex(side));
  const Waist waist(robot, value, rate);
  const Real33 R_BW = Transposed(waist.R);
  const Real33 R_BS = R_BW * Yawed(value[f + 3]);
  const Real3 lever = Real3{value[f], value[f + 1], value[f + 2]} - waist.place;
  const Real3 p_BS = R_BW * lever, sole = From(leg.X_BSole.translation());
  const Real33 linear = FromMatrix(leg.X_BSole.linear());
  ExactLeg exact;
  for (size_t i = 0; i < 6; ++i) exact.q[i] = near[static_cast<Eigen::Index>(i)];
  for (int iteration = 0;; ++iteration) {
    const Placed placed = Place(leg, &exact);
    const Real3 at = exact.R[5] * sole + exact.t[5];
    // The rotation that is missing, for small ones.
    const Real33 E = R_BS * Transposed(exact.R[5] * linear);
    const Real3 turn = {(E[2][1] - E[1][2]) / 2, (E[0][2] - E[2][0]) / 2, (E[1][0] - E[0][1]) / 2};
    const Real3 gap = p_BS - at;
    std::array<Real6, 6> J;
    for (size_t i = 0; i < 6; ++i) {
      const Real3 v = Cross(placed.axis[i], at - placed.point[i]);
      for (size_t k = 0; k < 3; ++k) {
        J[k][i] = placed.axis[i][k];
        J[k + 3][i] = v[k];
      }
    }
    if (Norm(turn) + Norm(gap) < 1e-28 || iteration == 12) {
      exact.found = iteration < 12;
      const Real3 velocity = R_BW * (Real3{rate[f], rate[f + 1], rate[f + 2]} - waist.velocity -
                                     waist.rate * Cross({0, 0, 1}, lever));
      exact.speeds =
          Solved(J, {0, 0, rate[f + 3] - waist.rate, velocity[0], velocity[1], velocity[2]});
      return exact;
    }
    const Real6 step = Solved(J, {turn[0], turn[1], turn[2], gap[0], gap[1], gap[2]});
    for (size_t i = 0; i < 6; ++i) exact.q[i] += step[i];
  }
}

Real3 PointAt(const RobotModel& robot, Side side, const ExactLeg& exact, size_t link,
              const Eigen::Vector3d& p_L, const ClosedFormWalk::Quantities& value) {
  const Eigen::Isometry3d& X_BL = Nth(robot.legs, Index(side)).joints[link].X_BLink;
  const Real3 p_B = FromMatrix(X_BL.linear()) * From(p_L) + From(X_BL.translation());
  const Waist waist(robot, value, {});
  return waist.place + waist.R * (exact.R[link] * p_B + exact.t[link]);
}

Real ExactReach(const RobotModel& robot, Side side, const ExactLeg& exact) {
  const Leg& leg = Nth(robot.legs, Index(side));
  Real3 axis = From(leg.joints[3].axis_B);
  axis = (1 / Norm(axis)) * axis;
  const Real3 hip = From(leg.hip_B - leg.joints[3].point_B);
  const Real3 ankle = From(leg.ankle_B - leg.joints[3].point_B);
  const Real along = Dot(axis, hip) - Dot(axis, ankle);
  const Real r_h = Norm(hip - Dot(axis, hip) * axis), r_a = Norm(ankle - Dot(axis, ankle) * axis);
  const Real longest = Sqrt(along * along + (r_h + r_a) * (r_h + r_a));
  // Seen from the thigh, the knee alone moves the ankle.
  const Real3 point = From(leg.joints[3].point_B);
  const Real3 moved = point + Rotation(axis, exact.q[3]) * (From(leg.ankle_B) - point);
  return longest - Norm(moved - From(leg.hip_B));
}

}  // namespace halfstep::oracle
