#include "experiments/survey/found_soles.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "experiments/survey/found_frames.h"
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

// What is less above the lowest point touches [m]: of flat parts, and of what is round or pointed.
constexpr double kNearFloor = 1e-3, kOnFloor = 2e-4;
// The normal of a flat part, or of a plane through corners, is the axis that is nearer than this;
// triangles that face within this of each other are one flat part [rad].
constexpr double kFlat = 0.01, kPlane = 1e-4, kOnePart = 0.02;
constexpr double kLeastSole = 5e-3;  // either side of its rectangle [m]
// Of the largest rectangle on which a foot can stand, what a flat part has at least.
constexpr double kCarries = 0.5;

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
                               double near, double* lowest) {
  const Vector3d up = R.col(2);
  *lowest = std::numeric_limits<double>::infinity();
  for (const RobotBody* body : bodies) *lowest = std::min(*lowest, -Support(body->shape, -up));
  std::vector<Vector2d> points;
  for (const RobotBody* body : bodies) {
    const double ball = body->shape.ball_radius, disc = body->shape.disc_radius;
    const double tilt = disc * up.head<2>().norm();
    for (const Vector3d& v : body->shape.vertices.colwise()) {
      if (up.dot(v) - ball - tilt > *lowest + near) continue;
      const Vector2d at(R.col(0).dot(v), R.col(1).dot(v));
      points.push_back(at);
      // Inside of a disc's edge.
      for (int k = 0; disc > 0 && tilt < near && k < 64; ++k) {
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

// The directions in which planes through three or more corners of the bodies face, within 60° of
// `down`, with all corners on one side. Corners are those of the shapes' cores: a ball's centre,
// the ends of a cylinder's axis.
std::vector<Vector3d> PlanesBelow(const std::vector<const RobotBody*>& bodies,
                                  const Vector3d& down) {
  Eigen::Index count = 0;
  for (const RobotBody* body : bodies) count += body->shape.vertices.cols();
  Eigen::Matrix3Xd corners(3, count);
  for (const RobotBody* body : bodies) {
    const Eigen::Index n = body->shape.vertices.cols();
    corners.middleCols(count -= n, n) = body->shape.vertices;
  }
  std::vector<Vector3d> normals;
  const auto add = [&](const Vector3d& normal) {
    if (normal.dot(down) > 0.5) normals.push_back(normal);
  };
  if (corners.cols() < 3) return normals;
  const Vector3d middle = corners.rowwise().mean();
  const Eigen::JacobiSVD<Eigen::Matrix3Xd> svd(corners.colwise() - middle, Eigen::ComputeFullU);
  if (svd.singularValues()[2] > 1e-6 * svd.singularValues()[0]) {
    const ConvexBody hull = MakeHull(corners);
    for (const Vector3d& normal : hull.normals.colwise()) add(normal);
  } else if (svd.singularValues()[1] > 1e-6 * svd.singularValues()[0]) {
    const Vector3d normal = svd.matrixU().col(2);
    add(normal.dot(down) < 0 ? Vector3d(-normal) : normal);
  }
  return normals;
}

// The rectangle on which a foot stands when a floor lies across `normal`, which points down, or
// across an axis within `snap` of it. What is less than `near` above the floor touches.
FoundSole SoleAcross(const Matrix3d& R_FB, const std::vector<const RobotBody*>& bodies,
                     Vector3d normal, double snap, double near) {
  const Vector3d down = R_FB * -Vector3d::UnitZ();
  FoundSole sole;
  sole.tilt = Acos(std::min(1.0, normal.dot(down)));
  normal = sole.tilt < snap ? down : Snapped(normal, snap);
  Matrix3d R;
  R.col(2) = -normal;
  const Vector3d forward = R_FB * Vector3d::UnitX();
  R.col(0) = (forward - forward.dot(normal) * normal).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  double lowest = 0.0;
  const Rectangle carries = LargestRectangle(Touching(bodies, R, near, &lowest));
  sole.size = carries.size;
  sole.depth = -lowest;
  sole.X_FootSole.linear() = R;
  sole.X_FootSole.translation() = R * Vector3d(carries.centre.x(), carries.centre.y(), lowest);
  return sole;
}

FoundSole FindSole(const Leg& leg, const std::vector<const RobotBody*>& bodies) {
  const Matrix3d R_FB = leg.joints[5].X_BLink.linear().transpose();
  const Vector3d down = R_FB * -Vector3d::UnitZ();
  FoundSole flat;
  if (const Vector3d normal = LargestFace(bodies, down); !normal.isZero()) {
    flat = SoleAcross(R_FB, bodies, normal, kFlat, kNearFloor);
    flat.what =
        "the largest flat part of each foot's bodies and all that is less than 1 mm above its "
        "lowest point";
  }
  FoundSole best;
  std::vector<Vector3d> normals = PlanesBelow(bodies, down);
  normals.insert(normals.begin(), down);
  for (const Vector3d& normal : normals) {
    const FoundSole sole = SoleAcross(R_FB, bodies, normal, kPlane, kOnFloor);
    if (sole.size.minCoeff() >= kLeastSole && sole.size.prod() > best.size.prod()) best = sole;
  }
  best.what = "the plane below each foot's lowest balls, cylinders, edges and points";
  // A flat part that carries little is a facet of what is round.
  const bool carries = flat.size.minCoeff() >= kLeastSole;
  if (carries && kCarries * best.size.prod() < flat.size.prod()) return flat;
  if (best.size.isZero()) {
    throw std::runtime_error("the foot " + bodies.front()->name +
                             " stands on an edge or a point with all joints at zero (valid: a flat "
                             "part, or three balls, edges or points; or --sole LENGTH WIDTH)");
  }
  return best;
}

// The sole that the user knows, below the lowest point of the bodies or the foot's origin.
FoundSole StatedSole(const Leg& leg, Side side, const std::vector<const RobotBody*>& bodies,
                     const StatedSoles& stated) {
  const Matrix3d R_FB = leg.joints[5].X_BLink.linear().transpose();
  FoundSole sole = bodies.empty()
                       ? FoundSole{}
                       : SoleAcross(R_FB, bodies, R_FB * -Vector3d::UnitZ(), kFlat, kNearFloor);
  if (bodies.empty()) sole.X_FootSole.linear() = R_FB;
  if (bodies.empty() || stated.centre) {
    const Vector2d ahead = stated.centre.value_or(Vector2d::Zero());
    const Vector3d centre(ahead.x(), Sign(side) * ahead.y(), -sole.depth);
    sole.X_FootSole.translation() = sole.X_FootSole.linear() * centre;
  }
  sole.size = stated.size;
  sole.what = "as stated by --sole";
  return sole;
}

}  // namespace

std::array<FoundSole, 2> FindSoles(const std::array<Leg, 2>& legs,
                                   const std::vector<RobotBody>& bodies,
                                   const std::optional<StatedSoles>& stated) {
  std::array<FoundSole, 2> soles;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    std::vector<const RobotBody*> foot;
    for (const RobotBody& body : bodies) {
      if (body.leg == Index(side) && body.link == 5) foot.push_back(&body);
    }
    if (stated) {
      Nth(soles, side) = StatedSole(Nth(legs, side), side, foot, *stated);
      continue;
    }
    if (foot.empty()) {
      throw std::runtime_error("the " + std::string(Name(side)) +
                               " foot has no collision bodies (valid: some, or --sole LENGTH WIDTH "
                               "AHEAD OUTWARDS)");
    }
    Nth(soles, side) = FindSole(Nth(legs, side), foot);
  }
  return soles;
}

}  // namespace halfstep
