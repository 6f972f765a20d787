#include "tests/oracle/plain_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/oracle/real.h"

namespace halfstep::oracle {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kSameLevel = 0.5e-9;  // [m]; heights are whole nanometres
constexpr double kBeside = 1e-6;       // from an edge, where a point is asked about [m]

double WholeNanometres(Real x) {
  return std::round(static_cast<double>(x * Real(1000000000))) / 1e9;
}

// Holds points on the left of all sides, for corners in either sense.
bool Holds(const Polygon& polygon, const Eigen::Vector2d& p) {
  bool left = true, right = true;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double turn = Wedge(b - a, p - a);
    left = left && turn >= 0;
    right = right && turn <= 0;
  }
  return left || right;
}

// Where along a → b it meets the other segment's line within that segment, as a share of its way.
std::optional<double> Meets(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                            const Eigen::Vector2d& c, const Eigen::Vector2d& d) {
  const double across = Wedge(b - a, d - c);
  if (std::abs(across) < 1e-12 * (b - a).norm() * (d - c).norm()) return std::nullopt;
  const double share = Wedge(c - a, d - c) / across, other = Wedge(c - a, b - a) / across;
  const double near = 1e-7 / (d - c).norm();
  if (share <= 0 || share >= 1 || other < -near || other > 1 + near) return std::nullopt;
  return share;
}

PlainSolid Prism(const std::string& name, const Polygon& outline, double bottom, double top) {
  PlainSolid solid{.name = name, .outline = outline, .bottom = bottom, .top = top, .set = {}};
  for (const Eigen::Vector2d& p : outline) {
    for (const double z : {bottom, top}) {
      solid.set.points.emplace_back(p.x(), p.y(), z);
      solid.center += solid.set.points.back() / static_cast<double>(2 * outline.size());
    }
  }
  for (const Eigen::Vector3d& p : solid.set.points) {
    solid.radius = std::max(solid.radius, (p - solid.center).norm() * (1 + 1e-9) + 1e-9);
  }
  return solid;
}

}  // namespace

PlainGround::PlainGround(bool has_floor, const std::vector<PlainSurface>& surfaces)
    : has_floor_(has_floor) {
  for (const PlainSurface& s : surfaces) {
    if (!s.polygon.empty()) {
      Polygon outline;
      for (const Eigen::Vector2d& p : s.polygon) {
        outline.emplace_back(WholeNanometres(p.x()), WholeNanometres(p.y()));
      }
      const double top = WholeNanometres(s.height);
      double bottom = has_floor ? 0 : -kInfinite;
      if (s.thickness >= 0) {
        bottom = std::max(bottom, WholeNanometres(Real(s.height) - Real(s.thickness)));
      }
      solids_.push_back(Prism(s.name, outline, bottom, top));
      continue;
    }
    const Real yaw = Real(s.yaw_deg) * Real(std::numbers::pi_v<long double>) / 180;
    for (int k = 0; k < s.count; ++k) {
      Polygon outline;
      for (const auto& [along, aside] :
           {std::array{0, -1}, std::array{1, -1}, std::array{1, 1}, std::array{0, 1}}) {
        const Real x = Real(s.run) * (k + along), y = Real(s.width) / 2 * aside;
        outline.emplace_back(WholeNanometres(s.at.x() + Cos(yaw) * x - Sin(yaw) * y),
                             WholeNanometres(s.at.y() + Sin(yaw) * x + Cos(yaw) * y));
      }
      const double top = WholeNanometres(s.at.z() + Real(s.rise) * (k + 1));
      const double bottom =
          has_floor ? 0 : WholeNanometres(Real(std::min(s.at.z(), 0.0)) - Real(1) / 10);
      solids_.push_back(Prism(s.name + "_" + std::to_string(k + 1), outline, bottom, top));
    }
  }
}

std::optional<double> PlainGround::HeightUnder(const Eigen::Vector2d& p) const {
  std::optional<double> highest;
  if (has_floor_) highest = 0;
  for (const PlainSolid& solid : solids_) {
    if (Holds(solid.outline, p) && (!highest || solid.top > *highest)) highest = solid.top;
  }
  return highest;
}

bool PlainGround::Bears(const Eigen::Vector2d& p, double height) const {
  bool bears = has_floor_ && std::abs(height) < kSameLevel;
  for (const PlainSolid& solid : solids_) {
    if (!Holds(solid.outline, p)) continue;
    if (std::abs(solid.top - height) < kSameLevel) {
      bears = true;
    } else if (solid.top > height && solid.bottom < height + kSameLevel) {
      return false;
    }
  }
  return bears;
}

double PlainGround::Inside(const Polygon& outline, double height) const {
  if (std::none_of(outline.begin(), outline.end(),
                   [&](const Eigen::Vector2d& p) { return Bears(p, height); })) {
    return -kInfinite;
  }
  // All edges of all solids, cut where they meet: the level ends along a piece that has it on one
  // side alone.
  double least = kInfinite;
  for (const PlainSolid& solid : solids_) {
    for (size_t i = 0; i < solid.outline.size(); ++i) {
      const Eigen::Vector2d &a = solid.outline[i],
                            &b = solid.outline[(i + 1) % solid.outline.size()];
      std::vector<double> cuts = {0, 1};
      for (const PlainSolid& other : solids_) {
        for (size_t k = 0; k < other.outline.size(); ++k) {
          const Eigen::Vector2d &c = other.outline[k],
                                &d = other.outline[(k + 1) % other.outline.size()];
          if (const auto share = Meets(a, b, c, d)) cuts.push_back(*share);
          // Ends of edges that lie along this one.
          const double along = (c - a).dot(b - a) / (b - a).squaredNorm();
          if (along > 0 && along < 1 && std::abs(Wedge(b - a, c - a)) < 1e-7 * (b - a).norm()) {
            cuts.push_back(along);
          }
        }
      }
      std::sort(cuts.begin(), cuts.end());
      const Eigen::Vector2d aside = Eigen::Vector2d(a.y() - b.y(), b.x() - a.x()).normalized();
      for (size_t k = 0; k + 1 < cuts.size(); ++k) {
        const Eigen::Vector2d from = a + cuts[k] * (b - a), to = a + cuts[k + 1] * (b - a);
        if ((to - from).norm() < 1e-8) continue;
        const Eigen::Vector2d middle = 0.5 * (from + to);
        if (Bears(middle + kBeside * aside, height) == Bears(middle - kBeside * aside, height)) {
          continue;
        }
        least = std::min(least, Apart(outline, {from, to}));
      }
    }
  }
  if (least < 0) return least;
  // No border passes the outline, so it bears all of it or nothing.
  return Bears(outline[0], height) ? least : -kInfinite;
}

}  // namespace halfstep::oracle
