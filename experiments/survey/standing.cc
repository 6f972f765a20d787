#include "experiments/survey/standing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "wpg/files/text.h"
#include "wpg/robot/leg_ik.h"
#include "wpg/robot/robot_legs.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

// Turns angles by whole turns into the limits where that is possible.
bool FitLimits(const Leg& leg, Vector6d* q) {
  bool fits = true;
  for (size_t i = 0; i < 6; ++i) {
    double& angle = (*q)[static_cast<Eigen::Index>(i)];
    const LegJoint& joint = leg.joints[i];
    if (angle < joint.lower) angle += 2 * std::numbers::pi;
    if (angle > joint.upper) angle -= 2 * std::numbers::pi;
    fits = fits && angle >= joint.lower && angle <= joint.upper;
  }
  return fits;
}

// How far the knee axis is ahead of the middle of hip and ankle [m].
double KneeAhead(const Leg& leg, const Vector6d& q) {
  const LegFrames frames = PlaceLeg(leg, q);
  const Vector3d ankle = frames.X_BLink[6] * (leg.X_BSole.inverse() * leg.ankle_B);
  const Vector3d middle = 0.5 * (leg.hip_B + ankle);
  const Vector3d off = frames.point_B[3] - middle;
  return (off - off.dot(frames.axis_B[3]) * frames.axis_B[3]).x();
}

// The closed form takes hip and ankle axes for axes that meet. Where they do not, the sole is level
// but elsewhere: asked for as much elsewhere the other way, a few times, it comes to its place.
std::optional<Vector6d> AtItsPlace(const Leg& leg, const Eigen::Isometry3d& X_BSole,
                                   const LegIkBranchSolution& near) {
  constexpr double kNear = 1e-9;  // [m]
  Vector6d q = near.q;
  Eigen::Isometry3d asked = X_BSole;
  for (int round = 0; round < 50; ++round) {
    const Vector3d off = X_BSole.translation() - PlaceLeg(leg, q).X_BLink[6].translation();
    if (off.norm() < kNear) return q;
    asked.translation() += off;
    const LegIkSolution solution = SolveLegIk(leg, asked, near.branch);
    if (solution.status != LegIkStatus::kSolved) return std::nullopt;
    q = solution.q;
    if (!FitLimits(leg, &q)) return std::nullopt;
  }
  return std::nullopt;
}

Eigen::Isometry3d SolePlace(Side side, const StandingRequest& request, double z) {
  Eigen::Isometry3d X_BSole = Eigen::Isometry3d::Identity();
  X_BSole.translation() = Vector3d(request.x, Sign(side) * 0.5 * request.width, z);
  return X_BSole;
}

}  // namespace

std::optional<double> StandingHeight(const Leg& leg, Side side, const StandingRequest& request) {
  const Vector3d ankle_S = leg.X_BSole.inverse() * leg.ankle_B;
  const Vector3d across = SolePlace(side, request, 0.0) * ankle_S - leg.hip_B;
  const double reach = request.bend * StretchedLength(leg);
  const double height = reach * reach - across.head<2>().squaredNorm();
  if (height <= 0) return std::nullopt;
  return leg.hip_B.z() - ankle_S.z() - std::sqrt(height);
}

std::optional<Vector6d> FindStanding(const Leg& leg, Side side, const StandingRequest& request,
                                     double z) {
  const Eigen::Isometry3d X_BSole = SolePlace(side, request, z);
  std::optional<LegIkBranchSolution> best;
  double farthest = -std::numeric_limits<double>::infinity();
  for (LegIkBranchSolution& solution : SolveLegIkAll(leg, X_BSole)) {
    if (!FitLimits(leg, &solution.q)) continue;
    const double ahead = KneeAhead(leg, solution.q);
    // Of two that turn hip or ankle round, the one that turns less.
    const double value = ahead - 1e-3 * solution.q.norm();
    if (value > farthest) {
      farthest = value;
      best = solution;
    }
  }
  if (!best) return std::nullopt;
  return AtItsPlace(leg, X_BSole, *best);
}

std::string JointInTheWay(const Leg& leg, Side side, const StandingRequest& request, double z) {
  double least = std::numeric_limits<double>::infinity();
  std::string said;
  for (LegIkBranchSolution& solution : SolveLegIkAll(leg, SolePlace(side, request, z))) {
    FitLimits(leg, &solution.q);
    double lacking = 0.0, most = 0.0;
    std::string worst;
    for (size_t i = 0; i < 6; ++i) {
      const LegJoint& joint = leg.joints[i];
      const double q = solution.q[static_cast<Eigen::Index>(i)];
      const double beyond = std::max(joint.lower - q, q - joint.upper);
      lacking += std::max(beyond, 0.0);
      if (beyond <= most) continue;
      most = beyond;
      constexpr double kDegree = std::numbers::pi / 180.0;
      worst = joint.name + Formatted(" would be at %.1f deg, its limits are %.1f and %.1f deg",
                                     q / kDegree, joint.lower / kDegree, joint.upper / kDegree);
    }
    if (lacking >= least) continue;
    least = lacking;
    said = worst;
  }
  return said;
}

double NarrowestStance(const std::array<Leg, 2>& legs, const std::array<FoundSole, 2>& soles,
                       const std::vector<RobotBody>& bodies, double gap) {
  double width = 0.0;
  for (size_t side = 0; side < 2; ++side) {
    const Eigen::Isometry3d X_BSole = legs[side].joints[5].X_BLink * soles[side].X_FootSole;
    const double sign = side == 0 ? 1.0 : -1.0;
    width = std::max(width, 2 * sign * X_BSole.translation().y());
    double inner = 0.5 * soles[side].size.y();
    const Vector3d inwards = soles[side].X_FootSole.linear() * Vector3d(0, -sign, 0);
    for (const RobotBody& body : bodies) {
      if (body.leg != static_cast<int>(side) || body.link != 5) continue;
      inner = std::max(
          inner, Support(body.shape, inwards) - inwards.dot(soles[side].X_FootSole.translation()));
    }
    width = std::max(width, 2 * inner + gap);
  }
  return width;
}

}  // namespace halfstep
