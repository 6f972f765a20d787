#include "experiments/export/whole_trajectory.h"

#include <algorithm>
#include <array>

#include "experiments/tables/csv_writer.h"
#include "experiments/tables/result_tables.h"
#include "wpg/elementary.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

constexpr CsvInterpolation kLinearForm = CsvInterpolation::kLinear;

std::string NumberCell(double value) {
  CsvWriter one({{"x", CsvType::kNumber}});
  one.Cell(value).EndRow();
  const std::string& text = one.text();
  return text.substr(2, text.size() - 3);  // between "x\n" and "\n"
}

size_t PlaceOf(const CsvColumns& columns, const std::string& name) {
  const auto found = std::ranges::find(columns, name, &CsvColumn::name);
  return static_cast<size_t>(found - columns.begin());
}

void AddJoints(const RobotModel& robot, const RobotTree& tree, DeclaredTable* table) {
  const std::string last = "q_" + robot.legs[1].joints[5].name + "_rad";
  size_t at = PlaceOf(table->columns, last) + 1;
  for (const int joint : JointsInFileOrder(tree.urdf)) {
    const auto j = static_cast<size_t>(joint);
    const std::string& name = tree.urdf.joints[j].name;
    const std::string column = "q_" + name + "_rad";
    if (PlaceOf(table->columns, column) < table->columns.size()) continue;  // of a leg
    const auto offset = static_cast<std::ptrdiff_t>(at++);
    table->columns.insert(
        table->columns.begin() + offset,
        {column, CsvType::kNumber, "rad",
         "angle of joint " + name + ", which keeps the standing posture", "", kLinearForm});
    table->table.header.insert(table->table.header.begin() + offset, column);
    const std::string cell = NumberCell(tree.posture[j]);
    for (auto& row : table->table.rows) row.insert(row.begin() + offset, cell);
  }
}

void TurnYawIntoQuaternion(DeclaredTable* table) {
  const std::vector<double> yaw = table->table.Numbers("waist_yaw_rad");
  const size_t at = PlaceOf(table->columns, "waist_yaw_rad");
  const std::array<std::string, 4> names = {"waist_qw", "waist_qx", "waist_qy", "waist_qz"};
  const auto replace = [at](auto* list, const auto& four) {
    const auto place = list->erase(list->begin() + static_cast<std::ptrdiff_t>(at));
    list->insert(place, four.begin(), four.end());
  };
  std::array<CsvColumn, 4> columns;
  for (size_t k = 0; k < 4; ++k) {
    columns[k] = {names[k], CsvType::kNumber,
                  "1",      "waist frame B, unit quaternion, " + names[k].substr(6),
                  "W",      kLinearForm};
  }
  replace(&table->columns, columns);
  replace(&table->table.header, names);
  // Yaws are not wrapped, so neither half of one jumps.
  const double sign = !yaw.empty() && Cos(0.5 * yaw.front()) < 0.0 ? -1.0 : 1.0;
  for (size_t row = 0; row < yaw.size(); ++row) {
    const std::array<std::string, 4> cells = {NumberCell(sign * Cos(0.5 * yaw[row])), "0.0", "0.0",
                                              NumberCell(sign * Sin(0.5 * yaw[row]))};
    replace(&table->table.rows[row], cells);
  }
}

}  // namespace

DeclaredTable InForm(CsvTable trajectory, const RobotModel& robot, const RobotTree& tree,
                     const TrajectoryForm& form) {
  DeclaredTable table{std::move(trajectory), TrajectoryColumns(robot)};
  const bool fits = std::ranges::equal(table.table.header, table.columns, {}, {}, &CsvColumn::name);
  if (!fits) {
    throw InputError(
        {table.table.path + ":1: its columns are not those of this robot's trajectory"});
  }
  if (form.all_joints) AddJoints(robot, tree, &table);
  if (form.waist_quaternion) TurnYawIntoQuaternion(&table);
  return table;
}

}  // namespace halfstep
