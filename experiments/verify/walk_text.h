#pragma once

#include <optional>
#include <string>
#include <vector>

#include "halfstep/wpg/motion/half_step_sequence.h"

namespace halfstep::verify {

/// A row of half_steps.csv.
struct HalfStepRow {
  std::string kind, support;                         ///< up or down; left or right
  double start = 0, duration = 0, height_scale = 0;  ///< [s], [s], 1
  double support_point = 0;                          ///< [m]
};

/// A row of overlaps.csv; its columns about what was allowed, what holds the overlap and what that
/// costs are not read: no statement is about them.
struct OverlapRow {
  std::string kind;    ///< up_down or down_up
  double overlap = 0;  ///< [s]
  double duration_before = 0, duration_after = 0, scale_before = 0, scale_after = 0;
};

/// A row of footsteps.csv.
struct FootstepRow {
  int footstep = 0;  ///< 0: a foot at the start
  std::string foot;  ///< left or right
  Pose2 X_WF;
  double via_height = 0, duration = 0;  ///< [m], [s]
};

/// A row of summary.csv.
struct SummaryRow {
  std::string method, status, worst_family;
  bool certified = false;
  double duration = 0, speedup = 0, cost = 0, worst_margin = 0;
  long iterations = 0;
  std::optional<double> gap_to_reference;
};

/// Each throws InputError for a text that is no such table.
std::vector<HalfStepRow> ReadHalfSteps(const std::string& path, const std::string& text);
std::vector<OverlapRow> ReadOverlaps(const std::string& path, const std::string& text);
std::vector<FootstepRow> ReadFootsteps(const std::string& path, const std::string& text);
std::vector<SummaryRow> ReadSummary(const std::string& path, const std::string& text);

}  // namespace halfstep::verify
