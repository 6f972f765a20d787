#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What the page shows of one method's walk, from its folder in a run (trajectory.csv,
/// half_steps.csv, overlaps.csv, certificate.json). The trajectory's rows are thinned to about
/// `spacing` [s], the last one included. A column is {"step": s, "delta": [...]}: integers whose
/// running sum times s is the value; null where it is not finite. Beside the columns of
/// trajectory.csv: `speed_<joint>_rad_s`, central differences of its rows.
/// Throws InputError for what is no such folder.
nlohmann::json WalkJson(const std::filesystem::path& folder, double spacing);

/// The same with the columns `zmp_robot_x_m` and `zmp_robot_y_m`, and where soles stand at
/// different heights `tilt_x` and `tilt_y` (RobotZmps).
nlohmann::json WalkJson(const RobotModel& robot, const std::filesystem::path& folder,
                        double spacing);

/// `columns` of a trajectory.csv in the same way, and `support`: the first letter of each row's.
nlohmann::json MotionJson(const std::filesystem::path& trajectory,
                          const std::vector<std::string>& columns, double spacing);

/// Rows of a CSV file as objects: what reads as a number is one, to 6 digits; an empty cell null.
nlohmann::json RowsJson(const std::filesystem::path& csv);

}  // namespace halfstep
