#include "experiments/control/state_estimate.h"

#include <cmath>
#include <numbers>

#include "wpg/elementary.h"
#include "wpg/geometry/rotation.h"
#include "wpg/nth.h"

namespace halfstep::control {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

double YawOf(const Matrix3d& R) { return Atan2(R(1, 0), R(0, 0)); }

// A central difference: joints after and before h, seen with speeds.
constexpr double kStep = 1e-4;  // [s]

std::array<Vector6d, 2> After(const std::array<Vector6d, 2>& q,
                              const std::array<Vector6d, 2>& speeds, double h) {
  return {q[0] + h * speeds[0], q[1] + h * speeds[1]};
}

// A sole that carries, and its share.
struct Anchor {
  Vector3d p_S;  // centre of pressure in the sole's frame
  double share = 0.0;
};

std::array<Anchor, 2> AnchorsOf(const MeasuredState& measured) {
  std::array<Anchor, 2> anchors;
  const double all = measured.loads[0].force + measured.loads[1].force;
  for (size_t s = 0; s < 2; ++s) {
    const SoleLoad& load = measured.loads[s];
    anchors[s].p_S << load.centre, 0.0;
    if (all > 0.0) anchors[s].share = load.force / all;
  }
  return anchors;
}

// Roll and pitch of `R_WB`, and the yaw that the anchors give; without anchors the planned one.
Matrix3d Orientation(const RobotModel& robot, const MeasuredState& measured,
                     const PlannedState& then, const std::array<AnkleBush, 2>& bushes,
                     const std::array<Anchor, 2>& anchors) {
  const double imu = YawOf(measured.R_WB);
  double off = anchors[0].share + anchors[1].share > 0.0 ? 0.0 : YawOf(then.X_WB.linear()) - imu;
  for (size_t s = 0; s < 2; ++s) {
    const Isometry3d X_BSole =
        LegForwardKinematics(robot.legs[s], measured.q[s])[6] * bushes[s].X_RestSole();
    const double seen = YawOf(measured.R_WB * X_BSole.linear());
    off += anchors[s].share *
           std::remainder(YawOf(then.X_WSole[s].linear()) - seen, 2 * std::numbers::pi);
  }
  return AxisRotation(off, Vector3d::UnitZ()) * measured.R_WB;
}

}  // namespace

Vector3d CentreOfMass(const RobotModel& robot, const std::array<Vector6d, 2>& q) {
  const RobotMasses& masses = robot.masses;
  double mass = masses.waist.mass;
  Vector3d moment = mass * masses.waist.com;
  for (size_t s = 0; s < 2; ++s) {
    const auto X_BLink = LegForwardKinematics(robot.legs[s], q[s]);
    for (size_t j = 0; j < 6; ++j) {
      const BodyMass& link = masses.links[s][j];
      moment += link.mass * (X_BLink[j] * link.com);
      mass += link.mass;
    }
  }
  return moment / mass;
}

Vector3d CentreOfMassVelocity(const RobotModel& robot, const std::array<Vector6d, 2>& q,
                              const std::array<Vector6d, 2>& speeds) {
  return (CentreOfMass(robot, After(q, speeds, kStep)) -
          CentreOfMass(robot, After(q, speeds, -kStep))) /
         (2 * kStep);
}

EstimatedState EstimateState(const RobotModel& robot, const MeasuredState& measured,
                             const PlannedState& then, const std::array<AnkleBush, 2>& bushes) {
  const std::array<Anchor, 2> anchors = AnchorsOf(measured);
  const Vector3d com_B = CentreOfMass(robot, measured.q);
  const Vector3d moves_B = CentreOfMassVelocity(robot, measured.q, measured.speeds);
  EstimatedState state;
  state.X_WB.linear() = Orientation(robot, measured, then, bushes, anchors);
  const Matrix3d& R = state.X_WB.linear();
  if (anchors[0].share + anchors[1].share <= 0.0) {
    state.X_WB.translation() = then.X_WB.translation();
    state.com = state.X_WB * com_B;
    state.velocity = then.com_velocity;
    return state;
  }
  Vector3d p_WB(0, 0, 0);
  for (size_t s = 0; s < 2; ++s) {
    const Anchor& anchor = anchors[s];
    const auto at = [&](double h) -> Vector3d {
      const Vector6d q = measured.q[s] + h * measured.speeds[s];
      return LegForwardKinematics(robot.legs[s], q)[6] * bushes[s].X_RestSole(h) * anchor.p_S;
    };
    const Vector3d p_B = at(0.0), rests_B = (at(kStep) - at(-kStep)) / (2 * kStep);
    p_WB += anchor.share * (then.X_WSole[s] * anchor.p_S - R * p_B);
    state.velocity += anchor.share * (R * (moves_B - rests_B + measured.turn_B.cross(com_B - p_B)));
  }
  state.X_WB.translation() = p_WB;
  state.com = state.X_WB * com_B;
  return state;
}

EstimatedState EstimateState(const RobotModel& robot, const MeasuredState& measured,
                             const PlannedState& then) {
  return EstimateState(robot, measured, then,
                       {AnkleBush(robot.legs[0], {}), AnkleBush(robot.legs[1], {})});
}

}  // namespace halfstep::control
