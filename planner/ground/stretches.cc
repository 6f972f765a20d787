#include "planner/ground/stretches.h"

#include <algorithm>
#include <limits>

namespace halfstep {
namespace {

// Calls visit(corner, outward normal of length 1) for every edge.
template <typename Visit>
void ForEachEdgeOf(const Eigen::Matrix2Xd& polygon, const Visit& visit) {
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Eigen::Vector2d a = polygon.col(i), edge = polygon.col((i + 1) % polygon.cols()) - a;
    visit(a, Eigen::Vector2d(Eigen::Vector2d(edge.y(), -edge.x()) / edge.norm()));
  }
}

}  // namespace

void Stretches::Add(const Stretch& part) {
  if (!(part.to - part.from > kLeast)) return;
  parts_.push_back(part);
  std::sort(parts_.begin(), parts_.end(),
            [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
  std::vector<Stretch> joined;
  for (const Stretch& next : parts_) {
    if (!joined.empty() && next.from - joined.back().to <= kLeast) {
      joined.back().to = std::max(joined.back().to, next.to);
    } else {
      joined.push_back(next);
    }
  }
  parts_ = std::move(joined);
}

void Stretches::Remove(const Stretches& others) {
  for (const Stretch& out : others.parts_) {
    std::vector<Stretch> left;
    for (const Stretch& part : parts_) {
      for (const Stretch& rest : {Stretch{part.from, std::min(part.to, out.from)},
                                  Stretch{std::max(part.from, out.to), part.to}}) {
        if (rest.to - rest.from > kLeast) left.push_back(rest);
      }
    }
    parts_ = std::move(left);
  }
}

Stretch StretchWithin(const Eigen::Matrix2Xd& polygon, const Eigen::Vector2d& begin,
                      const Eigen::Vector2d& along, double length) {
  Stretch part{0.0, length};
  ForEachEdgeOf(polygon, [&](const Eigen::Vector2d& corner, const Eigen::Vector2d& out) {
    const double outside = out.dot(begin - corner), rate = out.dot(along);
    if (rate > 0.0) {
      part.to = std::min(part.to, -outside / rate);
    } else if (rate < 0.0) {
      part.from = std::max(part.from, -outside / rate);
    } else if (outside > 0.0) {
      part.to = part.from;
    }
  });
  return part;
}

double DepthWithin(const Eigen::Matrix2Xd& polygon, const Eigen::Vector2d& point) {
  double depth = std::numeric_limits<double>::infinity();
  ForEachEdgeOf(polygon, [&](const Eigen::Vector2d& corner, const Eigen::Vector2d& out) {
    depth = std::min(depth, out.dot(corner - point));
  });
  return depth;
}

}  // namespace halfstep
