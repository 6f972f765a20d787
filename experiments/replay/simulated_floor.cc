#include "experiments/replay/simulated_floor.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

#include "wpg/elementary.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"
#include "wpg/geometry/rotation.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/nth.h"

namespace halfstep::replay {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kMostHeight = 0.1;    // of plates [m]
constexpr double kMostDegrees = 20.0;  // of a slope: with a friction of 0.5 soles slip at 26

[[noreturn]] void Refuse(const std::string& who, const std::string& text) {
  throw InputError({who + " " + Quote(text) +
                    ": is no floor (valid: plates=H with H from 0 to 0.1 m, slope=A with A from 0 "
                    "to 20 degrees, or plates=H,slope=A)"});
}

// Where soles come to stand after the first row.
std::vector<Eigen::Vector4d> Landings(const std::vector<TrajectoryRow>& rows) {
  std::vector<Eigen::Vector4d> landings;
  for (size_t i = 1; i < rows.size(); ++i) {
    for (size_t side = 0; side < 2; ++side) {
      if (rows[i].stands[side] && !rows[i - 1].stands[side]) {
        landings.push_back(rows[i].soles[side]);
      }
    }
  }
  return landings;
}

Pose2 PlaceOf(const Eigen::Vector4d& sole) { return {sole[0], sole[1], sole[3]}; }

// The plane through the middle of the soles at the start, turned by the slope, then lowered until
// no corner of a sole is below it.
Isometry3d DrawPlane(double slope, const TrajectoryRow& start, const RobotModel& robot,
                     SeedDraws* draws) {
  const double direction = draws->Between(0.0, 2 * std::numbers::pi);
  const Eigen::Vector2d middle = 0.5 * (start.soles[0] + start.soles[1]).head<2>();
  const Vector3d axis(-Sin(direction), Cos(direction), 0.0);
  Isometry3d X = Isometry3d::Identity();
  X.linear() = AxisRotation(slope, axis);
  const Vector3d normal = X.linear().col(2);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector4d& sole : start.soles) {
    const auto corners = SoleCorners(PlaceOf(sole), robot.sole_size);
    for (Eigen::Index i = 0; i < corners.cols(); ++i) {
      const Eigen::Vector2d from_middle = corners.col(i) - middle;
      lowest = std::min(lowest, normal.head<2>().dot(from_middle));
    }
  }
  X.translation() << middle, lowest / normal.z();
  return X;
}

}  // namespace

FloorRelief ParseRelief(const std::string& who, const std::string& text) {
  FloorRelief relief;
  std::optional<double> plates, slope;
  size_t begin = 0;
  while (begin <= text.size()) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const size_t equals = std::min(part.find('='), part.size());
    const std::string key = part.substr(0, equals);
    const NumberText number = ParseNumber(part.substr(std::min(equals + 1, part.size())));
    std::optional<double>* const value = key == "plates"  ? &plates
                                         : key == "slope" ? &slope
                                                          : nullptr;
    const double most = key == "plates" ? kMostHeight : kMostDegrees;
    if (value == nullptr || *value || number.kind != NumberText::Kind::kNumber ||
        !(number.value >= 0.0 && number.value <= most)) {
      Refuse(who, text);
    }
    *value = number.value;
    begin = end + 1;
  }
  relief.plates = plates.value_or(0.0);
  relief.slope = slope.value_or(0.0) * std::numbers::pi / 180;
  return relief;
}

SimulatedFloor DrawFloor(const FloorRelief& relief, const std::vector<TrajectoryRow>& rows,
                         const RobotModel& robot, SeedDraws* draws) {
  SimulatedFloor floor;
  const TrajectoryRow& start = rows.front();
  const Isometry3d plane = DrawPlane(relief.slope, start, robot, draws);
  if (relief.slope > 0.0) floor.X_WFloor = plane;
  const Eigen::Vector2d half = 0.5 * robot.sole_size;
  for (const Eigen::Vector4d& landing : Landings(rows)) {
    const Eigen::Vector2d shift(draws->Between(-half.x(), half.x()),
                                draws->Between(-half.y(), half.y()));
    const double height = draws->Between(0.0, relief.plates);
    Isometry3d X_WP =
        TrajectoryRow::Upright(landing) * Eigen::Translation3d(shift.x(), shift.y(), 0);
    const bool apart = std::ranges::all_of(start.soles, [&](const Eigen::Vector4d& sole) {
      return (sole.head<2>() - X_WP.translation().head<2>()).norm() > 2 * half.norm();
    });
    if (height == 0.0 || !apart) continue;
    X_WP.translation().z() = 0.0;
    const Eigen::Vector2d foot = floor.X_WFloor.translation().head<2>();
    X_WP.translation().head<2>() -= foot;
    floor.plates.push_back({Eigen::Translation3d(0, 0, height) * X_WP, robot.sole_size});
  }
  return floor;
}

}  // namespace halfstep::replay
