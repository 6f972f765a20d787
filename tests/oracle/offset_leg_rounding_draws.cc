#include <cmath>

#include "tests/oracle/real_vectors.h"
#include "tests/oracle/rounding_draws.h"
#include "wpg/nth.h"
#include "wpg/robot/leg_neighbourhood.h"

namespace halfstep::oracle {
namespace {

// A leg on the way from its closed-form neighbour, exactly: axes about hip_B, the sole, and how
// they go on.
struct ExactOnTheWay {
  ExactOnTheWay(const Leg& leg, const Vector6d& q, double share) {
    const Leg& met = leg.met.front();
    Real33 R = kIdentity;
    Real3 t{}, t_rate{};
    for (size_t j = 0; j < 6; ++j) {
      const LegJoint& joint = leg.joints[j];
      Real3 axis = From(joint.axis_B);
      axis = (1 / Norm(axis)) * axis;
      const Real3 its = AxisPoint(met, j), offset = AxisPoint(leg, j) - its;
      const Real3 at_zero = its + Real(share) * offset;
      const Real3 turned = R * axis, point = R * at_zero + t, rate = R * offset + t_rate;
      const Real3 moment = Cross(turned, From(leg.hip_B) - point);
      for (size_t k = 0; k < 3; ++k) {
        J[k][j] = turned[k];
        J[k + 3][j] = moment[k];
      }
      R = R * Rotation(axis, q[static_cast<Eigen::Index>(j)]);
      t = point - R * at_zero;
      t_rate = rate - R * offset;
    }
    const Real3 its_sole = From(met.X_BSole.translation());
    const Real3 offset = From(leg.X_BSole.translation()) - its_sole;
    turn = R * FromMatrix(leg.X_BSole.linear());
    place = R * (its_sole + Real(share) * offset) + t;
    by_share = R * offset + t_rate;
  }

  static Real3 AxisPoint(const Leg& leg, size_t j) {
    if (leg.closed_form() && j != 3) return From(j < 3 ? leg.hip_B : leg.ankle_B);
    Real3 axis = From(leg.joints[j].axis_B);
    axis = (1 / Norm(axis)) * axis;
    const Real3 point = From(leg.joints[j].point_B), near = From(j < 4 ? leg.hip_B : leg.ankle_B);
    return point + Dot(axis, near - point) * axis;
  }

  std::array<Real6, 6> J{};
  Real33 turn;  // of the sole's frame
  Real3 place, by_share;
};

double Times(const Matrix6d& Y, Eigen::Index row, const Real6& x, double less = 0.0) {
  Real sum = -Real(less);
  for (size_t k = 0; k < 6; ++k) sum += Real(Y(row, static_cast<Eigen::Index>(k))) * x[k];
  return static_cast<double>(Absolute(sum));
}

Eigen::Isometry3d Scaled(Eigen::Isometry3d X, double scale) {
  X.translation() *= scale;
  return X;
}

}  // namespace

RobotModel ScaledRobot(RobotModel robot, double scale) {
  const auto scale_leg = [scale](Leg* leg) {
    for (LegJoint& joint : leg->joints) {
      joint.point_B *= scale;
      joint.X_BLink = Scaled(joint.X_BLink, scale);
    }
    leg->hip_B *= scale;
    leg->ankle_B *= scale;
    leg->X_BSole = Scaled(leg->X_BSole, scale);
  };
  for (Leg& leg : robot.legs) {
    scale_leg(&leg);
    for (Leg& met : leg.met) scale_leg(&met);
  }
  for (RobotBody& body : robot.bodies) {
    body.shape.center *= scale;
    body.shape.radius *= scale;
  }
  const auto scale_mass = [scale](BodyMass* of) {
    of->com *= scale;
    of->mass *= scale * scale * scale;
    of->inertia *= scale * scale * scale * scale * scale;
  };
  scale_mass(&robot.masses.waist);
  for (auto& leg : robot.masses.links) {
    for (BodyMass& link : leg) scale_mass(&link);
  }
  robot.sole_size *= scale;
  robot.waist_height *= scale;
  robot.com_x_B *= scale;
  return robot;
}

void DrawNeighbourhoods(const RobotModel& of, double scale, long draws, unsigned seed,
                        RoundingTally* tally) {
  const RobotModel robot = ScaledRobot(of, scale);
  Draw draw(seed);
  for (; draws > 0; --draws) {
    const Leg& leg = Nth(robot.legs, draw.Below(2));
    Vector6d q;
    for (double& angle : q) angle = draw.Uniform(-1, 1);
    const double share = draw.Chance(0.5) ? 1.0 : draw.Uniform(0, 1);
    const auto near = LegNeighbourhood::Around(leg, q, share);
    if (!near) continue;
    const ExactOnTheWay exact(leg, q, share);
    const Matrix6d& Y = near->inverse();
    const Matrix6d inverse = near->Change(Vector6d::Zero());
    // The twist about hip_B from the exact pose to the computed one.
    const Real33 E = FromMatrix(near->X_BSole().linear()) * Transposed(exact.turn);
    const Real3 turn = {(E[2][1] - E[1][2]) / 2, (E[0][2] - E[2][0]) / 2, (E[1][0] - E[0][1]) / 2};
    const Real3 moved = From(Eigen::Vector3d(near->X_BSole().translation())) - exact.place +
                        Cross(turn, From(leg.hip_B) - exact.place);
    const Real6 way = {turn[0], turn[1], turn[2], moved[0], moved[1], moved[2]};
    const Real3& p = exact.by_share;
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (Eigen::Index j = 0; j < 6; ++j) {
        Real6 column;
        for (size_t k = 0; k < 6; ++k) column[k] = exact.J[k][static_cast<size_t>(j)];
        tally->Add("YJ", Times(Y, i, column, i == j ? 1.0 : 0.0), inverse(i, j));
      }
      tally->Add("way", Times(Y, i, way), near->WayRounding()[i]);
      tally->Add("by share", Times(Y, i, {0, 0, 0, -p[0], -p[1], -p[2]}, near->by_share()[i]),
                 near->ByShareRounding()[i]);
    }
  }
}

}  // namespace halfstep::oracle
