#include "experiments/config/footsteps_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/regular_file.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/files/yaml_fields.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr std::uint64_t kMostTableBytes = 16 << 20;
constexpr size_t kMostFootsteps = 10000;
constexpr size_t kMostComplaints = 30;
constexpr double kFarthest = 1000.0;                 // from the world's origin [m]
constexpr double kMostTurn = 20 * std::numbers::pi;  // of a yaw [rad]

// A cell of a table, and the column at which it begins, from 1 in bytes.
struct Cell {
  std::string text;
  int column = 1;
};

// The cells of a line; quotes around a whole cell are left out.
std::vector<Cell> CellsOf(std::string_view line) {
  std::vector<Cell> cells;
  for (size_t begin = 0;;) {
    const size_t end = std::min(line.find(',', begin), line.size());
    std::string_view text = line.substr(begin, end - begin);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
      text = text.substr(1, text.size() - 2);
    }
    cells.push_back({std::string(text), static_cast<int>(begin) + 1});
    if (end == line.size()) return cells;
    begin = end + 1;
  }
}

/// What a number of a footstep may be.
struct Range {
  double least, most;
  const char* valid;
};
constexpr Range kPlaceRange = {-kFarthest, kFarthest, "-1000 … 1000 m"};
constexpr Range kYawRange = {-kMostTurn, kMostTurn, "-3600 … 3600°"};
constexpr Range kHeightRange = {0.01, 1.0, "0.01 … 1 m"};
constexpr Range kDurationRange = {0.6, 6.0, "0.6 … 6 s"};
constexpr Range kRestRange = {0.0, 3600.0, "0 … 3600 s"};
constexpr Range kCrouchRange = {0.0, 0.5, "0 … 0.5 m"};

/// Reads a table of footsteps.
class FootstepTable {
 public:
  explicit FootstepTable(const std::string& path) : path_(path) {}

  FiledFootsteps Read() {
    std::string text = ReadRegularFile(path_, kMostTableBytes);
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    std::vector<Pose2> start;
    for (size_t begin = 0; begin < text.size();) {
      const size_t end = std::min(text.find('\n', begin), text.size());
      std::string_view line = std::string_view(text).substr(begin, end - begin);
      if (line.ends_with('\r')) line.remove_suffix(1);
      begin = end + 1;
      ++line_;
      if (line_ == 1) {
        ReadHeader(CellsOf(line));
      } else if (!line.empty()) {
        ReadRow(CellsOf(line), &start);
      }
      if (complaints_.lines().size() > kMostComplaints) break;
    }
    if (line_ == 0) complaints_.Add(path_, 0, 0, "footsteps", "the file is empty");
    if (complaints_.empty() && read_.steps.empty()) {
      complaints_.Add(path_, line_, 1, "foot", "there are no footsteps (valid: at least one row)");
    }
    if (complaints_.empty() && !start.empty()) CheckStart(start);
    complaints_.ThrowIfAny();
    return std::move(read_);
  }

 private:
  void Complain(int column, const std::string& key, const std::string& what) {
    complaints_.Add(path_, line_, column, key, what);
  }

  void ReadHeader(const std::vector<Cell>& cells) {
    static const std::vector<std::string> kNames = {"footstep",
                                                    "foot",
                                                    "x_m",
                                                    "y_m",
                                                    "z_m",
                                                    "yaw_rad",
                                                    "yaw_deg",
                                                    "via_height_m",
                                                    "duration_s",
                                                    "rest_s",
                                                    "rest_on_one_foot_s",
                                                    "crouch_m"};
    width_ = cells.size();
    for (size_t i = 0; i < cells.size(); ++i) {
      if (!columns_.emplace(cells[i].text, i).second) {
        Complain(cells[i].column, cells[i].text, "is there twice (valid: once)");
      } else if (std::ranges::find(kNames, cells[i].text) == kNames.end()) {
        Complain(cells[i].column, cells[i].text,
                 "no such column" + Suggestion(cells[i].text, kNames));
      }
    }
    for (const char* name : {"foot", "x_m", "y_m"}) {
      if (!columns_.contains(name)) Complain(1, name, "no such column (valid: it is required)");
    }
    if (columns_.contains("yaw_rad") == columns_.contains("yaw_deg")) {
      Complain(1, "yaw_rad", "a column is needed, of yaw_rad or yaw_deg (valid: one of them)");
    }
    complaints_.ThrowIfAny();
  }

  void ReadRow(const std::vector<Cell>& cells, std::vector<Pose2>* start) {
    if (cells.size() != width_) {
      Complain(1, "footstep",
               std::to_string(cells.size()) + " cells for " + std::to_string(width_) + " columns");
      return;
    }
    const bool stands = columns_.contains("footstep") && cells[columns_["footstep"]].text == "0";
    FiledFootstep step;
    const Cell& foot = cells[columns_["foot"]];
    if (foot.text != "left" && foot.text != "right") {
      Complain(foot.column, "foot", Quote(foot.text) + " (valid: left, right)");
    }
    step.foot = foot.text == "right" ? Side::kRight : Side::kLeft;
    step.X_WF.x = Number(cells, "x_m", kPlaceRange).value_or(0.0);
    step.X_WF.y = Number(cells, "y_m", kPlaceRange).value_or(0.0);
    const bool degrees = columns_.contains("yaw_deg");
    step.X_WF.yaw = Number(cells, degrees ? "yaw_deg" : "yaw_rad", kYawRange).value_or(0.0);
    step.z = Number(cells, "z_m", kPlaceRange);
    const double beside = Nth(yaws_, Opposite(step.foot)).value_or(step.X_WF.yaw);
    if (std::abs(step.X_WF.yaw - beside) > std::numbers::pi * (1.0 + 1e-9)) {
      Complain(cells[columns_[degrees ? "yaw_deg" : "yaw_rad"]].column,
               degrees ? "yaw_deg" : "yaw_rad",
               "is more than half a turn from the yaw of the foot beside it: yaws are not wrapped");
    }
    Nth(yaws_, step.foot) = step.X_WF.yaw;
    if (stands) {
      if (!read_.steps.empty()) {
        Complain(1, "footstep", "0 after a footstep (valid: the feet at the start come first)");
      }
      if (static_cast<size_t>(Index(step.foot)) != start->size()) {
        Complain(foot.column, "foot", "the start has left and right, in this order");
      }
      start->push_back(step.X_WF);
      if (step.z) read_.start_heights.push_back(*step.z);
      return;
    }
    step.via_height = Number(cells, "via_height_m", kHeightRange);
    step.duration = Number(cells, "duration_s", kDurationRange);
    step.rest = Number(cells, "rest_s", kRestRange);
    step.rest_on_one_foot = Number(cells, "rest_on_one_foot_s", kRestRange);
    step.crouch = Number(cells, "crouch_m", kCrouchRange);
    if (read_.steps.empty() && step.rest.value_or(0.0) > 0.0) {
      Complain(cells[columns_["rest_s"]].column, "rest_s",
               "of the first footstep, with which the walk begins (valid: 0 there)");
    }
    read_.steps.push_back(step);
    if (read_.steps.size() > kMostFootsteps) Complain(1, "footstep", "more than 10000 footsteps");
  }

  // The number in a column, in SI units; none without the column, where the cell is empty, and,
  // after a complaint, where it is no such number.
  std::optional<double> Number(const std::vector<Cell>& cells, const std::string& name,
                               const Range& range) {
    const auto found = columns_.find(name);
    if (found == columns_.end()) return std::nullopt;
    const Cell& cell = cells[found->second];
    const bool may_be_empty = name == "z_m" || name == "via_height_m" || name == "duration_s" ||
                              name == "rest_s" || name == "rest_on_one_foot_s" ||
                              name == "crouch_m";
    if (cell.text.empty() && may_be_empty) return std::nullopt;
    const NumberText number = ParseNumber(cell.text);
    if (number.kind != NumberText::Kind::kNumber) {
      Complain(cell.column, name, NumberMistake(cell.text) + " (valid: a finite decimal number)");
      return std::nullopt;
    }
    const double value = IsDegrees(name) ? DegreesToRadians(number.extended) : number.value;
    if (value >= range.least && value <= range.most) return value;
    Complain(cell.column, name, cell.text + " is out of range (valid: " + range.valid + ")");
    return std::nullopt;
  }

  void CheckStart(const std::vector<Pose2>& start) {
    if (start.size() != 2) {
      line_ = 2;
      Complain(1, "footstep", "one foot at the start (valid: left and right, or neither)");
      return;
    }
    read_.start = start;
  }

  const std::string& path_;
  Complaints complaints_;
  int line_ = 0;
  size_t width_ = 0;
  std::map<std::string, size_t> columns_;
  std::array<std::optional<double>, 2> yaws_;  // of the feet where they stand, by Index(Side)
  FiledFootsteps read_;
};

/// A StepTarget as it is written.
struct StepTarget {
  Pose2 pose;
  int leg = 0;
};

void DeclareTarget(Fields& fields, StepTarget* target) {
  fields.Group("pose", {.meaning = "of the sole", .required = true}, [&](Fields& f) {
    const NumberSpec place{
        .meaning = "", .unit = "m", .min = -kFarthest, .max = kFarthest, .required = true};
    f.Number("x", &target->pose.x, place);
    f.Number("y", &target->pose.y, place);
    f.Number("theta", &target->pose.yaw,
             {.meaning = "", .unit = "rad", .min = -kMostTurn, .max = kMostTurn, .required = true});
  });
  fields.Integer("leg", &target->leg,
                 {.meaning = "0 right, 1 left", .min = 0, .max = 1, .required = true});
}

double NearestYaw(double yaw, double beside) {
  return yaw - 2.0 * std::numbers::pi * std::round((yaw - beside) / (2.0 * std::numbers::pi));
}

FiledFootsteps ReadTargets(const std::string& path, bool relative,
                           const std::optional<std::vector<Pose2>>& start) {
  std::vector<StepTarget> targets;
  ReadYaml(path, {}, [&](Fields& fields) {
    fields.List("footsteps",
                {.meaning = "", .required = true, .min_items = 1, .max_items = kMostFootsteps},
                &targets, DeclareTarget);
    // What PlanFootsteps and ExecFootsteps say besides.
    std::string ignored;
    for (const char* key : {"result", "costs", "final_eps", "planning_time", "expanded_states",
                            "feedback_frequency"}) {
      fields.Text(key, &ignored, {});
    }
  });
  FiledFootsteps read;
  std::array<Pose2, 2> at = {Pose2{}, Pose2{}};
  if (start) at = {start->front(), start->back()};
  for (const StepTarget& target : targets) {
    const Side foot = target.leg == 1 ? Side::kLeft : Side::kRight;
    const Pose2& beside = Nth(at, Opposite(foot));
    Pose2 X_WF = relative ? beside * target.pose : target.pose;
    X_WF.yaw = NearestYaw(X_WF.yaw, beside.yaw);
    Nth(at, foot) = X_WF;
    read.steps.push_back({foot, X_WF, std::nullopt, std::nullopt});
  }
  return read;
}

}  // namespace

FiledFootsteps ReadFootsteps(const std::string& path, bool relative,
                             const std::optional<std::vector<Pose2>>& start) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".csv") return FootstepTable(path).Read();
  if (ending == ".yaml" || ending == ".yml") return ReadTargets(path, relative, start);
  throw InputError({path + ": is no file of footsteps by its name (valid: .csv, a table; .yaml, "
                           "humanoid_nav_msgs/StepTarget[])"});
}

}  // namespace halfstep
