#include "experiments/tables/trajectory_file.h"

#include <algorithm>
#include <cmath>

#include "experiments/tables/csv_reader.h"
#include "experiments/tables/run_record.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/geometry/rotation.h"
#include "wpg/motion/standing_heights.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"

namespace halfstep {
namespace {

[[noreturn]] void Refuse(const CsvTable& table, size_t row, const std::string& what) {
  throw InputError({table.path + ":" + std::to_string(row + 2) + ": " + what});
}

std::vector<double> Finite(const CsvTable& table, const std::string& column) {
  std::vector<double> numbers = table.Numbers(column);
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (!std::isfinite(numbers[i])) Refuse(table, i, column + ": not finite: cannot be played");
  }
  return numbers;
}

// Fills a place of every row from NAME_x_m … NAME_yaw_rad.
template <typename Member>
void ReadPlace(const CsvTable& table, const std::string& name, const Member& member,
               std::vector<TrajectoryRow>* rows) {
  const std::array<std::string, 4> endings = {"_x_m", "_y_m", "_z_m", "_yaw_rad"};
  for (size_t k = 0; k < endings.size(); ++k) {
    const std::vector<double> numbers = Finite(table, name + endings[k]);
    for (size_t i = 0; i < rows->size(); ++i) {
      member(&(*rows)[i])[static_cast<Eigen::Index>(k)] = numbers[i];
    }
  }
}

bool StandsAtZero(const TrajectoryRow& row) {
  for (size_t side = 0; side < 2; ++side) {
    if (row.stands[side] && std::abs(row.soles[side].z()) > StandingHeights::kLevel) return false;
  }
  return true;
}

std::vector<TrajectoryRow> Rows(const CsvTable& table, const RobotModel& robot) {
  std::vector<TrajectoryRow> rows(table.rows.size());
  if (rows.size() < 2) throw InputError({table.path + ": fewer than two rows"});
  const std::vector<double> t = Finite(table, "t_s"), zmp_x = Finite(table, "zmp_x_m"),
                            zmp_y = Finite(table, "zmp_y_m");
  const std::vector<std::string> support = table.Texts("support");
  for (size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && t[i] <= t[i - 1]) Refuse(table, i, "t_s: does not increase");
    if (support[i] != "left" && support[i] != "right" && support[i] != "both") {
      Refuse(table, i, "support: " + Quote(support[i]) + " (valid: left, right, both)");
    }
    rows[i].t = t[i];
    rows[i].stands = {support[i] != "right", support[i] != "left"};
    rows[i].zmp = {zmp_x[i], zmp_y[i]};
  }
  ReadPlace(
      table, "waist", [](TrajectoryRow * row) -> auto& { return row->waist; }, &rows);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto sole = [side](TrajectoryRow * row) -> auto& { return Nth(row->soles, side); };
    ReadPlace(table, std::string(Name(side)) + "_foot", sole, &rows);
    for (size_t j = 0; j < 6; ++j) {
      const std::vector<double> q =
          Finite(table, "q_" + Nth(robot.legs, side).joints[j].name + "_rad");
      for (size_t i = 0; i < rows.size(); ++i) {
        Nth(rows[i].q, side)[static_cast<Eigen::Index>(j)] = q[i];
      }
    }
  }
  FindZmpPlanes(robot, &rows);
  return rows;
}

}  // namespace

void FindZmpPlanes(const RobotModel& robot, std::vector<TrajectoryRow>* rows) {
  if (std::ranges::all_of(*rows, StandsAtZero)) return;
  std::vector<TrajectoryRow>& all = *rows;
  for (size_t i = 0; i < all.size(); ++i) {
    all[i].zmp_z = all[i].waist.z() - robot.waist_height;
    if (i == 0 || i + 1 == all.size()) continue;
    const double before = all[i].t - all[i - 1].t, after = all[i + 1].t - all[i].t;
    const double second = 2.0 / (before + after) *
                          ((all[i + 1].waist.z() - all[i].waist.z()) / after -
                           (all[i].waist.z() - all[i - 1].waist.z()) / before);
    all[i].zmp_z -= robot.com_height / kGravity * second;
  }
}

Eigen::Isometry3d TrajectoryRow::Upright(const Eigen::Vector4d& place) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = AxisRotation(place[3], Eigen::Vector3d::UnitZ());
  X.translation() = place.head<3>();
  return X;
}

std::vector<TrajectoryRow> ReadTrajectory(const std::filesystem::path& path,
                                          const RobotModel& robot) {
  return Rows(ReadCsv(path.string()), robot);
}

std::vector<TrajectoryRow> ParseTrajectory(const std::string& path, const std::string& text,
                                           const RobotModel& robot) {
  return Rows(ParseCsv(text, path), robot);
}

std::vector<std::string> MethodsOfRun(const std::string& run,
                                      const std::optional<std::string>& method) {
  std::vector<std::string> names;
  std::string valid;
  for (const MethodRecord& record : ReadRun(run).methods) {
    names.push_back(record.name);
    valid += (valid.empty() ? "" : ", ") + record.name;
  }
  if (!method) return names;
  if (std::find(names.begin(), names.end(), *method) == names.end()) {
    throw InputError({"--method " + *method + ": is not in " + run + " (valid: " + valid + ")"});
  }
  return {*method};
}

}  // namespace halfstep
