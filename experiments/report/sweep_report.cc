#include "experiments/report/sweep_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "experiments/report/report_page.h"
#include "experiments/report/sweep_grid.h"
#include "experiments/tables/ending_words.h"
#include "experiments/tables/json_file.h"
#include "opt/solvers/ending.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// What the page's data may have, so that the page stays below 5 MB.
constexpr size_t kMostBytes = 3'600'000;
constexpr size_t kMostMessageBytes = 300'000;
constexpr size_t kBytesOfCase = 20, kBytesOfAxis = 4,
                 kBytesOfRow = 40;  // as JSON, also where there is no row

// Numbers for texts that come again and again.
class Dictionary {
 public:
  int Index(const std::string& text) {
    const auto [found, is_new] = index_.try_emplace(text, static_cast<int>(texts_.size()));
    if (is_new) texts_.push_back(text);
    return found->second;
  }
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::unordered_map<std::string, int> index_;
  std::vector<std::string> texts_;
};

// Columns of runs.csv that the page shows.
struct Runs {
  explicit Runs(const CsvTable& table)
      : method(table.Texts("method")),
        status(table.Texts("status")),
        certified(table.Texts("certified")),
        margin_name(table.Texts("worst_margin_name")),
        message(table.Texts("message")),
        duration(table.NumbersOrEmpty("duration_s")),
        margin(table.NumbersOrEmpty("worst_margin")),
        iterations(table.NumbersOrEmpty("iterations")),
        effort(table.NumbersOrEmpty("effort")) {
    if (table.Has("gap_lipm")) gap_lipm = table.NumbersOrEmpty("gap_lipm");
  }

  // Whether the method has a proved walk of its own.
  bool Solved(size_t row) const {
    const std::optional<opt::Ending> ending = opt::EndingOf(status[row]);
    return certified[row] == "true" && ending && HasOwnResult(*ending);
  }

  std::vector<std::string> method, status, certified, margin_name, message;
  std::vector<std::optional<double>> duration, margin, iterations, effort;
  std::vector<std::optional<double>> gap_lipm;  // empty: no case knows a bound
};

json NumberJson(const std::optional<double>& value, int digits) {
  return value && std::isfinite(*value) ? json(Shortened(*value, digits)) : json(nullptr);
}

json AxesJson(const SweepGrid& grid, const Thinning& thinning) {
  json axes = json::array();
  for (size_t k = 0; k < grid.axes.size(); ++k) {
    const SweptKeys& axis = grid.axes[k];
    const auto stride = static_cast<size_t>(thinning.stride[k]);
    json values = json::array(), at = json::array();
    for (size_t i = 0; i < axis.values.size(); i += stride) values.push_back(axis.values[i]);
    for (const size_t i : thinning.kept) at.push_back(axis.at[i] / thinning.stride[k]);
    axes.push_back({{"keys", axis.keys},
                    {"values", std::move(values)},
                    {"stride", stride},
                    {"of", axis.values.size()},
                    {"at", std::move(at)}});
  }
  return axes;
}

// Rows by method and status: how many, and how many of them have a proved walk of their own.
json CountsJson(const Runs& runs) {
  std::map<std::string, std::map<std::string, std::pair<int, int>>> counts;
  for (size_t row = 0; row < runs.method.size(); ++row) {
    auto& [all, solved] = counts[runs.method[row]][runs.status[row]];
    ++all;
    solved += runs.Solved(row) ? 1 : 0;
  }
  json result = json::object();
  for (const auto& [method, statuses] : counts) {
    for (const auto& [status, count] : statuses) {
      result[method][status] = {count.first, count.second};
    }
  }
  return result;
}

// A column a quantity for each method; null: no row, or no number.
json EmptyTable(size_t cases, bool with_bound) {
  json table = json::object();
  for (const char* column :
       {"status", "solved", "duration", "margin", "margin_of", "iterations", "effort", "message"}) {
    table[column] = json(std::vector<json>(cases));
  }
  if (with_bound) table["gap_lipm"] = json(std::vector<json>(cases));
  return table;
}

void FillTables(const Runs& runs, const SweepGrid& grid, const Thinning& thinning, json* page) {
  Dictionary methods, statuses, families, messages;
  for (const std::string& method : runs.method) {
    if (method != "none") methods.Index(method);
  }
  std::vector<int> place(grid.ids.size(), -1);
  for (size_t i = 0; i < thinning.kept.size(); ++i) {
    place[thinning.kept[i]] = static_cast<int>(i);
  }
  std::vector<json> tables(std::max<size_t>(1, methods.texts().size()),
                           EmptyTable(thinning.kept.size(), !runs.gap_lipm.empty()));
  size_t message_bytes = 0;
  for (size_t row = 0; row < runs.method.size(); ++row) {
    const int at = place[grid.case_of_row[row]];
    if (at < 0) continue;
    const auto one = static_cast<size_t>(at);
    const bool no_walk = runs.method[row] == "none";  // which every method failed to shorten
    const bool solved = runs.Solved(row);
    const auto first = no_walk ? 0 : static_cast<size_t>(methods.Index(runs.method[row]));
    for (size_t k = first; k < (no_walk ? tables.size() : first + 1); ++k) {
      json& table = tables[k];
      table["status"][one] = statuses.Index(runs.status[row]);
      table["solved"][one] = solved ? 1 : 0;
      table["duration"][one] = NumberJson(runs.duration[row], 6);
      table["margin"][one] = NumberJson(runs.margin[row], 3);
      table["margin_of"][one] = families.Index(runs.margin_name[row]);
      table["iterations"][one] = NumberJson(runs.iterations[row], 6);
      table["effort"][one] = NumberJson(runs.effort[row], 6);
      if (!runs.gap_lipm.empty()) table["gap_lipm"][one] = NumberJson(runs.gap_lipm[row], 6);
      if (solved || message_bytes > kMostMessageBytes) continue;
      const size_t before = messages.texts().size();
      table["message"][one] = messages.Index(runs.message[row]);
      message_bytes += 8 + (messages.texts().size() > before ? runs.message[row].size() : 0);
    }
  }
  (*page)["methods"] = methods.texts();
  (*page)["statuses"] = statuses.texts();
  (*page)["families"] = families.texts();
  (*page)["messages"] = messages.texts();
  (*page)["tables"] = tables;
}

std::vector<std::string> KeysOf(const json& manifest, const fs::path& path) {
  if (manifest.value("kind", "") != "sweep" || !manifest.contains("keys") ||
      !manifest["keys"].is_array()) {
    throw InputError({path.string() + ": is the manifest of no sweep"});
  }
  std::vector<std::string> keys;
  for (const json& key : manifest["keys"]) keys.push_back(key.is_string() ? key : json(""));
  return keys;
}

json MeaningsJson() {
  json meanings = {{"no_plan", "The planner found no way to the goal."},
                   {"on_no_step_area", "A footstep is on an area that must not be stepped on."},
                   {"error", "A mistake of halfstep; the message says which."},
                   {"crashed", "The program that did the case died."}};
  for (const opt::Ending ending : opt::kEndings) meanings[Name(ending)] = FullMeaning(ending);
  return meanings;
}

// Of statuses of which that is to be said.
json NotRepeatableJson() {
  json words = json::object();
  for (const opt::Ending ending : opt::kEndings) {
    if (!NotRepeatable(ending, "").empty()) words[Name(ending)] = NotRepeatable(ending, "");
  }
  return words;
}

}  // namespace

std::string SweepReport(const fs::path& folder, const fs::path& page_path) {
  const fs::path path = folder / "manifest.json";
  const json manifest = ReadJsonObject(path);
  const std::vector<std::string> keys = KeysOf(manifest, path);
  if (!fs::exists(folder / "runs.csv")) {
    throw InputError({folder.string() + ": has no runs.csv, since not all cases are done (valid: a "
                                        "sweep that came to its end)"});
  }
  const CsvTable table = ReadCsv((folder / "runs.csv").string());
  const SweepGrid grid = GridOf(table, keys);
  const Runs runs(table);
  const size_t methods = std::set<std::string>(runs.method.begin(), runs.method.end()).size();
  const Thinning thinning = ThinnedTo(
      grid, kMostBytes / (kBytesOfCase + kBytesOfAxis * grid.axes.size() + kBytesOfRow * methods));
  json page = {
      {"kind", "sweep"},
      {"name", manifest.value("name", "")},
      {"version", manifest.value("version", "")},
      {"commit", manifest.value("commit", "")},
      {"cases", grid.ids.size()},
      {"rows", runs.method.size()},
      {"counts", CountsJson(runs)},
      {"meanings", MeaningsJson()},
      {"not_repeatable", NotRepeatableJson()},
      {"axes", AxesJson(grid, thinning)},
      {"constants", grid.constants},
      {"ids", json::array()},
      {"reports", json::array()},
      {"place", fs::proximate(fs::absolute(folder) / "cases", fs::absolute(page_path).parent_path())
                    .generic_string()}};
  for (size_t i = 0; i < thinning.kept.size(); ++i) {
    const std::string& id = grid.ids[thinning.kept[i]];
    page["ids"].push_back(id);
    if (fs::exists(folder / "cases" / id / "report.html")) page["reports"].push_back(i);
  }
  FillTables(runs, grid, thinning, &page);
  return SweepPage(page);
}

}  // namespace halfstep
