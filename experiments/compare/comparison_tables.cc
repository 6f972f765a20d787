#include "experiments/compare/comparison_tables.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/about/build_info.h"
#include "experiments/tables/csv_writer.h"
#include "experiments/tables/not_covered_json.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using enum CsvType;
constexpr size_t kOnePercent = 0, kFivePercent = 1;

std::optional<double> Spent(const std::optional<RuntimeToTarget>& work, bool by_wall) {
  if (!work) return std::nullopt;
  return by_wall ? work->wall : work->effort;
}

// An empty cell would make a column of them something else to pandas.
std::string_view OrNone(const std::string& variables) {
  return variables.empty() ? std::string_view("none") : variables;
}

// Gap of an incumbent, by duration; none where there is no best or another objective.
std::optional<double> GapOf(const ComparedCase& one, double duration) {
  if (!one.best_cost || one.objective != "fastest") return std::nullopt;
  return duration / *one.best_cost - 1.0;
}

}  // namespace

CsvColumns ComparisonColumns(bool with_bound) {
  CsvColumns columns = {
      {"scenario", kString, "", "name of the experiment"},
      {"objective", kString, "", "what the methods pursued"},
      {"half_steps", kInteger, "", "of the walk"},
      {"method", kString, "", "its name, with the label of its run"},
      {"variables", kString, "", "of the method, none for raw"},
      {"status", kString, "", "how it ended: " + opt::EndingNames()},
      {"certified", kBoolean, "", "whether its walk is proved"},
      {"duration_s", kNumber, "s", "of the walk"},
      {"speedup", kNumber, "1", "duration of raw divided by this one's"},
      {"cost", kNumber, "", "what is compared; empty: raw with another objective than `fastest`"},
      {"best_cost", kNumber, "",
       "of the scenario; empty: no method has a certified walk of its own"},
      {"gap_to_best", kNumber, "1", "(cost - best)/|best|; inf: no certified walk of its own"},
      {"gap_to_reference", kNumber, "1", "as in summary.csv"},
      {"instants", kNumber, "", "instants evaluated by the method"},
      {"effort", kNumber, "", "work of the method; 1 is about a second of one core of 2026"},
      {"collision_queries", kNumber, "", "pairs of bodies that were not culled"},
      {"wall_s", kNumber, "s", "of the method"},
      {"time_to_5pct_s", kNumber, "s",
       "until a certified walk within 5 % of the best cost; empty: never"},
      {"time_to_1pct_s", kNumber, "s",
       "until a certified walk within 1 % of the best cost; empty: never"},
      {"effort_to_5pct", kNumber, "", "effort until then; empty: never"},
      {"effort_to_1pct", kNumber, "", "effort until then; empty: never"},
      {"run", kString, "", "run folder, as it was named; after ./ where it begins like a formula"},
  };
  if (with_bound) columns.push_back({"gap_lipm", kNumber, "1", "as in summary.csv"});
  return columns;
}

CsvFile ComparisonCsv(const Comparison& comparison) {
  const bool with_bound = std::ranges::any_of(comparison.cases, [](const ComparedCase& one) {
    return std::ranges::any_of(
        one.methods, [](const ComparedMethod& m) { return m.record.gap_lipm.has_value(); });
  });
  CsvWriter csv(ComparisonColumns(with_bound));
  for (const ComparedCase& one : comparison.cases) {
    for (const ComparedMethod& method : one.methods) {
      const MethodRecord& record = method.record;
      csv.Cell(one.scenario).Cell(one.objective).Cell(one.half_steps).Cell(record.name);
      csv.Cell(OrNone(record.variables))
          .Cell(Name(record.ending))
          .Cell(record.certified)
          .Cell(record.duration);
      const bool compared = !std::isnan(method.gap);
      csv.Cell(record.speedup).Cell(compared ? std::optional(record.cost) : std::nullopt);
      csv.Cell(one.best_cost).Cell(compared ? std::optional(method.gap) : std::nullopt);
      csv.Cell(record.gap_to_reference);
      csv.Cell(record.instants).Cell(record.effort);
      csv.Cell(record.collision_queries).Cell(record.wall);
      for (bool by_wall : {true, false}) {
        csv.Cell(Spent(method.reached[kFivePercent], by_wall));
        csv.Cell(Spent(method.reached[kOnePercent], by_wall));
      }
      csv.Cell(LooksLikeFormula(record.run) ? "./" + record.run : record.run);
      if (with_bound) csv.Cell(record.gap_lipm);
      csv.EndRow();
    }
  }
  return csv.file();
}

CsvFile PerformanceProfileCsv(const Comparison& comparison) {
  CsvWriter csv({
      {"gap", kNumber, "1", "a method solves a scenario by a certified walk within it"},
      {"work", kString, "", "wall_s or effort"},
      {"method", kString, "", "its name, with the label of its run"},
      {"variables", kString, "", "of the method, none for raw"},
      {"objective", kString, "", "what the method pursued"},
      {"ratio", kNumber, "1", "work divided by the least of any method in that scenario"},
      {"fraction", kNumber, "1", "of the scenarios that were solved within this ratio", "",
       CsvInterpolation::kPiecewiseConstant},
  });
  for (const ProfileCurve& curve : PerformanceProfiles(comparison)) {
    for (const auto& [ratio, fraction] : curve.points) {
      csv.Cell(Nth(kTargets, curve.target));
      csv.Cell(curve.by_wall ? "wall_s" : "effort");
      csv.Cell(curve.method.name).Cell(OrNone(curve.method.variables)).Cell(curve.method.objective);
      csv.Cell(ratio).Cell(fraction).EndRow();
    }
  }
  return csv.file();
}

CsvFile AnytimeCsv(const Comparison& comparison) {
  CsvWriter csv({
      {"scenario", kString, "", "name of the experiment"},
      {"objective", kString, "", "what the method pursued"},
      {"method", kString, "", "its name, with the label of its run"},
      {"variables", kString, "", "of the method"},
      {"wall_s", kNumber, "s", "since the method began"},
      {"instants", kNumber, "", "since the method began"},
      {"effort", kNumber, "", "since the method began"},
      {"duration_s", kNumber, "s", "of the incumbent", "", CsvInterpolation::kPiecewiseConstant},
      {"gap_to_best", kNumber, "1", "by duration; empty: no best, or another objective", "",
       CsvInterpolation::kPiecewiseConstant},
  });
  for (const ComparedCase& one : comparison.cases) {
    for (const ComparedMethod& method : one.methods) {
      const MethodRecord& record = method.record;
      if (record.raw()) continue;
      const auto row = [&](const IncumbentRecord& incumbent) {
        csv.Cell(one.scenario).Cell(one.objective).Cell(record.name).Cell(OrNone(record.variables));
        csv.Cell(incumbent.wall).Cell(incumbent.instants).Cell(incumbent.effort);
        csv.Cell(incumbent.duration).Cell(GapOf(one, incumbent.duration)).EndRow();
      };
      double last = one.methods.front().record.duration;
      row({.duration = last});
      for (const IncumbentRecord& incumbent : record.incumbents) {
        if (incumbent.duration == last) continue;
        last = incumbent.duration;
        row(incumbent);
      }
      row({record.wall, record.instants, record.effort, record.duration});
    }
  }
  return csv.file();
}

CsvFile MeansCsv(const Comparison& comparison) {
  CsvColumns columns = {
      {"method", kString, "", "its name, with the label of its run"},
      {"variables", kString, "", "of the method, none for raw"},
      {"objective", kString, "", "what the method pursued"},
      {"cases", kInteger, "", "scenarios"},
      {"missing", kInteger, "", "scenarios where it was not run"},
      {"certified", kInteger, "", "scenarios that it left with a certified walk"},
      {"failed", kInteger, "", "scenarios where it was interrupted, or has none of its own"},
      {"within_1pct", kInteger, "", "scenarios solved to 1 % of the best cost"},
      {"within_5pct", kInteger, "", "scenarios solved to 5 %"},
      {"ended", kInteger, "", "scenarios with a certified walk of its own, not interrupted"},
      {"speedup_mean", kNumber, "1", "geometric mean; a failure counts as 1"},
  };
  for (const std::string target : {"1pct", "5pct", "end"}) {
    columns.push_back({"time_to_" + target + "_mean_s", kNumber, "s", "shifted geometric mean"});
  }
  for (const std::string target : {"1pct", "5pct", "end"}) {
    columns.push_back({"effort_to_" + target + "_mean", kNumber, "", "shifted geometric mean"});
  }
  CsvWriter csv(columns);
  for (const MethodMeans& mean : Means(comparison)) {
    csv.Cell(mean.method.name).Cell(OrNone(mean.method.variables)).Cell(mean.method.objective);
    csv.Cell(mean.cases).Cell(mean.missing);
    csv.Cell(mean.certified).Cell(mean.failed());
    for (int solved : mean.solved) csv.Cell(solved);
    csv.Cell(mean.speedup);
    for (const RuntimeToTarget& work : mean.work) csv.Cell(work.wall);
    for (const RuntimeToTarget& work : mean.work) csv.Cell(work.effort);
    csv.EndRow();
  }
  return csv.file();
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
                                {"manifest_sha256", run.manifest_sha256},
                                {"not_covered", NotCoveredJson(run.not_covered)}});
  }
  return manifest.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace halfstep
