#include "experiments/replay/simulated_floor.h"

#include <algorithm>
#include <cmath>
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
  throw InputError(
      {who + " " + Quote(text) +
       ": is no floor (valid: plates=H with H from 0 to 0.1 m, curb=H with H from −0.1 "
       "to 0.1 m, slope=A with A from 0 to 20 degrees, or several with commas)"});
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

// The plane z = 0, turned about the middle of the soles at the start.
Isometry3d DrawPlane(double slope, const TrajectoryRow& start, SeedDraws* draws) {
  const double direction = draws->Between(0.0, 2 * std::numbers::pi);
  if (slope == 0.0) return Isometry3d::Identity();
  Vector3d middle = Vector3d::Zero();
  middle.head<2>() = 0.5 * (start.soles[0] + start.soles[1]).head<2>();
  const Vector3d axis(-Sin(direction), Cos(direction), 0.0);
  Isometry3d X = Isometry3d::Identity();
  X.linear() = AxisRotation(slope, axis);
  X.translation() = middle - X.linear() * middle;
  return X;
}

// Whether all corners of one rectangle are beyond the line of an edge of another.
bool IsBeyondAnEdge(const SupportPolygon& one, const SupportPolygon& other) {
  for (int i = 0; i < other.size(); ++i) {
    const Eigen::Vector2d a = other.corner(i), along = other.corner((i + 1) % other.size()) - a;
    bool beyond = true;
    for (int k = 0; k < one.size(); ++k) {
      const Eigen::Vector2d to = one.corner(k) - a;
      beyond = beyond && along.x() * to.y() - along.y() * to.x() < 0.0;
    }
    if (beyond) return true;
  }
  return false;
}

bool AreApart(const SupportPolygon& one, const SupportPolygon& other) {
  return IsBeyondAnEdge(one, other) || IsBeyondAnEdge(other, one);
}

}  // namespace

FloorRelief ParseRelief(const std::string& who, const std::string& text) {
  FloorRelief relief;
  std::optional<double> plates, curb, slope;
  size_t begin = 0;
  while (begin <= text.size()) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const size_t equals = std::min(part.find('='), part.size());
    const std::string key = part.substr(0, equals);
    const NumberText number = ParseNumber(part.substr(std::min(equals + 1, part.size())));
    std::optional<double>* const value = key == "plates"  ? &plates
                                         : key == "curb"  ? &curb
                                         : key == "slope" ? &slope
                                                          : nullptr;
    const double most = key == "slope" ? kMostDegrees : kMostHeight;
    const double least = key == "curb" ? -kMostHeight : 0.0;
    if (value == nullptr || *value || number.kind != NumberText::Kind::kNumber ||
        !(number.value >= least && number.value <= most)) {
      Refuse(who, text);
    }
    *value = number.value;
    begin = end + 1;
  }
  relief.plates = plates.value_or(0.0);
  relief.curb = curb.value_or(0.0);
  relief.slope = slope.value_or(0.0) * std::numbers::pi / 180;
  return relief;
}

SimulatedFloor FloorAhead(const FloorRelief& relief, const TrajectoryRow& start,
                          const RobotModel& robot, SeedDraws* draws) {
  constexpr double kLarge = 20.0;  // length of plates [m]
  constexpr double kCurb = 0.6;    // where it begins, of a sole's length before its middle
  SimulatedFloor floor;
  floor.X_WFloor = DrawPlane(relief.slope, start, draws);
  if (relief.curb == 0.0) return floor;
  // The higher part is plates on the lower one, seen from the left sole: where it ends on the way,
  // and in the middle between both soles.
  const Pose2 X_WL = PlaceOf(start.soles[0]);
  const double x = kCurb * robot.sole_size.x(), large = 0.5 * kLarge;
  const double y = 0.5 * (X_WL.Inverse() * PlaceOf(start.soles[1]).position()).y();
  const auto add = [&](double at_x, double at_y, double length, double width, bool at_start) {
    const Pose2 X = X_WL * Pose2{at_x, at_y, 0.0};
    floor.plates.push_back({TrajectoryRow::Upright({X.x, X.y, std::abs(relief.curb), X.yaw}),
                            Eigen::Vector2d(length, width), at_start});
  };
  if (relief.curb > 0.0) {
    add(x + large, y - large, kLarge, kLarge, false);
  } else {
    floor.X_WFloor = floor.X_WFloor * Eigen::Translation3d(0, 0, relief.curb);
    add(x - large, y, kLarge, 2 * kLarge, true);
    add(x + large, y + large, kLarge, kLarge, false);
  }
  return floor;
}

SimulatedFloor DrawFloor(const FloorRelief& relief, const std::vector<TrajectoryRow>& rows,
                         const RobotModel& robot, SeedDraws* draws) {
  const TrajectoryRow& start = rows.front();
  SimulatedFloor floor = FloorAhead(relief, start, robot, draws);
  const Eigen::Vector2d half = 0.5 * robot.sole_size;
  for (const Eigen::Vector4d& landing : Landings(rows)) {
    const Pose2 shift{draws->Between(-half.x(), half.x()), draws->Between(-half.y(), half.y()),
                      0.0};
    const double height = draws->Between(0.0, relief.plates);
    const Pose2 X_FP = PlaceOf(landing) * shift;
    const SupportPolygon face(X_FP, robot.sole_size);
    const bool apart = std::ranges::all_of(start.soles, [&](const Eigen::Vector4d& sole) {
      return AreApart(face, SupportPolygon(PlaceOf(sole), robot.sole_size));
    });
    if (height == 0.0 || !apart) continue;
    floor.plates.push_back(
        {TrajectoryRow::Upright({X_FP.x, X_FP.y, height, X_FP.yaw}), robot.sole_size});
  }
  return floor;
}

}  // namespace halfstep::replay
