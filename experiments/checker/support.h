#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "experiments/checker/interval_proof.h"
#include "experiments/checker/push.h"

namespace halfstep::checker {

template <int N>
using Seen = std::array<Taylor<N>, 2>;  ///< x and y of a point in motion [m]

/// An edge of a closed way around corners of the soles that stand, counter-clockwise as doubles see
/// it. A point that lies to the left of every edge, by δ or more, is surrounded by the way, and so
/// is the disc of radius δ, which no edge meets: so it lies in the corners' convex hull, whether
/// the way is the hull's or not.
template <int N>
struct SupportEdge {
  Seen<N> along;     ///< of length 1
  Taylor<N> inside;  ///< how far to its left the point is [m]
};

/// A closed way around points [m] in doubles, counter-clockwise: indices.
std::vector<size_t> HullHint(const std::vector<Eigen::Vector2d>& points);
/// The edges of a closed way along corners that rest, and how far to their left a point is. Throws
/// NotDefined for edges without length.
std::vector<SupportEdge<1>> EdgesAround(const std::vector<std::array<Interval, 2>>& way,
                                        const Seen<1>& point);

/// Of two points p ± ρu an edge lets ρ be inside/share.
struct Room {
  Rate inside;     ///< how far p is inside [m]
  Interval share;  ///< how much nearer to the edge one of both is per metre of ρ; its upper bound
};
/// The least inside/share, in the middle of the interval [m].
double LeastRoom(const std::vector<Room>& rooms);
/// Of all edges, u along that one which leaves most room in the middle of the interval.
std::vector<Room> RoomInHull(const std::vector<SupportEdge<1>>& support);
/// How much less than `friction` suffices as a coefficient for two points p ± ρu, each with half of
/// the push and ± n_z/2ρ across u; p: the ZMP, seen from the point that moments are about. Throws
/// NotDefined where it may not be inside. Source: wpg/README.md, "Friction that is needed".
Kept FrictionLeft(const std::vector<Room>& rooms, const Push& floor, const Seen<1>& zmp,
                  double friction);

}  // namespace halfstep::checker
