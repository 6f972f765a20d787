#include "planner/collision/triangle_surface.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "planner/collision/convex_distance.h"
#include "planner/collision/triangle_tree.h"
#include "wpg/check.h"
#include "wpg/geometry/bounds_tree.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Bvh = fcl::BVHModel<fcl::OBBRSSd>;

// Of some triangles of a mesh, with their own corners only.
std::unique_ptr<const Bvh> MakeBvh(const TriangleMesh& mesh, std::vector<int32_t> triangles) {
  std::sort(triangles.begin(), triangles.end());  // as the mesh has them
  std::vector<fcl::Vector3d> points;
  std::vector<fcl::Triangle> faces;
  std::unordered_map<int, size_t> own;
  for (const int32_t triangle : triangles) {
    size_t corners[3];
    for (int k = 0; k < 3; ++k) {
      const int corner = mesh.triangles(k, triangle);
      const auto [at, fresh] = own.try_emplace(corner, points.size());
      if (fresh) points.emplace_back(mesh.vertices.col(corner));
      corners[k] = at->second;
    }
    faces.emplace_back(corners[0], corners[1], corners[2]);
  }
  auto bvh = std::make_unique<Bvh>();
  bvh->beginModel(static_cast<int>(faces.size()), static_cast<int>(points.size()));
  bvh->addSubModel(points, faces);
  bvh->endModel();
  return bvh;
}

// The least coordinates of a convex body along the directions that separated it last, in the frame
// of a mesh.
class LastSlabs {
 public:
  LastSlabs(const ConvexBody& body, const Eigen::Isometry3d& X_MB) : body_(body), X_MB_(X_MB) {}

  // Along a unit n, towards the body.
  void Add(const Eigen::Vector3d& n) {
    const Eigen::Vector3d n_B = X_MB_.linear().transpose() * n;
    Nth(slabs_, next_) = {n, n.dot(X_MB_.translation()) - Support(body_, -n_B)};
    next_ = (next_ + 1) % slabs_.size();
    count_ = std::max(count_, next_ == 0 ? slabs_.size() : next_);
  }
  // Whether one is at least `wide` to something whose largest coordinate along n is most(n).
  template <typename Most>
  bool Any(double wide, const Most& most) const {
    return std::any_of(slabs_.begin(), slabs_.begin() + static_cast<std::ptrdiff_t>(count_),
                       [&](const Slab& slab) { return slab.least - most(slab.n) >= wide; });
  }

 private:
  struct Slab {
    Eigen::Vector3d n;
    double least = 0.0;
  };
  const ConvexBody& body_;
  const Eigen::Isometry3d& X_MB_;
  std::array<Slab, 6> slabs_;
  size_t next_ = 0, count_ = 0;
};

}  // namespace

struct TriangleSurface::Impl {
  Impl(TriangleMesh its_mesh, int block)
      : mesh(std::move(its_mesh)),
        tree(TriangleBounds(mesh), block),
        once(tree.nodes.size()),
        bvhs(tree.nodes.size()) {}

  // Of a leaf of the tree.
  const Bvh& BvhOf(int32_t leaf) {
    std::unique_ptr<const Bvh>& bvh = Nth(bvhs, leaf);
    std::call_once(Nth(once, leaf), [&] {
      const BoundsTree::Node& node = Nth(tree.nodes, leaf);
      const auto first = tree.order.begin() + node.first;
      bvh = MakeBvh(mesh, {first, first + node.count});
      ++built;
    });
    return *bvh;
  }

  // With few triangles in a leaf.
  const TriangleTree& triangles() {
    std::call_once(once_triangles, [this] { triangle_tree.emplace(mesh); });
    return *triangle_tree;
  }

  const TriangleMesh mesh;
  const BoundsTree tree;
  std::once_flag once_triangles;
  std::optional<const TriangleTree> triangle_tree;
  std::vector<std::once_flag> once;  // by node; inner nodes have none
  std::vector<std::unique_ptr<const Bvh>> bvhs;
  std::atomic<int> built = 0;
};

TriangleSurface::TriangleSurface(TriangleMesh mesh, int block) {
  HALFSTEP_CHECK(mesh.triangles.cols() > 0, "a mesh without triangles");
  HALFSTEP_CHECK(mesh.triangles.minCoeff() >= 0 && mesh.triangles.maxCoeff() < mesh.vertices.cols(),
                 "vertex indices " << mesh.triangles.minCoeff() << " … "
                                   << mesh.triangles.maxCoeff() << " of " << mesh.vertices.cols()
                                   << " vertices");
  impl_ = std::make_unique<Impl>(std::move(mesh), block);
}

TriangleSurface::~TriangleSurface() = default;

const TriangleMesh& TriangleSurface::mesh() const { return impl_->mesh; }
int TriangleSurface::built() const { return impl_->built; }

std::optional<TriangleSurface::Nearest> TriangleSurface::Distance(
    const TriangleSurface& a, const Eigen::Isometry3d& X_Wa, const Eigen::Vector3d& center_W,
    double radius, const TriangleSurface& b, const Eigen::Isometry3d& X_Wb, double cap) {
  const BoundsTree& tree = b.impl_->tree;
  const Eigen::Vector3d center = X_Wb.inverse(Eigen::Isometry) * center_W;
  const double rounding =
      1e-12 * (1.0 + radius + X_Wb.translation().norm() + center_W.norm() + tree.Farthest());
  const fcl::DistanceRequestd request(/*enable_nearest_points=*/true);
  // The result goes from block to block, and FCL leaves out what is farther than it.
  fcl::DistanceResultd result(cap);
  // Nodes by a lower bound of their distance, the nearest first.
  using Bound = std::pair<double, int32_t>;
  std::priority_queue<Bound, std::vector<Bound>, std::greater<>> open;
  const auto add = [&](int32_t n) {
    const double bound = BoundsTree::Gap(Nth(tree.nodes, n), center) - radius - rounding;
    if (bound < result.min_distance) open.emplace(bound, n);
  };
  add(0);
  while (!open.empty() && result.min_distance > 0) {
    const auto [bound, n] = open.top();
    open.pop();
    if (bound >= result.min_distance) break;
    const BoundsTree::Node& node = Nth(tree.nodes, n);
    if (node.left >= 0) {
      add(node.left);
      add(node.left + 1);
      continue;
    }
    fcl::distance(&a.impl_->BvhOf(0), X_Wa, &b.impl_->BvhOf(n), X_Wb, request, result);
  }
  if (result.o1 == nullptr) return std::nullopt;
  return Nearest{result.min_distance, result.nearest_points[0], result.nearest_points[1]};
}

double TriangleSurface::LeastSlab(const ConvexBody& body, const Eigen::Isometry3d& X_MB,
                                  const Eigen::Vector3d& first_M, double enough) const {
  const TriangleTree& tree = impl_->triangles();
  const Eigen::Isometry3d X_BM = X_MB.inverse(Eigen::Isometry);
  const Eigen::Vector3d center = X_MB * body.center;
  const double ball = body.radius + 1e-12 * (1.0 + center.norm() + tree.Farthest());
  LastSlabs slabs(body, X_MB);
  if (first_M.squaredNorm() > 0.5) slabs.Add(first_M);
  ConvexBody triangle;
  std::array<int32_t, BoundsTree::kDeepest> stack{};
  size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const BoundsTree::Node& node = Nth(tree.nodes, Nth(stack, --top));
    const auto box_most = [&node](const Eigen::Vector3d& n) {
      return n.dot(node.center) + n.cwiseAbs().dot(node.half);
    };
    if (BoundsTree::Gap(node, center) - ball >= enough || slabs.Any(enough, box_most)) continue;
    if (node.left >= 0) {
      Nth(stack, top++) = node.left + 1;
      Nth(stack, top++) = node.left;
      continue;
    }
    for (int32_t i = node.first; i < node.first + node.count; ++i) {
      const Eigen::Matrix3d& corners = Nth(tree.triangles, i);
      const auto most = [&corners](const Eigen::Vector3d& n) {
        return (n.transpose() * corners).maxCoeff();
      };
      if (slabs.Any(enough, most)) continue;
      triangle.vertices = corners;
      triangle.center = corners.rowwise().mean();
      const auto slab = [&](double until) {
        return FindConvexDistance(body, triangle, X_BM, body.center - X_BM * triangle.center,
                                  until);
      };
      ConvexDistance found = slab(enough);
      if (!(found.lower >= enough)) found = slab(kConverge);
      enough = std::min(enough, found.lower);
      slabs.Add(X_MB.linear() * found.normal_A);
    }
  }
  return enough;
}

}  // namespace halfstep
