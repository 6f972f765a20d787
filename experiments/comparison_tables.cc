#include "experiments/comparison_tables.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/build_info.h"
#include "experiments/csv_writer.h"

namespace halfstep {
namespace {

constexpr size_t kOnePercent = 0, kFivePercent = 1;

void EffortCell(const std::optional<Effort>& effort, bool by_wall, CsvWriter* csv) {
  effort ? csv->Cell(by_wall ? effort->wall : effort->evaluations) : csv->Empty();
}

// Gap of an incumbent, by duration; none where there is no best or another objective.
void DurationGapCell(const ComparedCase& one, double duration, CsvWriter* csv) {
  if (!one.best_cost || one.objective != "fastest") {
    csv->Empty();
  } else {
    csv->Cell(duration / *one.best_cost - 1.0);
  }
}

}  // namespace

std::string ComparisonCsv(const Comparison& comparison) {
  CsvWriter csv({"scenario",
                 "objective",
                 "half_steps",
                 "method",
                 "variables",
                 "status",
                 "certified",
                 "duration_s",
                 "speedup",
                 "cost",
                 "best_cost",
                 "gap_to_best",
                 "gap_to_reference",
                 "margin_evaluations",
                 "collision_queries",
                 "wall_s",
                 "time_to_5pct_s",
                 "time_to_1pct_s",
                 "evaluations_to_5pct",
                 "evaluations_to_1pct",
                 "run"});
  for (const ComparedCase& one : comparison.cases) {
    for (const ComparedMethod& method : one.methods) {
      const MethodRecord& record = method.record;
      csv.Cell(one.scenario).Cell(one.objective).Cell(one.half_steps).Cell(record.name);
      csv.Cell(record.variables).Cell(record.status).Cell(record.certified).Cell(record.duration);
      csv.Cell(record.speedup);
      std::isnan(method.gap) ? csv.Empty() : csv.Cell(record.cost);
      one.best_cost ? csv.Cell(*one.best_cost) : csv.Empty();
      std::isnan(method.gap) ? csv.Empty() : csv.Cell(method.gap);
      record.gap_to_reference ? csv.Cell(*record.gap_to_reference) : csv.Empty();
      csv.Cell(record.evaluations).Cell(record.collision_queries).Cell(record.wall);
      for (bool by_wall : {true, false}) {
        EffortCell(method.reached[kFivePercent], by_wall, &csv);
        EffortCell(method.reached[kOnePercent], by_wall, &csv);
      }
      csv.Cell(record.run).EndRow();
    }
  }
  return csv.text();
}

std::string PerformanceProfileCsv(const Comparison& comparison) {
  CsvWriter csv({"gap", "effort", "method", "variables", "objective", "ratio", "fraction"});
  for (const ProfileCurve& curve : PerformanceProfiles(comparison)) {
    for (const auto& [ratio, fraction] : curve.points) {
      csv.Cell(kTargets[static_cast<size_t>(curve.target)]);
      csv.Cell(curve.by_wall ? "wall_s" : "evaluations");
      csv.Cell(curve.method.name).Cell(curve.method.variables).Cell(curve.method.objective);
      csv.Cell(ratio).Cell(fraction).EndRow();
    }
  }
  return csv.text();
}

std::string AnytimeCsv(const Comparison& comparison) {
  CsvWriter csv({"scenario", "objective", "method", "variables", "wall_s", "evaluations",
                 "duration_s", "gap_to_best"});
  for (const ComparedCase& one : comparison.cases) {
    for (const ComparedMethod& method : one.methods) {
      const MethodRecord& record = method.record;
      if (record.raw()) continue;
      const auto row = [&](const IncumbentRecord& incumbent) {
        csv.Cell(one.scenario).Cell(one.objective).Cell(record.name).Cell(record.variables);
        csv.Cell(incumbent.wall).Cell(incumbent.evaluations).Cell(incumbent.duration);
        DurationGapCell(one, incumbent.duration, &csv);
        csv.EndRow();
      };
      double last = one.methods.front().record.duration;
      row({0.0, 0.0, last});
      for (const IncumbentRecord& incumbent : record.incumbents) {
        if (incumbent.duration == last) continue;
        last = incumbent.duration;
        row(incumbent);
      }
      row({record.wall, record.evaluations, record.duration});
    }
  }
  return csv.text();
}

std::string MeansCsv(const Comparison& comparison) {
  CsvWriter csv({"method", "variables", "objective", "cases", "missing", "certified", "failed",
                 "within_1pct", "within_5pct", "finished", "speedup_mean", "time_to_1pct_mean_s",
                 "time_to_5pct_mean_s", "time_to_end_mean_s", "evaluations_to_1pct_mean",
                 "evaluations_to_5pct_mean", "evaluations_to_end_mean"});
  for (const MethodMeans& mean : Means(comparison)) {
    csv.Cell(mean.method.name).Cell(mean.method.variables).Cell(mean.method.objective);
    csv.Cell(mean.cases).Cell(mean.missing);
    csv.Cell(mean.certified).Cell(mean.failed());
    for (int solved : mean.solved) csv.Cell(solved);
    csv.Cell(mean.speedup);
    for (const Effort& effort : mean.effort) csv.Cell(effort.wall);
    for (const Effort& effort : mean.effort) csv.Cell(effort.evaluations);
    csv.EndRow();
  }
  return csv.text();
}

std::string ComparisonManifest(const std::vector<RunRecord>& runs) {
  nlohmann::ordered_json manifest = {{"format", 1},          {"program", "halfstep"},
                                     {"kind", "comparison"}, {"version", kVersion},
                                     {"commit", kCommit},    {"targets", {0.01, 0.05, "inf"}}};
  for (const RunRecord& run : runs) {
    manifest["runs"].push_back({{"run", run.run},
                                {"scenario", run.scenario},
                                {"objective", run.objective},
                                {"problem_sha256", run.problem},
                                {"manifest_sha256", run.manifest_sha256}});
  }
  return manifest.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace halfstep
