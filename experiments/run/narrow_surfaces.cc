#include "experiments/run/narrow_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "wpg/elementary.h"
#include "wpg/files/text.h"
#include "wpg/geometry/planar_hull.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kTogether = 4e-9;  // [m] surfaces no farther apart are looked at together
constexpr int kDirections = 360;    // of half a turn
constexpr double kApart = std::numbers::pi / kDirections;

double WidthOf(const Eigen::Matrix2Xd& points, const Eigen::Vector2d& direction) {
  const Eigen::RowVectorXd along = direction.transpose() * points;
  return along.maxCoeff() - along.minCoeff();
}

// Surfaces that may bear one sole together.
struct Group {
  std::vector<int> solids;
  std::vector<Eigen::Vector2d> corners;
};

Eigen::AlignedBox2d BoundsOf(const GroundSolid& solid) {
  return {solid.polygon.rowwise().minCoeff(), solid.polygon.rowwise().maxCoeff()};
}

std::vector<Group> GroupsOf(const Ground& ground) {
  const std::vector<GroundSolid>& solids = ground.Solids();
  std::vector<int> order;
  for (int i = 0; i < std::ssize(solids); ++i) {
    if (Nth(solids, i).bears) order.push_back(i);
  }
  std::ranges::stable_sort(order, {}, [&](int i) { return BoundsOf(Nth(solids, i)).min().x(); });
  std::vector<int> root(solids.size());
  std::iota(root.begin(), root.end(), 0);
  const auto root_of = [&](int i) {
    while (Nth(root, i) != i) i = Nth(root, i) = Nth(root, Nth(root, i));
    return i;
  };
  for (size_t a = 0; a < order.size(); ++a) {
    const GroundSolid& first = Nth(solids, order[a]);
    Eigen::AlignedBox2d near = BoundsOf(first);
    near.extend(Eigen::Vector2d(near.max().array() + kTogether));
    near.extend(Eigen::Vector2d(near.min().array() - kTogether));
    for (size_t b = a + 1; b < order.size(); ++b) {
      const Eigen::AlignedBox2d bounds = BoundsOf(Nth(solids, order[b]));
      if (bounds.min().x() > near.max().x()) break;
      if (Nth(solids, order[b]).bears == first.bears && near.intersects(bounds)) {
        Nth(root, root_of(order[a])) = root_of(order[b]);
      }
    }
  }
  std::map<int, Group> groups;
  for (int i = 0; i < std::ssize(solids); ++i) {
    const GroundSolid& solid = Nth(solids, i);
    if (!solid.bears) continue;
    Group& group = groups[root_of(i)];
    group.solids.push_back(i);
    for (const auto& corner : solid.polygon.colwise()) group.corners.emplace_back(corner);
  }
  std::vector<Group> all;
  for (auto& [key, group] : groups) all.push_back(std::move(group));
  return all;
}

// Where the sole does not fit on the hull of a group as it is turned.
struct Narrow {
  double width = 0.0;          // of the hull, across the edge where it is narrowest [m]
  std::optional<int> degrees;  // by which a sole is turned at least from pointing that way; none:
                               // it fits in no direction
  auto operator<=>(const Narrow&) const = default;
};

// The sole's outline, with the width of what it needs in each direction of its own half turn.
class Sole {
 public:
  Sole(const RobotModel& robot, double foothold) : outline_(robot.sole_outline) {
    double diameter = 0.0;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = k * kApart;
      widths_.push_back(WidthOf(outline_, {Cos(angle), Sin(angle)}) + 2.0 * foothold);
      diameter = std::max(diameter, widths_.back());
    }
    // A width a step away is smaller by no more.
    between_ = diameter * kApart * 1.001;
  }

  double length() const { return widths_.front(); }
  double least() const { return *std::ranges::min_element(widths_); }
  // Whether it may be no wider than `width` in a direction within a step of its k-th.
  bool MayFit(int k, double width) const {
    const int n = ((k % kDirections) + kDirections) % kDirections;
    return Nth(widths_, n) - between_ <= width;
  }

 private:
  Eigen::Matrix2Xd outline_;
  std::vector<double> widths_;
  double between_ = 0.0;
};

std::optional<Narrow> NarrowFor(const Sole& sole, std::vector<Eigen::Vector2d> corners) {
  std::vector<Eigen::Vector2d> hull(2 * corners.size() + 1);
  hull.resize(PlanarHull(corners, hull));
  Eigen::Matrix2Xd points(2, std::ssize(hull));
  for (int i = 0; i < std::ssize(hull); ++i) points.col(i) = Nth(hull, i);
  struct Across {
    double angle, width;
  };
  std::vector<Across> ways;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector2d edge = points.col((i + 1) % points.cols()) - points.col(i);
    const Eigen::Vector2d normal = Eigen::Vector2d(edge.y(), -edge.x()).normalized();
    ways.push_back({Atan2(normal.y(), normal.x()), WidthOf(points, normal)});
  }
  const Across narrowest = *std::ranges::min_element(ways, {}, &Across::width);
  if (narrowest.width >= sole.length()) return std::nullopt;
  Narrow narrow{.width = narrowest.width, .degrees = std::nullopt};
  // Directions in which the sole points, from that of the least width. Those in between are half a
  // step away at most, and so is what is seen of a way.
  int turned = kDirections;
  for (int k = 0; k < kDirections; ++k) {
    const bool fits = std::ranges::all_of(ways, [&](const Across& way) {
      const double seen = way.angle - narrowest.angle - k * kApart;
      return sole.MayFit(static_cast<int>(std::lround(seen / kApart)), way.width);
    });
    if (fits) turned = std::min(turned, std::min(k, kDirections - k));
  }
  if (turned < kDirections) {
    narrow.degrees = static_cast<int>(std::floor((turned - 1) * 180.0 / kDirections));
    if (*narrow.degrees <= 0) return std::nullopt;
  }
  return narrow;
}

std::string NamesOf(const std::vector<int>& solids, const std::vector<GroundSolid>& all) {
  constexpr size_t kNamed = 3;
  std::string text;
  for (size_t i = 0; i < std::min(kNamed, solids.size()); ++i) {
    text += (i == 0 ? "" : i + 1 == solids.size() ? " and " : ", ") + Nth(all, solids[i]).name;
  }
  if (solids.size() > kNamed) text += Formatted(" and %zu more", solids.size() - kNamed);
  return text;
}

}  // namespace

std::vector<std::string> NarrowSurfaces(const RobotModel& robot, const Ground& ground,
                                        double foothold, const Eigen::AlignedBox2d& area) {
  constexpr size_t kMost = 3;
  const Sole sole(robot, foothold);
  const std::vector<GroundSolid>& solids = ground.Solids();
  std::map<Narrow, std::vector<int>> alike;
  for (const Group& group : GroupsOf(ground)) {
    const auto narrow = NarrowFor(sole, group.corners);
    if (!narrow) continue;
    std::vector<int>& those =
        alike[{.width = 1e-3 * std::round(1e3 * narrow->width), .degrees = narrow->degrees}];
    for (const int i : group.solids) {
      if (area.intersects(BoundsOf(Nth(solids, i)))) those.push_back(i);
    }
  }
  std::vector<std::string> sentences;
  for (auto& [narrow, those] : alike) {
    if (those.empty() || sentences.size() == kMost) continue;
    std::ranges::sort(those);
    const std::string names = NamesOf(those, solids);
    const char* are = those.size() == 1 ? "it is" : "they are";
    if (narrow.degrees) {
      sentences.push_back(
          Formatted("no sole that points across fits on %s: %s %.3f m along the "
                    "shorter way, and a sole needs %.3f m or is turned by more "
                    "than %d°",
                    names.c_str(), are, narrow.width, sole.length(), *narrow.degrees));
    } else {
      sentences.push_back(
          Formatted("no sole fits on %s, however it is turned: %s %.3f m along the "
                    "shorter way, and a sole needs %.3f by %.3f m",
                    names.c_str(), are, narrow.width, sole.length(), sole.least()));
    }
  }
  return sentences;
}

}  // namespace halfstep
