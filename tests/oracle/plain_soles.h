#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace halfstep::oracle {

using Polygon = std::vector<Eigen::Vector2d>;

struct PlainRobot;

/// What of a foot may touch the ground, in the sole's frame: the sole rectangle, and the points of
/// its body that are less than `height` above the sole [m].
Polygon Touching(const PlainRobot& robot, size_t leg, double height);
/// An outline at a foot's x, y, z, yaw.
Polygon Standing(const Polygon& outline, const Eigen::Vector4d& foot);

double Wedge(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// Corners of a sole rectangle of that size [m] at a foot's x, y, z, yaw.
std::array<Eigen::Vector2d, 4> SoleCorners(const Eigen::Vector4d& foot,
                                           const Eigen::Vector2d& size);

/// A side of a convex hull: hull points x have `inwards`·x ≥ `offset`.
struct HullSide {
  Eigen::Vector2d along, inwards;
  double offset = 0;
};
/// All pairs of points that have every other point on their left.
std::vector<HullSide> HullSides(const std::vector<Eigen::Vector2d>& points);

/// Least signed distance to the lines of the hull's edges, positive inside [m].
double InsideHull(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& p);

/// Distance of a point from a sole rectangle, 0 inside [m].
double FromSole(const Eigen::Vector4d& foot, const Eigen::Vector2d& size, const Eigen::Vector2d& p);

/// Of all lines through p along a side of the hull: how far, at most, p is from the nearer one of
/// the two points where the line leaves the hull [m]; below 0 outside.
double LongestLever(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& p);

/// Of the rectangles of two soles that stand at different heights, each seen from where the line of
/// the ZMP passes the plane of its sole: how far from that line, at most, two opposite points of a
/// section between them can be, along an edge of either sole, with a disc of a quarter of it
/// (wpg/README.md, "Soles at different heights") [m]; below 0: none.
double LongestSectionLever(const std::array<Eigen::Vector2d, 4>& left,
                           const std::array<Eigen::Vector2d, 4>& right);

/// Distance of a convex outline, the hull of points, and a simple polygon; −1 µm when they overlap
/// [m].
double Apart(const Polygon& outline, const Polygon& area);

}  // namespace halfstep::oracle
