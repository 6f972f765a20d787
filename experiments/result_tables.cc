#include "experiments/result_tables.h"

#include <algorithm>

#include "experiments/csv_writer.h"
#include "smoothing/sampled_feasibility.h"

namespace halfstep {
namespace {

std::string Active(const MarginEvaluator& evaluator, const JunctionResult& junction) {
  if (junction.limited_by) return evaluator.Describe(*junction.limited_by);
  return junction.overlap < junction.upper_bound ? "not bisected" : "upper bound";
}

}  // namespace

std::string FootstepsCsv(const HalfStepSequence& sequence) {
  CsvWriter csv({"footstep", "foot", "x_m", "y_m", "yaw_rad", "via_height_m", "duration_s"});
  const auto row = [&](int index, Side side, const Pose2& X_WF, double height, double duration) {
    csv.Cell(index).Cell(Name(side)).Cell(X_WF.x).Cell(X_WF.y).Cell(X_WF.yaw);
    csv.Cell(height).Cell(duration).EndRow();
  };
  for (Side side : {Side::kLeft, Side::kRight}) {
    row(0, side, sequence.start[static_cast<size_t>(Index(side))], 0.0, 0.0);
  }
  for (int step = 0; step < sequence.num_steps(); ++step) {
    const PlacedHalfStep& down = sequence.half_steps[static_cast<size_t>(2 * step + 1)];
    row(step + 1, down.half_step.swing(), down.X_WS * down.half_step.X_SF,
        down.half_step.via_height, down.half_step.duration);
  }
  return csv.text();
}

std::string HalfStepsCsv(const HalfStepSequence& sequence, const MethodRun& run) {
  CsvWriter csv({"half_step", "kind", "support", "start_s", "duration_s", "height_scale"});
  const HomotopyParameters& parameters = run.result.parameters;
  double start = 0.0;
  for (size_t i = 0; i < sequence.half_steps.size(); ++i) {
    const HalfStep& half_step = sequence.half_steps[i].half_step;
    csv.Cell(static_cast<long>(i) + 1).Cell(half_step.kind == HalfStepKind::kUp ? "up" : "down");
    csv.Cell(Name(half_step.support)).Cell(start).Cell(parameters.durations[i]);
    csv.Cell(parameters.height_scales[i / 2]).EndRow();
    if (i < parameters.overlaps.size()) start += parameters.durations[i] - parameters.overlaps[i];
  }
  return csv.text();
}

std::string OverlapsCsv(const MarginEvaluator& evaluator, const MethodRun& run) {
  CsvWriter csv({"junction", "kind", "overlap_s", "upper_bound_s", "active", "limit_family",
                 "limit_scale", "price_s", "multiplier_s", "duration_before_s", "duration_after_s",
                 "height_scale_before", "height_scale_after"});
  const HomotopyParameters& parameters = run.result.parameters;
  int index = 0;
  for (const JunctionResult& junction : run.result.junctions) {
    csv.Cell(++index).Cell(junction.kind == JunctionKind::kUpDown ? "up_down" : "down_up");
    csv.Cell(junction.overlap).Cell(junction.upper_bound);
    csv.Cell(Active(evaluator, junction));
    if (junction.limited_by) {
      csv.Cell(Name(junction.limited_by->family)).Cell(Scale(junction.limited_by->family));
    } else {
      csv.Empty().Empty();
    }
    junction.price ? csv.Cell(*junction.price) : csv.Empty();
    junction.multiplier ? csv.Cell(*junction.multiplier) : csv.Empty();
    const size_t after = static_cast<size_t>(index), before = after - 1;
    csv.Cell(parameters.durations[before]).Cell(parameters.durations[after]);
    csv.Cell(parameters.height_scales[before / 2]).Cell(parameters.height_scales[after / 2]);
    csv.EndRow();
  }
  return csv.text();
}

std::string ParetoCsv(const MarginEvaluator& evaluator, const HalfStepSequence& sequence,
                      const MethodRun& run) {
  constexpr double kPeriod = 0.005;
  std::vector<std::string> columns = {"duration_s", "least_slack"};
  for (MarginFamily family : AllMarginFamilies()) {
    std::string unit(Unit(family));
    std::replace(unit.begin(), unit.end(), '/', '_');
    columns.push_back(std::string(Name(family)) + "_" + unit);
  }
  CsvWriter csv(columns);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  for (const ParetoPoint& point : run.result.pareto) {
    csv.Cell(point.duration).Cell(point.least_slack);
    const SuperposedWalk walk(sequence, point.parameters);
    for (const Margin& margin : SampleMargins(evaluator, walk, kPeriod, &scratch)) {
      csv.Cell(margin.value);
    }
    csv.EndRow();
  }
  return csv.text();
}

std::string IteratesCsv(const MethodRun& run) {
  CsvWriter csv({"iteration", "wall_s", "evaluations", "candidate_duration_s",
                 "candidate_worst_margin", "accepted", "lambda", "incumbent_duration_s",
                 "incumbent_worst_margin"});
  int index = 0;
  for (const SmoothingIterate& iterate : run.result.iterates) {
    csv.Cell(++index).Cell(iterate.wall).Cell(iterate.evaluations).Cell(iterate.candidate_duration);
    iterate.candidate_slack ? csv.Cell(*iterate.candidate_slack) : csv.Empty();
    csv.Cell(iterate.accepted).Cell(iterate.lambda).Cell(iterate.incumbent_duration);
    iterate.incumbent_slack ? csv.Cell(*iterate.incumbent_slack) : csv.Empty();
    csv.EndRow();
  }
  return csv.text();
}

std::vector<std::string> SummaryColumns() {
  return {"method",
          "status",
          "certified",
          "duration_s",
          "speedup",
          "cost",
          "worst_margin",
          "worst_margin_name",
          "iterations",
          "margin_evaluations",
          "collision_queries",
          "wall_s",
          "time_to_first_improvement_s",
          "gap_to_reference"};
}

std::string SummaryCsv(const MarginEvaluator& evaluator, const std::vector<MethodRun>& runs) {
  CsvWriter csv(SummaryColumns());
  std::optional<double> reference;
  for (const MethodRun& run : runs) {
    if (run.method == "reference") reference = run.duration;
  }
  for (const MethodRun& run : runs) {
    const SmoothingResult& result = run.result;
    const Margin& worst = WorstOf(run.margins, evaluator.limits());
    csv.Cell(run.method)
        .Cell(Name(result.status))
        .Cell(run.certified.answer.verdict == Verdict::kFeasible);
    csv.Cell(run.duration).Cell(runs.front().duration / run.duration).Cell(result.cost);
    csv.Cell(worst.value).Cell(Name(worst.family));
    csv.Cell(static_cast<long>(result.iterates.size())).Cell(result.instants);
    csv.Cell(result.collision_queries).Cell(result.wall);
    result.time_to_first_improvement ? csv.Cell(*result.time_to_first_improvement) : csv.Empty();
    reference ? csv.Cell(run.duration / *reference - 1.0) : csv.Empty();
    csv.EndRow();
  }
  return csv.text();
}

}  // namespace halfstep
