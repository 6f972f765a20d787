#include "smoothing/margins/reach_margin.h"

#include <algorithm>
#include <limits>

#include "wpg/nth.h"

namespace halfstep {

int ReachMargin::count() const { return 2; }

std::string ReachMargin::Subject(const Margin& margin) const {
  return margin.subject < 6 ? "left leg" : "right leg";
}

Margin ReachMargin::Least(Instant* at, double) const {
  Margin least = Of(std::numeric_limits<double>::infinity(), -1);
  for (int s = 0; s < 2; ++s) {
    Lower(Of(Nth(at->posture().ik, s).reach_margin, 6 * s + 3), &least);
  }
  return least;
}

void ReachMargin::AddRows(Instant* at, SlackSink* rows) const {
  const Posture& posture = at->posture();
  if (!at->regular()) {
    // Out of reach, or stretched: how far is all that is known.
    const double reach = std::min(posture.ik[0].reach_margin, posture.ik[1].reach_margin);
    rows->Add(std::min(reach, 0.0) - 1e-3, [](size_t) { return 0.0; });
    return;
  }
  for (size_t s = 0; s < 2; ++s) {
    const Leg& leg = at->robot().legs[s];
    if (!leg.closed_form()) {
      const double slope = LegLengthAt(leg, posture.ik[s].q[3]).slope;
      rows->Add(posture.ik[s].reach_margin,
                [&](size_t i) { return -slope * rows->tangents[i].q[s][3]; });
      continue;
    }
    const Eigen::Vector3d hip_to_ankle =
        posture.frames[s].X_BLink[5] * (leg.joints[5].X_BLink.inverse() * leg.ankle_B) - leg.hip_B;
    const Eigen::Vector3d along = hip_to_ankle.normalized();
    const Eigen::Vector3d ankle_from_sole =
        hip_to_ankle + leg.hip_B - posture.frames[s].X_BLink[6].translation();
    rows->Add(posture.ik[s].reach_margin, [&](size_t i) {
      const PostureTangent& t = rows->tangents[i];
      const double turn =
          rows->sensitivities[i].jet.value[FootIndex(static_cast<Side>(s)) + 3] - t.waist_yaw;
      return -along.dot(t.sole_B[s] + turn * Eigen::Vector3d::UnitZ().cross(ankle_from_sole));
    });
  }
}

void ReachMargin::AddBounds(const MarginInterval& interval, TightestStatement* tightest) const {
  for (int s = 0; s < 2; ++s) {
    const size_t i = static_cast<size_t>(s);
    tightest->Add(Of(interval.motion.posture.ik[i].reach_margin, 6 * s + 3),
                  interval.motion.leg_length_change[i] + interval.mid.rounding());
  }
}

}  // namespace halfstep
