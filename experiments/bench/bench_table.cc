#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "experiments/bench/bench_folder.h"
#include "experiments/tables/csv_reader.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

// The cases of one cell.
struct Cell {
  int cases = 0, solved = 0, certified = 0, crouched = 0;
  std::map<std::string, int> not_solved;  // by status
  std::vector<double> footsteps, smoothed, effort;
};

double Median(std::vector<double> values) {
  std::ranges::sort(values);
  const size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

std::string CellText(const Cell& cell) {
  std::string text = Formatted("  %3d/%-3d", cell.solved, cell.cases);
  text += cell.footsteps.empty() ? "    -" : Formatted(" %4.4g", Median(cell.footsteps));
  return text +
         (cell.smoothed.empty() ? "       - " : Formatted(" %6.1f s", Median(cell.smoothed)));
}

// In the order in which they first come.
std::vector<std::string> Distinct(const std::vector<std::string>& texts) {
  std::vector<std::string> distinct;
  for (const std::string& text : texts) {
    if (std::ranges::find(distinct, text) == distinct.end()) distinct.push_back(text);
  }
  return distinct;
}

}  // namespace

std::string BenchTable(const std::string& bench_csv) {
  const CsvTable table = ParseCsv(bench_csv, "bench.csv");
  const auto kinds = table.Texts("kind"), planners = table.Texts("planner"),
             difficulties = table.Texts("difficulty"), solved = table.Texts("solved"),
             certified = table.Texts("certified"), statuses = table.Texts("status");
  const auto footsteps = table.Numbers("footsteps"), effort = table.Numbers("effort"),
             crouch = table.Numbers("crouch_m");
  const auto smoothed = table.NumbersOrEmpty("smoothed_s");
  const std::vector<std::string> columns = Distinct(planners);
  std::vector<std::pair<std::string, std::string>> rows;  // kind and difficulty
  for (const std::string& kind : Distinct(kinds)) {
    for (const std::string& difficulty : Distinct(difficulties))
      rows.emplace_back(kind, difficulty);
    rows.emplace_back(kind, "all");
  }
  rows.emplace_back("all", "all");
  std::map<std::pair<std::string, std::string>, std::map<std::string, Cell>> cells;
  for (size_t i = 0; i < kinds.size(); ++i) {
    for (const auto& row :
         {std::pair{kinds[i], difficulties[i]}, std::pair{kinds[i], std::string("all")},
          std::pair{std::string("all"), std::string("all")}}) {
      Cell& cell = cells[row][planners[i]];
      ++cell.cases;
      cell.effort.push_back(effort[i]);
      if (solved[i] != "true") {
        ++cell.not_solved[statuses[i]];
        continue;
      }
      ++cell.solved;
      cell.certified += certified[i] == "true" ? 1 : 0;
      cell.crouched += crouch[i] > 0.0 ? 1 : 0;
      cell.footsteps.push_back(footsteps[i]);
      if (smoothed[i]) cell.smoothed.push_back(*smoothed[i]);
    }
  }
  std::string text = Formatted("%-9s %-10s", "kind", "difficulty");
  for (const std::string& planner : columns) text += Formatted("  %-21s", planner.c_str());
  for (const auto& [kind, difficulty] : rows) {
    text += Formatted("\n%-9s %-10s", kind.c_str(), difficulty.c_str());
    for (const std::string& planner : columns) text += CellText(cells[{kind, difficulty}][planner]);
  }
  text +=
      "\neach: solved, and of what is solved the medians of footsteps and of the smoothed walk\n";
  for (const std::string& planner : columns) {
    const Cell& all = cells[{"all", "all"}][planner];
    text += planner + Formatted(": %d smoothed walks certified, %d crouched; median effort %.3g",
                                all.certified, all.crouched, Median(all.effort));
    for (const auto& [status, count] : all.not_solved) {
      text += "; " + status + " " + std::to_string(count);
    }
    text += "\n";
  }
  return text;
}

}  // namespace halfstep
