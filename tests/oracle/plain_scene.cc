#include "tests/oracle/plain_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "tests/oracle/real.h"

namespace halfstep::oracle {
namespace {

using Point = std::array<Real, 3>;
constexpr double kReach = 6;  // half the edge of the box that meshes are cut to [m]

Point Cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Turns about fixed x, then y, then z: R = R_z R_y R_x.
std::array<Point, 3> Rotation(const Eigen::Vector3d& rpy_deg) {
  std::array<Real, 3> c, s;
  for (size_t i = 0; i < 3; ++i) {
    const Real angle =
        Real(rpy_deg[static_cast<Eigen::Index>(i)]) * (Real(std::numbers::pi_v<long double>) / 180);
    c[i] = Cos(angle);
    s[i] = Sin(angle);
  }
  return {Point{c[2] * c[1], c[2] * s[1] * s[0] - s[2] * c[0], c[2] * s[1] * c[0] + s[2] * s[0]},
          Point{s[2] * c[1], s[2] * s[1] * s[0] + c[2] * c[0], s[2] * s[1] * c[0] - c[2] * s[0]},
          Point{-s[1], c[1] * s[0], c[1] * c[0]}};
}

// From the obstacle's frame to W, as seen from `center`.
Point Place(const PlainObstacle& o, const std::array<Point, 3>& R, const Eigen::Vector3d& center,
            const Point& p) {
  Point placed;
  for (size_t i = 0; i < 3; ++i) {
    const Eigen::Index k = static_cast<Eigen::Index>(i);
    placed[i] = Dot(R[i], p) + Real(o.xyz[k]) - Real(center[k]);
  }
  return placed;
}

Eigen::Vector3d ToDouble(const Point& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

// A polygon's part in the box |x|, |y|, |z| ≤ kReach, side after side.
std::vector<Point> CutToBox(std::vector<Point> polygon) {
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const int sign : {1, -1}) {
      std::vector<Point> kept;
      for (size_t i = 0; i < polygon.size(); ++i) {
        const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const Real out_a = sign * a[axis] - kReach, out_b = sign * b[axis] - kReach;
        if (out_a <= 0) kept.push_back(a);
        if ((out_a < 0 && out_b > 0) || (out_a > 0 && out_b < 0)) {
          const Real s = out_a / (out_a - out_b);
          Point p;
          for (size_t k = 0; k < 3; ++k) p[k] = a[k] + s * (b[k] - a[k]);
          kept.push_back(p);
        }
      }
      polygon = std::move(kept);
    }
  }
  return polygon;
}

// Components by shared vertices: the component of each triangle.
std::vector<int> ComponentsOf(const PlainObstacle& mesh) {
  std::vector<int> label(mesh.vertices.size());
  std::iota(label.begin(), label.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& t : mesh.triangles) {
      const int least =
          std::min({label[static_cast<size_t>(t[0])], label[static_cast<size_t>(t[1])],
                    label[static_cast<size_t>(t[2])]});
      for (const int v : t) {
        changed |= label[static_cast<size_t>(v)] != least;
        label[static_cast<size_t>(v)] = least;
      }
    }
  }
  std::vector<int> of;
  for (const auto& t : mesh.triangles) of.push_back(label[static_cast<size_t>(t[0])]);
  return of;
}

// Signed solid angle of a triangle seen from the origin, by Girard's theorem: the sum of the angles
// of the spherical triangle, less π.
long double SolidAngle(const std::array<Point, 3>& t) {
  const Real volume = Dot(t[0], Cross(t[1], t[2]));
  if (volume == 0) return 0;
  std::array<Point, 3> side;  // normals of the planes through the origin and an edge
  for (size_t i = 0; i < 3; ++i) side[i] = Cross(t[i], t[(i + 1) % 3]);
  long double sum = -std::numbers::pi_v<long double>;
  for (size_t i = 0; i < 3; ++i) {
    const Point &a = side[(i + 2) % 3], &b = side[i];
    const Real cosine = -Dot(a, b), sine = Sqrt(Dot(Cross(a, b), Cross(a, b)));
    sum += std::atan2(static_cast<long double>(sine / Sqrt(Dot(a, a) * Dot(b, b))),
                      static_cast<long double>(cosine / Sqrt(Dot(a, a) * Dot(b, b))));
  }
  return volume > 0 ? sum : -sum;
}

bool RayHits(const std::array<Point, 3>& t, const Point& d) {
  // The origin's ray along d goes through the triangle when d is a sum of its corners with weights
  // of one sign, by Cramer's rule.
  const Real volume = Dot(t[0], Cross(t[1], t[2]));
  if (volume == 0) return false;
  for (size_t i = 0; i < 3; ++i) {
    if (Dot(d, Cross(t[(i + 1) % 3], t[(i + 2) % 3])) / volume < 0) return false;
  }
  return true;
}

}  // namespace

PlacedScene::PlacedScene(const PlainScene& scene, const Eigen::Vector3d& center)
    : center_(center), ground_(scene.has_floor, scene.surfaces) {
  for (const PlainObstacle& o : scene.obstacles) {
    Placed& placed = obstacles_.emplace_back();
    placed.name = o.name;
    placed.motion = o;
    placed.motion.vertices.clear();
    placed.motion.triangles.clear();
    if (o.kind == PlainObstacle::Kind::kMesh) {
      AddMesh(o, &placed);
    } else if (o.kind == PlainObstacle::Kind::kPoints) {
      AddCloud(o, &placed);
    } else {
      const auto R = Rotation(o.rpy_deg);
      const auto at = [&](double x, double y, double z) {
        return Eigen::Vector3d(ToDouble(Place(o, R, center, {x, y, z})) + center);
      };
      Piece piece;
      const double half = 0.5 * o.size[1];
      switch (o.kind) {
        case PlainObstacle::Kind::kBox:
          for (int k = 0; k < 8; ++k) {
            piece.set.points.push_back(at((k & 1 ? 0.5 : -0.5) * o.size[0],
                                          (k & 2 ? 0.5 : -0.5) * o.size[1],
                                          (k & 4 ? 0.5 : -0.5) * o.size[2]));
          }
          break;
        case PlainObstacle::Kind::kSphere:
          piece.set.points = {at(0, 0, 0)};
          piece.set.ball = o.size[0];
          break;
        case PlainObstacle::Kind::kCapsule:
          piece.set.points = {at(0, 0, -half), at(0, 0, half)};
          piece.set.ball = o.size[0];
          break;
        default:
          piece.set.points = {at(0, 0, -half), at(0, 0, half)};
          piece.set.disc = o.size[0];
          piece.set.disc_axis = ToDouble({R[0][2], R[1][2], R[2][2]});
      }
      placed.pieces.push_back(std::move(piece));
    }
    for (Piece& piece : placed.pieces) {
      piece.center.setZero();
      for (const auto& p : piece.set.points) {
        piece.center += p / static_cast<double>(piece.set.points.size());
      }
      for (const auto& p : piece.set.points) {
        piece.radius = std::max(piece.radius, (p - piece.center).norm());
      }
      piece.radius = (piece.radius + piece.set.disc + piece.set.ball) * (1 + 1e-9) + 1e-9;
      placed.radius = std::max(placed.radius, (piece.center - o.xyz).norm() + piece.radius);
    }
  }
}

Eigen::Vector3d PlacedScene::AtStart(size_t obstacle, double t,
                                     const Eigen::Vector3d& point) const {
  const PlainObstacle& o = obstacles_[obstacle].motion;
  if (o.waypoints.empty() || t <= 0) return point;
  PlainObstacle::Waypoint from{.t = 0, .xyz = o.xyz, .yaw_deg = 0}, at = o.waypoints.back();
  for (const PlainObstacle::Waypoint& to : o.waypoints) {
    if (t < to.t) {
      const double share = (t - from.t) / (to.t - from.t);
      at.xyz = from.xyz + share * (to.xyz - from.xyz);
      at.yaw_deg = from.yaw_deg + share * (to.yaw_deg - from.yaw_deg);
      break;
    }
    from = to;
  }
  const double yaw = at.yaw_deg * std::numbers::pi / 180;
  return o.xyz + Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()) * (point - at.xyz);
}

double PlacedScene::Uncertainty(size_t obstacle, double t) const {
  const PlainObstacle& o = obstacles_[obstacle].motion;
  double since = std::abs(t - o.measured_at);
  if (o.horizon >= 0) since = std::min(since, o.horizon);
  return o.error + o.speed * since;
}

double PlacedScene::speed(size_t obstacle) const {
  const Placed& placed = obstacles_[obstacle];
  double fastest = 0;
  PlainObstacle::Waypoint from{.t = 0, .xyz = placed.motion.xyz, .yaw_deg = 0};
  for (const PlainObstacle::Waypoint& to : placed.motion.waypoints) {
    const double turn = std::abs(to.yaw_deg - from.yaw_deg) * std::numbers::pi / 180;
    fastest =
        std::max(fastest, ((to.xyz - from.xyz).norm() + turn * placed.radius) / (to.t - from.t));
    from = to;
  }
  return fastest + placed.motion.speed;
}

// A cloud as planner/README.md has it: the cubes of edge r, of the lattice through the origin of
// the cloud's frame, that the ball of radius r around a point meets.
void PlacedScene::AddCloud(const PlainObstacle& cloud, Placed* placed) const {
  const auto R = Rotation(cloud.rpy_deg);
  const double r = cloud.size[0];
  std::set<std::array<long, 3>> cubes;
  for (const Eigen::Vector3d& p : cloud.vertices) {
    std::array<long, 3> own{};
    for (size_t k = 0; k < 3; ++k) {
      own[k] = std::lround(std::floor(p[static_cast<Eigen::Index>(k)] / r));
    }
    for (int neighbour = 0; neighbour < 125; ++neighbour) {
      const std::array<long, 3> cube = {own[0] + neighbour % 5 - 2, own[1] + neighbour / 5 % 5 - 2,
                                        own[2] + neighbour / 25 - 2};
      Real squared = 0;
      for (size_t k = 0; k < 3; ++k) {
        const Real at = p[static_cast<Eigen::Index>(k)], low = Real(cube[k]) * r, high = low + r;
        const Real off = at < low ? low - at : at > high ? at - high : Real(0);
        squared += off * off;
      }
      if (squared <= Real(r) * r) cubes.insert(cube);
    }
  }
  for (const std::array<long, 3>& cube : cubes) {
    Piece piece;
    for (int k = 0; k < 8; ++k) {
      const Point corner = {Real(r) * Real(cube[0] + (k & 1)),
                            Real(r) * Real(cube[1] + (k >> 1 & 1)),
                            Real(r) * Real(cube[2] + (k >> 2))};
      piece.set.points.push_back(ToDouble(Place(cloud, R, center_, corner)) + center_);
    }
    placed->pieces.push_back(std::move(piece));
  }
}

void PlacedScene::AddMesh(const PlainObstacle& mesh, Placed* placed) const {
  const auto R = Rotation(mesh.rpy_deg);
  std::vector<Point> points;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    // The scaled vertex is a double number: that is what the file means to every reader.
    points.push_back(
        Place(mesh, R, center_, {mesh.scale * v.x(), mesh.scale * v.y(), mesh.scale * v.z()}));
  }
  const std::vector<int> components = ComponentsOf(mesh);
  std::vector<int> seen;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::vector<Point> corners;
    Triangle whole;
    for (size_t k = 0; k < 3; ++k) {
      corners.push_back(points[static_cast<size_t>(mesh.triangles[i][k])]);
      whole[k] = ToDouble(corners.back());
    }
    const auto known = std::find(seen.begin(), seen.end(), components[i]);
    const size_t c = static_cast<size_t>(known - seen.begin());
    if (known == seen.end()) {
      seen.push_back(components[i]);
      placed->components.emplace_back();
    }
    placed->components[c].push_back(whole);
    for (const Eigen::Vector3d& corner : whole) placed->bounds.extend(corner);
    Piece piece;
    for (const Point& p : CutToBox(corners)) piece.set.points.push_back(ToDouble(p) + center_);
    if (!piece.set.points.empty()) placed->pieces.push_back(std::move(piece));
  }
}

Bracket PlacedScene::Distance(size_t obstacle, const ConvexSet& set, const Eigen::Vector3d& center,
                              double radius, double enough) const {
  Bracket least{enough, enough};
  for (const Piece& piece : obstacles_[obstacle].pieces) {
    if ((piece.center - center).norm() - piece.radius - radius >= least.lower) continue;
    const Bracket here = DistanceOf(set, piece.set);
    least.lower = std::min(least.lower, here.lower);
    least.upper = std::min(least.upper, here.upper);
  }
  return least;
}

double PlacedScene::BallDistance(size_t obstacle, const Eigen::Vector3d& center,
                                 double radius) const {
  double least = 1e9;
  for (const Piece& piece : obstacles_[obstacle].pieces) {
    least = std::min(least, (piece.center - center).norm() - piece.radius - radius);
  }
  return least;
}

bool PlacedScene::MightSurround(size_t obstacle, const Eigen::Vector3d& point) const {
  return obstacles_[obstacle].bounds.contains(point - center_);
}

PlacedScene::Inside PlacedScene::Around(size_t obstacle, const Eigen::Vector3d& point) const {
  Inside inside;
  const Eigen::Vector3d from = point - center_;
  long double sum = 0;
  std::vector<Point> rays;
  for (const int x : {-1, 0, 1}) {
    for (const int y : {-1, 0, 1}) {
      for (const int z : {-1, 0, 1}) {
        const int count = std::abs(x) + std::abs(y) + std::abs(z);
        if (count == 1 || count == 3) {
          rays.push_back({Real(x + 0.0137), Real(y + 0.0071), Real(z - 0.0193)});
        }
      }
    }
  }
  std::vector<bool> hit(rays.size(), false);
  for (const std::vector<Triangle>& component : obstacles_[obstacle].components) {
    long double winding = 0;
    for (const Triangle& triangle : component) {
      std::array<Point, 3> seen;
      for (size_t k = 0; k < 3; ++k) {
        for (size_t axis = 0; axis < 3; ++axis) {
          const Eigen::Index a = static_cast<Eigen::Index>(axis);
          seen[k][axis] = Real(triangle[k][a]) - Real(from[a]);
        }
      }
      winding += SolidAngle(seen) / (4 * std::numbers::pi_v<long double>);
      for (size_t r = 0; r < rays.size(); ++r) hit[r] = hit[r] || RayHits(seen, rays[r]);
    }
    inside.component = std::max(inside.component, static_cast<double>(std::abs(winding)));
    sum += winding;
  }
  inside.sum = static_cast<double>(std::abs(sum));
  inside.surrounded = std::find(hit.begin(), hit.end(), false) == hit.end();
  return inside;
}

}  // namespace halfstep::oracle
