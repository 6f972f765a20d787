#include "experiments/checker/trajectory.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "experiments/tables/csv_reader.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/files/yaml_node.h"

namespace halfstep::checker {
namespace {

constexpr double kMost = 1e6;  // of angles [rad] and their derivatives
constexpr const char* kTimes[] = {"t_s", "t", "time", "time_s"};

[[noreturn]] void Refuse(const std::string& file, const std::string& what) {
  throw InputError({file + ": " + what});
}

// A column's joint and which derivative of it; order −1: of none that is known.
struct Column {
  std::string joint;
  int order = -1;
};
Column ColumnOf(const std::string& name) {
  const auto between = [&](const std::string& before, const std::string& after, int order) {
    if (!name.starts_with(before) || !name.ends_with(after)) return Column{};
    if (name.size() <= before.size() + after.size()) return Column{};
    return Column{name.substr(before.size(), name.size() - before.size() - after.size()), order};
  };
  for (const Column& column :
       {between("q_", "_rad", 0), between("v_", "_rad_s", 1), between("a_", "_rad_s2", 2),
        between("", "_vel", 1), between("", "_acc", 2)}) {
    if (column.order >= 0) return column;
  }
  return {name, 0};
}

// Joints in the order in which they are first named.
class Collected {
 public:
  Collected(std::string file, const JointNames& names) : names_(names) {
    trajectory_.file = std::move(file);
  }

  bool Knows(const std::string& joint) const {
    if (std::ranges::find(names_.others, joint) != names_.others.end()) {
      Refuse(trajectory_.file, joint +
                                   ": is not revolute, or its axis or limits are missing in the "
                                   "URDF (valid: revolute and continuous joints)");
    }
    return std::ranges::find(names_.turning, joint) != names_.turning.end();
  }
  void LeaveOut(const std::string& column) { trajectory_.unread.push_back(column); }

  void Add(const std::string& joint, int order, std::vector<double> values) {
    auto [at, is_new] = rows_[static_cast<size_t>(order)].emplace(joint, std::move(values));
    if (!is_new) Refuse(trajectory_.file, joint + ": is told twice");
    if (std::ranges::find(trajectory_.joints, joint) == trajectory_.joints.end()) {
      trajectory_.joints.push_back(joint);
    }
  }

  Trajectory Finished(std::vector<double> times) {
    trajectory_.times = std::move(times);
    if (trajectory_.times.size() < 2) Refuse(trajectory_.file, "fewer than two knots");
    for (size_t k = 0; k < trajectory_.times.size(); ++k) {
      const double t = trajectory_.times[k];
      if (!std::isfinite(t) || (k > 0 && !(t > trajectory_.times[k - 1]))) {
        Refuse(trajectory_.file, Formatted("knot %zu: time %g s (valid: growing times)", k + 1, t));
      }
    }
    if (rows_[0].empty()) {
      Refuse(trajectory_.file,
             "names no revolute joint of the robot (valid: " + Joined(names_.turning) + ")");
    }
    trajectory_.q = Filled(0);
    trajectory_.v = Filled(1);
    trajectory_.a = Filled(2);
    return std::move(trajectory_);
  }

 private:
  Eigen::MatrixXd Filled(size_t order) const {
    static const char* const kWhat[] = {"position", "velocity", "acceleration"};
    if (rows_[order].empty()) return {};
    Eigen::MatrixXd filled(std::ssize(trajectory_.joints), std::ssize(trajectory_.times));
    for (Eigen::Index j = 0; j < filled.rows(); ++j) {
      const std::string& joint = trajectory_.joints[static_cast<size_t>(j)];
      const auto row = rows_[order].find(joint);
      if (row == rows_[order].end()) {
        Refuse(trajectory_.file, joint + ": has no " + kWhat[order] + ", as other joints have");
      }
      for (Eigen::Index k = 0; k < filled.cols(); ++k) {
        filled(j, k) = row->second[static_cast<size_t>(k)];
        if (std::abs(filled(j, k)) <= kMost) continue;  // no NaN either
        Refuse(trajectory_.file, joint + Formatted(": knot %d: ", static_cast<int>(k + 1)) +
                                     kWhat[order] + " is no number (valid: within 1e6)");
      }
    }
    return filled;
  }

  const JointNames& names_;
  Trajectory trajectory_;
  std::map<std::string, std::vector<double>> rows_[3];
};

Trajectory FromCsv(const std::string& path, const JointNames& names) {
  const CsvTable table = ReadCsv(path);
  if (table.header.empty() || std::ranges::find(kTimes, table.header[0]) == std::end(kTimes)) {
    Refuse(path, "the first column is no time (valid: t_s, t, time, time_s)");
  }
  Collected all(path, names);
  for (size_t i = 1; i < table.header.size(); ++i) {
    const Column column = ColumnOf(table.header[i]);
    if (!all.Knows(column.joint)) {
      all.LeaveOut(table.header[i]);
      continue;
    }
    all.Add(column.joint, column.order, table.Numbers(table.header[i]));
  }
  return all.Finished(table.Numbers(table.header[0]));
}

// A JointTrajectory as ROS prints it.
class MessageReader {
 public:
  MessageReader(const std::string& path, const std::string& text, const JointNames& names)
      : complaints_(path), all_(path, names) {
    constexpr YamlLimits kLimits{
        .bytes = size_t{1} << 28, .values = 30'000'000, .aliased = 200'000};
    root_ = ParseYaml(text, "", &complaints_, kLimits);
  }

  Trajectory Read() {
    const std::vector<std::string> names = Names();
    const YamlNode& points = Needed(root_, "points");
    std::vector<double> times;
    std::vector<std::vector<double>> rows[3];
    constexpr const char* kKeys[] = {"positions", "velocities", "accelerations"};
    for (const YamlNode& point : points.items) {
      times.push_back(Time(Needed(point, "time_from_start")));
      for (size_t order = 0; order < 3; ++order) {
        const YamlNode* const list = point.Find(kKeys[order]);
        if (list == nullptr || (list->items.empty() && order > 0)) continue;
        if (list->items.size() != names.size()) {
          complaints_.Fail(list->place, kKeys[order],
                           Formatted("%zu numbers (valid: one for each of the %zu joints)",
                                     list->items.size(), names.size()));
        }
        std::vector<double>& row = rows[order].emplace_back();
        for (const YamlNode& item : list->items) row.push_back(Number(item, kKeys[order]));
      }
    }
    for (size_t order = 0; order < 3; ++order) {
      if (rows[order].empty() && order > 0) continue;
      if (rows[order].size() != points.items.size()) {
        complaints_.Fail(points.place, kKeys[order], "some points have them and others have not");
      }
      for (size_t j = 0; j < names.size(); ++j) {
        if (!all_.Knows(names[j])) {
          if (order == 0) all_.LeaveOut(names[j]);
          continue;
        }
        std::vector<double> values;
        for (const std::vector<double>& row : rows[order]) values.push_back(row[j]);
        all_.Add(names[j], static_cast<int>(order), std::move(values));
      }
    }
    return all_.Finished(std::move(times));
  }

 private:
  const YamlNode& Needed(const YamlNode& map, const std::string& key) {
    const YamlNode* const value = map.Find(key);
    if (value == nullptr) complaints_.Fail(map.place, key, "is missing");
    return *value;
  }
  std::vector<std::string> Names() {
    std::vector<std::string> names;
    for (const YamlNode& name : Needed(root_, "joint_names").items) names.push_back(name.text);
    if (names.empty()) complaints_.Fail(root_.place, "joint_names", "names no joint");
    return names;
  }
  double Number(const YamlNode& node, const std::string& key) {
    const NumberText number = ParseNumber(node.text);
    if (node.kind != YamlNode::Kind::kScalar || number.kind != NumberText::Kind::kNumber) {
      complaints_.Fail(node.place, key, Quote(node.text) + " is no number");
    }
    return number.value;
  }
  // Seconds, or those and nanoseconds.
  double Time(const YamlNode& node) {
    if (node.kind == YamlNode::Kind::kScalar) return Number(node, "time_from_start");
    const bool old = node.Find("secs") != nullptr;
    return Number(Needed(node, old ? "secs" : "sec"), "time_from_start") +
           1e-9 * Number(Needed(node, old ? "nsecs" : "nanosec"), "time_from_start");
  }

  YamlComplaints complaints_;
  Collected all_;
  YamlNode root_;
};

}  // namespace

const char* Name(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::kLinear:
      return "linear";
    case Interpolation::kCubic:
      return "cubic";
    case Interpolation::kQuintic:
      return "quintic";
  }
  return "";
}

Trajectory ReadTrajectory(const std::string& path,
                          const std::optional<Interpolation>& interpolation,
                          const JointNames& names) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".csv" && ending != ".yaml" && ending != ".yml") {
    Refuse(path, "is no trajectory (valid: .csv, or a JointTrajectory in .yaml)");
  }
  Trajectory trajectory = ending == ".csv" ? FromCsv(path, names)
                                           : MessageReader(path, ReadCsvText(path), names).Read();
  const bool v = trajectory.v.size() > 0, a = trajectory.a.size() > 0;
  trajectory.interpolation = interpolation.value_or(v && a ? Interpolation::kQuintic
                                                    : v    ? Interpolation::kCubic
                                                           : Interpolation::kLinear);
  const bool enough = trajectory.interpolation == Interpolation::kLinear ||
                      (v && (a || trajectory.interpolation == Interpolation::kCubic));
  if (!enough) {
    Refuse(path, std::string("--interpolation ") + Name(trajectory.interpolation) +
                     ": the file has no " + (v ? "accelerations" : "velocities") +
                     " (valid: " + (v ? "linear, cubic)" : "linear)"));
  }
  return trajectory;
}

}  // namespace halfstep::checker
