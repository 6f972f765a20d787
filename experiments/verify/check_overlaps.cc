#include "experiments/verify/check_overlaps.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace halfstep::verify {
namespace {

// Numbers that are computed twice differ by rounding [s], [m], [rad], [1].
constexpr double kTwiceRounding = 1e-9;
// The longest rest between two half-steps [s].
constexpr double kLongestRest = 3600;

bool Same(double a, double b) { return std::abs(a - b) <= kTwiceRounding; }  // false for nan

bool SameMove(const Pose2& a, const Pose2& b) {
  return Same(a.x, b.x) && Same(a.y, b.y) && Same(a.yaw, b.yaw);
}

bool Same(const FormColumns& a, const FormColumns& b) {
  return SameMove(a.footstep, b.footstep) &&
         std::ranges::all_of(kAllFormColumns, [&](const FormColumn& one) {
           return Same(a.*one.value, b.*one.value);
         });
}

// What is wrong with a form, of whatever plan; "": nothing. Numbers that are not finite are out of
// every range.
std::string FaultOfForm(const FormColumns& form) {
  const auto within = [](double x, double least, double most) { return x >= least && x <= most; };
  for (const FormColumn& one : kAllFormColumns) {
    const double value = form.*one.value;
    if (within(value, one.least, one.most)) continue;
    return one.before + Formatted("%.9g", value) + one.after;
  }
  const Pose2& move = form.footstep;
  if (!within(move.x, -0.5, 0.5) || !within(move.y, -0.5, 0.5) || !within(move.yaw, -1, 1)) {
    return Formatted("footstep moved by %.9g, %.9g, turned by %.9g", move.x, move.y, move.yaw);
  }
  return "";
}

// What is wrong with a row of the planned motion; "": nothing.
std::string FaultOfRaw(const HalfStepRow& row, const HalfStep& planned) {
  if (!Same(row.duration, planned.duration)) {
    return Formatted("duration %.9g, planned %.9g", row.duration, planned.duration);
  }
  if (!Same(row.support_point, planned.support_point)) {
    return Formatted("support point %.9g, planned %.9g", row.support_point, planned.support_point);
  }
  if (!Same(row.FormOf(planned), planned.form)) return "a form that is not planned";
  return Same(row.height_scale, 1) ? ""
                                   : Formatted("height scale %.9g, planned 1", row.height_scale);
}

// Largest overlap that the homotopy allows at a junction [s].
// Source: smoothing/README.md, "Natural bounds".
double NaturalBound(const HalfStepRow& before, const HalfStepRow& after, const HalfStep& planned) {
  if (before.kind == "down") return std::min(before.duration, after.duration);
  const auto flight = [&planned](const HalfStepRow& row) {
    const double shift = row.form ? row.form->zmp_shift : planned.form.zmp_shift;
    return row.duration * (1 - shift) / 2;
  };
  return std::min(flight(before), flight(after));
}

std::string FaultOf(const OverlapRow& row, const HalfStepRow& before, const HalfStepRow& after,
                    const HalfStep& planned) {
  if (row.kind != (before.kind == "up" ? "up_down" : "down_up")) return "kind " + row.kind;
  const std::string fault = FaultOfOverlap(row.overlap, before, after, planned);
  if (!fault.empty()) return fault;
  if (!Same(row.duration_before, before.duration) || !Same(row.duration_after, after.duration) ||
      !Same(row.scale_before, before.height_scale) || !Same(row.scale_after, after.height_scale)) {
    return "durations and height scales are not those of half_steps.csv";
  }
  return "";
}

// The column of a form; null: the parameter is none.
const FormColumn* FormNamed(const std::string& parameter) {
  const auto* found = std::ranges::find(kAllFormColumns, parameter, &FormColumn::name);
  return found != kAllFormColumns.end() ? found : nullptr;
}

// The number of a footstep's move that a parameter is.
std::optional<double Pose2::*> MoveNamed(const std::string& parameter) {
  if (parameter == "footstep_x") return &Pose2::x;
  if (parameter == "footstep_y") return &Pose2::y;
  if (parameter == "footstep_yaw") return &Pose2::yaw;
  return std::nullopt;
}

}  // namespace

std::string FaultOfHalfStep(const HalfStepRow& row, const HalfStep& planned) {
  if (row.kind != (planned.up ? "up" : "down")) return "kind " + row.kind;
  if (row.support != Name(planned.support)) return "support " + row.support;
  if (!std::isfinite(row.start) || !std::isfinite(row.duration) ||
      !std::isfinite(row.height_scale) || !std::isfinite(row.support_point)) {
    return "a number is not finite";
  }
  if (!(row.duration > 0)) return Formatted("duration %.9g", row.duration);
  if (!(row.height_scale >= 0)) return Formatted("height scale %.9g", row.height_scale);
  if (row.height_scale * planned.via_height < planned.X_SF.height - kTwiceRounding) {
    return Formatted("height scale %.9g, with which the foot passes lower than it stands",
                     row.height_scale);
  }
  return row.form ? FaultOfForm(*row.form) : "";
}

std::string FaultOfStep(const HalfStepRow& up, const HalfStepRow& down) {
  if (!Same(down.height_scale, up.height_scale)) {
    return "another height scale than the step's up half-step";
  }
  for (const FormColumn& one : kFormColumns) {
    if (!one.of_step() || !up.form || !down.form) continue;
    if (Same(*down.form.*one.value, *up.form.*one.value)) continue;
    return std::string(one.differs) + " than the step's up half-step";
  }
  if (up.form && down.form && !SameMove(down.form->footstep, up.form->footstep)) {
    return "another footstep than the step's up half-step";
  }
  return Same(down.support_point, up.support_point)
             ? ""
             : "another support point than the step's up half-step";
}

std::string FaultOfOverlap(double overlap, const HalfStepRow& before, const HalfStepRow& after,
                           const HalfStep& planned) {
  const double bound = NaturalBound(before, after, planned);
  if (overlap >= -kLongestRest && overlap <= bound + kTwiceRounding) return "";
  return Formatted("overlap %.9g, natural bound %.9g", overlap, bound);
}

bool CheckOverlaps(const std::vector<HalfStepRow>& half_steps,
                   const std::optional<std::vector<OverlapRow>>& overlaps, const WalkPlan& planned,
                   Findings* findings) {
  const long before = findings->disagreements();
  const size_t n = planned.half_steps.size();
  findings->Say("half_steps.csv: " + Count(std::ssize(half_steps)) + " half-steps, " +
                (overlaps ? Count(std::ssize(*overlaps)) + " overlaps" : "no overlaps"));
  if (half_steps.size() != n) {
    findings->Disagree(
        Formatted("half_steps.csv: %zu half-steps, the footsteps make %zu", half_steps.size(), n));
    return false;
  }
  if (overlaps && overlaps->size() + 1 != n) {
    findings->Disagree(
        Formatted("overlaps.csv: %zu junctions instead of %zu", overlaps->size(), n - 1));
    return false;
  }
  double start = 0;
  for (size_t i = 0; i < n; ++i) {
    const HalfStepRow& row = half_steps[i];
    const std::string line = Formatted("half_steps.csv:%zu: ", i + 2);
    const HalfStep& as_planned = planned.half_steps[i].half_step;
    std::string fault = FaultOfHalfStep(row, as_planned);
    if (fault.empty() && !overlaps) fault = FaultOfRaw(row, as_planned);
    if (!fault.empty()) findings->Disagree(line + fault);
    if (!Same(row.start, start)) {
      findings->Disagree(
          line + Formatted("start %.9g, but %.9g by durations and overlaps", row.start, start));
    }
    fault = i % 2 == 1 ? FaultOfStep(half_steps[i - 1], row) : "";
    if (!fault.empty()) findings->Disagree(line + fault);
    if (i + 1 == n) break;
    start += row.duration - (overlaps ? (*overlaps)[i].overlap : -planned.half_steps[i + 1].rest);
    if (!overlaps) continue;
    const std::string overlap_fault =
        FaultOf((*overlaps)[i], row, half_steps[i + 1], planned.half_steps[i].half_step);
    if (!overlap_fault.empty()) {
      findings->Disagree(Formatted("overlaps.csv:%zu: ", i + 2) + overlap_fault);
    }
  }
  return findings->disagreements() == before;
}

void CheckUpperBounds(const std::string& method, const std::vector<HalfStepRow>& half_steps,
                      const std::vector<OverlapRow>& overlaps, const WalkPlan& planned,
                      const DichotomyOptions& config, Findings* findings) {
  const bool published = method == "dichotomy/published";
  const bool capped = method == "dichotomy" || method == "dichotomy/right_to_left" ||
                      method == "dichotomy/three_passes";
  Faults faults;
  for (size_t i = 0; i < overlaps.size(); ++i) {
    const bool up = half_steps[i].kind == "up";
    const double cap = published ? (up ? 0.8 : 0.76)
                       : capped  ? (up ? config.up_down_cap : config.down_up_cap)
                                 : 1;
    const double bound =
        cap * NaturalBound(half_steps[i], half_steps[i + 1], planned.half_steps[i].half_step);
    if (Same(overlaps[i].upper_bound, bound)) continue;
    faults.Add(Formatted("overlaps.csv:%zu: upper_bound_s is %.9g, but %.9g by half_steps.csv",
                         i + 2, overlaps[i].upper_bound, bound));
  }
  faults.Conclude(findings);
}

void CheckFixed(const std::vector<HalfStepRow>& half_steps, const std::vector<OverlapRow>& overlaps,
                const WalkPlan& planned, const std::vector<FixedConfig>& fixed,
                Findings* findings) {
  for (const FixedConfig& one : fixed) {
    const size_t i = static_cast<size_t>(one.index - 1);
    double is = 0, demanded = 0;
    if (one.parameter == "overlap" && i < overlaps.size()) {
      is = overlaps[i].overlap;
      demanded = 0.0 - planned.half_steps[i + 1].rest;
    } else if (one.parameter == "duration" && i < half_steps.size()) {
      is = half_steps[i].duration;
      demanded = planned.half_steps[i].half_step.duration;
    } else if (one.parameter == "height_scale" && 2 * i < half_steps.size()) {
      is = half_steps[2 * i].height_scale;
      demanded = 1;
    } else if (one.parameter == "support_point" && 2 * i < half_steps.size()) {
      is = half_steps[2 * i].support_point;
      demanded = planned.half_steps[2 * i].half_step.support_point;
    } else if (const auto move = MoveNamed(one.parameter); move && 2 * i < half_steps.size()) {
      is = half_steps[2 * i].FormOf(planned.half_steps[2 * i].half_step).footstep.**move;
    } else if (const auto* form = FormNamed(one.parameter);
               form && (form->of_step() ? 2 * i : i) < half_steps.size()) {
      const size_t row = form->of_step() ? 2 * i : i;
      const HalfStep& plan = planned.half_steps[row].half_step;
      is = half_steps[row].FormOf(plan).*form->value;
      demanded = plan.form.*form->value;
    } else {
      findings->Disagree("config.yaml: smoothing.fixed: " + one.parameter +
                         Formatted(" %d is not known here", one.index));
      continue;
    }
    demanded = one.value.value_or(demanded);
    if (Same(is, demanded)) continue;
    findings->Disagree(one.parameter +
                       Formatted(" %d is %.9g, fixed at %.9g", one.index, is, demanded));
  }
}

void CheckFootsteps(const std::vector<FootstepRow>& rows, const WalkPlan& planned,
                    Findings* findings) {
  const size_t steps = planned.half_steps.size() / 2;
  findings->Say(Formatted("footsteps.csv: %zu footsteps", steps));
  if (rows.size() != steps + 2) {
    findings->Disagree(Formatted("footsteps.csv: %zu rows instead of %zu", rows.size(), steps + 2));
    return;
  }
  const bool changes_crouch = ChangesCrouch(planned);
  for (size_t i = 0; i < rows.size(); ++i) {
    Side side = i == 0 ? Side::kLeft : Side::kRight;
    Foothold X_WF = planned.start[std::min<size_t>(i, 1)];
    double height = 0, duration = 0, rest = 0, rest_on_one = 0;
    double crouch = StartCrouch(planned);
    if (i >= 2) {
      const PlacedHalfStep& down = planned.half_steps[2 * (i - 2) + 1];
      side = down.half_step.swing();
      X_WF = down.X_WS * down.half_step.X_SF;
      height = down.half_step.via_height;
      duration = down.half_step.duration;
      rest = planned.half_steps[2 * (i - 2)].rest;
      rest_on_one = down.rest;
      crouch = down.half_step.crouch;
    }
    const FootstepRow& row = rows[i];
    if (row.foot != Name(side) || !Same(row.X_WF.x, X_WF.x) || !Same(row.X_WF.y, X_WF.y) ||
        !Same(row.X_WF.yaw, X_WF.yaw) || !Same(row.z, X_WF.height) ||
        !Same(row.via_height, height) || !Same(row.duration, duration) || !Same(row.rest, rest) ||
        !Same(row.rest_on_one, rest_on_one) ||
        (row.crouch ? !Same(*row.crouch, crouch) : changes_crouch)) {
      findings->Disagree(Formatted("footsteps.csv:%zu: not the footstep of config.yaml", i + 2));
    }
  }
}

}  // namespace halfstep::verify
