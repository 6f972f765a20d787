#include "experiments/report/report_walk.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "experiments/report/robot_zmp.h"
#include "experiments/tables/csv_reader.h"
#include "experiments/tables/json_file.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kFine = 1e-5;    // of lengths and angles [m, rad]
constexpr double kSpeeds = 1e-4;  // of speeds [m/s, rad/s]
// Of a number that is drawn; sums of differences stay exact in JavaScript's doubles.
constexpr double kMostSteps = 4e15;

// Of rows `period` apart every so-manieth is shown.
size_t StrideOf(double period, double spacing) {
  const double ratio = std::ceil(spacing / std::max(period, 1e-6) - 1e-6);
  return static_cast<size_t>(std::max(1.0, ratio));
}

// Every stride-th row, and the last one.
std::vector<size_t> RowsToShow(const std::vector<double>& times, double spacing) {
  std::vector<size_t> rows;
  const size_t stride = StrideOf(times.size() > 2 ? times[1] - times[0] : spacing, spacing);
  for (size_t i = 0; i + 1 < times.size(); i += stride) rows.push_back(i);
  rows.push_back(times.size() - 1);
  return rows;
}

size_t PlaceOf(const std::string& path, const std::vector<std::string>& header,
               const std::string& column) {
  const auto found = std::ranges::find(header, column);
  if (found == header.end()) throw InputError({path + ":1: no column '" + column + "'"});
  return static_cast<size_t>(found - header.begin());
}

double NumberIn(const std::string& path, size_t row, const std::string& column,
                const std::string& cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error == std::errc() && end == cell.data() + cell.size()) return value;
  throw InputError({path + Formatted(":%zu: ", row + 2) + column + ": not a number"});
}

// How far apart the rows of a trajectory.csv of more than two are [s].
double PeriodOf(const std::string& path, double otherwise) {
  std::vector<double> times;
  EachCsvRow(path, [&](const auto& header, const auto& cells) {
    times.push_back(NumberIn(path, times.size(), "t_s", cells[PlaceOf(path, header, "t_s")]));
    return times.size() < 3;
  });
  return times.size() > 2 ? times[1] - times[0] : otherwise;
}

json ColumnJson(const std::vector<double>& values, const std::vector<size_t>& rows, double step) {
  json deltas = json::array();
  long before = 0;
  for (size_t row : rows) {
    const double steps = values[row] / step;
    if (!(std::abs(steps) <= kMostSteps)) {
      deltas.push_back(nullptr);
      continue;
    }
    const long now = std::lround(steps);
    deltas.push_back(now - before);
    before = now;
  }
  return {{"step", step}, {"delta", std::move(deltas)}};
}

std::vector<double> Differences(const std::vector<double>& times,
                                const std::vector<double>& values) {
  std::vector<double> speeds(times.size(), 0.0);
  for (size_t i = 0; i < times.size() && times.size() > 1; ++i) {
    const size_t from = i == 0 ? 0 : i - 1, to = std::min(i + 1, times.size() - 1);
    speeds[i] = (values[to] - values[from]) / (times[to] - times[from]);
  }
  return speeds;
}

bool IsSpeed(const std::string& column) {
  return column.ends_with("_m_s") || column.ends_with("_rad_s");
}

// What is read of a trajectory.csv, and which of its rows are shown.
struct ShownRows {
  CsvTable table;
  std::vector<double> times;
  std::vector<size_t> rows;
};

ShownRows ReadRows(const fs::path& path, double spacing) {
  ShownRows shown{.table = ReadCsv(path.string()), .times = {}, .rows = {}};
  shown.times = shown.table.Numbers("t_s");
  if (shown.times.empty()) throw InputError({path.string() + ": no rows"});
  shown.rows = RowsToShow(shown.times, spacing);
  return shown;
}

std::string SupportOf(const ShownRows& shown) {
  std::string support;
  const std::vector<std::string> supports = shown.table.Texts("support");
  for (const size_t row : shown.rows)
    support += supports[row].empty() ? '?' : supports[row].front();
  return support;
}

json TrajectoryJson(const fs::path& path, double spacing) {
  const ShownRows shown = ReadRows(path, spacing);
  json columns = json::object();
  for (const std::string& column : shown.table.header) {
    if (column == "support" || column.starts_with("com_v") || column.starts_with("com_a")) continue;
    const std::vector<double> values = shown.table.Numbers(column);
    columns[column] = ColumnJson(values, shown.rows, IsSpeed(column) ? kSpeeds : kFine);
    if (!column.starts_with("q_") || !column.ends_with("_rad")) continue;
    const std::string joint = column.substr(2, column.size() - 6);
    columns["speed_" + joint + "_rad_s"] =
        ColumnJson(Differences(shown.times, values), shown.rows, kSpeeds);
  }
  return {{"columns", std::move(columns)}, {"support", SupportOf(shown)}};
}

// The waist rises where levels change, and only there.
bool OnOneLevel(const CsvTable& trajectory) {
  const std::vector<double> z = trajectory.Numbers("waist_z_m");
  return std::ranges::all_of(z, [&](double height) { return height == z.front(); });
}

json CellJson(const std::string& cell) {
  if (cell.empty()) return nullptr;
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool is_number = error == std::errc() && end == cell.data() + cell.size();
  return is_number && std::isfinite(value) ? json(Shortened(value, 6)) : json(cell);
}

// {least, begin_s, end_s} of each family of a certified walk: what is proved of all times, and the
// interval where that is least.
json ProvedJson(const fs::path& certificate) {
  const CsvTable table = ReadCsv(certificate.string());
  const std::vector<double> begin = table.Numbers("begin_s"), end = table.Numbers("end_s"),
                            margin = table.Numbers("margin"), bound = table.Numbers("bound");
  const std::vector<std::string> families = table.Texts("family");
  json proved = json::object();
  for (size_t i = 0; i < families.size(); ++i) {
    const double least = margin[i] - bound[i];
    if (!std::isfinite(least)) continue;
    json& one = proved[families[i]];
    if (one.is_object() && one["least"].get<double>() <= least) continue;
    one = {{"least", least}, {"begin_s", begin[i]}, {"end_s", end[i]}};
  }
  return proved;
}

}  // namespace

json MotionJson(const fs::path& trajectory, const std::vector<std::string>& columns,
                double spacing) {
  const std::string path = trajectory.string();
  const size_t stride = StrideOf(PeriodOf(path, spacing), spacing);
  std::vector<size_t> places, rows;  // of the columns; 0, 1, 2, …
  std::vector<std::vector<double>> shown(columns.size());
  std::string support;
  const auto show = [&](size_t row, const std::vector<std::string>& cells) {
    for (size_t i = 0; i < columns.size(); ++i) {
      shown[i].push_back(NumberIn(path, row, columns[i], cells[places[i + 1]]));
    }
    const std::string& carries = cells[places[0]];
    support += carries.empty() ? '?' : carries.front();
    rows.push_back(rows.size());
  };
  std::vector<std::string> last;
  size_t next = 0;
  EachCsvRow(path, [&](const auto& header, const auto& cells) {
    if (next == 0) {
      places = {PlaceOf(path, header, "support")};
      for (const std::string& column : columns) places.push_back(PlaceOf(path, header, column));
    }
    last = cells;
    if (next++ % stride == 0) {
      show(next - 1, cells);
      last.clear();
    }
    return true;
  });
  if (next == 0) throw InputError({path + ": no rows"});
  if (!last.empty()) show(next - 1, last);
  json drawn = json::object();
  for (size_t i = 0; i < columns.size(); ++i) {
    drawn[columns[i]] = ColumnJson(shown[i], rows, kFine);
    shown[i] = {};
  }
  return {{"columns", std::move(drawn)}, {"support", support}};
}

json RowsJson(const fs::path& csv) {
  const CsvTable table = ReadCsv(csv.string());
  json rows = json::array();
  for (const std::vector<std::string>& cells : table.rows) {
    json row = json::object();
    for (size_t i = 0; i < cells.size(); ++i) row[table.header[i]] = CellJson(cells[i]);
    rows.push_back(std::move(row));
  }
  return rows;
}

json WalkJson(const fs::path& folder, double spacing) {
  const fs::path overlaps = folder / "overlaps.csv";
  const json certificate = ReadJsonObject(folder / "certificate.json");
  json walk = TrajectoryJson(folder / "trajectory.csv", spacing);
  walk["half_steps"] = RowsJson(folder / "half_steps.csv");
  walk["overlaps"] = fs::exists(overlaps) ? RowsJson(overlaps) : json::array();
  for (const char* key :
       {"verdict", "message", "statement", "demanded", "limits", "statements", "not_covered"}) {
    if (!certificate.contains(key)) {
      throw InputError({(folder / "certificate.json").string() + ": no '" + key + "'"});
    }
    walk["certificate"][key] = certificate[key];
  }
  if (certificate["verdict"] == "certified") {
    walk["certificate"]["proved"] = ProvedJson(folder / "certificate.csv");
  }
  if (certificate.contains("tube")) walk["certificate"]["tube"] = certificate["tube"];
  return walk;
}

json WalkJson(const RobotModel& robot, const fs::path& folder, double spacing) {
  json walk = WalkJson(folder, spacing);
  const ShownRows shown = ReadRows(folder / "trajectory.csv", spacing);
  const std::vector<RobotZmp> zmps = RobotZmps(robot, shown.table);
  const auto add = [&](const std::string& column, Eigen::Vector2d RobotZmp::*of, int axis) {
    std::vector<double> values;
    for (const RobotZmp& zmp : zmps) values.push_back((zmp.*of)[axis]);
    walk["columns"][column] = ColumnJson(values, shown.rows, kFine);
  };
  add("zmp_robot_x_m", &RobotZmp::zmp, 0);
  add("zmp_robot_y_m", &RobotZmp::zmp, 1);
  if (!OnOneLevel(shown.table)) {
    add("tilt_x", &RobotZmp::tilt, 0);
    add("tilt_y", &RobotZmp::tilt, 1);
  }
  return walk;
}

}  // namespace halfstep
