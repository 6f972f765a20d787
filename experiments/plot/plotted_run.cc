#include "experiments/plot/plotted_run.h"

#include <algorithm>
#include <cmath>

#include "experiments/config/folder_name.h"
#include "experiments/plot/ticks.h"
#include "experiments/report/report.h"
#include "experiments/tables/run_record.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep::plot {
namespace {

namespace fs = std::filesystem;

std::string SoleColumn(Side side, const char* what) {
  return std::string(halfstep::Name(side)) + "_foot_" + what;
}

const MethodRecord& ShortestCertified(const RunRecord& record) {
  const MethodRecord* best = &record.methods.front();
  for (const MethodRecord& method : record.methods) {
    if (method.certified && (!best->certified || method.duration < best->duration)) best = &method;
  }
  return *best;
}

const MethodRecord& Named(const RunRecord& record, const std::string& name) {
  std::vector<std::string> names;
  for (const MethodRecord& method : record.methods) {
    if (method.name == name) return method;
    names.push_back(method.name);
  }
  throw InputError(
      {"--method: " + Quote(name) + " is not in " + record.run + Suggestion(name, names)});
}

std::optional<double> DemandedZmp(const fs::path& folder) {
  const fs::path path = folder / "certificate.csv";
  if (!fs::exists(path)) return std::nullopt;
  const CsvTable table = ReadCsv(path.string());
  const std::vector<std::string> families = table.Texts("family");
  const auto zmp = std::ranges::find(families, "zmp");
  if (zmp == families.end()) return std::nullopt;
  const double demanded = table.Numbers("demanded")[static_cast<size_t>(zmp - families.begin())];
  return std::isfinite(demanded) ? std::optional(demanded) : std::nullopt;
}

PlottedWalk ReadWalk(const fs::path& run, const MethodRecord& method) {
  PlottedWalk walk{.method = method.name,
                   .duration = method.duration,
                   .folder = run / MethodFolder(method.name),
                   .rows = {},
                   .t = {}};
  walk.rows = ReadCsv((walk.folder / "trajectory.csv").string());
  walk.t = walk.rows.Numbers("t_s");
  if (walk.t.size() < 2) throw InputError({walk.rows.path + ": has less than two rows"});
  walk.demanded_zmp = DemandedZmp(walk.folder);
  return walk;
}

std::vector<Eigen::Vector2d> Joined(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(x.size());
  for (size_t i = 0; i < x.size(); ++i) points.emplace_back(x[i], y[i]);
  return points;
}

}  // namespace

std::vector<Eigen::Vector2d> PlottedWalk::OverTime(const std::string& column, double factor) const {
  std::vector<Eigen::Vector2d> points = Joined(t, rows.Numbers(column));
  for (Eigen::Vector2d& p : points) p.y() *= factor;
  return points;
}

std::vector<Eigen::Vector2d> PlottedWalk::Path(const std::string& x, const std::string& y,
                                               double factor) const {
  std::vector<Eigen::Vector2d> points = Joined(rows.Numbers(x), rows.Numbers(y));
  for (Eigen::Vector2d& p : points) p *= factor;
  return points;
}

std::vector<Pose2> PlottedWalk::Soles(Side side) const {
  const std::vector<double> x = rows.Numbers(SoleColumn(side, "x_m")),
                            y = rows.Numbers(SoleColumn(side, "y_m")),
                            yaw = rows.Numbers(SoleColumn(side, "yaw_rad"));
  std::vector<Pose2> soles;
  for (size_t i = 0; i < x.size(); ++i) soles.push_back({x[i], y[i], yaw[i]});
  return soles;
}

std::vector<bool> PlottedWalk::Stands(Side side) const {
  std::vector<bool> stands;
  for (const std::string& support : rows.Texts("support")) {
    stands.push_back(support == "both" || support == halfstep::Name(side));
  }
  return stands;
}

std::vector<Pose2> PlottedWalk::Footprints(Side side) const {
  const std::vector<Pose2> soles = Soles(side);
  const std::vector<bool> stands = Stands(side);
  std::vector<Pose2> places;
  for (size_t i = 0; i < soles.size(); ++i) {
    if (stands[i] && (i == 0 || !stands[i - 1])) places.push_back(soles[i]);
  }
  return places;
}

std::string PlottedWalk::Title() const { return method + ", " + DecimalText(duration, 2) + " s"; }

double PlottedRun::duration() const {
  double longest = 0.0;
  for (const PlottedWalk& walk : walks) longest = std::max(longest, walk.duration);
  return longest;
}

PlottedRun ReadPlottedRun(const fs::path& run, const std::vector<std::string>& methods,
                          const Toolbox& tools) {
  const RunRecord record = ReadRun(run.string());
  const ExperimentConfig config = LoadConfig((run / "config.yaml").string(), {}, tools);
  PlottedRun result{.folder = run,
                    .name = record.scenario,
                    .place = PlaceOfRun(run, tools),
                    .joint_speed_scale = config.smoothing.limits.joint_speed_scale,
                    .walks = {}};
  if (methods.empty()) result.walks.push_back(ReadWalk(run, ShortestCertified(record)));
  for (const std::string& name : methods) {
    result.walks.push_back(ReadWalk(run, Named(record, name)));
  }
  return result;
}

std::vector<Row> Compared(std::vector<Panel> panels, double high) {
  const Panel& first = panels.front();
  const double aspect = (first.y.high - first.y.low) / (first.x.high - first.x.low);
  if (aspect > high) {
    for (size_t i = 1; i < panels.size(); ++i) panels[i].y.label = "";
    return {std::move(panels)};
  }
  std::vector<Row> rows;
  for (size_t i = 0; i < panels.size(); ++i) {
    panels[i].numbers_below = i + 1 == panels.size();
    rows.push_back({std::move(panels[i])});
  }
  return rows;
}

void Extent::Add(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

void Extent::Add(const std::vector<Eigen::Vector2d>& points, int k) {
  for (const Eigen::Vector2d& p : points) Add(p[k]);
}

Axis Extent::WithMargin(const std::string& label, double share, double least) const {
  const double from = low <= high ? low : 0.0, to = low <= high ? high : 1.0;
  const double length = std::max(to - from, least), middle = 0.5 * (from + to);
  return {.label = label,
          .low = middle - (0.5 + share) * length,
          .high = middle + (0.5 + share) * length};
}

}  // namespace halfstep::plot
