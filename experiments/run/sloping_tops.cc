#include "experiments/run/sloping_tops.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "wpg/elementary.h"
#include "wpg/files/text.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

// Triangles whose normals are alike.
struct Slope {
  double area = 0.0;                                        // [m²]
  double lowest = std::numeric_limits<double>::infinity();  // z in W [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();         // up, times the area
};

// The steepness of the largest slope of an obstacle [rad]; none: it has none on which to walk up.
std::optional<double> WalkUp(const TriangleMesh& mesh, const Eigen::Isometry3d& X_WO,
                             const RobotModel& robot, const Ground& ground) {
  constexpr double kAlike = 0.02;  // of the normals' x and y
  constexpr double kShare = 0.3;
  constexpr double kLeast = 2.0 * std::numbers::pi / 180, kMost = 30.0 * std::numbers::pi / 180;
  constexpr double kSteepest = 0.5;  // z of the normal of what faces up or down
  std::map<std::pair<int, int>, Slope> slopes;
  double all = 0.0;
  for (const auto& triangle : mesh.triangles.colwise()) {
    const Eigen::Vector3d a = X_WO * mesh.vertices.col(triangle[0]),
                          b = X_WO * mesh.vertices.col(triangle[1]),
                          c = X_WO * mesh.vertices.col(triangle[2]);
    Eigen::Vector3d across = 0.5 * (b - a).cross(c - a);
    const double area = across.norm();
    if (!(std::fabs(across.z()) > kSteepest * area)) continue;
    if (across.z() < 0.0) across = -across;
    all += area;
    const auto bin = [&](double x) { return static_cast<int>(std::lround(x / (area * kAlike))); };
    Slope& slope = slopes[{bin(across.x()), bin(across.y())}];
    slope.area += area;
    slope.normal += across;
    slope.lowest = std::min({slope.lowest, a.z(), b.z(), c.z()});
  }
  std::optional<double> found;
  double largest = std::max(kShare * all, robot.sole_size.prod());
  for (const auto& [bin, slope] : slopes) {
    const double angle = Atan2(slope.normal.head<2>().norm(), slope.normal.z());
    if (slope.area < largest || angle < kLeast || angle > kMost) continue;
    const bool begins_at_level =
        std::ranges::any_of(ground.Levels(), [&](const GroundLevel& level) {
          return std::fabs(slope.lowest - level.height) <= 0.15 * LegLengthOf(robot);
        });
    if (!begins_at_level) continue;
    largest = slope.area;
    found = angle;
  }
  return found;
}

}  // namespace

std::vector<std::string> SlopingTops(const RobotModel& robot, const Scene& scene,
                                     const Eigen::AlignedBox2d& area) {
  constexpr size_t kMost = 3;
  std::vector<std::string> sentences;
  for (const Obstacle& obstacle : scene.obstacles) {
    if (sentences.size() == kMost) break;
    if (!obstacle.rests()) continue;
    const Eigen::AlignedBox3d bounds = BoundsOf(obstacle.shape, obstacle.X_WO);
    if (!area.intersects(
            {Eigen::Vector2d(bounds.min().head<2>()), Eigen::Vector2d(bounds.max().head<2>())}))
      continue;
    const auto of = [&](const auto& shape) {
      const auto& body = BodyOf(shape);
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(body)>, TriangleMesh>) {
        return WalkUp(body, obstacle.X_WO, robot, *scene.ground);
      } else {
        return WalkUp(FacesOf(body), obstacle.X_WO, robot, *scene.ground);
      }
    };
    const auto angle = std::visit(of, obstacle.shape);
    if (!angle) continue;
    sentences.push_back(Quote(obstacle.name) +
                        Formatted(" slopes by %.3g deg, and soles stand on level surfaces only",
                                  *angle * 180.0 / std::numbers::pi));
  }
  return sentences;
}

}  // namespace halfstep
