#pragma once

#include <vector>

#include "experiments/replay/simulation.h"
#include "experiments/tables/trajectory_file.h"

namespace halfstep::replay {

/// The motion that the servos shall follow, made from the rows of a trajectory: cubic between rows,
/// with the slopes of central differences, at rest before the first and after the last.
class ReferenceMotion {
 public:
  /// Precondition: at least two rows, times that increase.
  explicit ReferenceMotion(std::vector<TrajectoryRow> rows);

  const std::vector<TrajectoryRow>& rows() const { return rows_; }  ///< of the file
  double end() const { return rows_.back().t; }                     ///< of the last row [s]
  JointTargets TargetsAt(double t) const;                           ///< between rows, at t [s]
  /// Planned ZMP, waist and soles, linear between rows; support of the earlier row.
  TrajectoryRow RowAt(double t) const;
  /// Whether the two rows about t are the same posture at the same place; true before the first row
  /// and after the last.
  bool RestsAt(double t) const;

 private:
  // The row i with t_i ≤ t < t_{i+1}, the last but one at the end.
  size_t Find(double t) const;

  std::vector<TrajectoryRow> rows_;
  std::vector<std::array<Vector6d, 2>> speeds_;
};

}  // namespace halfstep::replay
