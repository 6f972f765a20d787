#include "smoothing/margins/joint_speed_margin.h"

#include <cmath>

#include "wpg/nth.h"

namespace halfstep {

int JointSpeedMargin::count() const { return 12; }

std::string JointSpeedMargin::Subject(const Margin& margin) const {
  return JointName(place_.robot, margin);
}

Margin JointSpeedMargin::Least(Instant* at, double) const {
  if (!at->regular()) return Of(-kUnlimited, -1);
  Margin least = Of(kUnlimited, -1);
  for (int s = 0; s < 2; ++s) {
    for (int j = 0; j < 6; ++j) {
      const LegJoint& joint = Nth(Nth(place_.robot.legs, s).joints, j);
      const double speed = std::abs(Nth(at->posture().speeds, s)[j]);
      Lower(Of(at->limits().joint_speed_scale * joint.max_speed - speed, 6 * s + j), &least);
    }
  }
  return least;
}

void JointSpeedMargin::AddRows(Instant* at, SlackSink* rows) const {
  if (!at->regular()) return;
  for (size_t s = 0; s < 2; ++s) {
    for (int j = 0; j < 6; ++j) {
      const LegJoint& joint = Nth(place_.robot.legs[s].joints, j);
      const double limit = at->limits().joint_speed_scale * joint.max_speed;
      const double speed = at->posture().speeds[s][j];
      const double sign = speed < 0.0 ? -1.0 : 1.0;
      rows->Add(limit - std::abs(speed),
                [&](size_t i) { return -sign * rows->tangents[i].speeds[s][j]; });
    }
  }
}

void JointSpeedMargin::AddBounds(const MarginInterval& interval,
                                 TightestStatement* tightest) const {
  const IntervalMotion& motion = interval.motion;
  for (int s = 0; s < 2; ++s) {
    const size_t i = static_cast<size_t>(s);
    for (int j = 0; j < 6; ++j) {
      const LegJoint& joint = Nth(place_.robot.legs[i].joints, j);
      const double limit = interval.mid.limits().joint_speed_scale * joint.max_speed;
      tightest->Add(Of(limit - std::abs(motion.posture.speeds[i][j]), 6 * s + j),
                    motion.half_width * motion.joints[i].acceleration[j] + interval.mid.rounding());
    }
  }
}

}  // namespace halfstep
