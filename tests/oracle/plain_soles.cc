#include "tests/oracle/plain_soles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/oracle/plain_robot.h"

namespace halfstep::oracle {
namespace {

double FromSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - (a + s * (b - a))).norm();
}

bool CrossingNumberIsOdd(const Polygon& polygon, const Eigen::Vector2d& p) {
  bool odd = false;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) odd = !odd;
  }
  return odd;
}

}  // namespace

Polygon Touching(const PlainRobot& robot, size_t leg, double height) {
  const Eigen::Vector2d half = 0.5 * robot.sole_size;
  Polygon points = {
      {half.x(), half.y()}, {-half.x(), half.y()}, {-half.x(), -half.y()}, {half.x(), -half.y()}};
  for (const PlainRobot::Body& body : robot.bodies) {
    if (body.link != robot.legs[leg].foot_link) continue;
    for (const Eigen::Vector3d& p : body.points) {
      const Eigen::Vector3d seen = p - robot.legs[leg].sole;
      if (seen.z() < height) points.emplace_back(seen.x(), seen.y());
    }
  }
  return points;
}

Polygon Standing(const Polygon& outline, const Eigen::Vector4d& foot) {
  Polygon placed;
  for (const Eigen::Vector2d& p : outline) {
    placed.push_back(foot.head<2>() + Eigen::Rotation2Dd(foot[3]) * p);
  }
  return placed;
}

double Wedge(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

std::array<Eigen::Vector2d, 4> SoleCorners(const Eigen::Vector4d& foot,
                                           const Eigen::Vector2d& size) {
  const Eigen::Vector2d ahead(std::cos(foot[3]), std::sin(foot[3])), left(-ahead.y(), ahead.x());
  const Eigen::Vector2d p = foot.head<2>();
  const Eigen::Vector2d a = 0.5 * size.x() * ahead, b = 0.5 * size.y() * left;
  return {p + a + b, p - a + b, p - a - b, p + a - b};
}

std::vector<HullSide> HullSides(const std::vector<Eigen::Vector2d>& points) {
  std::vector<HullSide> sides;
  for (const Eigen::Vector2d& a : points) {
    for (const Eigen::Vector2d& b : points) {
      const double length = (b - a).norm();
      if (length < 1e-9) continue;
      const Eigen::Vector2d along = (b - a) / length;
      const bool edge = std::all_of(points.begin(), points.end(), [&](const Eigen::Vector2d& c) {
        return Wedge(along, c - a) > -1e-12;
      });
      const Eigen::Vector2d inwards(-along.y(), along.x());
      if (edge) sides.push_back({along, inwards, inwards.dot(a)});
    }
  }
  return sides;
}

double InsideHull(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& p) {
  // Seen from the first point, so that a hull far away costs no digits.
  std::vector<Eigen::Vector2d> seen;
  for (const Eigen::Vector2d& q : points) seen.push_back(q - points[0]);
  double least = std::numeric_limits<double>::infinity();
  for (const HullSide& side : HullSides(seen)) {
    least = std::min(least, side.inwards.dot(p - points[0]) - side.offset);
  }
  return least;
}

double FromSole(const Eigen::Vector4d& foot, const Eigen::Vector2d& size,
                const Eigen::Vector2d& p) {
  const Eigen::Vector2d ahead(std::cos(foot[3]), std::sin(foot[3])), left(-ahead.y(), ahead.x());
  const Eigen::Vector2d away = p - foot.head<2>();
  const double x = std::max(0.0, std::abs(ahead.dot(away)) - 0.5 * size.x());
  const double y = std::max(0.0, std::abs(left.dot(away)) - 0.5 * size.y());
  return std::hypot(x, y);
}

double LongestLever(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& p) {
  std::vector<Eigen::Vector2d> seen;
  for (const Eigen::Vector2d& q : points) seen.push_back(q - points[0]);
  const std::vector<HullSide> sides = HullSides(seen);
  double longest = -std::numeric_limits<double>::infinity();
  for (const HullSide& line : sides) {
    double lever = std::numeric_limits<double>::infinity();
    for (const HullSide& side : sides) {
      // Along the line, either way, a side comes nearer by at most this share of the way.
      const double share = std::abs(side.inwards.dot(line.along));
      const double apart = side.inwards.dot(p - points[0]) - side.offset;
      if (share > 1e-12) lever = std::min(lever, apart / share);
    }
    longest = std::max(longest, lever);
  }
  return longest;
}

double LongestSectionLever(const std::array<Eigen::Vector2d, 4>& left,
                           const std::array<Eigen::Vector2d, 4>& right) {
  std::vector<Eigen::Vector2d> edges;
  for (const auto& sole : {left, right}) {
    edges.push_back((sole[0] - sole[1]).normalized());
    edges.push_back((sole[1] - sole[2]).normalized());
  }
  // How far the line is inside of a sole along an outward normal.
  const auto inside = [](const std::array<Eigen::Vector2d, 4>& sole, const Eigen::Vector2d& n) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& corner : sole) farthest = std::max(farthest, n.dot(corner));
    return farthest;
  };
  double longest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& u : edges) {
    const auto lever = [&](double lambda) {
      double least = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector2d& edge : edges) {
        for (const double sign : {-1.0, 1.0}) {
          const Eigen::Vector2d n(-sign * edge.y(), sign * edge.x());
          const double depth = (1 - lambda) * inside(left, n) + lambda * inside(right, n);
          least = std::min(least, depth / std::max(std::abs(n.dot(u)), 0.25));
        }
      }
      return least;
    };
    // It is concave in λ: golden section.
    const double golden = 0.5 * (std::sqrt(5.0) - 1);
    double low = 0, high = 1, a = 1 - golden, b = golden, at_a = lever(a), at_b = lever(b);
    longest = std::max({longest, lever(0), lever(1)});
    while (high - low > 1e-14) {
      if (at_a > at_b) {
        high = b, b = a, at_b = at_a;
        a = high - golden * (high - low), at_a = lever(a);
      } else {
        low = a, a = b, at_a = at_b;
        b = low + golden * (high - low), at_b = lever(b);
      }
      longest = std::max({longest, at_a, at_b});
    }
  }
  return longest;
}

double Apart(const Polygon& outline, const Polygon& area) {
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& a : outline) {
    for (const Eigen::Vector2d& b : outline) {  // edges and diagonals
      if (a == b) continue;
      for (size_t i = 0; i < area.size(); ++i) {
        const Eigen::Vector2d &c = area[i], &d = area[(i + 1) % area.size()];
        if (Wedge(b - a, c - a) * Wedge(b - a, d - a) < 0 &&
            Wedge(d - c, a - c) * Wedge(d - c, b - c) < 0) {
          return -1e-6;
        }
        least = std::min({least, FromSegment(a, b, c), FromSegment(c, d, a), FromSegment(c, d, b)});
      }
    }
  }
  const bool holds = CrossingNumberIsOdd(area, outline[0]) || InsideHull(outline, area[0]) > 0;
  return holds ? -1e-6 : least;
}

}  // namespace halfstep::oracle
