#include "experiments/verify/level_tops.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/verify/floor_distances.h"
#include "wpg/ground/ground.h"

namespace halfstep::verify {
namespace {

using Eigen::Matrix2Xd;
using Eigen::Vector2d;

// Heights are whole nanometres [m].
constexpr double kSameHeight = 0.5e-9;
// Gaps of at most 2 nm are none; what cutting leaves of edges that two surfaces share is thinner.
constexpr double kThin = 2.5e-9;

// How far p is to the left of the line from a to b [m].
double LeftOf(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const Vector2d along = (b - a).normalized(), to = p - a;
  return along.x() * to.y() - along.y() * to.x();
}

// What of a convex polygon lies to the left of the line from a to b, `side` 1, or right of it, −1.
Matrix2Xd Cut(const Matrix2Xd& polygon, const Vector2d& a, const Vector2d& b, double side) {
  std::vector<Vector2d> kept;
  const Eigen::Index n = polygon.cols();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector2d p = polygon.col(i), q = polygon.col((i + 1) % n);
    const double of_p = side * LeftOf(a, b, p), of_q = side * LeftOf(a, b, q);
    if (of_p >= 0) kept.push_back(p);
    if ((of_p > 0 && of_q < 0) || (of_p < 0 && of_q > 0)) {
      kept.push_back(p + of_p / (of_p - of_q) * (q - p));
    }
  }
  Matrix2Xd cut(2, std::ssize(kept));
  for (Eigen::Index i = 0; i < cut.cols(); ++i) cut.col(i) = kept[static_cast<size_t>(i)];
  return cut;
}

// Whether a convex polygon is nowhere wider than kThin across some edge, or is none.
bool IsThin(const Matrix2Xd& polygon) {
  const Eigen::Index n = polygon.cols();
  if (n < 3) return true;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector2d a = polygon.col(i), b = polygon.col((i + 1) % n);
    if ((b - a).norm() < kThin) continue;
    double width = 0;
    for (Eigen::Index k = 0; k < n; ++k) width = std::max(width, LeftOf(a, b, polygon.col(k)));
    if (width <= kThin) return true;
  }
  return false;
}

// Adds what a convex polygon leaves of another.
void Subtract(const Matrix2Xd& polygon, Matrix2Xd from, std::vector<Matrix2Xd>* left) {
  std::vector<Matrix2Xd> outside;
  const Matrix2Xd whole = from;
  const Eigen::Index n = polygon.cols();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector2d a = polygon.col(i), b = polygon.col((i + 1) % n);
    Matrix2Xd beyond = Cut(from, a, b, -1);
    if (!IsThin(beyond)) outside.push_back(std::move(beyond));
    from = Cut(from, a, b, 1);
    if (IsThin(from)) {  // they do not meet
      left->push_back(whole);
      return;
    }
  }
  left->insert(left->end(), outside.begin(), outside.end());
}

bool Bears(const GroundSolid& solid, double z) {
  return solid.bears.has_value() && std::abs(solid.top - z) < kSameHeight;
}

bool IsInTheWay(const GroundSolid& solid, double z) {
  return solid.bottom <= z + kSameHeight && solid.top >= z + kSameHeight;
}

bool Meets(const Matrix2Xd& polygon, const Matrix2Xd& window) {
  return (polygon.rowwise().maxCoeff().array() >= window.rowwise().minCoeff().array()).all() &&
         (polygon.rowwise().minCoeff().array() <= window.rowwise().maxCoeff().array()).all();
}

}  // namespace

std::vector<Matrix2Xd> LevelTops::Missing(const Matrix2Xd& window, double z) const {
  if (std::abs(scene_.ground->Floor() - z) < kSameHeight) return {};
  std::vector<Matrix2Xd> missing = {window};
  for (const GroundSolid& solid : scene_.ground->Solids()) {
    if (!Bears(solid, z) || !Meets(solid.polygon, window)) continue;
    std::vector<Matrix2Xd> left;
    for (Matrix2Xd& part : missing) Subtract(solid.polygon, std::move(part), &left);
    missing = std::move(left);
  }
  return missing;
}

double LevelTops::Inside(const RobotModel& robot, const Pose2& X_WF, double z) const {
  const double reach = robot.sole_outline.colwise().norm().maxCoeff();
  double nearest = std::numeric_limits<double>::infinity();
  // What lies beyond a window is farther away than `around`.
  for (const double around : {0.1, 1.0, 10.0, 1e3}) {
    const double half = reach + around;
    Matrix2Xd window(2, 4);
    window << -half, half, half, -half, -half, -half, half, half;
    window.colwise() += X_WF.position();
    for (const Matrix2Xd& part : Missing(window, z)) {
      nearest = std::min(nearest, FromArea(robot, X_WF, part));
    }
    for (const GroundSolid& solid : scene_.ground->Solids()) {
      if (!IsInTheWay(solid, z) || !Meets(solid.polygon, window)) continue;
      nearest = std::min(nearest, FromArea(robot, X_WF, solid.polygon));
    }
    if (nearest <= around) break;
  }
  return nearest;
}

std::optional<double> LevelTops::HeightUnder(const RobotModel& robot, const Pose2& X_WF,
                                             const std::optional<double>& only) const {
  std::vector<double> heights;
  const double floor = scene_.ground->Floor();
  if (std::isfinite(floor)) heights.push_back(floor);
  for (const GroundSolid& solid : scene_.ground->Solids()) {
    if (solid.bears) heights.push_back(solid.top);
  }
  std::ranges::sort(heights, std::greater<>());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  for (const double z : heights) {
    if (only && std::abs(z - *only) >= kSameHeight) continue;
    if (Inside(robot, X_WF, z) > 0) return z;
  }
  return std::nullopt;
}

std::optional<double> LevelTops::HeightNamed(const std::string& name) const {
  const double floor = scene_.ground->Floor();
  if (name == "floor") return std::isfinite(floor) ? std::optional(floor) : std::nullopt;
  for (const GroundSolid& solid : scene_.ground->Solids()) {
    if (solid.name == name && solid.bears) return solid.top;
  }
  return std::nullopt;
}

}  // namespace halfstep::verify
