#include <algorithm>
#include <filesystem>
#include <map>

#include "experiments/checker/trajectory.h"
#include "experiments/tables/csv_reader.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/files/yaml_node.h"
#include "wpg/geometry/rotation.h"

namespace halfstep::checker {
namespace {

[[noreturn]] void Refuse(const std::string& file, const std::string& what) {
  throw InputError({file + ": " + what});
}

constexpr const char* kTimes[] = {"t_s", "t", "time", "time_s"};

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

// Which number a column of the base tells: x, y, z, qw … qz, roll, pitch, yaw, vx … wz; "": none.
std::string PoseColumn(const std::string& name) {
  if (!name.starts_with("base_") && !name.starts_with("root_")) return "";
  const std::string rest = name.substr(5);
  for (const auto& [unit, names] :
       {std::pair<std::string, std::vector<std::string>>{"_m", {"x", "y", "z"}},
        {"_rad", {"roll", "pitch", "yaw"}},
        {"_m_s", {"vx", "vy", "vz"}},
        {"_rad_s", {"wx", "wy", "wz"}},
        {"", {"qw", "qx", "qy", "qz"}}}) {
    for (const std::string& one : names) {
      if (rest == one || rest == one + unit) return one;
    }
  }
  return "";
}

// Joints in the order in which they are first named.
class Collected {
 public:
  Collected(std::string file, const JointNames& names) : names_(names) {
    trajectory_.file = std::move(file);
  }

  bool Knows(const std::string& joint) const {
    return std::ranges::find(names_.moving, joint) != names_.moving.end() ||
           std::ranges::find(names_.others, joint) != names_.others.end();
  }
  void LeaveOut(const std::string& column) { trajectory_.unread.push_back(column); }

  void Add(const std::string& joint, int order, std::vector<double> values) {
    if (order == 0) trajectory_.joints.push_back(joint);
    auto [at, is_new] = rows_[static_cast<size_t>(order)].emplace(joint, std::move(values));
    if (!is_new) Refuse(trajectory_.file, joint + ": is told twice");
  }
  void AddPose(const std::string& number, std::vector<double> values) {
    if (!pose_.emplace(number, std::move(values)).second) {
      Refuse(trajectory_.file, "base_" + number + ": is told twice");
    }
  }

  Trajectory Finished(std::vector<double> times) {
    trajectory_.times = std::move(times);
    trajectory_.q = Filled(0);
    trajectory_.v = Filled(1);
    trajectory_.a = Filled(2);
    if (!pose_.empty()) AddBase();
    CheckNumbers(trajectory_, names_);
    return std::move(trajectory_);
  }

 private:
  Eigen::MatrixXd Filled(size_t order) const {
    static const char* const kWhat[] = {"position", "velocity", "acceleration"};
    if (rows_[order].empty()) return {};
    for (const auto& [joint, values] : rows_[order]) {
      if (!rows_[0].contains(joint)) Refuse(trajectory_.file, joint + ": has no position");
    }
    Eigen::MatrixXd filled(std::ssize(trajectory_.joints), std::ssize(trajectory_.times));
    for (Eigen::Index j = 0; j < filled.rows(); ++j) {
      const std::string& joint = trajectory_.joints[static_cast<size_t>(j)];
      const auto row = rows_[order].find(joint);
      if (row == rows_[order].end()) {
        Refuse(trajectory_.file, joint + ": has no " + kWhat[order] + ", as other joints have");
      }
      for (Eigen::Index k = 0; k < filled.cols(); ++k) {
        filled(j, k) = row->second[static_cast<size_t>(k)];
      }
    }
    return filled;
  }
  const std::vector<double>& Pose(const std::string& number) const {
    const auto values = pose_.find(number);
    if (values == pose_.end()) {
      Refuse(trajectory_.file,
             "base_" + number +
                 ": is missing (valid: x, y, z, and qw, qx, qy, qz or roll, "
                 "pitch, yaw of the base; all of vx, vy, vz, wx, wy, wz or none)");
    }
    return values->second;
  }
  void AddBase() {
    const auto count = std::ssize(trajectory_.times);
    Eigen::MatrixXd poses(7, count), velocities(6, count);
    const auto tells = [this](const char* number) { return pose_.contains(number); };
    const bool angles = tells("roll") || tells("pitch") || tells("yaw");
    const bool moves =
        tells("vx") || tells("vy") || tells("vz") || tells("wx") || tells("wy") || tells("wz");
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto at = [&](const char* number) { return Pose(number)[static_cast<size_t>(k)]; };
      const Eigen::Vector3d place{at("x"), at("y"), at("z")};  // braces: in that order
      const Eigen::Quaterniond turn =
          angles ? Eigen::Quaterniond(RollPitchYaw(at("roll"), at("pitch"), at("yaw")))
                 : Eigen::Quaterniond{at("qw"), at("qx"), at("qy"), at("qz")};
      poses.col(k) << place, turn.w(), turn.vec();
      if (!moves) continue;
      const Eigen::Vector3d v{at("vx"), at("vy"), at("vz")}, w{at("wx"), at("wy"), at("wz")};
      velocities.col(k) << v, w;
    }
    SetBase(std::move(poses), &trajectory_);
    if (moves) SetBaseVelocities(std::move(velocities), &trajectory_);
  }

  const JointNames& names_;
  Trajectory trajectory_;
  std::map<std::string, std::vector<double>> rows_[3], pose_;
};

// Of a first line that does not begin with a time's name.
[[noreturn]] void RefuseFirstLine(const std::string& path, const std::vector<std::string>& cells,
                                  const JointNames& names) {
  const std::string line = path + ":1";
  const bool numbers = std::ranges::all_of(cells, [](const std::string& cell) {
    return ParseNumber(cell).kind == NumberText::Kind::kNumber;
  });
  if (numbers) {
    constexpr size_t kPose = 7;  // numbers of a root's position and quaternion
    const size_t count = cells.size(), joints = names.moving.size();
    std::string as_many;
    for (const auto& [other, what] :
         {std::pair<size_t, std::string>{0, ""}, {kPose, " and 7 for the root's pose"}}) {
      if (count != joints + other && count != joints + other + 1) continue;
      as_many = Formatted(": one for each of the robot's %zu joints", joints) + what +
                (count == joints + other ? ", without a time" : ", and a time");
    }
    const std::string first = names.moving.empty() ? "NAME" : names.moving.front();
    Refuse(line, Formatted("begins with %zu numbers in place of the columns' names", count) +
                     as_many + " (valid: a first line like t_s," + first +
                     ",…: a time, joints, and where the root moves base_x_m, base_y_m, base_z_m, "
                     "base_qw, base_qx, base_qy, base_qz, in any order; joints: " +
                     Joined(names.moving) + ")");
  }
  if (cells.size() == 1 && cells[0].find_first_of(";\t ") != std::string::npos) {
    Refuse(line, "is one column, " + Quote(cells[0]) + " (valid: commas between columns)");
  }
  Refuse(line,
         "the first column is no time, but " + Quote(cells[0]) + " (valid: t_s, t, time, time_s)");
}

Trajectory FromCsv(const std::string& path, const JointNames& names) {
  const CsvTable table = ReadCsv(path);
  if (std::ranges::find(kTimes, table.header.at(0)) == std::end(kTimes)) {
    RefuseFirstLine(path, table.header, names);
  }
  Collected all(path, names);
  for (size_t i = 1; i < table.header.size(); ++i) {
    const Column column = ColumnOf(table.header[i]);
    const std::string pose = PoseColumn(table.header[i]);
    if (!all.Knows(column.joint)) {
      if (pose.empty()) {
        all.LeaveOut(table.header[i]);
      } else {
        all.AddPose(pose, table.Numbers(table.header[i]));
      }
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

Trajectory ReadTrajectory(const std::string& path,
                          const std::optional<Interpolation>& interpolation,
                          const JointNames& names) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".npz") Refuse(path, "is for NumPy: hs.check(\"FILE.npz\", robot=...) in Python");
  if (ending != ".csv" && ending != ".yaml" && ending != ".yml") {
    Refuse(path, "is no trajectory (valid: .csv, or a JointTrajectory in .yaml)");
  }
  Trajectory trajectory = ending == ".csv" ? FromCsv(path, names)
                                           : MessageReader(path, ReadCsvText(path), names).Read();
  SetInterpolation(interpolation, &trajectory);
  return trajectory;
}

}  // namespace halfstep::checker
