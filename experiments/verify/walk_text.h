#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/verify/walk_plan.h"

namespace halfstep::verify {

/// A row of half_steps.csv.
struct HalfStepRow {
  std::string kind, support;                         ///< up or down; left or right
  double start = 0, duration = 0, height_scale = 0;  ///< [s], [s], 1
  double support_point = 0;                          ///< [m]
  std::optional<FormColumns> form = {};              ///< none: as planned
  bool has_rise = false;  ///< whether the form's rise has columns; else it is as planned

  /// The form of the half-step whose plan is `planned`.
  FormColumns FormOf(const HalfStep& planned) const {
    FormColumns of = form.value_or(planned.form);
    for (const FormColumn& one : kRiseColumns) {
      if (!has_rise) of.*one.value = planned.form.*one.value;
    }
    return of;
  }
};

/// A row of overlaps.csv; its columns about what holds the overlap and what that costs are not
/// read: no statement is about them.
struct OverlapRow {
  std::string kind;    ///< up_down or down_up
  double overlap = 0;  ///< [s]
  /// Of the half-steps [s] and height scales on both sides.
  double duration_before = 0, duration_after = 0, scale_before = 0, scale_after = 0;
  double upper_bound = 0;  ///< the largest overlap that was allowed [s]
};

/// A row of footsteps.csv.
struct FootstepRow {
  int footstep = 0;                     ///< 0: a foot at the start
  std::string foot;                     ///< left or right
  Pose2 X_WF;                           ///< place of the sole, in W, seen from above
  double z = 0;                         ///< its height [m]
  double via_height = 0, duration = 0;  ///< [m], [s]
  double rest = 0, rest_on_one = 0;     ///< on both feet before its step, on one foot [s]
  std::optional<double> crouch = {};    ///< of its step [m]; none: that of config.yaml
};

/// A row of summary.csv.
struct SummaryRow {
  std::string method, status, worst_family;  ///< as the columns of these names say
  bool certified = false;                    ///< whether its walk is said to be certified
  /// [s], ratio, cost of the objective, unit of the family.
  double duration = 0, speedup = 0, cost = 0, worst_margin = 0;
  long iterations = 0;                     ///< of the method
  std::optional<double> gap_to_reference;  ///< none: there is no reference
  std::optional<double> gap_lipm = {};     ///< none: no bound is told
};

/// Each throws InputError for a text that is no such table.
std::vector<HalfStepRow> ReadHalfSteps(const std::string& path, const std::string& text);
/// The same of a table that begins with another half-step, `*first`, counted from 0 (out).
std::vector<HalfStepRow> ReadHalfStepsFrom(const std::string& path, const std::string& text,
                                           int* first);
/// The rows of overlaps.csv.
std::vector<OverlapRow> ReadOverlaps(const std::string& path, const std::string& text);
/// The overlaps of an episode's walks/NNN/overlaps.csv [s], whose half_steps.csv begins with
/// half-step `first`, counted from 0: the first is that with the one before it, if there is one.
std::vector<double> ReadOverlapsOfEpisode(const std::string& path, const std::string& text,
                                          int first);
/// The rows of footsteps.csv.
std::vector<FootstepRow> ReadFootsteps(const std::string& path, const std::string& text);
/// The same of a table whose first soles stand where `before` footsteps have been taken.
std::vector<FootstepRow> ReadFootstepsAfter(const std::string& path, const std::string& text,
                                            int before);
/// The rows of summary.csv.
std::vector<SummaryRow> ReadSummary(const std::string& path, const std::string& text);

}  // namespace halfstep::verify
