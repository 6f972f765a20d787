#include "experiments/checker/support.h"

#include <algorithm>
#include <numeric>

namespace halfstep::checker {

// Andrew's chains. They go along a direction that sides of soles are hardly ever across: corners
// that are equally far along it, up to rounding, may come in a wrong order, and the way around is
// not the hull's.
std::vector<size_t> HullHint(const std::vector<Eigen::Vector2d>& points) {
  std::vector<size_t> order(points.size()), hull;
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, [&](size_t i, size_t k) {
    const Eigen::Vector2d along(0.7390851332151607, 0.6736120291832148);
    return along.dot(points[i]) < along.dot(points[k]);
  });
  for (int chain = 0; chain < 2; ++chain) {
    const size_t begin = hull.size();
    for (const size_t i : order) {
      while (hull.size() >= begin + 2) {
        const Eigen::Vector2d edge = points[hull.back()] - points[hull[hull.size() - 2]];
        const Eigen::Vector2d next = points[i] - points[hull.back()];
        if (edge.x() * next.y() - edge.y() * next.x() > 1e-12) break;
        hull.pop_back();
      }
      hull.push_back(i);
    }
    hull.pop_back();
    std::ranges::reverse(order);
  }
  return hull;
}

std::vector<SupportEdge<1>> EdgesAround(const std::vector<std::array<Interval, 2>>& way,
                                        const Seen<1>& point) {
  std::vector<SupportEdge<1>> edges;
  for (size_t i = 0; i < way.size(); ++i) {
    const auto& [x, y] = way[i];
    const std::array<Interval, 2>& next = way[(i + 1) % way.size()];
    const Interval dx = next[0] - x, dy = next[1] - y, length = Sqrt(Square(dx) + Square(dy));
    if (!(length.lo > 0.0)) throw NotDefined();
    SupportEdge<1> edge{{Rate(dx / length), Rate(dy / length)}, {}};
    edge.inside = (Rate(x) - point[0]) * edge.along[1] - (Rate(y) - point[1]) * edge.along[0];
    edges.push_back(edge);
  }
  return edges;
}

double LeastRoom(const std::vector<Room>& rooms) {
  double least = kInfinity;
  for (const Room& room : rooms) {
    least = std::min(least, room.inside.at[0].Middle() / room.share.hi);
  }
  return least;
}

std::vector<Room> RoomInHull(const std::vector<SupportEdge<1>>& support) {
  std::vector<Room> best;
  for (const SupportEdge<1>& along : support) {
    std::vector<Room> rooms;
    for (const SupportEdge<1>& edge : support) {
      const auto &e = edge.along, &u = along.along;
      const Interval across = e[0].over[0] * u[1].over[0] - e[1].over[0] * u[0].over[0];
      rooms.push_back({edge.inside, across.Magnitude()});
    }
    if (best.empty() || LeastRoom(rooms) > LeastRoom(best)) best = std::move(rooms);
  }
  return best;
}

Kept FrictionLeft(const std::vector<Room>& rooms, const Push& floor, const Seen<1>& zmp,
                  double friction) {
  const auto& [force, moment] = floor;
  const Rate yaw = moment[2] - (zmp[0] * force[1] - zmp[1] * force[0]);
  const Rate push = Inverse(force[2]);
  const Rate square = force[0] * force[0] + force[1] * force[1];
  // ‖f_t‖, which has no derivative at 0.
  Interval side = Sqrt(square.over[0]), side_at = Sqrt(square.at[0]);
  if (square.over[0].lo > 0.0) side = Sqrt(square).over[0];
  Kept kept{kInfinity, kInfinity};
  for (const Room& room : rooms) {
    if (!(room.inside.over[0].lo > 0.0)) throw NotDefined();
    const Rate turning = Interval(room.share.hi) * (yaw * Inverse(room.inside));
    const Interval over = (side + Interval(turning.over[0].Magnitude())) * push.over[0];
    const Interval at = (side_at + Interval(turning.at[0].Magnitude())) * push.at[0];
    kept = Least(kept, Kept::Of(Interval(friction) - over, Interval(friction) - at));
  }
  return kept;
}

}  // namespace halfstep::checker
