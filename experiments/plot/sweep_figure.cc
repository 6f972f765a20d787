#include <algorithm>
#include <map>

#include "experiments/plot/style.h"
#include "experiments/plot/subjects.h"
#include "experiments/tables/csv_reader.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;

constexpr double kPanelHeight = 90.0;  // [pt]
constexpr size_t kMostLines = 8;       // of values of the second key, evenly chosen

/// A key that varies in a sweep.
struct SweptKey {
  std::string key;
  std::vector<std::string> values;  // different ones, in the order of the table

  bool numbers() const {
    return std::ranges::all_of(values, [](const std::string& value) {
      return ParseNumber(value).kind == NumberText::Kind::kNumber;
    });
  }
};

// The columns between `case` and `method` with more than one value.
std::vector<SweptKey> KeysOf(const CsvTable& table) {
  std::vector<SweptKey> keys;
  for (const std::string& column : table.header) {
    if (column == "case") continue;
    if (column == "method") break;
    SweptKey key{column, {}};
    for (const std::string& value : table.Texts(column)) {
      if (std::ranges::find(key.values, value) == key.values.end()) key.values.push_back(value);
    }
    if (key.values.size() > 1) keys.push_back(std::move(key));
  }
  return keys;
}

// "clearance 0.005 m": the last part of a key and its unit, with a value.
std::string Valued(const std::string& key, const std::string& value) {
  return key.substr(key.rfind('.') + 1) + " " + value;
}

// Values of the second key of which lines are drawn: all, or some evenly.
std::vector<std::string> DrawnValues(const std::vector<std::string>& values) {
  if (values.size() <= kMostLines) return values;
  std::vector<std::string> drawn;
  for (size_t i = 0; i < kMostLines; ++i) {
    drawn.push_back(values[i * (values.size() - 1) / (kMostLines - 1)]);
  }
  return drawn;
}

}  // namespace

std::vector<Row> SweepRows(const std::filesystem::path& sweep,
                           const std::vector<std::string>& methods) {
  const CsvTable table = ReadCsv((sweep / "runs.csv").string());
  const std::vector<SweptKey> keys = KeysOf(table);
  const auto across = std::ranges::find_if(keys, &SweptKey::numbers);
  if (across == keys.end()) {
    throw InputError({table.path + ": no key with numbers varies (valid: one does)"});
  }
  const auto second = std::ranges::find_if(
      keys, [&](const SweptKey& key) { return key.key != across->key && key.values.size() > 1; });
  const std::vector<std::string> names = table.Texts("method"),
                                 certified = table.Texts("certified");
  const std::vector<std::optional<double>> durations = table.NumbersOrEmpty("duration_s");
  const std::vector<double> x = table.Numbers(across->key);
  const std::vector<std::string> seconds =
      second == keys.end() ? std::vector<std::string>{} : table.Texts(second->key);
  std::vector<std::string> all;
  for (const std::string& name : names) {
    if (name != "none" && std::ranges::find(all, name) == all.end()) all.push_back(name);
  }
  for (const std::string& name : methods) {
    if (std::ranges::find(all, name) == all.end()) {
      throw InputError(
          {"--method: " + Quote(name) + " is not in " + table.path + Suggestion(name, all)});
    }
  }
  const std::vector<std::string> lines_of =
      second == keys.end() ? std::vector<std::string>{""} : DrawnValues(second->values);
  Extent extent;
  std::vector<Row> rows;
  for (const std::string& method : methods.empty() ? all : methods) {
    Panel panel{.title = method};
    for (size_t k = 0; k < lines_of.size(); ++k) {
      Line line{.name = method + "/" + lines_of[k],
                .points = {},
                .stroke = style::Nth(static_cast<int>(k))};
      if (!lines_of[k].empty()) line.label = Valued(second->key, lines_of[k]);
      std::map<double, double> best;  // the shortest where other keys vary, too
      for (size_t i = 0; i < names.size(); ++i) {
        if (names[i] != method || certified[i] != "true" || !durations[i]) continue;
        if (!seconds.empty() && seconds[i] != lines_of[k]) continue;
        const auto [at, is_new] = best.emplace(x[i], *durations[i]);
        at->second = std::min(at->second, *durations[i]);
      }
      for (const auto& [key, duration] : best) {
        line.points.emplace_back(key, duration);
        panel.marks.push_back({.at = {key, duration}, .radius = 1.1, .fill = line.stroke.color});
      }
      extent.Add(line.points, 1);
      if (!line.points.empty()) panel.lines.push_back(std::move(line));
    }
    if (!panel.lines.empty()) rows.push_back({std::move(panel)});
  }
  if (rows.empty()) throw InputError({table.path + ": has no certified walk"});
  Extent values;
  for (const double value : x) values.Add(value);
  for (size_t i = 0; i < rows.size(); ++i) {
    Panel& panel = rows[i][0];
    panel.x = values.WithMargin(across->key, 0.04, 1e-9);
    panel.y = extent.WithMargin("duration [s]", 0.08);
    panel.height = kPanelHeight;
    panel.numbers_below = i + 1 == rows.size();
  }
  return rows;
}

}  // namespace halfstep::plot
