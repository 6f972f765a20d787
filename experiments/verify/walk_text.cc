#include "experiments/verify/walk_text.h"

#include <algorithm>

#include "experiments/verify/csv_text.h"
#include "wpg/files/input_error.h"

namespace halfstep::verify {
namespace {

constexpr std::string_view kReplayColumns = ",stands,replay_tilt_rad";

}  // namespace

std::vector<HalfStepRow> ReadHalfSteps(const std::string& path, const std::string& text) {
  int first = 0;
  std::vector<HalfStepRow> rows = ReadHalfStepsFrom(path, text, &first);
  if (!rows.empty() && first != 0) throw InputError({path + ":2: does not begin with half-step 1"});
  return rows;
}

std::vector<HalfStepRow> ReadHalfStepsFrom(const std::string& path, const std::string& text,
                                           int* begin) {
  std::vector<std::string> columns = {"half_step",  "kind",         "support",        "start_s",
                                      "duration_s", "height_scale", "support_point_m"};
  const std::string head = text.substr(0, text.find('\n'));
  const bool has_rise = head.ends_with("," + std::string(kRiseColumns.back().column));
  const bool has_footsteps = has_rise || head.ends_with(",footstep_yaw_rad");
  const bool has_forms =
      has_footsteps || head.ends_with("," + std::string(kFormColumns.back().column));
  const size_t first = columns.size();
  if (has_forms) {
    for (const FormColumn& one : kFormColumns) columns.emplace_back(one.column);
  }
  if (has_footsteps) {
    columns.insert(columns.end(), {"footstep_x_m", "footstep_y_m", "footstep_yaw_rad"});
  }
  if (has_rise) {
    for (const FormColumn& one : kRiseColumns) columns.emplace_back(one.column);
  }
  const CsvText csv(path, text, columns);
  std::vector<HalfStepRow> rows;
  for (size_t i = 0; i < csv.size(); ++i) {
    if (i == 0) *begin = csv.Positive(0, 0) - 1;
    csv.CheckFirst(i, *begin + static_cast<int>(i) + 1);
    rows.push_back({.kind = csv.Word(i, 1, {"up", "down"}),
                    .support = csv.Word(i, 2, {"left", "right"}),
                    .start = csv.Number(i, 3),
                    .duration = csv.Number(i, 4),
                    .height_scale = csv.Number(i, 5),
                    .support_point = csv.Number(i, 6)});
    if (!has_forms) continue;
    FormColumns& form = rows.back().form.emplace();
    for (size_t k = 0; k < kFormColumns.size(); ++k)
      form.*kFormColumns[k].value = csv.Number(i, first + k);
    if (!has_footsteps) continue;
    const size_t moves = first + kFormColumns.size();
    form.footstep = {csv.Number(i, moves), csv.Number(i, moves + 1), csv.Number(i, moves + 2)};
    rows.back().has_rise = has_rise;
    for (size_t k = 0; has_rise && k < kRiseColumns.size(); ++k)
      form.*kRiseColumns[k].value = csv.Number(i, moves + 3 + k);
  }
  return rows;
}

std::vector<OverlapRow> ReadOverlaps(const std::string& path, const std::string& text) {
  const CsvText csv(
      path, text,
      {"junction", "kind", "overlap_s", "upper_bound_s", "limited_by", "limited_by_family",
       "limited_by_scale", "price_s", "multiplier_s", "duration_before_s", "duration_after_s",
       "height_scale_before", "height_scale_after"});
  std::vector<OverlapRow> rows;
  for (size_t i = 0; i < csv.size(); ++i) {
    csv.CheckFirst(i, static_cast<int>(i) + 1);
    rows.push_back({.kind = csv.Word(i, 1, {"up_down", "down_up"}),
                    .overlap = csv.Number(i, 2),
                    .duration_before = csv.Number(i, 9),
                    .duration_after = csv.Number(i, 10),
                    .scale_before = csv.Number(i, 11),
                    .scale_after = csv.Number(i, 12),
                    .upper_bound = csv.Number(i, 3)});
  }
  return rows;
}

std::vector<double> ReadOverlapsOfEpisode(const std::string& path, const std::string& text,
                                          int first) {
  const CsvText csv(path, text, {"junction", "overlap_s"});
  std::vector<double> overlaps;
  for (size_t i = 0; i < csv.size(); ++i) {
    csv.CheckFirst(i, std::max(first, 1) + static_cast<int>(i));
    overlaps.push_back(csv.Number(i, 1));
  }
  return overlaps;
}

std::vector<FootstepRow> ReadFootsteps(const std::string& path, const std::string& text) {
  return ReadFootstepsAfter(path, text, 0);
}

std::vector<FootstepRow> ReadFootstepsAfter(const std::string& path, const std::string& text,
                                            int before) {
  std::vector<std::string> columns = {"footstep", "foot",         "x_m",       "y_m",
                                      "yaw_rad",  "via_height_m", "duration_s"};
  // Where soles stand at heights.
  const bool has_heights = text.substr(0, text.find('\n')).find(",z_m,") != std::string::npos;
  const size_t yaw = has_heights ? 5 : 4;
  if (has_heights) columns.insert(columns.begin() + 4, "z_m");
  // Where a plan rests between half-steps.
  const bool has_rests = text.substr(0, text.find('\n')).find(",rest_s,") != std::string::npos;
  if (has_rests) columns.insert(columns.end(), {"rest_s", "rest_on_one_foot_s"});
  // Where the waist changes its height.
  const bool has_crouches = text.substr(0, text.find('\n')).ends_with(",crouch_m");
  if (has_crouches) columns.emplace_back("crouch_m");
  const CsvText csv(path, text, columns);
  std::vector<FootstepRow> rows;
  for (size_t i = 0; i < csv.size(); ++i) {
    const int footstep = i < 2 ? 0 : before + static_cast<int>(i) - 1;
    csv.CheckFirst(i, footstep);
    rows.push_back({.footstep = footstep,
                    .foot = csv.Word(i, 1, {"left", "right"}),
                    .X_WF = {csv.Number(i, 2), csv.Number(i, 3), csv.Number(i, yaw)},
                    .z = has_heights ? csv.Number(i, 4) : 0.0,
                    .via_height = csv.Number(i, yaw + 1),
                    .duration = csv.Number(i, yaw + 2),
                    .rest = has_rests ? csv.Number(i, yaw + 3) : 0.0,
                    .rest_on_one = has_rests ? csv.Number(i, yaw + 4) : 0.0});
    if (has_crouches) rows.back().crouch = csv.Number(i, columns.size() - 1);
  }
  return rows;
}

std::vector<SummaryRow> ReadSummary(const std::string& path, const std::string& text) {
  std::vector<std::string> columns = {"method",     "status",  "certified",    "duration_s",
                                      "speedup",    "cost",    "worst_margin", "worst_margin_name",
                                      "iterations", "instants"};
  std::string head = text.substr(0, text.find('\n'));
  const bool has_replay = head.ends_with(kReplayColumns);  // what a simulation did: not examined
  if (has_replay) head.resize(head.size() - kReplayColumns.size());
  const bool has_effort = head.find(",instants,effort,") != std::string::npos;  // else it is older
  if (has_effort) columns.emplace_back("effort");
  const size_t queries = columns.size(), wall = queries + 1, first = wall + 1, gap = first + 1;
  columns.insert(columns.end(), {"collision_queries", "wall_s", "time_to_first_improvement_s",
                                 "gap_to_reference"});
  const bool has_bound = head.ends_with(",gap_lipm");
  if (has_bound) columns.emplace_back("gap_lipm");
  if (has_replay) columns.insert(columns.end(), {"stands", "replay_tilt_rad"});
  const CsvText csv(path, text, columns);
  std::vector<SummaryRow> rows;
  for (size_t i = 0; i < csv.size(); ++i) {
    SummaryRow row{.method = csv.Cell(i, 0),
                   .status = csv.Cell(i, 1),
                   .worst_family = csv.Cell(i, 7),
                   .certified = csv.Word(i, 2, {"true", "false"}) == "true",
                   .duration = csv.Number(i, 3),
                   .speedup = csv.Number(i, 4),
                   .cost = csv.Number(i, 5),
                   .worst_margin = csv.Number(i, 6),
                   .iterations = static_cast<long>(csv.Number(i, 8)),
                   .gap_to_reference = {}};
    for (size_t column = 9; column <= wall; ++column) (void)csv.Number(i, column);
    if (has_bound && !csv.Cell(i, gap + 1).empty()) row.gap_lipm = csv.Number(i, gap + 1);
    if (!csv.Cell(i, first).empty()) (void)csv.Number(i, first);
    if (!csv.Cell(i, gap).empty()) row.gap_to_reference = csv.Number(i, gap);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace halfstep::verify
