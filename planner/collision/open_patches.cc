#include "planner/collision/open_patches.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

constexpr double kSumRounding = 1e-6;  // of sums of winding numbers
constexpr double kInside = 0.5;        // of a winding number, beyond it
// What is said of patches that are too near to say anything: more than any rule asks for, and small
// enough to leave no rounding when it is taken off a sum.
constexpr double kNothingKnown = 2.0;
constexpr double kLeastGap = 1e-9;  // of a distance by which is divided [m]

}  // namespace

struct OpenPatches::Look {
  double sum = 0.0, error = kNothingKnown;   // of Σ w_i
  double least = 0.0, most = kNothingKnown;  // of Σ|w_i|
  double wanted() const { return most - least + error + (most > kInside ? kNothingKnown : 0.0); }
};

OpenPatches::OpenPatches(std::vector<TriangleMesh> patches) {
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<Part> of_patches;
  for (TriangleMesh& mesh : patches) {
    boxes.emplace_back(Vector3d(mesh.vertices.rowwise().minCoeff()),
                       Vector3d(mesh.vertices.rowwise().maxCoeff()));
    of_patches.push_back(PartOf(mesh));
    patches_.emplace_back(std::move(mesh));
  }
  tree_ = BoundsTree(boxes, 1);
  for (const BoundsTree::Node& node : tree_.nodes) {
    parts_.push_back(Together(node, of_patches));
  }
}

OpenPatches::Part OpenPatches::PartOf(const TriangleMesh& patch) {
  Part part;
  struct Triangle {
    double area;
    Vector3d normal, middle;
    double spread;  // ∫ |y − middle|² dA
  };
  std::vector<Triangle> triangles;
  Vector3d weighted(0, 0, 0);
  for (const Eigen::Vector3i& t : patch.triangles.colwise()) {
    const Vector3d a = patch.vertices.col(t[0]), b = patch.vertices.col(t[1]),
                   c = patch.vertices.col(t[2]);
    const Vector3d doubled = (b - a).cross(c - a);
    const double area = 0.5 * doubled.norm();
    if (!(area > 0.0)) continue;
    const Vector3d middle = (a + b + c) / 3.0;
    const double squares =
        (a - middle).squaredNorm() + (b - middle).squaredNorm() + (c - middle).squaredNorm();
    triangles.push_back({area, 0.5 / area * doubled, middle, area / 12 * squares});
    part.area += area;
    weighted += area * middle;
  }
  part.centroid = part.area > 0.0 ? Vector3d(weighted / part.area) : patch.vertices.col(0).eval();
  for (const Triangle& t : triangles) {
    const Vector3d off = t.middle - part.centroid;
    part.as_is.normals += t.area * t.normal;
    part.as_is.moments += t.area * t.normal * off.transpose();
    part.squares += t.area * t.normal * t.normal.transpose();
    part.spread += t.spread + t.area * off.squaredNorm();
  }
  const double length = part.as_is.normals.norm();
  if (length > 0.0) {
    part.axis = part.as_is.normals / length;
    part.off_axis = 0.0;
    for (const Triangle& t : triangles) {
      part.off_axis = std::max(part.off_axis, (t.normal - part.axis).norm());
    }
  }
  for (const Vector3d& p : patch.vertices.colwise()) {
    part.radius = std::max(part.radius, (p - part.centroid).norm());
    part.thickness = std::max(part.thickness, std::abs(part.axis.dot(p - part.centroid)));
  }
  return part;
}

OpenPatches::Part OpenPatches::Together(const BoundsTree::Node& node,
                                        const std::vector<Part>& patches) const {
  Part all;
  Vector3d weighted(0, 0, 0), middle(0, 0, 0);
  const auto for_each = [&](const auto& visit) {
    for (int32_t i = node.first; i < node.first + node.count; ++i) {
      visit(Nth(patches, Nth(tree_.order, i)));
    }
  };
  for_each([&](const Part& patch) {
    all.area += patch.area;
    all.squares += patch.squares;
    weighted += patch.area * patch.centroid;
    middle += patch.centroid / node.count;
  });
  all.centroid = all.area > 0.0 ? Vector3d(weighted / all.area) : middle;
  all.axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(all.squares).eigenvectors().col(2);
  all.off_axis = 0.0;
  for_each([&](const Part& patch) {
    const Vector3d off = patch.centroid - all.centroid;
    const double distance = off.norm();
    const double sign = patch.as_is.normals.dot(all.axis) < 0.0 ? -1.0 : 1.0;
    const Eigen::Matrix3d moments = patch.as_is.moments + patch.as_is.normals * off.transpose();
    all.as_is.normals += patch.as_is.normals;
    all.as_is.moments += moments;
    all.aligned.normals += sign * patch.as_is.normals;
    all.aligned.moments += sign * moments;
    all.spread += patch.spread + patch.area * distance * distance;
    all.radius = std::max(all.radius, distance + patch.radius);
    const double turned = (sign * patch.axis - all.axis).norm();
    all.off_axis = std::max(all.off_axis, patch.off_axis + turned);
    all.thickness = std::max(all.thickness,
                             std::abs(all.axis.dot(off)) + patch.thickness + turned * patch.radius);
  });
  return all;
}

OpenPatches::Look OpenPatches::LookAt(int32_t n, const Vector3d& point) const {
  const Part& part = Nth(parts_, n);
  Look look;
  const Vector3d ahead = part.centroid - point;
  const double rho = ahead.norm();
  const double rounding = 1e-12 * (1.0 + point.cwiseAbs().sum() + tree_.Farthest());
  const double d =
      std::max(BoundsTree::Gap(Nth(tree_.nodes, n), point), rho - part.radius) - rounding;
  if (!(d > kLeastGap)) return look;
  const double sphere = 4 * std::numbers::pi;
  const Vector3d u = ahead / rho;
  const double error = 3 * part.spread * (1 + 1e-9) / (sphere * d * d * d * d);
  const auto winding_of = [&](const Sums& sums) {
    const double first = sums.moments.trace() - 3 * u.dot(sums.moments * u);
    return (sums.normals.dot(u) + first / rho) / (sphere * rho * rho);
  };
  // How far from a triangle's plane the point is at least, and whether all see it on one side.
  const double beside = std::abs(part.axis.dot(ahead)) - part.thickness - rounding;
  const bool from_one_side = beside > part.off_axis * (rho + part.radius);
  const double aligned = std::abs(winding_of(part.aligned));
  if (from_one_side) {
    look.most = aligned + error;
  } else {
    const double sine = part.radius / rho;
    const double delta = sine < 1.0 ? std::sqrt(2 * (1 - std::sqrt((1 - sine) * (1 + sine)))) : 2.0;
    const double across =
        std::sqrt(std::max(part.area * u.dot(part.squares * u), 0.0)) + delta * part.area;
    look.most = across * (1 + 1e-9) / (sphere * d * d);
  }
  look.most = std::min({look.most, part.area * (1 + 1e-9) / (sphere * d * d), kNothingKnown});
  look.least = std::clamp(aligned - error, 0.0, look.most);
  const double sum = winding_of(part.as_is);
  if (std::abs(sum) + error < look.most) {
    look.sum = sum;
    look.error = error;
  } else {
    look.error = look.most;
  }
  return look;
}

bool OpenPatches::Contain(const Vector3d& point, int* asked) const {
  if (asked != nullptr) *asked = 0;
  if (patches_.empty()) return false;
  double sum = 0, absolute = 0;                            // of the windings that are known
  Look rest{.sum = 0, .error = 0, .least = 0, .most = 0};  // of those that are not
  int near = 0;  // nodes in which a patch may wind more than a half by itself
  struct Open {
    double wanted;
    int32_t node;
    Look look;
    bool operator<(const Open& other) const {
      return std::pair(wanted, node) < std::pair(other.wanted, other.node);
    }
  };
  std::priority_queue<Open> unknown;
  const auto count = [&](const Look& look, int sign) {
    rest.sum += sign * look.sum;
    rest.error += sign * look.error;
    rest.least += sign * look.least;
    rest.most += sign * look.most;
    if (look.most > kInside - kSumRounding) near += sign;
  };
  const auto add = [&](int32_t n) {
    const Look look = LookAt(n, point);
    count(look, 1);
    unknown.push({look.wanted(), n, look});
  };
  add(0);
  while (!unknown.empty()) {
    const double signed_sum = std::abs(sum + rest.sum);
    if (signed_sum - rest.error > kInside + kSumRounding ||
        absolute + rest.least > 1 - 0.5 * kSumRounding) {
      return true;
    }
    if (near == 0 && signed_sum + rest.error <= kInside - kSumRounding &&
        absolute + rest.most <= 1 - 2 * kSumRounding) {
      return false;
    }
    const Open open = unknown.top();
    unknown.pop();
    count(open.look, -1);
    const BoundsTree::Node& node = Nth(tree_.nodes, open.node);
    if (node.left >= 0) {
      add(node.left);
      add(node.left + 1);
      continue;
    }
    const double winding = Nth(patches_, Nth(tree_.order, node.first)).At(point);
    if (asked != nullptr) ++*asked;
    if (!(std::abs(winding) <= kInside)) return true;
    sum += winding;
    absolute += std::abs(winding);
  }
  return std::abs(sum) > kInside || absolute > 1 - kSumRounding;
}

bool OpenPatches::ContainOneByOne(const Vector3d& point) const {
  double sum = 0, absolute = 0;
  for (const PatchWinding& patch : patches_) {
    const double winding = patch.At(point);
    if (!(std::abs(winding) <= kInside)) return true;
    sum += winding;
    absolute += std::abs(winding);
  }
  return std::abs(sum) > kInside || absolute > 1 - kSumRounding;
}

}  // namespace halfstep
