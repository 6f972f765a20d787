#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "experiments/plot/style.h"
#include "experiments/plot/subjects.h"
#include "experiments/plot/ticks.h"
#include "experiments/tables/csv_reader.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep::plot {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;

constexpr double kBarPitch = 9.5;      // from bar to bar [pt]
constexpr double kLeastEffort = 1e-3;  // work below this reads as this

/// A table of a comparison, whose rows belong to methods.
struct MethodTable {
  CsvTable csv;
  std::vector<std::string> methods;  // of each row: its name, and its variables where they matter
};

MethodTable ReadTable(const fs::path& path) {
  MethodTable table{ReadCsv(path.string()), {}};
  const std::vector<std::string> names = table.csv.Texts("method"),
                                 variables = table.csv.Texts("variables");
  std::map<std::string, std::set<std::string>> all;
  for (size_t i = 0; i < names.size(); ++i) all[names[i]].insert(variables[i]);
  for (size_t i = 0; i < names.size(); ++i) {
    const bool several = all[names[i]].size() > 1;
    table.methods.push_back(several ? names[i] + " " + variables[i] : names[i]);
  }
  return table;
}

// The methods that are drawn, in the order of the table.
std::vector<std::string> Chosen(const MethodTable& table, const std::vector<std::string>& asked,
                                bool with_raw) {
  std::vector<std::string> all;
  const std::vector<std::string> names = table.csv.Texts("method");
  std::vector<std::string> plain;
  for (size_t i = 0; i < names.size(); ++i) {
    if (std::ranges::find(plain, names[i]) == plain.end()) plain.push_back(names[i]);
    const bool wanted = asked.empty() || std::ranges::find(asked, names[i]) != asked.end();
    if (!wanted || (names[i] == "raw" && !with_raw)) continue;
    if (std::ranges::find(all, table.methods[i]) == all.end()) all.push_back(table.methods[i]);
  }
  for (const std::string& name : asked) {
    if (std::ranges::find(plain, name) == plain.end()) {
      throw InputError(
          {"--method: " + Quote(name) + " is not in " + table.csv.path + Suggestion(name, plain)});
    }
  }
  return all;
}

template <typename T>
std::vector<T> Distinct(const std::vector<T>& values) {
  std::vector<T> distinct;
  for (const T& value : values) {
    if (std::ranges::find(distinct, value) == distinct.end()) distinct.push_back(value);
  }
  return distinct;
}

/// One bar: a walk of a scenario.
struct Bar {
  std::string method;
  double duration = 0.0, of_raw = 0.0;  // [s], [1]
  bool certified = false;
};

Panel BarPanel(const std::string& scenario, const std::vector<Bar>& bars) {
  Panel panel{.title = scenario};
  panel.y = {.label = "", .low = 0.0, .high = static_cast<double>(bars.size())};
  panel.x = {.label = "duration over that of raw", .low = 0.0, .high = 1.2};
  panel.height = kBarPitch * static_cast<double>(bars.size());
  for (size_t i = 0; i < bars.size(); ++i) {
    const double middle = static_cast<double>(bars.size() - i) - 0.5;
    const Bar& bar = bars[i];
    Area area{.name = bar.method,
              .corners = {{0.0, middle - 0.33},
                          {bar.of_raw, middle - 0.33},
                          {bar.of_raw, middle + 0.33},
                          {0.0, middle + 0.33}},
              .fill = bar.method == "raw" ? style::Grey(0.75) : style::Lighter(style::kBlue, 0.35),
              .outline = Stroke{.color = style::Grey(0.3), .width = 0.4}};
    if (!bar.certified) area.fill = style::kWhite;
    panel.areas.push_back(std::move(area));
    const std::string text =
        DecimalText(bar.duration, 2) + " s" + (bar.certified ? "" : ", not certified");
    panel.words.push_back({.at = {bar.of_raw, middle}, .text = text, .after = true});
    panel.y.ticks.push_back({middle, bar.method});
  }
  return panel;
}

}  // namespace

std::vector<Row> DurationsRows(const fs::path& comparison,
                               const std::vector<std::string>& methods) {
  const MethodTable table = ReadTable(comparison / "comparison.csv");
  const std::vector<std::string> chosen = Chosen(table, methods, true);
  const std::vector<std::string> scenarios = table.csv.Texts("scenario"),
                                 names = table.csv.Texts("method"),
                                 certified = table.csv.Texts("certified");
  const std::vector<std::optional<double>> durations = table.csv.NumbersOrEmpty("duration_s");
  std::vector<Row> rows;
  for (const std::string& scenario : Distinct(scenarios)) {
    double raw = 0.0;
    for (size_t i = 0; i < names.size(); ++i) {
      if (scenarios[i] == scenario && names[i] == "raw" && durations[i]) raw = *durations[i];
    }
    std::vector<Bar> bars;
    for (size_t i = 0; i < names.size() && raw > 0.0; ++i) {
      const bool drawn = std::ranges::find(chosen, table.methods[i]) != chosen.end();
      if (scenarios[i] != scenario || !drawn || !durations[i]) continue;
      const bool again = std::ranges::find(bars, table.methods[i], &Bar::method) != bars.end();
      if (again) continue;  // of another objective
      bars.push_back(
          {table.methods[i], *durations[i], *durations[i] / raw, certified[i] == "true"});
    }
    if (bars.empty()) continue;
    rows.push_back({BarPanel(scenario, bars)});
  }
  if (rows.empty()) throw InputError({table.csv.path + ": has no walk beside raw ones"});
  double longest = 1.0;
  for (const Row& row : rows) {
    for (const Area& area : row[0].areas) longest = std::max(longest, area.corners[1].x());
  }
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i][0].numbers_below = i + 1 == rows.size();
    rows[i][0].x.high = 1.2 * longest;
  }
  return rows;
}

std::vector<Row> ProfilesRows(const fs::path& comparison, const std::vector<std::string>& methods) {
  const MethodTable table = ReadTable(comparison / "performance_profile.csv");
  const std::vector<std::string> chosen = Chosen(table, methods, false);
  const std::vector<std::string> gaps = table.csv.Texts("gap"), works = table.csv.Texts("work"),
                                 objectives = table.csv.Texts("objective");
  const std::vector<double> ratios = table.csv.Numbers("ratio"),
                            fractions = table.csv.Numbers("fraction");
  if (gaps.empty()) throw InputError({table.csv.path + ": has no method"});
  double most = 2.0;
  for (size_t i = 0; i < ratios.size(); ++i) {
    if (works[i] == "effort" && std::isfinite(ratios[i])) most = std::max(most, ratios[i]);
  }
  const std::string objective = objectives.front();
  std::vector<Row> rows;
  for (const auto& [gap, title] :
       {std::pair{"0.05", "within 5 % of the best"}, std::pair{"0.01", "within 1 % of the best"},
        std::pair{"inf", "ended, certified"}}) {
    Panel panel{.title = title};
    panel.x = {.label = "effort over the least effort of any method",
               .low = 1.0,
               .high = 1.1 * most,
               .logarithmic = true};
    panel.y = {.label = "fraction solved", .low = -0.04, .high = 1.06};
    for (size_t m = 0; m < chosen.size(); ++m) {
      Line line{.name = chosen[m] + "/" + gap,
                .points = {},
                .stroke = style::Nth(static_cast<int>(m)),
                .label = chosen[m]};
      double reached = 0.0;
      for (size_t i = 0; i < ratios.size(); ++i) {
        if (table.methods[i] != chosen[m] || gaps[i] != gap || works[i] != "effort" ||
            objectives[i] != objective || !std::isfinite(ratios[i])) {
          continue;
        }
        if (!line.points.empty()) line.points.emplace_back(ratios[i], reached);
        reached = fractions[i];
        line.points.emplace_back(ratios[i], reached);
      }
      if (line.points.empty()) continue;
      line.points.emplace_back(1.1 * most, reached);
      panel.lines.push_back(std::move(line));
    }
    panel.height = 62.0;
    panel.numbers_below = std::string(gap) == "inf";
    rows.push_back({std::move(panel)});
  }
  return rows;
}

std::vector<Row> AnytimeRows(const fs::path& comparison, const std::vector<std::string>& methods) {
  const MethodTable table = ReadTable(comparison / "anytime.csv");
  const std::vector<std::string> chosen = Chosen(table, methods, false);
  const std::vector<std::string> scenarios = table.csv.Texts("scenario"),
                                 objectives = table.csv.Texts("objective");
  const std::vector<double> efforts = table.csv.Numbers("effort"),
                            durations = table.csv.Numbers("duration_s");
  std::vector<Row> rows;
  double most = 10 * kLeastEffort;
  for (const double effort : efforts) most = std::max(most, effort);
  for (const std::string& scenario : Distinct(scenarios)) {
    Panel panel{.title = scenario};
    Extent extent;
    for (size_t m = 0; m < chosen.size(); ++m) {
      Line line{.name = chosen[m] + "/" + scenario,
                .points = {},
                .stroke = style::Nth(static_cast<int>(m)),
                .label = chosen[m]};
      for (size_t i = 0; i < efforts.size(); ++i) {
        if (table.methods[i] != chosen[m] || scenarios[i] != scenario ||
            objectives[i] != objectives.front()) {
          continue;
        }
        const double effort = std::max(efforts[i], kLeastEffort);
        if (!line.points.empty()) line.points.emplace_back(effort, line.points.back().y());
        line.points.emplace_back(effort, durations[i]);
      }
      if (line.points.empty()) continue;
      extent.Add(line.points, 1);
      panel.lines.push_back(std::move(line));
    }
    if (panel.lines.empty()) continue;
    panel.x = {.label = "effort", .low = kLeastEffort, .high = 1.2 * most, .logarithmic = true};
    panel.y = extent.WithMargin("duration [s]");
    rows.push_back({std::move(panel)});
  }
  if (rows.empty()) throw InputError({table.csv.path + ": has no method"});
  for (size_t i = 0; i < rows.size(); ++i) rows[i][0].numbers_below = i + 1 == rows.size();
  return rows;
}

}  // namespace halfstep::plot
