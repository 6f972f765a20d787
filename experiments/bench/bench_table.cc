#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "experiments/bench/bench_folder.h"
#include "experiments/tables/csv_reader.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

// The cases of one line.
struct Line {
  int cases = 0, solved = 0, certified = 0, crouched = 0;
  std::vector<double> footsteps, smoothed, effort;
};

std::string MedianCell(std::vector<double> values, const char* format) {
  if (values.empty()) return Formatted("%10s", "-");
  std::ranges::sort(values);
  const size_t n = values.size();
  return Formatted(format, 0.5 * (values[(n - 1) / 2] + values[n / 2]));
}

}  // namespace

std::string BenchTable(const std::string& bench_csv) {
  const CsvTable table = ParseCsv(bench_csv, "bench.csv");
  const auto kinds = table.Texts("kind"), planners = table.Texts("planner"),
             solved = table.Texts("solved"), certified = table.Texts("certified");
  const auto difficulties = table.Numbers("difficulty"), footsteps = table.Numbers("footsteps"),
             effort = table.Numbers("effort"), crouch = table.Numbers("crouch_m");
  const auto smoothed = table.NumbersOrEmpty("smoothed_s");
  const auto rank = [](const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) - names.begin();
  };
  std::map<std::tuple<std::ptrdiff_t, int, std::ptrdiff_t>, Line> lines;
  for (size_t i = 0; i < kinds.size(); ++i) {
    Line& line = lines[{rank(kinds, kinds[i]), static_cast<int>(difficulties[i]),
                        rank(planners, planners[i])}];
    ++line.cases;
    line.effort.push_back(effort[i]);
    if (solved[i] != "true") continue;
    ++line.solved;
    line.certified += certified[i] == "true" ? 1 : 0;
    line.crouched += crouch[i] > 0.0 ? 1 : 0;
    line.footsteps.push_back(footsteps[i]);
    if (smoothed[i]) line.smoothed.push_back(*smoothed[i]);
  }
  std::string text =
      Formatted("%-9s %-10s %-14s %9s %9s %9s %9s %10s %10s\n", "kind", "difficulty", "planner",
                "solved", "certified", "crouched", "footsteps", "smoothed", "effort");
  for (const auto& [key, line] : lines) {
    const auto& [kind, difficulty, planner] = key;
    text +=
        Formatted("%-9s %-10d %-14s %5d/%-3d %9d %9d ", kinds[static_cast<size_t>(kind)].c_str(),
                  difficulty, planners[static_cast<size_t>(planner)].c_str(), line.solved,
                  line.cases, line.certified, line.crouched) +
        MedianCell(line.footsteps, "%9.4g") + MedianCell(line.smoothed, "%9.1f s") +
        MedianCell(line.effort, "%11.3f") + "\n";
  }
  return text +
         "footsteps and seconds of the smoothed walk: medians of what is solved; effort: of "
         "all, 1 is about a second of one core\n";
}

}  // namespace halfstep
