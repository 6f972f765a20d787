#include "experiments/sweep_tables.h"

#include <algorithm>

#include "experiments/csv_reader.h"
#include "experiments/csv_writer.h"

namespace halfstep {
namespace {

bool HoldsTime(const std::string& column) {
  return column == "wall_s" || column == "time_to_first_improvement_s";
}

std::vector<std::string> RunsColumns(const SweepConfig& sweep) {
  std::vector<std::string> columns = {"case"};
  for (const SweepAxis& axis : sweep.vary) columns.push_back(axis.key);
  for (const std::string& column : SummaryColumns()) {
    if (!HoldsTime(column)) columns.push_back(column);
  }
  columns.emplace_back("message");
  return columns;
}

std::vector<std::string> TimingsColumns() {
  std::vector<std::string> columns = {"case", "method"};
  for (const std::string& column : SummaryColumns()) {
    if (HoldsTime(column)) columns.push_back(column);
  }
  columns.emplace_back("case_wall_s");
  return columns;
}

// What a case without a walk says in a column: cells of numbers are empty, and no cell changes what
// type its column is read as.
std::string NothingIn(const std::string& column) {
  if (column == "method" || column == "worst_margin_name") return "none";
  if (column == "certified") return "false";
  const bool counts =
      column == "iterations" || column == "margin_evaluations" || column == "collision_queries";
  return counts ? "0" : "";
}

void BeginRow(const SweepCase& one, CsvWriter* csv) {
  csv->Cell(one.id);
  for (const YamlOverride& set : one.overrides) csv->Cell(set.value);
}

}  // namespace

std::string SweepRunsHeader(const SweepConfig& sweep) {
  return CsvWriter(RunsColumns(sweep)).text();
}

std::string SweepTimingsHeader() { return CsvWriter(TimingsColumns()).text(); }

SweepTables TablesOf(const SweepConfig& sweep, const SweepCase& one, const ExperimentRun& run,
                     double wall) {
  const CsvTable summary = ParseCsv(SummaryCsv(run.evaluator(), run.runs()), "summary.csv");
  CsvWriter runs(RunsColumns(sweep)), timings(TimingsColumns());
  for (size_t row = 0; row < summary.rows.size(); ++row) {
    BeginRow(one, &runs);
    timings.Cell(one.id).Cell(run.runs()[row].method);
    for (size_t column = 0; column < summary.header.size(); ++column) {
      CsvWriter& csv = HoldsTime(summary.header[column]) ? timings : runs;
      csv.Cell(summary.rows[row][column]);
    }
    runs.Cell(run.runs()[row].result.message).EndRow();
    timings.Cell(wall).EndRow();
  }
  return {runs.text(), timings.text()};
}

SweepTables TablesOfFailure(const SweepConfig& sweep, const SweepCase& one,
                            const std::string& status, const std::string& message, double wall) {
  CsvWriter runs(RunsColumns(sweep)), timings(TimingsColumns());
  BeginRow(one, &runs);
  timings.Cell(one.id).Cell(NothingIn("method"));
  for (const std::string& column : SummaryColumns()) {
    CsvWriter& csv = HoldsTime(column) ? timings : runs;
    csv.Cell(column == "status" ? status : NothingIn(column));
  }
  runs.Cell(message).EndRow();
  timings.Cell(wall).EndRow();
  return {runs.text(), timings.text()};
}

}  // namespace halfstep
