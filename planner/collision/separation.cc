#include "planner/collision/separation.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/collision/convex_distance.h"
#include "planner/collision/mesh_interior.h"
#include "planner/collision/triangle_surface.h"
#include "wpg/check.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kThickness = 1e-6;  // [m] given to a core without volume before it meets a mesh.
constexpr int kDiscSides = 64;
// Taken off triangle distances for rounding: of the coordinates, and at least [m].
constexpr double kTriangleRounding = 1e-12, kLeastRounding = 1e-10;
// Taken off slabs to a mesh's hull for rounding: of the mesh's coordinates.
constexpr double kSlabRounding = 4e-15;
constexpr Eigen::Index kMostOfAHull = 20'000;  // triangles of a mesh that is given its hull
// By this much more than asked must a remembered direction separate [m]. It is more than a slab may
// be narrower than the distance where the search for it ends, so the answer is the same as without
// a memory. Deep overlaps are searched locally: there the memory might know better.
constexpr double kRemembered = 1e-9;
// Asked of a slab: whether there is any, not how wide it is or how deep the overlap.
constexpr double kAny = std::numeric_limits<double>::min();

// Corners of the polygon around a disc: at most 0.1 mm of it stands out, or 1/800 of the radius.
int DiscSides(double radius) {
  constexpr double kExcess = 1e-4;  // [m] of r(1/cos(π/n) − 1) ≈ r(π/n)²/2
  const double sides = std::numbers::pi * std::sqrt(radius / (2 * kExcess));
  return 4 * static_cast<int>(std::ceil(std::clamp(sides, 1.0 * kDiscSides, 512.0) / 4));
}

// A convex body whose triangles are those around the core of another, the body without its ball;
// that core reaches beyond them by at most the ball of this one.
ConvexBody MakeCore(const ConvexBody& body) {
  if (body.disc_radius == 0 && !body.triangles.empty()) {
    ConvexBody core = body;
    core.ball_radius = 0;
    return core;
  }
  // What each vertex is widened by: a polygon around the disc, else an octahedron.
  std::vector<Eigen::Vector3d> around;
  if (body.disc_radius > 0) {
    const int sides = DiscSides(body.disc_radius);
    const double reach = body.disc_radius / Cos(std::numbers::pi / sides) * (1 + 1e-12);
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      around.emplace_back(reach * Cos(angle), reach * Sin(angle), 0);
    }
  } else {
    for (int axis = 0; axis < 3; ++axis) {
      around.push_back(kThickness * Eigen::Vector3d::Unit(axis));
      around.push_back(-kThickness * Eigen::Vector3d::Unit(axis));
    }
  }
  const Eigen::Index n = static_cast<Eigen::Index>(around.size());
  Eigen::Matrix3Xd points(3, n * body.vertices.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    points.col(i) = body.vertices.col(i / n) + Nth(around, i % n);
  }
  return MakeHull(points);
}

// Convex and around the mesh, wide enough for the rounding of slabs.
ConvexBody Enclosing(const TriangleMesh& mesh) {
  HALFSTEP_CHECK(mesh.triangles.cols() > 0, "a mesh without triangles");
  HALFSTEP_CHECK(mesh.vertices.allFinite(), "a vertex of the mesh is not finite");
  HALFSTEP_CHECK(mesh.triangles.minCoeff() >= 0 && mesh.triangles.maxCoeff() < mesh.vertices.cols(),
                 "vertex indices " << mesh.triangles.minCoeff() << " … "
                                   << mesh.triangles.maxCoeff() << " of " << mesh.vertices.cols()
                                   << " vertices");
  const auto bounds = [&mesh] {
    const Eigen::Vector3d lower = mesh.vertices.rowwise().minCoeff();
    const Eigen::Vector3d upper = mesh.vertices.rowwise().maxCoeff();
    ConvexBody box;
    box.vertices.resize(3, 8);
    for (int i = 0; i < 8; ++i) {
      box.vertices.col(i) << ((i & 1) ? upper : lower).x(), ((i & 2) ? upper : lower).y(),
          ((i & 4) ? upper : lower).z();
    }
    return box;
  };
  ConvexBody around;
  try {
    around = mesh.triangles.cols() > kMostOfAHull ? bounds() : MakeHull(mesh.vertices);
  } catch (const std::runtime_error&) {  // flat
    around = bounds();
  }
  around.ball_radius += kSlabRounding * mesh.vertices.colwise().norm().maxCoeff();
  BoundBySphere(&around);
  return around;
}

// The same body, with what makes its support function fast.
ConvexBody Mapped(ConvexBody body) {
  const bool mapped = !body.directions.Along(Eigen::Vector3d::UnitX()).empty();
  if (!mapped) MapDirections(&body);
  return body;
}

bool IsFinite(const Eigen::Isometry3d& X) { return std::isfinite(X.matrix().topRows<3>().sum()); }

}  // namespace

struct CollisionShape::Impl {
  explicit Impl(ConvexBody body) : convex(Mapped(std::move(body))) {}
  explicit Impl(TriangleMesh triangles) : convex(Mapped(Enclosing(triangles))), is_mesh(true) {
    surface_.emplace(std::move(triangles));
  }

  // The triangles; of a convex body those of its core, built when it first comes near a mesh.
  const TriangleSurface& surface() const {
    std::call_once(surface_once_, [this] {
      if (is_mesh) return;
      const ConvexBody core = MakeCore(convex);
      surface_.emplace(FacesOf(core), TriangleSurface::kOneBlock);
      excess_ = core.ball_radius;
    });
    return *surface_;
  }
  // How far a convex body reaches beyond the triangles.
  double beyond() const {
    surface();
    return excess_ + convex.ball_radius;
  }
  // What the surface encloses; built when first asked for.
  const MeshInterior& interior() const {
    std::call_once(interior_once_, [this] { interior_.emplace(surface().mesh()); });
    return *interior_;
  }

  const ConvexBody convex;
  const bool is_mesh = false;

 private:
  mutable std::once_flag surface_once_, interior_once_;
  mutable std::optional<TriangleSurface> surface_;
  mutable double excess_ = 0.0;  // by which the core reaches beyond its triangles [m]
  mutable std::optional<MeshInterior> interior_;
};

CollisionShape::CollisionShape(ConvexBody body) {
  HALFSTEP_CHECK(body.vertices.cols() > 0 && body.vertices.allFinite(), body.vertices.cols()
                                                                            << " vertices");
  HALFSTEP_CHECK(body.disc_radius >= 0 && body.ball_radius >= 0,
                 "disc_radius = " << body.disc_radius << ", ball_radius = " << body.ball_radius);
  impl_ = std::make_shared<const Impl>(std::move(body));
}
CollisionShape::CollisionShape(TriangleMesh mesh)
    : impl_(std::make_shared<const Impl>(std::move(mesh))) {}

CollisionShape::CollisionShape(const Shape& shape)
    : CollisionShape(std::visit([](const auto& s) { return CollisionShape(BodyOf(s)); }, shape)) {}

bool CollisionShape::is_mesh() const { return impl_->is_mesh; }
const ConvexBody& CollisionShape::convex() const { return impl_->convex; }
const Eigen::Vector3d& CollisionShape::center() const { return impl_->convex.center; }
double CollisionShape::radius() const { return impl_->convex.radius; }

namespace {

ConvexDistance Slab(const CollisionShape& a, const Eigen::Isometry3d& X_Wa, const CollisionShape& b,
                    const Eigen::Isometry3d& X_Wb, double enough) {
  const Eigen::Isometry3d X_AB = X_Wa.inverse(Eigen::Isometry) * X_Wb;
  return FindConvexDistance(a.convex(), b.convex(), X_AB, a.center() - X_AB * b.center(), enough);
}

Separation InWorld(const ConvexDistance& found, const Eigen::Isometry3d& X_Wa) {
  return {found.lower, X_Wa.linear() * found.normal_A, X_Wa * found.point_a_A,
          X_Wa * found.point_b_A};
}

// Taken off the distance of triangles for rounding [m].
double TriangleRounding(const CollisionShape& a, const Eigen::Isometry3d& X_Wa,
                        const CollisionShape& b, const Eigen::Isometry3d& X_Wb) {
  const double coordinates = (X_Wa.translation() - X_Wb.translation()).norm() + a.center().norm() +
                             a.radius() + b.center().norm() + b.radius();
  return std::max(kLeastRounding, kTriangleRounding * coordinates);
}

// Whether a body that meets no triangle of the mesh holds a part of it or lies inside it.
bool Contains(const CollisionShape& body, const CollisionShape& mesh,
              const Eigen::Isometry3d& X_MB) {
  ConvexBody point;
  point.vertices.resize(3, 1);
  const Eigen::Isometry3d X_BM = X_MB.inverse(Eigen::Isometry);
  const auto holds = [&](const Eigen::Vector3d& p) {
    point.vertices.col(0) = point.center = p;
    const Eigen::Vector3d first = body.center() - X_BM * p;
    return FindConvexDistance(body.convex(), point, X_BM, first, 0.0).lower < 0;
  };
  const MeshInterior& interior = mesh.impl().interior();
  return interior.AnyPatch(X_MB * body.center(), body.radius(), holds) ||
         interior.Contains(X_MB * body.convex().vertices.col(0));
}

// The normal points to the body.
Separation SeparateFromMesh(const CollisionShape& body, const Eigen::Isometry3d& X_WB,
                            const CollisionShape& mesh, const Eigen::Isometry3d& X_WM, double cap) {
  // The slab between the body and the mesh's hull. How far these overlap costs much and matters
  // only where the body touches the mesh itself.
  const auto slab = [&](double enough) {
    return InWorld(Slab(body, X_WB, mesh, X_WM, enough), X_WB);
  };
  Separation to_hull = slab(kAny);
  const bool apart = to_hull.distance > 0;
  if (apart) to_hull = slab(kConverge);
  const auto contact = [&] {
    if (!apart) to_hull = slab(kConverge);
    to_hull.distance = std::min(to_hull.distance, 0.0);
    return to_hull;
  };
  if (apart && to_hull.distance >= cap) return to_hull;
  try {
    const double ball = body.impl().beyond();
    const double rounding = TriangleRounding(body, X_WB, mesh, X_WM);
    const double asked = std::max(cap, kLeastRounding) + ball + rounding;
    const auto found = TriangleSurface::Distance(body.impl().surface(), X_WB, X_WB * body.center(),
                                                 body.radius(), mesh.impl().surface(), X_WM, asked);
    const double core_distance = found ? found->distance - rounding : asked - rounding;
    if (!(core_distance > 0)) return contact();
    Eigen::Vector3d normal_W = to_hull.normal_W;
    if (found) normal_W = (found->point_a_W - found->point_b_W).normalized();
    const Eigen::Isometry3d X_MB = X_WM.inverse(Eigen::Isometry) * X_WB;
    // As much of it as slabs prove; half of what was taken off is for their own rounding.
    const double slabs =
        mesh.impl().surface().LeastSlab(body.convex(), X_MB, X_WM.linear().transpose() * normal_W,
                                        core_distance - ball + 0.5 * rounding);
    const double distance = std::min(core_distance - ball, slabs - 0.5 * rounding);
    if (!(distance + body.convex().ball_radius > 0)) return contact();
    if (!apart && Contains(body, mesh, X_MB)) return contact();
    if (!found) {
      to_hull.distance = std::max(std::min(cap, distance), to_hull.distance);
      return to_hull;
    }
    if (!apart && distance < 0) to_hull = slab(kConverge);
    if (to_hull.distance >= distance) return to_hull;
    return {distance, normal_W, found->point_a_W - ball * normal_W, found->point_b_W};
  } catch (const std::exception&) {
    return contact();
  }
}

Separation Swapped(const Separation& s) {
  return {s.distance, -s.normal_W, s.point_b_W, s.point_a_W};
}

}  // namespace

double SeparationAlong(const ConvexBody& a, const Eigen::Isometry3d& X_Wa, const ConvexBody& b,
                       const Eigen::Isometry3d& X_Wb, const Eigen::Vector3d& n_W) {
  HALFSTEP_CHECK(!(std::abs(n_W.squaredNorm() - 1) > 2e-9), "n_W = " << n_W.transpose());
  const double origins = n_W.dot(X_Wa.translation() - X_Wb.translation());
  return origins - Support(a, -(X_Wa.linear().transpose() * n_W)) -
         Support(b, X_Wb.linear().transpose() * n_W);
}

Separation Separate(const CollisionShape& a, const Eigen::Isometry3d& X_Wa, const CollisionShape& b,
                    const Eigen::Isometry3d& X_Wb, double cap) {
  HALFSTEP_CHECK(IsFinite(X_Wa) && IsFinite(X_Wb), "a pose is not finite:\n"
                                                       << X_Wa.matrix() << "\n"
                                                       << X_Wb.matrix());
  HALFSTEP_CHECK(!(a.is_mesh() && b.is_mesh()), "two meshes");
  if (b.is_mesh()) return SeparateFromMesh(a, X_Wa, b, X_Wb, cap);
  if (a.is_mesh()) return Swapped(SeparateFromMesh(b, X_Wb, a, X_Wa, cap));
  return InWorld(Slab(a, X_Wa, b, X_Wb, kConverge), X_Wa);
}

bool ClearsAlongCached(const CollisionShape& a, const Eigen::Isometry3d& X_Wa,
                       const CollisionShape& b, const Eigen::Isometry3d& X_Wb, double clearance,
                       Eigen::Vector3d* normal_W) {
  HALFSTEP_CHECK(IsFinite(X_Wa) && IsFinite(X_Wb), "a pose is not finite");
  const double spheres = (X_Wa * a.center() - X_Wb * b.center()).norm() - a.radius() - b.radius();
  if (spheres >= clearance) return true;
  if (clearance >= 0 && normal_W->squaredNorm() > 0.5 &&
      SeparationAlong(a.convex(), X_Wa, b.convex(), X_Wb, *normal_W) >= clearance + kRemembered) {
    return true;
  }
  const ConvexDistance slab = Slab(a, X_Wa, b, X_Wb, clearance);
  *normal_W = (X_Wa.linear() * slab.normal_A).normalized();
  if (slab.lower >= clearance) return true;
  if (!a.is_mesh() && !b.is_mesh()) return false;
  return Separate(a, X_Wa, b, X_Wb, clearance).distance >= clearance;
}

}  // namespace halfstep
