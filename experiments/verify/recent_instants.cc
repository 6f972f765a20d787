#include "experiments/verify/recent_instants.h"

#include <algorithm>

namespace halfstep::verify {

RecentInstants::Instant& RecentInstants::Of(double t) {
  const auto found = std::ranges::find(instants_, t, &Instant::t);
  if (found != instants_.end()) return *found;
  Instant& taken = instants_[oldest_];
  oldest_ = (oldest_ + 1) % instants_.size();
  taken = {};
  taken.t = t;
  return taken;
}

const PlayedRow& RecentInstants::Row(double t) {
  Instant& at = Of(t);
  if (!at.row) at.row = walk_.Row(t);
  return *at.row;
}

const WalkDynamics& RecentInstants::Dynamics(double t) {
  Instant& at = Of(t);
  if (!at.dynamics) at.dynamics = walk_.DynamicsAt(t);
  return *at.dynamics;
}

const std::array<Vector6d, 2>& RecentInstants::JointSpeeds(double t) {
  Instant& at = Of(t);
  if (!at.speeds) at.speeds = walk_.JointSpeeds(t);
  return *at.speeds;
}

}  // namespace halfstep::verify
