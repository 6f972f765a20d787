#include "experiments/survey/found_frames.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "wpg/elementary.h"
#include "wpg/geometry/planar_hull.h"
#include "wpg/geometry/side.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNearFloor = 1e-3;  // what is less above the lowest point touches [m]
// Directions nearer to an axis [rad]: the waist's z, a sole's normal. Triangles of one flat part.
constexpr double kUpright = 0.5, kFlat = 0.01, kOnePart = 0.02;

// The axis of the frame that `direction` is within `angle` of, else the direction itself.
Vector3d Snapped(const Vector3d& direction, double angle) {
  for (int i = 0; i < 3; ++i) {
    const Vector3d axis = Vector3d::Unit(i) * (direction[i] < 0 ? -1.0 : 1.0);
    if (direction.dot(axis) > Cos(angle)) return axis;
  }
  return direction;
}

// The direction in which the largest flat part of the bodies faces, within 60° of `down`; zero when
// there is none. Triangles within 1° of each other are one part.
Vector3d LargestFace(const std::vector<const RobotBody*>& bodies, const Vector3d& down) {
  struct Face {
    Vector3d normal;
    double area;
  };
  std::vector<Face> faces;
  for (const RobotBody* body : bodies) {
    const ConvexBody& shape = body->shape;
    for (const Eigen::Vector3i& t : shape.triangles) {
      const Vector3d a = shape.vertices.col(t[0]), b = shape.vertices.col(t[1]);
      const Vector3d c = shape.vertices.col(t[2]);
      const Vector3d across = (b - a).cross(c - a);
      if (across.norm() > 0 && across.normalized().dot(down) > 0.5) {
        faces.push_back({across.normalized(), across.norm() / 2});
      }
    }
    // The bottom of an upright cylinder.
    const double disc = body->shape.disc_radius;
    if (disc > 0) {
      const double sign = down.z() < 0 ? -1 : 1;
      if (std::abs(down.z()) > 0.5) {
        faces.push_back({sign * Vector3d::UnitZ(), std::numbers::pi * disc * disc});
      }
    }
  }
  Vector3d best = Vector3d::Zero();
  double largest = 0.0;
  for (const Face& seed : faces) {
    double area = 0.0;
    Vector3d normal = Vector3d::Zero();
    for (const Face& face : faces) {
      if (face.normal.dot(seed.normal) < Cos(kOnePart)) continue;
      area += face.area;
      normal += face.area * face.normal;
    }
    if (area > largest) {
      largest = area;
      best = normal.normalized();
    }
  }
  return best;
}

// Points of the bodies that touch a floor across `up`, in the axes of R (x, y).
std::vector<Vector2d> Touching(const std::vector<const RobotBody*>& bodies, const Matrix3d& R,
                               double* lowest) {
  const Vector3d up = R.col(2);
  *lowest = std::numeric_limits<double>::infinity();
  for (const RobotBody* body : bodies) *lowest = std::min(*lowest, -Support(body->shape, -up));
  std::vector<Vector2d> points;
  for (const RobotBody* body : bodies) {
    const double ball = body->shape.ball_radius, disc = body->shape.disc_radius;
    const double tilt = disc * up.head<2>().norm();
    for (const Vector3d& v : body->shape.vertices.colwise()) {
      if (up.dot(v) - ball - tilt > *lowest + kNearFloor) continue;
      const Vector2d at(R.col(0).dot(v), R.col(1).dot(v));
      points.push_back(at);
      // Inside of a disc's edge.
      for (int k = 0; disc > 0 && tilt < kNearFloor && k < 64; ++k) {
        const double angle = 2 * std::numbers::pi * k / 64;
        points.push_back(at + disc * Vector2d(Cos(angle), Sin(angle)));
      }
    }
  }
  return points;
}

struct Rectangle {
  Vector2d centre{0, 0}, size{0, 0};
};

// The largest rectangle along the axes in the convex hull of points, its ends on 64 places along x.
Rectangle LargestRectangle(std::vector<Vector2d> points) {
  std::vector<Vector2d> hull(2 * points.size() + 1);
  hull.resize(PlanarHull(points, hull));
  if (hull.size() < 3) return {};
  // Least and largest y of the hull at x.
  const auto span = [&](double x) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (size_t i = 0; i < hull.size(); ++i) {
      const Vector2d a = hull[i], b = hull[(i + 1) % hull.size()];
      if (std::min(a.x(), b.x()) > x || std::max(a.x(), b.x()) < x) continue;
      const double s = a.x() == b.x() ? 0.0 : (x - a.x()) / (b.x() - a.x());
      const double y = a.y() + s * (b.y() - a.y());
      low = std::min({low, y, a.x() == b.x() ? b.y() : y});
      high = std::max({high, y, a.x() == b.x() ? b.y() : y});
    }
    return std::pair(low, high);
  };
  const auto [first, last] = std::minmax_element(
      hull.begin(), hull.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
  constexpr int kPlaces = 64;
  std::vector<std::pair<double, double>> spans;
  const double begin = first->x(), step = (last->x() - begin) / kPlaces;
  for (int i = 0; i <= kPlaces; ++i) {
    spans.push_back(span(i == kPlaces ? last->x() : begin + i * step));
  }
  Rectangle best;
  for (int i = 0; i <= kPlaces; ++i) {
    for (int k = i + 1; k <= kPlaces; ++k) {
      const auto& [low_i, high_i] = Nth(spans, i);
      const auto& [low_k, high_k] = Nth(spans, k);
      const double low = std::max(low_i, low_k), high = std::min(high_i, high_k);
      const Vector2d size((k - i) * step, high - low);
      if (size.y() > 0 && size.prod() > best.size.prod()) {
        best = {{begin + 0.5 * (i + k) * step, 0.5 * (low + high)}, size};
      }
    }
  }
  return best;
}

FoundSole FindSole(const Leg& leg, const std::vector<const RobotBody*>& bodies) {
  const Matrix3d R_FB = leg.joints[5].X_BLink.linear().transpose();
  const Vector3d down = R_FB * -Vector3d::UnitZ();
  Vector3d normal = LargestFace(bodies, down);
  if (normal.isZero()) {
    throw std::runtime_error("the foot " + bodies.front()->name +
                             " has no flat part that faces the floor with all joints at zero");
  }
  FoundSole sole;
  sole.tilt = Acos(std::min(1.0, normal.dot(down)));
  normal = sole.tilt < kFlat ? down : Snapped(normal, kFlat);
  Matrix3d R;
  R.col(2) = -normal;
  const Vector3d forward = R_FB * Vector3d::UnitX();
  R.col(0) = (forward - forward.dot(normal) * normal).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  double lowest = 0.0;
  const Rectangle carries = LargestRectangle(Touching(bodies, R, &lowest));
  if (carries.size.minCoeff() < 5e-3) {
    throw std::runtime_error("the foot " + bodies.front()->name +
                             " stands on an edge or a point, not on a flat part");
  }
  sole.size = carries.size;
  sole.depth = -lowest;
  sole.X_FootSole.linear() = R;
  sole.X_FootSole.translation() = R * Vector3d(carries.centre.x(), carries.centre.y(), lowest);
  return sole;
}

}  // namespace

Matrix3d FindWaistRotation(const UrdfTree& urdf, const FoundLegs& legs) {
  const auto X = urdf.LinkPoses(std::vector<double>(urdf.joints.size(), 0.0));
  const Isometry3d X_WaistRoot = Nth(X, legs.waist).inverse();
  const auto origin = [&](int joint) {
    return Vector3d(X_WaistRoot * Nth(X, Nth(urdf.joints, joint).child).translation());
  };
  const std::array<Vector3d, 2> hips{origin(legs.joints[0][2]), origin(legs.joints[1][2])};
  const std::array<Vector3d, 2> feet{origin(legs.joints[0][5]), origin(legs.joints[1][5])};
  const Vector3d up = Snapped((hips[0] + hips[1] - feet[0] - feet[1]).normalized(), kUpright);
  Vector3d left = hips[0] - hips[1];
  left = (left - left.dot(up) * up).normalized();
  Matrix3d R;
  R.col(2) = up;
  R.col(1) = Snapped(left, kOnePart);
  R.col(0) = R.col(1).cross(R.col(2));
  return R;
}

std::array<FoundSole, 2> FindSoles(const std::array<Leg, 2>& legs,
                                   const std::vector<RobotBody>& bodies) {
  const Eigen::DiagonalMatrix<double, 3> mirror(1, -1, 1);
  std::array<FoundSole, 2> soles;
  std::array<Isometry3d, 2> X_BSole;
  for (size_t side = 0; side < 2; ++side) {
    std::vector<const RobotBody*> foot;
    for (const RobotBody& body : bodies) {
      if (body.leg == static_cast<int>(side) && body.link == 5) foot.push_back(&body);
    }
    if (foot.empty()) {
      throw std::runtime_error("the " + std::string(Name(side == 0 ? Side::kLeft : Side::kRight)) +
                               " foot has no collision bodies");
    }
    soles[side] = FindSole(legs[side], foot);
    X_BSole[side] = legs[side].joints[5].X_BLink * soles[side].X_FootSole;
  }
  // What both have in common, as mirror images.
  const Vector3d left = X_BSole[0].translation(), right = mirror * X_BSole[1].translation();
  Vector3d both = 0.5 * (left + right);
  both.z() = std::min(left.z(), right.z());
  const Vector2d size = soles[0].size.cwiseMin(soles[1].size);
  const Matrix3d R = X_BSole[0].linear();
  X_BSole[0].translation() = both;
  X_BSole[1].translation() = mirror * both;
  X_BSole[1].linear() = mirror * R * mirror;
  for (size_t side = 0; side < 2; ++side) {
    soles[side].size = size;
    soles[side].X_FootSole = legs[side].joints[5].X_BLink.inverse() * X_BSole[side];
  }
  return soles;
}

}  // namespace halfstep
