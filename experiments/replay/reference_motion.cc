#include "experiments/replay/reference_motion.h"

#include <algorithm>

namespace halfstep::replay {

ReferenceMotion::ReferenceMotion(std::vector<TrajectoryRow> rows) : rows_(std::move(rows)) {
  speeds_.resize(rows_.size());
  for (size_t side = 0; side < 2; ++side) {
    speeds_.front()[side] = speeds_.back()[side] = Vector6d::Zero();
    for (size_t i = 1; i + 1 < rows_.size(); ++i) {
      const TrajectoryRow &before = rows_[i - 1], &after = rows_[i + 1];
      speeds_[i][side] = (after.q[side] - before.q[side]) / (after.t - before.t);
    }
  }
}

size_t ReferenceMotion::Find(double t) const {
  const auto after = std::upper_bound(rows_.begin(), rows_.end(), t,
                                      [](double x, const TrajectoryRow& row) { return x < row.t; });
  const auto index = static_cast<size_t>(after - rows_.begin());
  return std::clamp<size_t>(index, 1, rows_.size() - 1) - 1;
}

JointTargets ReferenceMotion::TargetsAt(double t) const {
  const size_t i = Find(t);
  const TrajectoryRow &a = rows_[i], &b = rows_[i + 1];
  const double h = b.t - a.t, x = std::clamp((t - a.t) / h, 0.0, 1.0);
  JointTargets targets;
  for (size_t side = 0; side < 2; ++side) {
    const Vector6d va = h * speeds_[i][side], vb = h * speeds_[i + 1][side];
    const Vector6d rise = b.q[side] - a.q[side];
    // a + va x + c x² + d x³ with both values and slopes.
    const Vector6d c = 3 * rise - 2 * va - vb, d = va + vb - 2 * rise;
    targets.q[side] = a.q[side] + x * (va + x * (c + x * d));
    targets.speed[side] = (va + x * (2 * c + 3 * x * d)) / h;
  }
  return targets;
}

bool ReferenceMotion::RestsAt(double t) const {
  constexpr double kSame = 1e-9;  // [rad], [m]
  if (t < rows_.front().t || t >= end()) return true;
  const size_t i = Find(t);
  const TrajectoryRow &a = rows_[i], &b = rows_[i + 1];
  return (a.waist - b.waist).isZero(kSame) && (a.q[0] - b.q[0]).isZero(kSame) &&
         (a.q[1] - b.q[1]).isZero(kSame);
}

TrajectoryRow ReferenceMotion::RowAt(double t) const {
  const size_t i = Find(t);
  const TrajectoryRow &a = rows_[i], &b = rows_[i + 1];
  const double x = std::clamp((t - a.t) / (b.t - a.t), 0.0, 1.0);
  TrajectoryRow row = x < 1.0 ? a : b;
  row.t = t;
  row.zmp = a.zmp + x * (b.zmp - a.zmp);
  row.zmp_z = a.zmp_z + x * (b.zmp_z - a.zmp_z);
  row.waist = a.waist + x * (b.waist - a.waist);
  for (size_t side = 0; side < 2; ++side) {
    row.soles[side] = a.soles[side] + x * (b.soles[side] - a.soles[side]);
  }
  return row;
}

}  // namespace halfstep::replay
