#include "wpg/robot/leg_ik.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "wpg/check.h"
#include "wpg/robot/leg_continuation.h"
#include "wpg/robot/paden_kahan.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

double SideSign(int choice) { return choice == 0 ? 1.0 : -1.0; }
int ChoiceOf(double side) { return side >= 0 ? 0 : 1; }

Vector3d RotateBack(const LegJoint& joint, const Turn& turn, const Vector3d& v) {
  return Rotate(joint.axis_B, turn.Inverse(), v);
}

// Hip and ankle around the knee axis. With psi the angle from the hip to the ankle, seen along the
// axis, distance² = sum2 − 2 product cos(psi) and knee angle = psi − psi at zero.
struct KneeTriangle {
  explicit KneeTriangle(const Leg& leg) {
    const LegJoint& knee = leg.joints[3];
    const Vector3d hip = leg.hip_B - knee.point_B, ankle = leg.ankle_B - knee.point_B;
    const double hip_along = knee.axis_B.dot(hip), ankle_along = knee.axis_B.dot(ankle);
    const double x = hip.dot(ankle) - hip_along * ankle_along;
    const double y = knee.axis_B.dot(hip.cross(ankle));
    product = std::sqrt(x * x + y * y);
    sum2 = hip.squaredNorm() + ankle.squaredNorm() - 2 * hip_along * ankle_along;
    at_zero = {x / product, y / product};
  }
  double farthest() const { return std::sqrt(sum2 + 2 * product); }
  double nearest() const { return std::sqrt(std::max(sum2 - 2 * product, 0.0)); }

  double product;
  double sum2;
  Turn at_zero;
};

struct Reach {
  bool reached;
  double margin;
  double cos_psi;
};

Reach ReachOf(const KneeTriangle& triangle, const Vector3d& hip_to_ankle) {
  // Rounding may put a just reachable pose this far outside; the sole is then off by rounding only.
  constexpr double kSlack = 1e-12;
  const double distance2 = hip_to_ankle.squaredNorm();
  const double cos_psi = (triangle.sum2 - distance2) / (2 * triangle.product);
  const double distance = std::sqrt(distance2);
  if (cos_psi > 1 + kSlack) return {false, distance - triangle.nearest(), 1.0};
  const double margin = triangle.farthest() - distance;
  if (!(cos_psi >= -1 - kSlack)) return {false, margin, -1.0};
  return {true, std::max(margin, 0.0), std::clamp(cos_psi, -1.0, 1.0)};
}

// The sole's displacement from its place at q = 0, as the hip and the ankle see it.
struct Demand {
  Demand(const Leg& leg, const Isometry3d& X_BSole)
      : R(X_BSole.linear() * leg.X_BSole.linear().transpose()),
        hip_to_ankle(X_BSole.translation() + R * (leg.ankle_B - leg.X_BSole.translation()) -
                     leg.hip_B),
        ankle_to_hip_in_foot(-(R.transpose() * hip_to_ankle)) {}

  Eigen::Matrix3d R;
  Vector3d hip_to_ankle;
  Vector3d ankle_to_hip_in_foot;
};

// Ankles, then hip, for a knee angle that gives the demanded distance. False: no such rotation.
bool SolveGivenKnee(const Leg& leg, const Demand& demand, const Turn& knee, const LegBranch& branch,
                    Vector6d* q) {
  const auto& j = leg.joints;
  const Vector3d hip_seen =
      RotateBack(j[3], knee, leg.hip_B - j[3].point_B) + j[3].point_B - leg.ankle_B;
  Turn ankle5_back, ankle4_back;
  if (!TwoTurnsFromTo(j[5].axis_B, j[4].axis_B, hip_seen, demand.ankle_to_hip_in_foot,
                      SideSign(branch.ankle), &ankle5_back, &ankle4_back)) {
    return false;
  }
  const Turn ankle4 = ankle4_back.Inverse(), ankle5 = ankle5_back.Inverse();
  // What remains for the hip is R = demand.R · (R3 R4 R5)⁻¹ = R0 R1 R2.
  const Vector3d axis2_turned =
      demand.R *
      RotateBack(j[5], ankle5, RotateBack(j[4], ankle4, RotateBack(j[3], knee, j[2].axis_B)));
  Turn hip0, hip1;
  if (!TwoTurnsFromTo(j[0].axis_B, j[1].axis_B, j[2].axis_B, axis2_turned, SideSign(branch.hip),
                      &hip0, &hip1)) {
    return false;
  }
  // R2 · R⁻¹ R0 axis1 = R1⁻¹ axis1 = axis1.
  const Vector3d axis1_seen =
      demand.R.transpose() * Rotate(j[0].axis_B, hip0, j[1].axis_B);  // before R3 R4 R5
  const Vector3d axis1_before_hip2 = Rotate(
      j[3].axis_B, knee, Rotate(j[4].axis_B, ankle4, Rotate(j[5].axis_B, ankle5, axis1_seen)));
  const Turn hip2 = TurnFromTo(j[2].axis_B, axis1_before_hip2, j[1].axis_B);
  *q << hip0.angle(), hip1.angle(), hip2.angle(), knee.angle(), ankle4.angle(), ankle5.angle();
  return true;
}

Turn KneeTurn(const KneeTriangle& triangle, double cos_psi, int choice) {
  const double sin_psi = SideSign(choice) * std::sqrt((1 - cos_psi) * (1 + cos_psi));
  return Turn{cos_psi, sin_psi} * triangle.at_zero.Inverse();
}

}  // namespace

LegIkSolution SolveLegIk(const Leg& leg, const Isometry3d& X_BSole) {
  if (leg.closed_form()) return SolveLegIk(leg, X_BSole, leg.branch);
  HALFSTEP_CHECK(X_BSole.matrix().allFinite(), "X_BSole =\n" << X_BSole.matrix());
  const LegContinuation followed = ContinueLeg(leg, X_BSole);
  LegIkSolution solution;
  solution.reach_margin = -followed.missing;
  if (!followed.arrived) return solution;
  solution.status = LegIkStatus::kSolved;
  solution.q = followed.q;
  const double distance = LegLengthAt(leg, followed.q[3]).distance;
  solution.reach_margin = std::max(KneeTriangle(leg).farthest() - distance, 0.0);
  return solution;
}

LegIkSolution SolveLegIk(const Leg& leg, const Isometry3d& X_BSole, const LegBranch& branch) {
  HALFSTEP_CHECK(leg.closed_form(), leg.offsets);
  HALFSTEP_CHECK(X_BSole.matrix().allFinite(), "X_BSole =\n" << X_BSole.matrix());
  const Demand demand(leg, X_BSole);
  const KneeTriangle triangle(leg);
  const Reach reach = ReachOf(triangle, demand.hip_to_ankle);
  LegIkSolution solution;
  solution.reach_margin = reach.margin;
  if (!reach.reached) return solution;
  const Turn knee = KneeTurn(triangle, reach.cos_psi, branch.knee);
  solution.status = SolveGivenKnee(leg, demand, knee, branch, &solution.q)
                        ? LegIkStatus::kSolved
                        : LegIkStatus::kUnreachableOrientation;
  return solution;
}

std::vector<LegIkBranchSolution> SolveLegIkAll(const Leg& leg, const Isometry3d& X_BSole) {
  std::vector<LegIkBranchSolution> all;
  for (int choice = 0; choice < 8; ++choice) {
    const LegBranch branch{choice & 1, (choice >> 1) & 1, (choice >> 2) & 1};
    const LegIkSolution solution = SolveLegIk(leg, X_BSole, branch);
    if (solution.status == LegIkStatus::kSolved) all.push_back({branch, solution.q});
  }
  return all;
}

LegBranch LegBranchOf(const Leg& leg, const Vector6d& q) {
  HALFSTEP_CHECK(leg.closed_form(), leg.offsets);
  const auto& j = leg.joints;
  const Turn hip1 = Turn::FromAngle(q[1]), knee = Turn::FromAngle(q[3]),
             ankle4 = Turn::FromAngle(q[4]);
  const Vector3d hip_seen =
      RotateBack(j[3], knee, leg.hip_B - j[3].point_B) + j[3].point_B - leg.ankle_B;
  const Vector3d hip_between = RotateBack(j[4], ankle4, hip_seen);
  const Vector3d axis2_between = Rotate(j[1].axis_B, hip1, j[2].axis_B);
  return {.knee = ChoiceOf((knee * KneeTriangle(leg).at_zero).sin),
          .ankle = ChoiceOf(j[5].axis_B.cross(j[4].axis_B).dot(hip_between)),
          .hip = ChoiceOf(j[0].axis_B.cross(j[1].axis_B).dot(axis2_between))};
}

LegLength LegLengthAt(const Leg& leg, double knee) {
  const KneeTriangle triangle(leg);
  const Turn psi = Turn::FromAngle(knee) * triangle.at_zero;
  const double distance = std::sqrt(std::max(triangle.sum2 - 2 * triangle.product * psi.cos, 0.0));
  return {distance, distance > 0 ? triangle.product * psi.sin / distance : 0.0, triangle.product};
}

Matrix6d LegJacobian(const LegFrames& frames) {
  const Vector3d sole = frames.X_BLink[6].translation();
  Matrix6d J;
  for (size_t i = 0; i < 6; ++i) {
    J.col(static_cast<Eigen::Index>(i)) << frames.axis_B[i],
        frames.axis_B[i].cross(sole - frames.point_B[i]);
  }
  return J;
}

Matrix6d LegJacobian(const Leg& leg, const Vector6d& q) { return LegJacobian(PlaceLeg(leg, q)); }

bool InvertLegJacobian(const Leg& leg, const LegFrames& frames, Matrix6d* inverse) {
  const double length = KneeTriangle(leg).farthest();
  if (!leg.closed_form()) {
    const Eigen::PartialPivLU<Matrix6d> lu(LegJacobian(frames));
    if (!(std::abs(lu.determinant()) > 1e-7 * length * length * length)) return false;
    *inverse = lu.inverse();
    return true;
  }
  Eigen::Matrix3d A, B, C;
  for (size_t i = 0; i < 3; ++i) {
    const Eigen::Index column = static_cast<Eigen::Index>(i);
    A.col(column) = frames.axis_B[i];
    B.col(column) = frames.axis_B[i + 3];
    C.col(column) = frames.axis_B[i + 3].cross(leg.hip_B - frames.point_B[i + 3]);
  }
  if (!(std::abs(A.determinant() * C.determinant()) > 1e-7 * length * length * length)) {
    return false;
  }
  // The sole's twist (ω, v) has the velocity v + ω × (hip − sole) at the hip.
  const Vector3d lever = leg.hip_B - frames.X_BLink[6].translation();
  Eigen::Matrix3d cross;
  cross << 0, lever.z(), -lever.y(),  //
      -lever.z(), 0, lever.x(),       //
      lever.y(), -lever.x(), 0;
  const Eigen::Matrix3d A_inverse = A.inverse(), C_inverse = C.inverse();
  const Eigen::Matrix3d hip = -A_inverse * B * C_inverse;
  inverse->topLeftCorner<3, 3>() = A_inverse + hip * cross;
  inverse->topRightCorner<3, 3>() = hip;
  inverse->bottomLeftCorner<3, 3>() = C_inverse * cross;
  inverse->bottomRightCorner<3, 3>() = C_inverse;
  return true;
}

bool LegIkDerivative(const Leg& leg, const Vector6d& q, const Isometry3d& X_WB,
                     const Isometry3d& X_WSole, Eigen::Matrix<double, 6, 8>* dq) {
  Matrix6d inverse;
  if (!InvertLegJacobian(leg, PlaceLeg(leg, q), &inverse)) return false;
  // Twists of the sole relative to the waist, in B, for a sole that moves along x, y, z and yaws.
  const Eigen::Matrix3d R_BW = X_WB.linear().transpose();
  Eigen::Matrix<double, 6, 4> twists;
  twists << Eigen::Matrix3d::Zero(), R_BW.col(2), R_BW, Vector3d::Zero();
  const Eigen::Matrix<double, 6, 4> of_sole = inverse * twists;
  // Moving the waist is moving the sole the other way; a yaw of the waist also carries it around.
  const Vector3d lever = X_WSole.translation() - X_WB.translation();
  const Vector3d carried = Vector3d::UnitZ().cross(lever);
  dq->leftCols<3>() = -of_sole.leftCols<3>();
  dq->col(3) = -of_sole.col(3) - of_sole.leftCols<3>() * carried;
  dq->rightCols<4>() = of_sole;
  return true;
}

}  // namespace halfstep
