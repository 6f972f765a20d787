#include "experiments/sweep/sweep_tables.h"

#include <algorithm>

#include "experiments/tables/csv_writer.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

using enum CsvType;

bool HoldsTime(const std::string& column) {
  return column == "wall_s" || column == "time_to_first_improvement_s";
}

// A key that varies: numbers when all its values are.
CsvColumn ColumnOf(const SweepAxis& axis) {
  const bool numbers =
      std::all_of(axis.values.begin(), axis.values.end(), [](const std::string& value) {
        return ParseNumber(value).kind == NumberText::Kind::kNumber;
      });
  return {axis.key, numbers ? kNumber : kString, "", "key of the config, as it was set"};
}

CsvColumns RunsColumns(const SweepConfig& sweep) {
  CsvColumns columns = {{"case", kString, "", "number of the case and hash of what it sets"}};
  for (const SweepAxis& axis : sweep.vary) columns.push_back(ColumnOf(axis));
  for (const CsvColumn& column : SummaryColumns(sweep.parts)) {
    if (!HoldsTime(column.name)) columns.push_back(column);
  }
  columns.push_back({"message", kString, "", "of the method, or why there is no walk"});
  return columns;
}

CsvColumns TimingsColumns() {
  CsvColumns columns = {{"case", kString, "", "as in runs.csv"},
                        {"method", kString, "", "as in runs.csv"}};
  for (const CsvColumn& column : SummaryColumns()) {
    if (HoldsTime(column.name)) columns.push_back(column);
  }
  columns.push_back({"case_wall_s", kNumber, "s", "time of the whole case"});
  return columns;
}

// What a case without a walk says in a column; only numbers may be left out.
void AddNothing(const CsvColumn& column, CsvWriter* csv) {
  switch (column.type) {
    case kString:
      csv->Cell("none");
      break;
    case kBoolean:
      csv->Cell(false);
      break;
    case kInteger:
      csv->Cell(0);
      break;
    case kNumber:
      csv->Empty();
      break;
  }
}

void BeginRow(const SweepConfig& sweep, const SweepCase& one, CsvWriter* csv) {
  csv->Cell(one.id);
  for (size_t i = 0; i < sweep.vary.size(); ++i) {
    const std::string& value = one.overrides[i].value;
    const CsvColumn column = ColumnOf(sweep.vary[i]);
    if (column.type == kNumber) {
      csv->Cell(ParseNumber(value).value);
    } else {
      csv->Cell(value.empty() ? "none" : value);
    }
  }
}

}  // namespace

CsvFile EmptyRuns(const SweepConfig& sweep) { return CsvWriter(RunsColumns(sweep)).file(); }

CsvFile EmptyTimings() { return CsvWriter(TimingsColumns()).file(); }

SweepTables TablesOf(const SweepConfig& sweep, const SweepCase& one, const ExperimentRun& run,
                     double wall) {
  CsvWriter runs(RunsColumns(sweep)), timings(TimingsColumns());
  for (size_t row = 0; row < run.runs().size(); ++row) {
    const MethodRun& method = run.runs()[row];
    BeginRow(sweep, one, &runs);
    timings.Cell(one.id).Cell(method.method);
    AddSummaryRow(run.evaluator(), run.runs(), row, sweep.parts,
                  [&](const CsvColumn& column) -> CsvWriter& {
                    return HoldsTime(column.name) ? timings : runs;
                  });
    runs.Cell(method.result.message.empty() ? "none" : method.result.message).EndRow();
    timings.Cell(wall).EndRow();
  }
  return {runs.file(), timings.file()};
}

SweepTables TablesOfFailure(const SweepConfig& sweep, const SweepCase& one,
                            const std::string& status, const std::string& message, double wall) {
  CsvWriter runs(RunsColumns(sweep)), timings(TimingsColumns());
  BeginRow(sweep, one, &runs);
  timings.Cell(one.id).Cell("none");
  for (const CsvColumn& column : SummaryColumns(sweep.parts)) {
    CsvWriter& csv = HoldsTime(column.name) ? timings : runs;
    if (column.name == "status") {
      csv.Cell(status);
    } else {
      AddNothing(column, &csv);
    }
  }
  runs.Cell(message).EndRow();
  timings.Cell(wall).EndRow();
  return {runs.file(), timings.file()};
}

}  // namespace halfstep
