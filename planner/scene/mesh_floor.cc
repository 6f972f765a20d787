#include "planner/scene/mesh_floor.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kNearlyHorizontal = 0.985;  // cosine of 10°

struct Placed {
  Eigen::Matrix3d corners_W;  // in columns
  double floor;               // its height in W [m]

  // Above the floor.
  double top() const { return corners_W.row(2).maxCoeff() - floor; }
  double bottom() const { return corners_W.row(2).minCoeff() - floor; }
  // If it is nearly horizontal and within the tolerance of the floor, else 0 [m²].
  double FloorArea(double tolerance) const {
    const Eigen::Vector3d doubled =
        (corners_W.col(1) - corners_W.col(0)).cross(corners_W.col(2) - corners_W.col(0));
    const double area = 0.5 * doubled.norm();
    const bool flat = 0.5 * std::abs(doubled.z()) >= kNearlyHorizontal * area;
    return flat && top() <= tolerance && bottom() >= -tolerance ? area : 0.0;
  }
};

Placed Place(const TriangleMesh& mesh, const Eigen::Isometry3d& X_WO, double floor,
             Eigen::Index triangle) {
  Placed placed{.corners_W = {}, .floor = floor};
  for (int k = 0; k < 3; ++k) {
    placed.corners_W.col(k) =
        X_WO * Eigen::Vector3d(mesh.vertices.col(mesh.triangles(k, triangle)));
  }
  return placed;
}

}  // namespace

CutMesh CutFloor(const TriangleMesh& mesh, const Eigen::Isometry3d& X_WO, double floor,
                 double tolerance) {
  CutMesh cut;
  cut.highest = -std::numeric_limits<double>::infinity();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < mesh.triangles.cols(); ++i) {
    const Placed placed = Place(mesh, X_WO, floor, i);
    if (placed.top() > tolerance) {
      kept.push_back(i);
      continue;
    }
    ++cut.floor;
    cut.area += placed.FloorArea(tolerance);
    cut.highest = std::max(cut.highest, placed.top());
    if (placed.bottom() < -tolerance) ++cut.deep;
  }
  // Corners of the floor are left out, so that they count nowhere.
  std::vector<int> own(static_cast<size_t>(mesh.vertices.cols()), -1);
  std::vector<Eigen::Index> used;
  cut.rest.hollow = true;
  cut.rest.triangles.resize(3, static_cast<Eigen::Index>(kept.size()));
  for (size_t i = 0; i < kept.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const int corner = mesh.triangles(k, kept[i]);
      int& number = Nth(own, corner);
      if (number < 0) {
        number = static_cast<int>(used.size());
        used.push_back(corner);
      }
      cut.rest.triangles(k, static_cast<Eigen::Index>(i)) = number;
    }
  }
  cut.rest.vertices.resize(3, static_cast<Eigen::Index>(used.size()));
  for (size_t i = 0; i < used.size(); ++i) {
    cut.rest.vertices.col(static_cast<Eigen::Index>(i)) = mesh.vertices.col(used[i]);
  }
  return cut;
}

double FloorArea(const TriangleMesh& mesh, const Eigen::Isometry3d& X_WO, double floor,
                 double tolerance) {
  double area = 0.0;
  for (Eigen::Index i = 0; i < mesh.triangles.cols(); ++i) {
    area += Place(mesh, X_WO, floor, i).FloorArea(tolerance);
  }
  return area;
}

}  // namespace halfstep
