#include <algorithm>

#include "experiments/plot/style.h"
#include "experiments/plot/subjects.h"
#include "wpg/files/input_error.h"

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;

constexpr double kSeen = 0.2999;  // margins beyond the horizon, 0.3 m, are not told apart [m]

std::vector<Vector2d> Against(const CsvTable& table, const std::string& column, double factor,
                              double most) {
  const std::vector<double> x = table.Numbers("duration_s");
  const std::vector<std::optional<double>> y = table.NumbersOrEmpty(column);
  std::vector<Vector2d> points;
  for (size_t i = 0; i < x.size(); ++i) {
    const bool seen = y[i] && *y[i] < most;
    points.emplace_back(x[i], seen ? factor * *y[i] : std::nan(""));
  }
  std::ranges::stable_sort(points, {}, [](const Vector2d& p) { return p.x(); });
  return points;
}

void AddCurve(const CsvTable& table, const std::string& column, const std::string& label,
              double factor, double most, Panel* panel, Extent* extent) {
  const Stroke stroke = style::Nth(static_cast<int>(panel->lines.size()) + 1);
  Line line{.name = column,
            .points = Against(table, column, factor, most),
            .stroke = stroke,
            .label = label};
  extent->Add(line.points, 1);
  for (const Vector2d& p : line.points)
    panel->marks.push_back({.at = p, .radius = 1.2, .fill = stroke.color});
  panel->lines.push_back(std::move(line));
}

}  // namespace

std::vector<Row> ParetoRows(const PlottedRun& run) {
  std::vector<Row> rows;
  for (const PlottedWalk& walk : run.walks) {
    const std::filesystem::path path = walk.folder / "pareto.csv";
    if (!std::filesystem::exists(path)) {
      throw InputError({"--what: pareto: " + walk.method +
                        " has no pareto.csv (valid: a method with the program `pareto`)"});
    }
    const CsvTable table = ReadCsv(path.string());
    Panel margins, slack;
    Extent durations, centimetres, slacks;
    for (const double duration : table.Numbers("duration_s")) durations.Add(duration);
    centimetres.Add(0.0);
    slacks.Add(0.0);
    AddCurve(table, "zmp_m", "ZMP", 100.0, kSeen, &margins, &centimetres);
    AddCurve(table, "self_clearance_m", "own bodies", 100.0, kSeen, &margins, &centimetres);
    AddCurve(table, "clearance_m", "obstacles", 100.0, kSeen, &margins, &centimetres);
    AddCurve(table, "least_slack", "", 1.0, 1e300, &slack, &slacks);
    for (Panel* panel : {&margins, &slack}) {
      panel->x = durations.WithMargin("duration of the walk, at most [s]", 0.03);
      panel->height = 80.0;
    }
    margins.y = centimetres.WithMargin("least margin [cm]", 0.05);
    slack.y = slacks.WithMargin("least slack [scales]", 0.05);
    slack.height = 50.0;
    margins.y.low = slack.y.low = 0.0;
    margins.numbers_below = false;
    if (run.compares()) margins.title = walk.Title();
    rows.push_back({std::move(margins)});
    rows.push_back({std::move(slack)});
  }
  return rows;
}

}  // namespace halfstep::plot
