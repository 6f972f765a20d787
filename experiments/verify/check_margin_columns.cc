#include "experiments/verify/check_margin_columns.h"

#include <algorithm>
#include <cmath>

#include "experiments/verify/check_rows.h"
#include "experiments/verify/joint_accelerations.h"
#include "experiments/verify/tolerances.h"

namespace halfstep::verify {
namespace {

// Distances beyond this are not told apart, or beyond twice what is demanded [m].
// Source: smoothing/README.md, "Margins".
constexpr double kCap = 0.3;

double JointSpeedMarginAt(const DescribedWalk& walk, double t, double scale) {
  const std::array<Vector6d, 2> speeds = walk.JointSpeeds(t);
  double least = kNoLimit;
  for (size_t s = 0; s < 2; ++s) {
    for (size_t j = 0; j < 6; ++j) {
      const double limit = scale * walk.robot().legs[s].joints[j].max_speed;
      least = std::min(least, limit - std::abs(speeds[s][static_cast<Eigen::Index>(j)]));
    }
  }
  return least;
}

// Of the foot in the air; +∞ when none is.
double FootSpeedMarginAt(const DescribedWalk& walk, const PlayedRow& row,
                         const std::optional<double>& limit) {
  if (row.support == Support::kBoth || !limit) return kNoLimit;
  const int foot = SoleX(row.support == Support::kLeft ? 1 : 0);
  return *limit - walk.At(row.t).first.segment<3>(foot).norm();
}

bool Same(double found, double stated, double tolerance) {
  return found == stated || std::abs(found - stated) <= tolerance;  // both may be infinite
}

}  // namespace

std::array<double, kNumMarginColumns> MarginsAt(const DescribedWalk& walk, const PlayedRow& row,
                                                const CertificateText& certificate, double cap,
                                                Distances* distances) {
  double joint = kNoLimit;
  for (int side = 0; side < 2; ++side) {
    for (int j = 0; j < 6; ++j) joint = std::min(joint, JointMargin(walk.robot(), row, side, j));
  }
  const Placement at = PlaceRobot(walk.robot(), row);
  const WalkDynamics dynamics = walk.DynamicsAt(row.t);
  return {ZmpMargin(row, walk.robot()),
          joint,
          JointSpeedMarginAt(walk, row.t, certificate.joint_speed_scale),
          FootSpeedMarginAt(walk, row, certificate.foot_speed),
          distances->NearestObstacle(at, row.t, cap),
          distances->NearestPair(at, cap),
          dynamics.zmp,
          dynamics.LeastTorqueMargin(walk.robot()),
          distances->scene().friction - dynamics.friction,
          LeastJointAccelerationMargin(walk, row.t)};
}

void CheckMarginColumns(const std::vector<PlayedRow>& rows, const DescribedWalk& walk,
                        const CertificateText& certificate, Distances* distances,
                        Findings* findings) {
  const Tolerances near(walk.robot());
  const std::array<double, kNumMarginColumns> tolerances = {
      near.column, near.column,   near.joint_speed, near.column,   near.slab,
      near.slab,   near.momentum, near.torque,      near.friction, near.acceleration};
  const double cap = std::max(
      {kCap, 2 * certificate.demanded[kClearance], 2 * certificate.demanded[kSelfClearance]});
  const size_t columns = NumMarginColumns(walk.robot());
  std::array<Faults, kNumMarginColumns> faults;
  for (size_t i = 0; i < rows.size(); ++i) {
    // Whatever is farther than both columns say need not be asked.
    const double stated = std::max(rows[i].margins[4], rows[i].margins[5]);
    const double enough = stated < cap ? std::min(cap, stated + 2 * near.slab) : cap;
    const auto found = MarginsAt(walk, rows[i], certificate, enough, distances);
    for (size_t k = 0; k < columns; ++k) {
      if (Same(found[k], rows[i].margins[k], tolerances[k])) continue;
      faults[k].Add(Formatted("trajectory.csv:%zu: %s is %.9g, but %.9g by the walk", i + 2,
                              kMarginColumns[k], rows[i].margins[k], found[k]));
    }
  }
  for (const Faults& of_column : faults) of_column.Conclude(findings);
  findings->Say("margin columns: " + Count(std::ssize(rows) * static_cast<long>(columns)) +
                " values computed again");
}

}  // namespace halfstep::verify
