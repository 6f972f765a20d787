#include "wpg/geometry/simplified_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "wpg/check.h"
#include "wpg/geometry/distinct_normals.h"
#include "wpg/geometry/outside_bound.h"
#include "wpg/geometry/triangle_weights.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

constexpr double kFlat = 0.02;         // of the surface: a face that counts as flat.
constexpr double kSameFace = 3e-5;     // distance of unit normals of one flat face.
constexpr double kDeep = 1e-9;         // of the size: a cut that is worth a plane.
constexpr double kMostOutside = 1e-9;  // of the size: what is left outside by rounding.

// Seen from a point inside the hull, so that every half-space is n·x ≤ h with h > 0.
class HalfSpaceCuts {
 public:
  HalfSpaceCuts(const ConvexBody& hull, int vertices) : hull_(hull), vertices_(vertices) {
    center_ = hull.vertices.rowwise().mean();
    points_ = hull.vertices.colwise() - center_;
    size_ = points_.colwise().norm().maxCoeff();
    heights_.resize(hull.normals.cols());
    for (Eigen::Index f = 0; f < heights_.size(); ++f) heights_[f] = Height(hull.normals.col(f));
  }

  // The corners of the intersection [m], in the hull's frame; none when there are too many at once.
  std::optional<Eigen::Matrix3Xd> Run(const Eigen::Matrix3Xd& kept) {
    for (const Vector3d& n : kept.colwise()) planes_.push_back(n / Height(n));
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        planes_.push_back(sign * Vector3d::Unit(axis) / Height(sign * Vector3d::Unit(axis)));
      }
    }
    std::optional<Eigen::Matrix3Xd> best = Corners();
    if (!best) return std::nullopt;
    const auto add = [&](const Vector3d& normal) {
      planes_.push_back(normal / Height(normal));
      auto corners = Corners();
      if (corners) best = std::move(corners);
      return corners.has_value();
    };
    for (const Vector3d& normal : FlatFaces()) {
      if (!add(normal)) return best->colwise() + center_;
    }
    for (;;) {
      const auto deepest = DeepestCut(*best);
      if (!deepest || !add(*deepest)) return best->colwise() + center_;
    }
  }

 private:
  double Height(const Vector3d& n) const { return (n.transpose() * points_).maxCoeff(); }

  // A polytope's corners are the face normals of its polar, divided by their heights; the polar is
  // the hull of the planes' normals, divided by theirs.
  std::optional<Eigen::Matrix3Xd> Corners() const {
    Eigen::Matrix3Xd polar_points(3, static_cast<Eigen::Index>(planes_.size()));
    for (size_t i = 0; i < planes_.size(); ++i) {
      polar_points.col(static_cast<Eigen::Index>(i)) = planes_[i];
    }
    const ConvexBody polar = MakeHull(polar_points);
    if (polar.normals.cols() > vertices_) return std::nullopt;
    Eigen::Matrix3Xd corners = polar.normals;
    for (auto corner : corners.colwise()) {
      corner /= (corner.transpose() * polar.vertices).maxCoeff();
    }
    return corners;
  }

  // Normals of the faces with a good part of the surface, the largest first.
  std::vector<Vector3d> FlatFaces() const {
    DistinctNormals distinct(kSameFace);
    std::vector<double> areas;
    double surface = 0;
    for (const Eigen::Vector3i& t : hull_.triangles) {
      const Vector3d a = points_.col(t[0]);
      const Vector3d n = (points_.col(t[1]) - a).cross(points_.col(t[2]) - a);
      const double area = n.norm();
      if (!(area > 0)) continue;
      surface += area;
      const size_t face = distinct.Add(n / area);
      areas.resize(distinct.kept().size());
      areas[face] += area;
    }
    std::vector<size_t> flat;
    for (size_t face = 0; face < areas.size(); ++face) {
      if (areas[face] > kFlat * surface) flat.push_back(face);
    }
    std::stable_sort(flat.begin(), flat.end(),
                     [&](size_t a, size_t b) { return areas[a] > areas[b]; });
    std::vector<Vector3d> normals;
    for (const size_t face : flat) normals.push_back(distinct.kept()[face]);
    return normals;
  }

  // The normal of the hull's face that one of the corners is farthest beyond.
  std::optional<Vector3d> DeepestCut(const Eigen::Matrix3Xd& corners) const {
    double deepest = kDeep * size_;
    std::optional<Vector3d> normal;
    for (Eigen::Index f = 0; f < heights_.size(); ++f) {
      const Vector3d n = hull_.normals.col(f);
      const double depth = (n.transpose() * corners).maxCoeff() - heights_[f];
      if (depth > deepest) {
        deepest = depth;
        normal = n;
      }
    }
    return normal;
  }

  const ConvexBody& hull_;
  const int vertices_;
  Vector3d center_;
  Eigen::Matrix3Xd points_;
  double size_ = 0.0;
  Eigen::VectorXd heights_;       // of the hull along its face normals
  std::vector<Vector3d> planes_;  // n/h
};

// The distance of a point from the surface of the hull of a body's vertices, rounded up.
double DistanceFrom(const ConvexBody& body, const Vector3d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3i& t : body.triangles) {
    const Vector3d a = body.vertices.col(t[0]) - point, b = body.vertices.col(t[1]) - point,
                   c = body.vertices.col(t[2]) - point;
    const auto [u, v, w] = TriangleWeights(a, b, c);
    nearest = std::min(nearest, (u * a + v * b + w * c).norm());
  }
  return nearest + 16 * std::numeric_limits<double>::epsilon() * (point.norm() + body.radius);
}

// The intersection of half-spaces.
SimplifiedHull Cut(const ConvexBody& hull, int vertices, const Eigen::Matrix3Xd& kept) {
  const auto corners = HalfSpaceCuts(hull, vertices).Run(kept);
  if (!corners) return {hull, 0.0};
  SimplifiedHull simplified{MakeHull(*corners), 0.0};
  ConvexBody& body = simplified.body;
  const double outside = OutsideBound(body, hull.vertices);
  if (body.vertices.cols() > vertices || !(outside < kMostOutside * hull.radius)) {
    return {hull, 0.0};
  }
  for (const Vector3d& corner : body.vertices.colwise()) {
    simplified.excess = std::max(simplified.excess, DistanceFrom(hull, corner));
  }
  body.ball_radius = outside + hull.ball_radius;
  simplified.excess += outside;
  BoundBySphere(&body);
  return simplified;
}

// The vertices of a hull that are deepest outside each face of the hull of some of them, deepest
// first.
std::vector<int> DeepestOutside(const ConvexBody& hull, const ConvexBody& inner) {
  Eigen::VectorXd heights(inner.normals.cols());
  for (Eigen::Index f = 0; f < heights.size(); ++f) {
    const Vector3d n = inner.normals.col(f);
    heights[f] = n.dot(inner.vertices.col(FarthestVertex(inner, n)));
  }
  std::vector<std::pair<double, int>> deepest(static_cast<size_t>(heights.size()), {0.0, -1});
  for (int i = 0; i < static_cast<int>(hull.vertices.cols()); ++i) {
    Eigen::Index face = 0;
    const double depth =
        (inner.normals.transpose() * hull.vertices.col(i) - heights).maxCoeff(&face);
    auto& known = Nth(deepest, face);
    if (depth > known.first) known = {depth, i};
  }
  std::ranges::stable_sort(deepest, std::ranges::greater{}, &std::pair<double, int>::first);
  std::vector<int> vertices;
  for (const auto& [depth, vertex] : deepest) {
    if (vertex >= 0) vertices.push_back(vertex);
  }
  return vertices;
}

// The hull of some vertices, the farthest outside the hull of those before, and a ball around.
SimplifiedHull Rounded(const ConvexBody& hull, int vertices) {
  std::vector<int> chosen;
  const auto choose = [&](int vertex) {
    if (std::find(chosen.begin(), chosen.end(), vertex) == chosen.end()) chosen.push_back(vertex);
  };
  for (int k = 0; k < 27; k += 2) {  // towards the corners and faces of a cube
    choose(FarthestVertex(hull, Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)));
  }
  for (;;) {
    ConvexBody body = MakeHull(hull.vertices(Eigen::all, chosen));
    // A quarter of those that are still to come at once.
    std::vector<int> more = DeepestOutside(hull, body);
    const size_t room = static_cast<size_t>(vertices) - chosen.size();
    more.resize(std::min(more.size(), (room + 3) / 4));
    const size_t before = chosen.size();
    for (const int vertex : more) choose(vertex);
    if (chosen.size() > before) continue;
    double outside = 0;
    for (const Vector3d& v : hull.vertices.colwise()) {
      outside = std::max(outside, DistanceFrom(body, v));
    }
    body.ball_radius = outside + hull.ball_radius;
    BoundBySphere(&body);
    return {std::move(body), outside};
  }
}

}  // namespace

SimplifiedHull SimplifyOutward(const ConvexBody& hull, int vertices, const Eigen::Matrix3Xd& kept) {
  HALFSTEP_CHECK(vertices >= kFewestHullVertices && !hull.triangles.empty() &&
                     hull.disc_radius == 0 && kept.cols() <= 6,
                 vertices << " vertices, " << hull.triangles.size() << " triangles, disc "
                          << hull.disc_radius << ", " << kept.cols() << " kept directions");
  if (hull.vertices.cols() <= vertices) return {hull, 0.0};
  std::vector<SimplifiedHull> found;
  const auto attempt = [&](const auto& simplify) {
    try {
      SimplifiedHull simplified = simplify();
      if (simplified.body.vertices.cols() <= vertices) found.push_back(std::move(simplified));
    } catch (const std::runtime_error&) {  // too thin a hull, or too thin a polar
    }
  };
  attempt([&] { return Cut(hull, vertices, kept); });
  if (kept.cols() == 0) attempt([&] { return Rounded(hull, vertices); });
  if (found.empty()) return {hull, 0.0};
  return *std::ranges::min_element(found, {}, &SimplifiedHull::excess);
}

}  // namespace halfstep
