// Numbers, polygons and distances.
#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/collision/separation.h"
#include "smoothing/margins/rounding.h"
#include "tests/oracle/nasty_draws.h"
#include "tests/oracle/real.h"
#include "tests/oracle/rounding_draws.h"
#include "wpg/geometry/simple_polygon.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/nth.h"
#include "wpg/rounded.h"

namespace halfstep::oracle {
namespace {

struct Point {
  Real x = 0, y = 0;
};

Real Size(Real x) { return x < 0 ? -x : x; }

// How far p is inside the hull of the points, all pairs of which are tried as an edge.
Real Inside(const std::vector<Point>& points, const Point& p) {
  Real margin = 1e9;
  for (const Point& a : points) {
    for (const Point& b : points) {
      const Real x = b.x - a.x, y = b.y - a.y, length = Sqrt(x * x + y * y);
      if (length < Real(1e-25)) continue;
      const bool edge = std::ranges::all_of(points, [&](const Point& c) {
        return x * (c.y - a.y) - y * (c.x - a.x) >= Real(-1e-28);
      });
      if (edge) margin = std::min(margin, (x * (p.y - a.y) - y * (p.x - a.x)) / length);
    }
  }
  return margin;
}

Eigen::Isometry3d DrawPlace(double far, Draw* draw) {
  Eigen::Quaterniond turn(draw->Uniform(-1, 1), draw->Uniform(-1, 1), draw->Uniform(-1, 1),
                          draw->Uniform(-1, 1));
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = turn.normalized().toRotationMatrix();
  X.translation() = Eigen::Vector3d(far, -far, 0) + draw->Vector(-1, 1);
  return X;
}

// The most that the body reaches along n from the place p, exactly where X says it is.
Real Reach(const ConvexBody& body, const Eigen::Isometry3d& X, const std::array<Real, 3>& n,
           const Eigen::Vector3d& p) {
  Real most = -1e9;
  for (Eigen::Index v = 0; v < body.vertices.cols(); ++v) {
    Real sum = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      Real at = Real(X.translation()[i]) - Real(p[i]);
      for (Eigen::Index j = 0; j < 3; ++j) at += Real(X.linear()(i, j)) * body.vertices(j, v);
      sum += n[static_cast<size_t>(i)] * at;
    }
    most = std::max(most, sum);
  }
  return most + Real(body.ball_radius);
}

}  // namespace

void DrawNumbers(long draws, unsigned seed, RoundingTally* tally) {
  Draw draw(seed);
  for (; draws > 0; --draws) {
    std::array<WithError, 3> x;
    std::array<Real, 3> exact;
    for (size_t i = 0; i < 3; ++i) {
      const double value = draw.Uniform(-1, 1) * draw.Logarithmic(1e-3, 1e3);
      const double error = draw.Chance(0.5) ? 0.0 : 1e-15 * std::abs(value);
      x[i] = WithError(value, error);
      exact[i] = Real(value) + Real(error) * draw.Uniform(-1, 1);
    }
    const auto add = [&](const std::string& name, Real truth, const WithError& computed) {
      tally->Add(name, static_cast<double>(Size(truth - Real(computed.value()))), computed.error());
    };
    add("sum", exact[0] + exact[1], x[0] + x[1]);
    add("product", exact[0] * exact[1], x[0] * x[1]);
    add("quotient", exact[0] / exact[1], x[0] / x[1]);
    add("formula", (exact[0] * exact[1] - exact[2]) / (exact[2] + 2 * exact[0]),
        (x[0] * x[1] - x[2]) / (x[2] + 2.0 * x[0]));
  }
}

void DrawSupports(long draws, unsigned seed, RoundingTally* tally) {
  Draw draw(seed);
  while (draws > 0) {
    const Eigen::Vector2d size(draw.Uniform(0.02, 0.3), draw.Uniform(0.02, 0.2));
    const double far = draw.Chance(0.3) ? 900.0 : draw.Logarithmic(0.1, 10);
    const double gap = draw.Logarithmic(1e-13, 0.3) * (draw.Chance(0.5) ? 1 : -1);
    const double yaw = draw.Chance(0.3) ? 0.0 : draw.Uniform(-600, 600);
    const double turned = draw.Chance(0.4) ? 0.0 : draw.Logarithmic(1e-13, 0.5);
    const double c = std::cos(yaw), s = std::sin(yaw), aside = size.y() + draw.Uniform(0.01, 0.2);
    const Pose2 left{draw.Uniform(-far, far), draw.Uniform(-far, far), yaw};
    const Pose2 right{left.x + c * gap + s * aside, left.y + s * gap - c * aside, yaw + turned};
    halfstep::WalkState x = halfstep::WalkState::Zero(), off = x;
    x.segment<2>(kLeftX) = left.position();
    x.segment<2>(kRightX) = right.position();
    const bool moved = draw.Chance(0.5);
    std::vector<Point> corners;
    for (const Pose2& sole : {left, right}) {
      const int f = FootIndex(&sole == &left ? Side::kLeft : Side::kRight);
      for (int q = f; moved && q < f + 4; ++q) off[q] = 1e-15 * far;
      const Real angle = Real(sole.yaw) + Real(off[f + 3]) * draw.Uniform(-1, 1);
      const Real px = Real(sole.x) + Real(off[f]) * draw.Uniform(-1, 1);
      const Real py = Real(sole.y) + Real(off[f + 1]) * draw.Uniform(-1, 1);
      for (const auto& [a, b] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
        const Real u = a * Real(size.x()) / 2, v = b * Real(size.y()) / 2;
        corners.push_back(
            {px + Cos(angle) * u - Sin(angle) * v, py + Sin(angle) * u + Cos(angle) * v});
      }
    }
    const SupportPolygon polygon(left, right, size);
    for (int k = 0; k < 5; ++k, --draws) {
      // A mean of corners, mostly near to an edge.
      Eigen::Vector2d p(0, 0);
      double sum = 0;
      for (const Point& corner : corners) {
        const double weight = draw.Logarithmic(1e-9, 1);
        p += weight * Eigen::Vector2d(static_cast<double>(corner.x), static_cast<double>(corner.y));
        sum += weight;
      }
      p /= sum;
      const double margin = polygon.Margin(p);
      if (!(margin >= 0)) continue;
      const Real exact = Inside(corners, {p.x(), p.y()});
      tally->Add("support", static_cast<double>(Real(margin) - exact),
                 SupportRounding(x, off, size, margin));
    }
  }
}

void DrawPolygons(long draws, unsigned seed, RoundingTally* tally) {
  Draw draw(seed);
  const auto polygon = [&draw](const Eigen::Vector2d& center, double size) {
    Eigen::Matrix2Xd corners(2, 4);
    const double yaw = draw.Uniform(-3, 3);
    for (int k = 0; k < 4; ++k) {
      const double angle = yaw + k * 1.5 + draw.Uniform(0, 1);
      corners.col(k) = center + size * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    return corners;
  };
  for (; draws > 0; --draws) {
    const double far = draw.Chance(0.3) ? 900.0 : draw.Logarithmic(0.1, 10);
    const Eigen::Vector2d center(draw.Uniform(-far, far), draw.Uniform(-far, far));
    const double size = draw.Logarithmic(0.05, 5);
    const Eigen::Vector2d aside(draw.Uniform(-1, 1), draw.Uniform(-1, 1));
    const Eigen::Matrix2Xd a = polygon(center, 0.15);
    const Eigen::Matrix2Xd b = polygon(center + (size + 0.3) * aside, size);
    const double distance = PolygonDistance(a, b);
    if (distance <= 0) continue;
    // From corners to edges, both ways.
    Real least = 1e9;
    const auto from = [&least](const Eigen::Matrix2Xd& corners, const Eigen::Matrix2Xd& edges) {
      for (Eigen::Index i = 0; i < 4; ++i) {
        for (Eigen::Index k = 0; k < 4; ++k) {
          const Real x = edges(0, k), y = edges(1, k), px = Real(corners(0, i)) - x;
          const Real dx = Real(edges(0, (k + 1) % 4)) - x, dy = Real(edges(1, (k + 1) % 4)) - y;
          const Real py = Real(corners(1, i)) - y,
                     along = (px * dx + py * dy) / (dx * dx + dy * dy);
          const Real share = std::min(Real(1), std::max(Real(0), along));
          const Real gx = px - share * dx, gy = py - share * dy;
          least = std::min(least, Sqrt(gx * gx + gy * gy));
        }
      }
    };
    from(a, b);
    from(b, a);
    tally->Add("polygons", std::max(0.0, static_cast<double>(Real(distance) - least)),
               PlanarRounding(center.x(), center.y()));
  }
}

void DrawDistances(const RobotModel& robot, long draws, unsigned seed, RoundingTally* tally) {
  Draw draw(seed);
  std::vector<CollisionShape> shapes;
  for (const RobotBody& body : robot.bodies) {
    if (body.shape.disc_radius == 0.0) shapes.emplace_back(body.shape);
  }
  for (; draws > 0; --draws) {
    const double far = draw.Chance(0.5) ? 900.0 : draw.Uniform(0, 10);
    const auto pick = [&] { return draw.Below(static_cast<int>(shapes.size())); };
    const CollisionShape &a = Nth(shapes, pick()), &b = Nth(shapes, pick());
    const Eigen::Isometry3d X_Wa = DrawPlace(far, &draw), X_Wb = DrawPlace(far, &draw);
    const Separation found = Separate(a, X_Wa, b, X_Wb);
    if (found.distance < 1e-3) continue;
    halfstep::WalkState x = halfstep::WalkState::Zero();
    x[kComX] = far;
    x[kComY] = -far;
    // Along that direction, made one of length 1.
    const Eigen::Vector3d& n = found.normal_W;
    const Real length = Sqrt(Real(n.x()) * n.x() + Real(n.y()) * n.y() + Real(n.z()) * n.z());
    const std::array<Real, 3> up = {n.x() / length, n.y() / length, n.z() / length};
    const std::array<Real, 3> down = {-up[0], -up[1], -up[2]};
    const Eigen::Vector3d origin = X_Wa.translation();
    const Real exact = -Reach(a.convex(), X_Wa, down, origin) - Reach(b.convex(), X_Wb, up, origin);
    tally->Add("distance", std::max(0.0, static_cast<double>(Real(found.distance) - exact)),
               DistanceRounding(x));
  }
}

}  // namespace halfstep::oracle
