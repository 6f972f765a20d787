#include "smoothing/margins/joint_acceleration_margin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "wpg/motion/dynamics_slope.h"
#include "wpg/nth.h"
#include "wpg/robot/acceleration_limits.h"

namespace halfstep {
namespace {

int AccelerationSubject(Side side, Eigen::Index joint) {
  return 6 * Index(side) + static_cast<int>(joint);
}

// ∂q̈/∂parameter of both legs by Index(Side), along each parameter.
std::vector<std::array<Vector6d, 2>> AccelerationSlopes(Instant* at, const SlackSink& rows) {
  std::vector<std::array<Vector6d, 2>> slopes;
  for (size_t i = 0; i < rows.sensitivities.size(); ++i) {
    const PostureTangent& tangent = rows.tangents[i];
    const DynamicsSlope slope(at->robot(), at->jet(), at->posture(), *at->motion(),
                              {rows.sensitivities[i].jet, tangent.q, tangent.speeds});
    slopes.push_back({slope.accelerations(Side::kLeft), slope.accelerations(Side::kRight)});
  }
  return slopes;
}

}  // namespace

JointAccelerationMargin::JointAccelerationMargin(const MarginPlace& place)
    : WholeFamily(kTraits), place_(place), present_(StatesAccelerationLimits(place.robot)) {}

std::string JointAccelerationMargin::Subject(const Margin& margin) const {
  return JointName(place_.robot, margin);
}

double JointAccelerationMargin::Limit(Side side, Eigen::Index joint) const {
  return Nth(Nth(place_.robot.legs, Index(side)).joints, joint).max_acceleration;
}

Margin JointAccelerationMargin::Least(Instant* at, double) const {
  if (!present_) return Of(kUnlimited, -1);
  const RobotDynamics* motion = at->motion();
  if (motion == nullptr) return Of(-kUnlimited, -1);
  Margin least = Of(kUnlimited, -1);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Vector6d& accelerations = motion->accelerations(side);
    for (Eigen::Index j = 0; j < 6; ++j) {
      Lower(Of(Limit(side, j) - std::abs(accelerations[j]), AccelerationSubject(side, j)), &least);
    }
  }
  return least;
}

void JointAccelerationMargin::AddRows(Instant* at, SlackSink* rows) const {
  if (!present_ || at->demanded(family()) == kNotDemanded) return;
  const RobotDynamics* motion = at->motion();
  if (motion == nullptr) return;
  std::vector<std::array<Vector6d, 2>> slopes;  // made when a row needs them
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Vector6d& accelerations = motion->accelerations(side);
    for (Eigen::Index j = 0; j < 6; ++j) {
      const double sign = accelerations[j] < 0.0 ? -1.0 : 1.0;
      rows->Add(Limit(side, j) - std::abs(accelerations[j]), [&](size_t i) {
        if (slopes.empty()) slopes = AccelerationSlopes(at, *rows);
        return -sign * Nth(slopes[i], Index(side))[j];
      });
    }
  }
}

void JointAccelerationMargin::AddBounds(const MarginInterval& interval,
                                        TightestStatement* tightest) const {
  Instant& mid = interval.mid;
  if (mid.demanded(family()) == kNotDemanded) {
    for (int i = 0; i < count(); ++i) tightest->Add(Of(kUnlimited, i), 0.0);
    return;
  }
  const Margin least = Least(&mid, kUnlimited);
  if (!(least.value >= mid.demanded(family()))) {  // no bound changes that
    tightest->Add(least, 0.0);
    return;
  }
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t s = static_cast<size_t>(Index(side));
    const Vector6d& accelerations = mid.motion()->accelerations(side);
    for (Eigen::Index j = 0; j < 6; ++j) {
      const double here = std::abs(accelerations[j]);
      const double drift = Nth(interval.drift().legs[s].joints, j).acceleration_drift;
      // |q̈| grows by no more than q̈ drifts, and to no more than it can be.
      const double rise = interval.motion.joints[s].acceleration[j] - here;
      tightest->Add(Of(Limit(side, j) - here, AccelerationSubject(side, j)),
                    std::max(0.0, std::min(drift, rise)) + place_.rounding.acceleration);
    }
  }
}

}  // namespace halfstep
