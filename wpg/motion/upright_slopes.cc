#include "wpg/motion/upright_slopes.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Of UprightAcceleration: at `p` from O, moved by `v`, with yaw rate `r` and acceleration `a`.
Vector6d UprightAccelerationSlope(const Vector3d& p, const Vector3d& v, double r, double a,
                                  const Vector3d& dp, const Vector3d& dv, const Vector3d& da,
                                  double dr, double d_yaw2) {
  const Vector3d z = Vector3d::UnitZ();
  return Spatial(d_yaw2 * z,
                 da - d_yaw2 * z.cross(p) - a * z.cross(dp) - dr * z.cross(v) - r * z.cross(dv));
}

}  // namespace

WaistSlope::WaistSlope(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                       const RobotDynamics& dynamics, const WalkJet& d) {
  const Vector3d z = Vector3d::UnitZ();
  const double rate = jet.first[kWaistYaw], d_yaw = d.value[kWaistYaw];
  const double yaw2 = jet.second[kWaistYaw];
  const double d_rate = d.first[kWaistYaw], d_yaw2 = d.second[kWaistYaw];
  const Vector3d x_W = posture.X_WB.linear().col(0), y_W = posture.X_WB.linear().col(1);
  const auto point = [](const WalkState& x) { return Vector3d(x[kComX], x[kComY], x[kWaistZ]); };

  // w = c − com_x x_W and its derivatives.
  const double com_x = robot.com_x_B;
  const Vector3d w = posture.X_WB.translation() - dynamics.O(), w1 = posture.waist_velocity;
  const Vector3d dw = point(d.value) - com_x * d_yaw * y_W;
  const Vector3d dw1 = point(d.first) - com_x * (d_rate * y_W - rate * d_yaw * x_W);
  const Vector3d dw2 =
      point(d.second) - com_x * (d_yaw2 * y_W - yaw2 * d_yaw * x_W - 2.0 * rate * d_rate * x_W -
                                 rate * rate * d_yaw * y_W);
  displacement = Spatial(d_yaw * z, dw - d_yaw * z.cross(w));
  velocity = Spatial(d_rate * z, dw1 - d_rate * z.cross(w) - rate * z.cross(dw));
  acceleration = UprightAccelerationSlope(w, w1, rate, yaw2, dw, dw1, dw2, d_rate, d_yaw2);
}

Vector6d SoleAccelerationSlope(Side side, const WalkJet& jet, const Posture& posture,
                               const RobotDynamics& dynamics, const WalkJet& d) {
  const size_t s = static_cast<size_t>(Index(side));
  const int foot = FootIndex(side);
  return UprightAccelerationSlope(
      posture.X_WSole[s].translation() - dynamics.O(), jet.first.segment<3>(foot),
      jet.first[foot + 3], jet.second[foot + 3], d.value.segment<3>(foot), d.first.segment<3>(foot),
      d.second.segment<3>(foot), d.first[foot + 3], d.second[foot + 3]);
}

void WaistGradient::AddTo(const RobotModel& robot, const WalkJet& jet, const Posture& posture,
                          const RobotDynamics& dynamics, WalkJet* by) const {
  const Vector3d z = Vector3d::UnitZ();
  const double rate = jet.first[kWaistYaw], yaw2 = jet.second[kWaistYaw];
  const double com_x = robot.com_x_B;
  const Vector3d x_W = posture.X_WB.linear().col(0), y_W = posture.X_WB.linear().col(1);
  const Vector3d w = posture.X_WB.translation() - dynamics.O(), w1 = posture.waist_velocity;
  const Vector3d carried = z.cross(w);
  const Vector3d by_d = displacement.tail<3>(), by_v = velocity.tail<3>(),
                 by_a = acceleration.tail<3>();
  // Of w and its derivatives.
  const Vector3d by_w = by_d - (rate * by_v + yaw2 * by_a).cross(z);
  const Vector3d by_w1 = by_v - rate * by_a.cross(z);
  by->value.segment<2>(kComX) += by_w.head<2>();
  by->first.segment<2>(kComX) += by_w1.head<2>();
  by->second.segment<2>(kComX) += by_a.head<2>();
  by->value[kWaistZ] += by_w.z();
  by->first[kWaistZ] += by_w1.z();
  by->second[kWaistZ] += by_a.z();
  by->value[kWaistYaw] +=
      displacement[2] - by_d.dot(carried) -
      com_x * (y_W.dot(by_w) - rate * x_W.dot(by_w1) - (yaw2 * x_W + rate * rate * y_W).dot(by_a));
  by->first[kWaistYaw] += velocity[2] - by_v.dot(carried) - by_a.dot(z.cross(w1)) -
                          com_x * (y_W.dot(by_w1) - 2.0 * rate * x_W.dot(by_a));
  by->second[kWaistYaw] += acceleration[2] - by_a.dot(carried) - com_x * y_W.dot(by_a);
}

void AddSoleAcceleration(Side side, const WalkJet& jet, const Posture& posture,
                         const RobotDynamics& dynamics, const Vector6d& by_sole, WalkJet* by) {
  const Vector3d z = Vector3d::UnitZ();
  const int foot = FootIndex(side);
  const Vector3d p = posture.X_WSole[static_cast<size_t>(Index(side))].translation() - dynamics.O();
  const Vector3d v = jet.first.segment<3>(foot), by_a = by_sole.tail<3>();
  const Vector3d turned = by_a.cross(z);
  by->value.segment<3>(foot) -= jet.second[foot + 3] * turned;
  by->first.segment<3>(foot) -= jet.first[foot + 3] * turned;
  by->second.segment<3>(foot) += by_a;
  by->first[foot + 3] -= by_a.dot(z.cross(v));
  by->second[foot + 3] += by_sole[2] - by_a.dot(z.cross(p));
}

}  // namespace halfstep
