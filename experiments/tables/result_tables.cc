#include "experiments/tables/result_tables.h"

#include <algorithm>
#include <cmath>

#include "experiments/tables/parameter_tables.h"
#include "planner/ground/level_surface.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "smoothing/walk/footstep_families.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using enum CsvType;

std::string Active(const MarginEvaluator& evaluator, const std::string& method,
                   const JunctionResult& junction) {
  if (junction.limited_by) return evaluator.Describe(*junction.limited_by);
  if (junction.fixed) return "fixed";
  if (method == "given") return "given";
  return junction.overlap < junction.upper_bound ? "not bisected" : "upper bound";
}

// Levels are whole nanometres; a height that was added up is rounded.
Foothold OnItsLevel(Foothold X_WF) {
  X_WF.height = WholeNanometres(X_WF.height);
  return X_WF;
}

// The bound that a method knows; none: none does.
std::optional<double> BoundOf(const std::vector<MethodRun>& runs) {
  for (const MethodRun& run : runs) {
    if (run.result.lower_bound) return run.result.lower_bound;
  }
  return std::nullopt;
}

}  // namespace

bool HasHeights(const HalfStepSequence& sequence) {
  const auto is_high = [](const Foothold& X_WF) { return X_WF.height != 0.0; };
  return std::ranges::any_of(sequence.start, is_high) ||
         std::ranges::any_of(sequence.half_steps, [&](const PlacedHalfStep& placed) {
           return is_high(placed.X_WS) || is_high(placed.half_step.X_SF);
         });
}

bool HasRests(const HalfStepSequence& sequence) {
  return std::ranges::any_of(sequence.half_steps,
                             [](const PlacedHalfStep& placed) { return placed.rest != 0.0; });
}

CsvColumns FootstepsColumns(bool with_heights, bool with_rests, bool with_crouches) {
  CsvColumns columns = {
      {"footstep", kInteger, "", "0 twice: the feet at the start; then 1, 2, ..."},
      {"foot", kString, "", "left or right"},
      {"x_m", kNumber, "m", "sole's centre, x", "W"},
      {"y_m", kNumber, "m", "sole's centre, y", "W"},
      {"yaw_rad", kNumber, "rad", "sole's yaw, not wrapped", "W"},
      {"via_height_m", kNumber, "m", "height of the via point of the step there; 0 at the start"},
      {"duration_s", kNumber, "s", "T of each of the step's half-steps; 0 at the start"},
  };
  if (with_heights) {
    columns.insert(columns.begin() + 4, {"z_m", kNumber, "m", "height of the level there", "W"});
  }
  if (with_rests) {
    columns.push_back({"rest_s", kNumber, "s", "at rest on both feet before the step"});
    columns.push_back({"rest_on_one_foot_s", kNumber, "s", "at rest on one foot before it lands"});
  }
  if (with_crouches) {
    columns.push_back(
        {"crouch_m", kNumber, "m", "how far the waist is kept below where it stands"});
  }
  return columns;
}

CsvFile FootstepsCsv(const HalfStepSequence& sequence, int before) {
  const bool has_heights = HasHeights(sequence), has_rests = HasRests(sequence),
             has_crouches = ChangesCrouch(sequence);
  CsvWriter csv(FootstepsColumns(has_heights, has_rests, has_crouches));
  const auto row = [&](int index, const Footstep& footstep) {
    const Foothold& X_WF = footstep.X_WF;
    csv.Cell(index).Cell(Name(footstep.side)).Cell(X_WF.x).Cell(X_WF.y);
    if (has_heights) csv.Cell(X_WF.height);
    csv.Cell(X_WF.yaw).Cell(footstep.via_height).Cell(footstep.duration);
    if (has_rests) csv.Cell(footstep.rest).Cell(footstep.rest_on_one_foot);
    if (has_crouches) csv.Cell(*footstep.crouch);
    csv.EndRow();
  };
  for (Side side : {Side::kLeft, Side::kRight}) {
    row(0, {.side = side,
            .X_WF = Nth(sequence.start, Index(side)),
            .via_height = 0.0,
            .duration = 0.0,
            .crouch = sequence.half_steps.front().half_step.crouch_on_floor()});
  }
  for (int step = 0; step < sequence.num_steps(); ++step) {
    const PlacedHalfStep& down = Nth(sequence.half_steps, 2 * step + 1);
    row(before + step + 1, {.side = down.half_step.swing(),
                            .X_WF = OnItsLevel(down.X_WS * down.half_step.X_SF),
                            .via_height = down.half_step.via_height,
                            .duration = down.half_step.duration,
                            .rest = Nth(sequence.half_steps, 2 * step).rest,
                            .rest_on_one_foot = down.rest,
                            .crouch = down.half_step.shape.crouch});
  }
  return csv.file();
}

CsvColumns OverlapsColumns() {
  return {
      {"junction", kInteger, "", "from 1: between half-steps `junction` and `junction` + 1"},
      {"kind", kString, "", "up_down or down_up"},
      ColumnOf(ParameterFamily::kOverlap),
      {"upper_bound_s", kNumber, "s", "largest overlap that was allowed"},
      {"limited_by", kString, "", "what holds the overlap"},
      {"limited_by_family", kString, "", "family of the margin that holds it, or none"},
      {"limited_by_scale", kNumber, "", "that family's scale in its unit; empty: none limits"},
      {"price_s", kNumber, "s",
       "how much shorter the walk for limited_by_scale less demanded, by this overlap alone, to "
       "first "
       "order; empty: it does not depend on it"},
      {"multiplier_s", kNumber, "s",
       "the same, all parameters adapting, from the program; empty: none was solved, or the "
       "margin hardly depends on them"},
      {"duration_before_s", kNumber, "s", "T of the half-step before"},
      {"duration_after_s", kNumber, "s", "T of the half-step after"},
      {"height_scale_before", kNumber, "1", "height scale of the step before"},
      {"height_scale_after", kNumber, "1", "height scale of the step after"},
  };
}

CsvFile OverlapsCsv(const MarginEvaluator& evaluator, const MethodRun& run) {
  CsvWriter csv(OverlapsColumns());
  const HomotopyParameters& parameters = run.result.parameters;
  int index = 0;
  for (const JunctionResult& junction : run.result.junctions) {
    csv.Cell(++index).Cell(junction.kind == JunctionKind::kUpDown ? "up_down" : "down_up");
    csv.Cell(junction.overlap).Cell(junction.upper_bound);
    csv.Cell(Active(evaluator, run.method, junction));
    if (junction.limited_by) {
      csv.Cell(Name(junction.limited_by->family)).Cell(Scale(junction.limited_by->family));
    } else {
      csv.Cell("none").Empty();
    }
    csv.Cell(junction.price);
    const bool determined = junction.multiplier && std::isfinite(*junction.multiplier);
    csv.Cell(determined ? junction.multiplier : std::nullopt);
    csv.Cell(Nth(parameters.durations, index - 1)).Cell(Nth(parameters.durations, index));
    csv.Cell(Nth(parameters.height_scales, (index - 1) / 2));
    csv.Cell(Nth(parameters.height_scales, index / 2));
    csv.EndRow();
  }
  return csv.file();
}

CsvColumns ParetoColumns(std::span<const MarginFamily> families) {
  CsvColumns columns = {{"duration_s", kNumber, "s", "of the walk"},
                        {"least_slack", kNumber, "1",
                         "proved for the families that `safest` raises, of their scales"}};
  for (const MarginFamily family : families) {
    columns.push_back({std::string(Traits(family).key), kNumber, std::string(Unit(family)),
                       "least margin of the family, sampled every 5 ms; inf: nowhere watched"});
  }
  return columns;
}

CsvFile ParetoCsv(const MarginEvaluator& evaluator, const HalfStepSequence& sequence,
                  const MethodRun& run) {
  constexpr double kPeriod = 0.005;
  CsvWriter csv(ParetoColumns(evaluator.families()));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  for (const ParetoPoint& point : run.result.pareto) {
    csv.Cell(point.duration).Cell(point.least_slack);
    const SuperposedWalk walk(sequence, point.parameters);
    const MarginSet margins = SampleMargins(evaluator, walk, kPeriod, &scratch);
    for (const MarginFamily family : evaluator.families()) {
      csv.Cell(Nth(margins, family).value);
    }
    csv.EndRow();
  }
  return csv.file();
}

CsvFile IteratesCsv(const MethodRun& run) {
  CsvWriter csv({
      {"iteration", kInteger, "", "from 1"},
      {"wall_s", kNumber, "s", "since the method began"},
      {"instants", kInteger, "", "instants evaluated so far"},
      {"effort", kNumber, "", "work done so far; 1 is about a second of one core of 2026"},
      {"candidate_duration_s", kNumber, "s", "of the candidate's whole walk"},
      {"candidate_worst_margin", kNumber, "1",
       "(margin - demanded)/scale of the margin that refused the candidate; empty: feasible or "
       "undecided"},
      {"accepted", kBoolean, "", "whether the incumbent moved"},
      {"lambda", kNumber, "1", "how far from the incumbent to the candidate the walk went"},
      {"incumbent_duration_s", kNumber, "s", "of the incumbent's walk after this row", "",
       CsvInterpolation::kPiecewiseConstant},
      {"incumbent_worst_margin", kNumber, "1", "of the incumbent; empty: not computed"},
  });
  int index = 0;
  for (const SmoothingIterate& iterate : run.result.iterates) {
    csv.Cell(++index).Cell(iterate.wall).Cell(iterate.instants).Cell(iterate.effort);
    csv.Cell(iterate.candidate_duration)
        .Cell(iterate.candidate_worst_margin)
        .Cell(iterate.accepted)
        .Cell(iterate.lambda);
    csv.Cell(iterate.incumbent_duration).Cell(iterate.incumbent_slack).EndRow();
  }
  return csv.file();
}

CsvColumns SummaryColumns(const SummaryParts& parts) {
  CsvColumns columns = {
      {"method", kString, "", "raw first"},
      {"status", kString, "", "how it ended: " + opt::EndingNames()},
      {"certified", kBoolean, "", "whether the walk is proved for all its time"},
      {"duration_s", kNumber, "s", "of the walk"},
      {"speedup", kNumber, "1", "duration of raw divided by this one's"},
      {"cost", kNumber, "", "what the method minimized; the duration for `fastest`"},
      {"worst_margin", kNumber, "",
       "with the least (margin - demanded)/scale among the rows of trajectory.csv, in its own "
       "unit"},
      {"worst_margin_name", kString, "", "its family"},
      {"iterations", kInteger, "", "rows of iterates.csv"},
      {"instants", kInteger, "", "instants evaluated by the method"},
      {"effort", kNumber, "", "work of the method; 1 is about a second of one core of 2026"},
      {"collision_queries", kInteger, "", "pairs of bodies that were not culled"},
      {"wall_s", kNumber, "s", "time of the method; 0 for raw"},
      {"time_to_first_improvement_s", kNumber, "s",
       "until the first candidate was accepted; empty: none was"},
      {"gap_to_reference", kNumber, "1",
       "duration divided by that of the method `reference`, less 1; empty: it was not run"},
  };
  if (parts.bound) {
    columns.push_back({"gap_lipm", kNumber, "1",
                       "duration divided by the lower bound that `reference/lipm` proved, less 1; "
                       "empty: of that method itself, and of walks that move footsteps"});
  }
  if (parts.replay) {
    columns.push_back({"stands", kString, "",
                       "simulated robots that stayed up, of all: 8 of 8; none: not certified, so "
                       "not simulated"});
    columns.push_back(
        {"replay_tilt_rad", kNumber, "rad", "median of their largest tilts; empty: not simulated"});
  }
  return columns;
}

void AddSummaryRow(const MarginEvaluator& evaluator, const std::vector<MethodRun>& runs,
                   size_t index, const SummaryParts& parts, const SummaryCell& cell) {
  const MethodRun& run = runs[index];
  const SmoothingResult& result = run.result;
  const Margin& worst = WorstOf(run.margins, evaluator.limits());
  const CsvColumns columns = SummaryColumns(parts);
  size_t column = 0;
  const auto next = [&]() -> CsvWriter& { return cell(columns[column++]); };
  std::optional<double> gap;
  for (const MethodRun& other : runs) {
    if (other.method == "reference") gap = run.duration / other.duration - 1.0;
  }
  next().Cell(run.method);
  next().Cell(Name(result.ending));
  next().Cell(run.certified.answer.verdict == Verdict::kFeasible);
  next().Cell(run.duration);
  next().Cell(runs.front().duration / run.duration);
  next().Cell(result.cost);
  next().Cell(worst.value);
  next().Cell(Name(worst.family));
  next().Cell(static_cast<long>(result.iterates.size()));
  next().Cell(result.work.evaluated());
  next().Cell(result.work.effort());
  next().Cell(result.collision_queries);
  next().Cell(result.wall);
  next().Cell(result.time_to_first_improvement);
  next().Cell(gap);
  if (parts.bound) {
    const std::optional<double> bound = BoundOf(runs);
    const bool holds = bound && !result.lower_bound && MovesOfFootsteps(result.parameters).empty();
    next().Cell(holds ? std::optional(run.duration / *bound - 1.0) : std::nullopt);
  }
  if (parts.replay) {
    next().Cell(run.replay ? run.replay->Standing() : "none");
    next().Cell(run.replay ? std::optional(run.replay->median_tilt) : std::nullopt);
  }
}

CsvFile SummaryCsv(const MarginEvaluator& evaluator, const std::vector<MethodRun>& runs,
                   bool with_replay) {
  const SummaryParts parts{.bound = BoundOf(runs).has_value(), .replay = with_replay};
  CsvWriter csv(SummaryColumns(parts));
  for (size_t i = 0; i < runs.size(); ++i) {
    AddSummaryRow(evaluator, runs, i, parts,
                  [&csv](const CsvColumn&) -> CsvWriter& { return csv; });
    csv.EndRow();
  }
  return csv.file();
}

}  // namespace halfstep
