#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "experiments/plot/style.h"
#include "experiments/plot/subjects.h"
#include "experiments/tables/margin_columns.h"
#include "smoothing/margins/margin.h"
#include "wpg/files/input_error.h"

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;

constexpr size_t kMostFamilies = 8;   // those with the least slack
constexpr double kShownScales = 8.0;  // above what is demanded, at most

/// What is proved of one family along a walk.
struct Proved {
  MarginFamily family = MarginFamily::kZmp;
  double demanded = 0.0;
  double least = 1e300;          // of all times [its unit]
  std::vector<Vector2d> points;  // (t, margin at least), a step an interval
  std::vector<Vector2d> found;   // (t, margin): rows of trajectory.csv, else the middle of each

  double slack() const { return (least - demanded) / Scale(family); }
};

/// A unit as figures have it.
struct ShownUnit {
  std::string text;
  double factor = 1.0;
};

ShownUnit UnitOf(MarginFamily family) {
  const std::string unit(Unit(family));
  if (unit == "m") return {"mm", 1e3};
  if (unit == "s") return {"ms", 1e3};
  return {unit == "1" ? "" : unit, 1.0};
}

std::string WordsOf(MarginFamily family) {
  switch (family) {
    case MarginFamily::kZmp:
      return "ZMP of the pendulum";
    case MarginFamily::kZmpRobot:
      return "ZMP of the robot";
    case MarginFamily::kSelfClearance:
      return "own bodies";
    case MarginFamily::kClearance:
      return "obstacles";
    default: {
      std::string name(halfstep::Name(family));
      std::ranges::replace(name, '_', ' ');
      return name;
    }
  }
}

// A row of a certificate: of some statements of a family, each at least so much.
struct ProvedRow {
  double begin, end, least;
};

// The least of the rows at each time, as steps; nan where there is none.
std::vector<Vector2d> LeastOverTime(const std::vector<ProvedRow>& rows) {
  std::map<double, std::vector<std::pair<double, bool>>> changes;  // values that begin, or end
  for (const ProvedRow& row : rows) {
    if (!(row.begin < row.end)) continue;
    changes[row.begin].emplace_back(row.least, true);
    changes[row.end].emplace_back(row.least, false);
  }
  std::vector<Vector2d> points;
  std::multiset<double> under_way;
  for (auto at = changes.begin(); at != changes.end(); ++at) {
    for (const auto& [least, begins] : at->second) {
      if (begins) under_way.insert(least);
    }
    for (const auto& [least, begins] : at->second) {
      if (!begins) under_way.erase(under_way.find(least));
    }
    const auto next = std::next(at);
    if (next == changes.end()) break;
    const double least = under_way.empty() ? std::nan("") : *under_way.begin();
    points.emplace_back(at->first, least);
    points.emplace_back(next->first, least);
  }
  return points;
}

std::map<std::string, Proved> ReadProved(const PlottedWalk& walk) {
  const std::filesystem::path path = walk.folder / "certificate.csv";
  if (!std::filesystem::exists(path)) {
    throw InputError(
        {"--what: margins: " + walk.method + " has no certificate (`halfstep certify` makes it)"});
  }
  const CsvTable table = ReadCsv(path.string());
  const std::vector<double> begin = table.Numbers("begin_s"), end = table.Numbers("end_s"),
                            margin = table.Numbers("margin"), bound = table.Numbers("bound"),
                            demanded = table.Numbers("demanded");
  const std::vector<std::string> names = table.Texts("family");
  std::map<std::string, MarginFamily> families;
  for (int f = 0; f < kNumMarginFamilies; ++f) {
    const auto family = static_cast<MarginFamily>(f);
    families.emplace(halfstep::Name(family), family);
  }
  std::map<std::string, Proved> proved;
  std::map<std::string, std::vector<ProvedRow>> rows;
  for (size_t i = 0; i < names.size(); ++i) {
    const auto family = families.find(names[i]);
    if (family == families.end() || !std::isfinite(demanded[i])) continue;
    Proved& one = proved[names[i]];
    one.family = family->second;
    one.demanded = demanded[i];
    const double least = margin[i] - bound[i];
    if (std::isfinite(least)) {
      one.least = std::min(one.least, least);
      rows[names[i]].push_back({begin[i], end[i], least});
    }
    one.found.emplace_back(0.5 * (begin[i] + end[i]),
                           std::isfinite(margin[i]) ? margin[i] : std::nan(""));
  }
  std::erase_if(proved, [](const auto& entry) { return entry.second.least > 1e299; });
  for (auto& [name, one] : proved) {
    one.points = LeastOverTime(rows[name]);
    const std::optional<std::string> column = TrajectoryColumnOf(one.family);
    if (column && walk.rows.Has(*column)) one.found = walk.OverTime(*column);
  }
  return proved;
}

// The families with the least slack in any walk, in the order of certificates.
std::vector<std::string> Tightest(const std::vector<std::map<std::string, Proved>>& walks) {
  std::map<std::string, double> slacks;
  for (const auto& walk : walks) {
    for (const auto& [name, proved] : walk) {
      const auto [at, is_new] = slacks.emplace(name, proved.slack());
      at->second = std::min(at->second, proved.slack());
    }
  }
  std::vector<std::string> names;
  for (const auto& [name, slack] : slacks) names.push_back(name);
  std::ranges::stable_sort(names, {}, [&](const std::string& name) { return slacks.at(name); });
  if (names.size() > kMostFamilies) names.resize(kMostFamilies);
  return names;
}

Stroke WalkStroke(size_t i) {
  if (i == 0) return {.color = style::kBlue, .width = 0.9};
  return {.color = style::kVermilion, .width = 0.9, .dash = {3.0, 1.2}};
}

// What was found at instants over what is proved about them.
void AddWalk(const PlottedWalk& walk, const Proved& proved, const std::string& name, size_t i,
             Panel* panel, Extent* extent) {
  const double factor = UnitOf(proved.family).factor;
  const double most = factor * (proved.demanded + kShownScales * Scale(proved.family));
  const auto scaled = [&](std::vector<Vector2d> points) {
    for (Vector2d& p : points) {
      p.y() *= factor;
      if (p.y() <= most) extent->Add(p.y());
    }
    return points;
  };
  const Stroke stroke = WalkStroke(i);
  panel->lines.push_back({.name = walk.method + "/" + name + " proved",
                          .points = scaled(proved.points),
                          .stroke = {.color = style::Lighter(stroke.color, 0.4), .width = 0.5}});
  panel->lines.push_back({.name = walk.method + "/" + name,
                          .points = scaled(proved.found),
                          .stroke = stroke,
                          .label = walk.method});
  extent->Add(factor * proved.least);
  extent->Add(factor * proved.demanded);
}

Panel FamilyPanel(const PlottedRun& run, const std::vector<std::map<std::string, Proved>>& walks,
                  const std::string& name) {
  Panel panel;
  Extent extent;
  double demanded = 0.0;
  for (size_t i = 0; i < walks.size(); ++i) {
    const auto found = walks[i].find(name);
    if (found == walks[i].end()) continue;
    const Proved& proved = found->second;
    const auto [unit, factor] = UnitOf(proved.family);
    AddWalk(run.walks[i], proved, name, i, &panel, &extent);
    demanded = factor * proved.demanded;
    panel.title = WordsOf(proved.family) + (unit.empty() ? "" : " [" + unit + "]");
  }
  panel.x = {.label = "time [s]", .low = 0.0, .high = run.duration()};
  panel.y = extent.WithMargin("", 0.1);
  panel.areas.push_back({.name = "below what is demanded",
                         .corners = {{0.0, panel.y.low},
                                     {run.duration(), panel.y.low},
                                     {run.duration(), demanded},
                                     {0.0, demanded}},
                         .fill = style::Grey(0.82)});
  panel.height = 42.0;
  return panel;
}

}  // namespace

std::vector<Row> MarginsRows(const PlottedRun& run) {
  std::vector<std::map<std::string, Proved>> walks;
  for (const PlottedWalk& walk : run.walks) walks.push_back(ReadProved(walk));
  const std::vector<std::string> names = Tightest(walks);
  if (names.empty()) throw InputError({"--what: margins: nothing is demanded of this walk"});
  std::vector<Row> rows;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i % 2 == 0) rows.emplace_back();
    Panel panel = FamilyPanel(run, walks, names[i]);
    panel.numbers_below = i + 2 >= names.size();
    for (Line& line : panel.lines) {
      if (i > 0) line.label = "";
      if (i == 0 && !run.compares())
        line.label = line.name.ends_with("proved") ? "proved" : "sampled";
    }
    rows.back().push_back(std::move(panel));
  }
  return rows;
}

}  // namespace halfstep::plot
