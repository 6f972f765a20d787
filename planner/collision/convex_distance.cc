#include "planner/collision/convex_distance.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <vector>

#include "wpg/elementary.h"
#include "wpg/geometry/triangle_weights.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

constexpr double kConverged = 1e-10;  // [m] gap of the two bounds at which the search stops.
constexpr double kTouching = 1e-11;   // [m] below it the cores count as overlapping.
constexpr int kMaxIterations = 128;
constexpr size_t kClimbs = 4;       // local searches for the least penetration.
constexpr double kNeighbour = 0.9;  // cosine between directions that climb to the same place.

// The core of a body is what remains without its ball. Farthest core point along d.
Vector3d CoreSupport(const ConvexBody& body, const Vector3d& d) {
  Vector3d point = body.vertices.col(FarthestVertex(body, d));
  if (body.disc_radius > 0) {
    const double radial = d.head<2>().norm();
    if (radial > 0) point.head<2>() += body.disc_radius / radial * d.head<2>();
  }
  return point;
}

// A point of the difference a − b of the cores, with the two points that it comes from.
struct Corner {
  Vector3d w, a, b;
};

// Up to four corners; `weight` are those of the point of their hull nearest to the origin.
struct Simplex {
  std::array<Corner, 4> corner;
  std::array<double, 4> weight{};
  int size = 0;

  Vector3d Nearest() const {
    Vector3d v = Vector3d::Zero();
    for (int i = 0; i < size; ++i) v += Nth(weight, i) * Nth(corner, i).w;
    return v;
  }
  void Keep(std::array<int, 3> which, std::array<double, 3> weights) {
    std::array<Corner, 3> kept;
    int n = 0;
    for (size_t i = 0; i < 3; ++i) {
      if (which[i] < 0 || !(weights[i] > 0)) continue;
      Nth(kept, n) = Nth(corner, which[i]);
      Nth(weight, n++) = weights[i];
    }
    std::copy(kept.begin(), kept.begin() + n, corner.begin());
    size = n;
  }
};

// Reduces the simplex to the face nearest to the origin; false when it holds the origin.
bool Reduce(Simplex* s) {
  const auto& p = s->corner;
  if (s->size == 1) {
    s->weight[0] = 1;
  } else if (s->size == 2) {
    s->Keep({0, 1, -1}, SegmentWeights(p[0].w, p[1].w));
  } else if (s->size == 3) {
    s->Keep({0, 1, 2}, TriangleWeights(p[0].w, p[1].w, p[2].w));
  } else {
    // Corner 3 is the newest: faces without it are not nearer. Opposite corner of each face last.
    constexpr std::array<std::array<int, 4>, 4> kFaces{
        {{0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}, {0, 1, 2, 3}}};
    bool inside = true;
    double nearest = std::numeric_limits<double>::infinity();
    std::array<int, 3> best_face{};
    std::array<double, 3> best_weights{};
    for (const auto& face : kFaces) {
      const Vector3d &a = Nth(p, face[0]).w, &b = Nth(p, face[1]).w;
      const Vector3d &c = Nth(p, face[2]).w, &d = Nth(p, face[3]).w;
      const Vector3d normal = (b - a).cross(c - a);
      const double here = -normal.dot(a), there = normal.dot(d - a);
      if (here * there > 0) continue;  // the origin lies on the inner side
      inside = false;
      const std::array<double, 3> weights = TriangleWeights(a, b, c);
      const double distance2 = (weights[0] * a + weights[1] * b + weights[2] * c).squaredNorm();
      if (distance2 < nearest) {
        nearest = distance2;
        best_face = {face[0], face[1], face[2]};
        best_weights = weights;
      }
    }
    if (inside) return false;
    s->Keep(best_face, best_weights);
  }
  return true;
}

class Search {
 public:
  Search(const ConvexBody& a, const ConvexBody& b, const Eigen::Isometry3d& X_AB)
      : a_(a),
        b_(b),
        R_(X_AB.linear()),
        p_(X_AB.translation()),
        balls_(a.ball_radius + b.ball_radius) {}

  // Slab of the cores along a direction from b to a of any length; keeps the best.
  Corner Try(const Vector3d& v) {
    const Vector3d a = CoreSupport(a_, -v);
    const Vector3d b = p_ + R_ * CoreSupport(b_, R_.transpose() * v);
    const Corner corner{a - b, a, b};
    const double length = v.norm();
    const double slab = corner.w.dot(v) / length;
    if (slab > slab_) {
      slab_ = slab;
      normal_ = v / length;
      best_ = corner;
    }
    return corner;
  }

  ConvexDistance Run(const Vector3d& first, double enough) {
    Simplex simplex;
    simplex.corner[0] = Try(first.norm() > kTouching ? first : Vector3d::UnitZ());
    simplex.size = 1;
    Reduce(&simplex);
    Vector3d v = simplex.Nearest();
    bool apart = true;
    for (int i = 0; i < kMaxIterations; ++i) {
      const double distance = v.norm();
      if (distance < kTouching) {
        apart = false;
        break;
      }
      upper_ = distance;
      const Corner corner = Try(v);
      if (distance - slab_ < kConverged) break;
      if (slab_ - balls_ >= enough || distance - balls_ < enough) break;
      Simplex next = simplex;
      Nth(next.corner, next.size++) = corner;
      if (!Reduce(&next)) {
        apart = false;
        break;
      }
      const Vector3d nearer = next.Nearest();
      if (!(nearer.squaredNorm() < v.squaredNorm())) break;  // rounding: no further progress
      simplex = next;
      v = nearer;
    }
    return apart ? Apart(simplex) : Overlapping(enough);
  }

 private:
  ConvexDistance Result(const Vector3d& a, const Vector3d& b) const {
    ConvexDistance result;
    result.normal_A = normal_;
    result.point_a_A = a - a_.ball_radius * normal_;
    result.point_b_A = b + b_.ball_radius * normal_;
    result.lower = slab_ - balls_;
    return result;
  }
  ConvexDistance Apart(const Simplex& simplex) const {
    Vector3d a = Vector3d::Zero(), b = Vector3d::Zero();
    for (int i = 0; i < simplex.size; ++i) {
      a += Nth(simplex.weight, i) * Nth(simplex.corner, i).a;
      b += Nth(simplex.weight, i) * Nth(simplex.corner, i).b;
    }
    ConvexDistance result = Result(a, b);
    result.upper = std::max(upper_ - balls_, 0.0);
    return result;
  }
  ConvexDistance Overlapping(double enough) {
    if (enough > -balls_) return Result(best_.a, best_.b);  // out of reach
    // Climb from the best candidates that are not neighbours: the slab has many local maxima.
    std::vector<Start> starts = Candidates();
    std::sort(starts.begin(), starts.end(),
              [](const Start& s, const Start& t) { return s.slab > t.slab; });
    std::vector<Vector3d> climbed;
    for (const Start& start : starts) {
      if (climbed.size() == kClimbs || slab_ - balls_ >= enough) break;
      const bool neighbour = std::any_of(climbed.begin(), climbed.end(), [&](const Vector3d& n) {
        return n.dot(start.normal) > kNeighbour;
      });
      if (!neighbour) climbed.push_back(Climb(start));
    }
    return Result(best_.a, best_.b);
  }

  struct Start {
    double slab;
    Vector3d normal;
  };
  std::vector<Start> Candidates() {
    std::vector<Start> starts;
    const auto add = [&](const Vector3d& v) {
      if (v.norm() < kTouching) return;
      const Vector3d n = v.normalized();
      starts.push_back({Try(n).w.dot(n), n});
    };
    add(Vector3d(normal_));  // the widest slab on the way here: near the best in a shallow overlap
    for (const Vector3d& n : a_.normals.colwise()) add(-n);
    for (const Vector3d& n : b_.normals.colwise()) add(R_ * n);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        add(sign * Vector3d::Unit(axis));
        add(sign * R_.col(axis));
      }
    }
    const Vector3d centers = a_.center - (p_ + R_ * b_.center);
    add(centers);
    add({centers.x(), centers.y(), 0});
    add(centers - centers.dot(R_.col(2)) * R_.col(2));
    return starts;
  }
  // Compass search on the sphere of directions; the compass turns, so that no ridge stops it.
  Vector3d Climb(Start here) {
    double turn = 0;
    for (double step = 0.3; step > 1e-6; step /= 3) {
      for (int round = 0; round < 8; ++round) {
        const Vector3d n = here.normal, t = n.unitOrthogonal(), s = n.cross(t);
        bool higher = false;
        turn += 0.3;
        for (int k = 0; k < 6; ++k) {
          const double angle = turn + k * std::numbers::pi / 3;
          const auto [sine, cosine] = SinCos(angle);
          const Vector3d m = (n + step * (cosine * t + sine * s)).normalized();
          const double slab = Try(m).w.dot(m);
          if (slab <= here.slab) continue;
          here = {slab, m};
          higher = true;
        }
        if (!higher) break;
      }
    }
    return here.normal;
  }

  const ConvexBody& a_;
  const ConvexBody& b_;
  const Eigen::Matrix3d R_;
  const Vector3d p_;
  const double balls_;
  double slab_ = -std::numeric_limits<double>::infinity();
  double upper_ = 0.0;
  Vector3d normal_{0, 0, 1};
  Corner best_{};
};

}  // namespace

ConvexDistance FindConvexDistance(const ConvexBody& a, const ConvexBody& b,
                                  const Eigen::Isometry3d& X_AB, const Vector3d& first_normal_A,
                                  double enough) {
  return Search(a, b, X_AB).Run(first_normal_A, enough);
}

}  // namespace halfstep
