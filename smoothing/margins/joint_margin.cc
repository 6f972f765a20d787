#include "smoothing/margins/joint_margin.h"

#include <algorithm>
#include <cmath>

#include "wpg/nth.h"

namespace halfstep {

int JointMargin::count() const { return 12; }

std::string JointMargin::Subject(const Margin& margin) const {
  return JointName(place_.robot, margin);
}

Margin JointMargin::Least(Instant* at, double) const {
  Margin least = Of(kUnlimited, -1);
  for (int s = 0; s < 2; ++s) {
    const Leg& leg = Nth(place_.robot.legs, s);
    const LegIkSolution& ik = Nth(at->posture().ik, s);
    if (ik.status != LegIkStatus::kSolved) {
      Lower(Of(-kUnlimited, 6 * s + 3), &least);
      continue;
    }
    for (int j = 0; j < 6; ++j) {
      const LegJoint& joint = Nth(leg.joints, j);
      Lower(Of(std::min(ik.q[j] - joint.lower, joint.upper - ik.q[j]), 6 * s + j), &least);
    }
  }
  return least;
}

void JointMargin::AddRows(Instant* at, SlackSink* rows) const {
  if (!at->regular()) return;
  for (size_t s = 0; s < 2; ++s) {
    for (int j = 0; j < 6; ++j) {
      const LegJoint& joint = Nth(place_.robot.legs[s].joints, j);
      const double q = at->posture().ik[s].q[j];
      rows->Add(q - joint.lower, [&](size_t i) { return rows->tangents[i].q[s][j]; });
      rows->Add(joint.upper - q, [&](size_t i) { return -rows->tangents[i].q[s][j]; });
    }
  }
}

void JointMargin::AddBounds(const MarginInterval& interval, TightestStatement* tightest) const {
  const IntervalMotion& motion = interval.motion;
  const double h = motion.half_width;
  for (int s = 0; s < 2; ++s) {
    const size_t i = static_cast<size_t>(s);
    const Vector6d& speed = motion.posture.speeds[i];
    const Vector6d& acceleration = motion.joints[i].acceleration;
    for (int j = 0; j < 6; ++j) {
      const LegJoint& joint = Nth(place_.robot.legs[i].joints, j);
      const double q = motion.posture.ik[i].q[j];
      tightest->Add(Of(std::min(q - joint.lower, joint.upper - q), 6 * s + j),
                    h * (std::abs(speed[j]) + 0.5 * h * acceleration[j]) + interval.mid.rounding());
    }
  }
}

}  // namespace halfstep
