// Forward and inverse kinematics of the oracle's robot.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tests/oracle/plain_robot.h"

namespace halfstep::oracle {
namespace {

// What turns and moves `from` to `to`: a rotation vector and a displacement.
Vector6 Error(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(to.linear() * from.linear().transpose()));
  // Small turns by the antisymmetric part, which does not lose the angle's last digits.
  const Eigen::Matrix3d R = to.linear() * from.linear().transpose();
  const Eigen::Vector3d small =
      0.5 * Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  Vector6 error;
  error << (small.norm() < 1e-3 && R.trace() > 0 ? small : turn.angle() * turn.axis()),
      to.translation() - from.translation();
  return error;
}

// The point nearest to the axes of some joints at q = 0, in the waist frame: Σ(1 − aaᵀ)(x − p) = 0.
Eigen::Vector3d NearestToAxes(const PlainRobot& robot, int leg, size_t first, size_t count) {
  const auto placed = robot.PlaceLeg(leg, Vector6::Zero());
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b(0, 0, 0);
  for (size_t j = first; j < first + count; ++j) {
    const int joint = robot.legs[static_cast<size_t>(leg)].joints[j];
    const Eigen::Vector3d axis = robot.joints[static_cast<size_t>(joint)].axis;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
    A += across;
    b += across * placed[j].translation();
  }
  return A.fullPivLu().solve(b);
}

}  // namespace

std::array<Eigen::Isometry3d, 7> PlainRobot::PlaceLeg(int leg, const Vector6& q) const {
  std::array<Eigen::Isometry3d, 7> placed;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const Leg& its = legs[static_cast<size_t>(leg)];
  for (size_t j = 0; j < 6; ++j) {
    const Joint& joint = joints[static_cast<size_t>(its.joints[j])];
    X.translate(joint.xyz);
    X.rotate(Eigen::AngleAxisd(q[static_cast<Eigen::Index>(j)], joint.axis));
    placed[j] = X;
  }
  placed[6] = X;
  placed[6].translate(its.sole);
  return placed;
}

Eigen::Matrix<double, 6, 6> PlainRobot::Jacobian(
    int leg, const std::array<Eigen::Isometry3d, 7>& placed) const {
  Eigen::Matrix<double, 6, 6> J;
  for (size_t j = 0; j < 6; ++j) {
    const int joint = legs[static_cast<size_t>(leg)].joints[j];
    // A turn about an axis leaves the axis where it is, also in the turned link.
    const Eigen::Vector3d axis = placed[j].linear() * joints[static_cast<size_t>(joint)].axis;
    J.col(static_cast<Eigen::Index>(j)) << axis,
        axis.cross(placed[6].translation() - placed[j].translation());
  }
  return J;
}

Eigen::Vector3d PlainRobot::HipInWaist(int leg) const { return NearestToAxes(*this, leg, 0, 3); }

Eigen::Vector3d PlainRobot::AnkleInSole(int leg) const {
  return -legs[static_cast<size_t>(leg)].sole;  // the foot's frame is where the ankle axes meet
}

double PlainRobot::HipToAnkle(int leg, double knee) const {
  Vector6 q = Vector6::Zero();
  const Eigen::Vector3d ankle =
      PlaceLeg(leg, q)[3].inverse() * NearestToAxes(*this, leg, 4, 2);  // on the shank
  q[3] = knee;
  return (PlaceLeg(leg, q)[3] * ankle - HipInWaist(leg)).norm();
}

// Golden section on the knee's angle: the distance has one maximum about the stretched knee.
double PlainRobot::LongestReach(int leg) const {
  const auto reach = [&](double knee) { return HipToAnkle(leg, knee); };
  double low = -1, high = 1;
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  while (high - low > 1e-8) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (reach(a) > reach(b) ? high : low) = reach(a) > reach(b) ? b : a;
  }
  return reach(0.5 * (low + high));
}

bool PlainRobot::SolveLeg(int leg, const Eigen::Isometry3d& X_BSole, Vector6* q) const {
  Vector6 at = *q;
  auto placed = PlaceLeg(leg, at);
  Vector6 error = Error(placed[6], X_BSole);
  for (int k = 0; k < 60; ++k) {
    const Eigen::Matrix<double, 6, 6> J = Jacobian(leg, placed);
    const Vector6 step = J.partialPivLu().solve(error);
    if (!step.allFinite()) return false;
    double length = std::min(1.0, 0.3 / step.cwiseAbs().maxCoeff());
    Vector6 next;
    bool better = false;
    const int halvings = error.norm() < 1e-13 ? 1 : 12;  // where rounding decides, or the step
    for (int halved = 0; halved < halvings && !better; ++halved, length *= 0.5) {
      next = at + length * step;
      const auto there = PlaceLeg(leg, next);
      const Vector6 left = Error(there[6], X_BSole);
      better = left.norm() < error.norm();
      if (better) {
        placed = there;
        error = left;
        at = next;
      }
    }
    if (!better) break;  // as near as rounding lets it, or stuck
    if (error.norm() < 1e-15) break;
  }
  *q = at;
  return error.norm() < 1e-11;
}

}  // namespace halfstep::oracle
