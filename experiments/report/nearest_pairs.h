#pragma once

#include <nlohmann/json.hpp>

#include "experiments/tables/csv_reader.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Where a walk comes nearest to the obstacles, and where the robot comes nearest to itself: an
/// entry for each of the two, {"family", "t_s", "margin_m", "between": two names, "points": two
/// points in W [m]}, of the row of trajectory.csv with the least value. A family has no entry when
/// nothing is within its cap, or a leg does not reach in that row. For drawing: what is proved
/// is the certificate's. Throws InputError where a column is missing or no number.
nlohmann::json NearestPairsJson(const RobotModel& robot, const Scene& scene,
                                const CsvTable& trajectory);

}  // namespace halfstep
