#include "experiments/tables/trajectory_match.h"

#include <cmath>
#include <vector>

#include "experiments/tables/result_tables.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

constexpr double kOtherMotion = 1e-6;  // far above what other compilers round otherwise

bool SameNumber(double a, double b) {
  return std::abs(a - b) <= kOtherMotion || (std::isnan(a) && std::isnan(b));
}

std::string NumberOrNan(double value) {
  return std::isfinite(value) ? ShortestText(value) : std::isnan(value) ? "nan" : "inf";
}

}  // namespace

std::string TrajectoryMismatch(const RobotModel& robot, const SuperposedWalk& walk,
                               const CsvTable& trajectory) {
  const CsvColumns columns = MotionColumns(robot);
  std::vector<std::vector<double>> numbers(columns.size());
  for (size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].type == CsvType::kNumber) numbers[c] = trajectory.Numbers(columns[c].name);
  }
  const std::vector<double>& t = numbers.front();
  if (t.empty()) throw InputError({trajectory.path + ": no rows"});
  if (!SameNumber(t.back(), walk.duration())) {
    return "the walk ends at " + ShortestText(walk.duration()) + " s, its rows at " +
           NumberOrNan(t.back()) + " s";
  }
  for (size_t row = 0; row < t.size(); ++row) {
    const std::vector<MotionCell> motion = MotionRow(robot, walk, t[row]);
    for (size_t c = 0; c < columns.size(); ++c) {
      const double* const value = std::get_if<double>(&motion[c]);
      if (value == nullptr || SameNumber(*value, numbers[c][row])) continue;
      return columns[c].name + " is " + NumberOrNan(*value) + " at " + NumberOrNan(t[row]) +
             " s of the walk, " + NumberOrNan(numbers[c][row]) + " in its row";
    }
  }
  return "";
}

}  // namespace halfstep
