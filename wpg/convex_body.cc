#include "wpg/convex_body.h"

extern "C" {  // its C++ interface does not compile as C++20
#include <libqhull_r/libqhull_r.h>
}

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "wpg/check.h"

namespace halfstep {
namespace {

constexpr double kThinnest = 1e-9;     // of the size: below it a hull counts as flat.
constexpr double kCutOff = 1e-11;      // of the size: points may lie this far outside their hull.
constexpr double kMerged = 1e-12;      // of the size: below it two points are one.
constexpr double kSameNormal = 1e-18;  // squared distance of unit normals of coplanar faces.

[[noreturn]] void Refuse(const std::string& why) {
  throw std::runtime_error("no convex hull: " + why);
}

double FarthestFrom(const ConvexBody& body, const Eigen::Vector3d& center, int* vertex) {
  double farthest = -1.0;
  for (int i = 0; i < static_cast<int>(body.vertices.cols()); ++i) {
    const Eigen::Vector3d d = body.vertices.col(i) - center;
    const double reach = std::hypot(d.head<2>().norm() + body.disc_radius, d.z());
    if (reach > farthest) {
      farthest = reach;
      *vertex = i;
    }
  }
  return farthest + body.ball_radius;
}

ConvexBody MakeSegment(double length) {
  ConvexBody body;
  body.vertices.resize(3, 2);
  body.vertices << 0, 0, 0, 0, -length / 2, length / 2;
  return body;
}

// Faces of the hull, as qhull gives them: indices into the points, outward normals.
struct Faces {
  std::vector<Eigen::Vector3i> triangles;
  std::vector<Eigen::Vector3d> normals;  // one a triangle
};

// A qhull context whose messages go nowhere.
class QhullRun {
 public:
  QhullRun() : messages_(open_memstream(&text_, &length_)) {
    if (messages_ == nullptr) Refuse("out of memory");
    qh_zero(&qh_, messages_);
  }
  ~QhullRun() {
    int current = 0, total = 0;
    qh_freeqhull(&qh_, !qh_ALL);
    qh_memfreeshort(&qh_, &current, &total);
    std::fclose(messages_);
    std::free(text_);
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;

  bool Run(Eigen::Matrix3Xd* points) {
    char command[] = "qhull Qt";
    return qh_new_qhull(&qh_, 3, static_cast<int>(points->cols()), points->data(), False, command,
                        nullptr, messages_) == 0;
  }
  qhT* get() { return &qh_; }

 private:
  char* text_ = nullptr;
  size_t length_ = 0;
  FILE* messages_;
  qhT qh_;
};

Faces RunQhull(Eigen::Matrix3Xd points) {
  QhullRun run;
  if (!run.Run(&points)) Refuse("the points are (nearly) coplanar, collinear or coincident");
  qhT* const qh = run.get();  // the name that qhull's macros expect
  Faces faces;
  for (const facetT* facet = qh->facet_list; facet != nullptr && facet->next != nullptr;
       facet = facet->next) {
    const int corners = qh_setsize(qh, facet->vertices);
    if (corners != 3) Refuse("qhull left a face that is not a triangle");
    Eigen::Vector3i triangle;
    for (int i = 0; i < 3; ++i) {
      const vertexT* corner = static_cast<const vertexT*>(facet->vertices->e[i].p);
      triangle[i] = qh_pointid(qh, corner->point);
    }
    const Eigen::Vector3d normal(facet->normal[0], facet->normal[1], facet->normal[2]);
    const Eigen::Vector3d a = points.col(triangle[0]);
    const Eigen::Vector3d ab = points.col(triangle[1]) - a, ac = points.col(triangle[2]) - a;
    if (ab.cross(ac).dot(normal) < 0) std::swap(triangle[1], triangle[2]);
    faces.triangles.push_back(triangle);
    faces.normals.push_back(normal.normalized());
  }
  return faces;
}

Eigen::Matrix3Xd Distinct(const std::vector<Eigen::Vector3d>& normals) {
  std::vector<Eigen::Vector3d> kept;
  for (const Eigen::Vector3d& n : normals) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Eigen::Vector3d& k) {
      return (k - n).squaredNorm() < kSameNormal;
    });
    if (!known) kept.push_back(n);
  }
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(kept.size()));
  for (size_t i = 0; i < kept.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = kept[i];
  return result;
}

// The points without those within `tolerance` of one that is kept. They are ordered along a
// direction that no edge is likely to be perpendicular to, so that the look back is short.
Eigen::Matrix3Xd Merged(const Eigen::Matrix3Xd& points, double tolerance) {
  const Eigen::Vector3d along = Eigen::Vector3d(0.62349, 0.21773, 0.75091).normalized();
  std::vector<Eigen::Vector3d> sorted(points.colwise().begin(), points.colwise().end());
  std::sort(sorted.begin(), sorted.end(), [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return along.dot(a) < along.dot(b);
  });
  Eigen::Matrix3Xd kept(3, points.cols());
  Eigen::Index n = 0;
  for (const Eigen::Vector3d& point : sorted) {
    bool again = false;
    for (Eigen::Index i = n - 1; i >= 0 && !again && along.dot(point - kept.col(i)) <= tolerance;
         --i) {
      again = (kept.col(i) - point).squaredNorm() <= tolerance * tolerance;
    }
    if (!again) kept.col(n++) = point;
  }
  kept.conservativeResize(3, n);
  return kept;
}

}  // namespace

double Support(const ConvexBody& body, const Eigen::Vector3d& direction) {
  const double x = direction.x(), y = direction.y(), z = direction.z();
  const auto& v = body.vertices;
  double farthest = (v.row(0) * x + v.row(1) * y + v.row(2) * z).maxCoeff();
  if (body.disc_radius > 0) farthest += body.disc_radius * std::sqrt(x * x + y * y);
  return farthest + body.ball_radius;
}

int FarthestVertex(const ConvexBody& body, const Eigen::Vector3d& direction) {
  const double x = direction.x(), y = direction.y(), z = direction.z();
  const Eigen::Index n = body.vertices.cols();
  const double *xs = body.vertices.data(), *ys = xs + n, *zs = ys + n;
  double best = -std::numeric_limits<double>::infinity();
  Eigen::Index farthest = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double along = xs[i] * x + ys[i] * y + zs[i] * z;
    if (along > best) {
      best = along;
      farthest = i;
    }
  }
  return static_cast<int>(farthest);
}

Eigen::Vector3d SupportPoint(const ConvexBody& body, const Eigen::Vector3d& direction) {
  Eigen::Vector3d point = body.vertices.col(FarthestVertex(body, direction));
  const double radial = direction.head<2>().norm();
  if (body.disc_radius > 0 && radial > 0) {
    point.head<2>() += body.disc_radius / radial * direction.head<2>();
  }
  if (body.ball_radius > 0) point += body.ball_radius * direction.normalized();
  return point;
}

// Badoiu & Clarkson 2003, "Smaller core-sets for balls": the centre walks towards the farthest
// point by 1/(i + 1). It starts at the middle of the axis-aligned bounds, often the best.
void BoundBySphere(ConvexBody* body) {
  HALFSTEP_CHECK(body->vertices.cols() > 0, "a body without vertices");
  Eigen::Vector3d center =
      (body->vertices.rowwise().minCoeff() + body->vertices.rowwise().maxCoeff()) / 2;
  int vertex = 0;
  body->radius = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= 100; ++i) {
    const double radius = FarthestFrom(*body, center, &vertex);
    if (radius < body->radius) {
      body->center = center;
      body->radius = radius;
    }
    center += (body->vertices.col(vertex) - center) / (i + 1);
  }
  body->radius += 1e-12 * (body->radius + body->center.norm());
}

ConvexBody MakeBox(const Eigen::Vector3d& size) {
  HALFSTEP_CHECK(size.allFinite() && size.minCoeff() > 0, "size = " << size.transpose());
  ConvexBody body;
  body.vertices.resize(3, 8);
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d sign((i & 1) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5, (i & 4) ? 0.5 : -0.5);
    body.vertices.col(i) = sign.cwiseProduct(size);
  }
  body.normals.resize(3, 6);
  body.normals << Eigen::Matrix3d::Identity(), -Eigen::Matrix3d::Identity();
  body.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  BoundBySphere(&body);
  return body;
}

ConvexBody MakeSphere(double radius) {
  HALFSTEP_CHECK(std::isfinite(radius) && radius > 0, "radius = " << radius);
  ConvexBody body;
  body.vertices = Eigen::Matrix3Xd::Zero(3, 1);
  body.ball_radius = radius;
  BoundBySphere(&body);
  return body;
}

ConvexBody MakeCylinder(double radius, double length) {
  HALFSTEP_CHECK(std::isfinite(radius) && radius > 0, "radius = " << radius);
  HALFSTEP_CHECK(std::isfinite(length) && length > 0, "length = " << length);
  ConvexBody body = MakeSegment(length);
  body.disc_radius = radius;
  BoundBySphere(&body);
  return body;
}

ConvexBody MakeCapsule(double radius, double length) {
  HALFSTEP_CHECK(std::isfinite(radius) && radius > 0, "radius = " << radius);
  HALFSTEP_CHECK(std::isfinite(length) && length > 0, "length = " << length);
  ConvexBody body = MakeSegment(length);
  body.ball_radius = radius;
  BoundBySphere(&body);
  return body;
}

ConvexBody MakeHull(const Eigen::Matrix3Xd& points) {
  if (points.cols() < 4) {
    Refuse("it takes at least four points, there are " + std::to_string(points.cols()));
  }
  if (!points.allFinite()) Refuse("a coordinate is not finite");
  const Eigen::Vector3d lower = points.rowwise().minCoeff(), upper = points.rowwise().maxCoeff();
  const Eigen::Vector3d middle = lower / 2 + upper / 2;
  const double size = (upper - lower).norm();
  if (!std::isfinite(size)) Refuse("the points are too far apart");
  if (!(size > 0)) Refuse("all points coincide");

  // Centred and scaled: qhull's tolerances depend on the largest coordinate.
  const Eigen::Matrix3Xd local = Merged((points.colwise() - middle) / size, kMerged);
  if (local.cols() < 4) Refuse("the points are (nearly) coplanar, collinear or coincident");
  const Faces faces = RunQhull(local);

  ConvexBody body;
  std::unordered_map<int, int> renumbered;
  body.vertices.resize(3, local.cols());
  for (Eigen::Vector3i triangle : faces.triangles) {
    for (int& corner : triangle) {
      const auto [place, fresh] =
          renumbered.try_emplace(corner, static_cast<int>(renumbered.size()));
      if (fresh) body.vertices.col(place->second) = local.col(corner);
      corner = place->second;
    }
    body.triangles.push_back(triangle);
  }
  body.vertices.conservativeResize(3, static_cast<Eigen::Index>(renumbered.size()));
  body.normals = Distinct(faces.normals);
  for (const Eigen::Vector3d& n : body.normals.colwise()) {
    const double reach = Support(body, n);
    if (reach + Support(body, -n) < kThinnest) Refuse("the points are (nearly) coplanar");
    if ((n.transpose() * local).maxCoeff() > reach + kCutOff) {
      Refuse("rounding would cut off points; they are (nearly) coplanar");
    }
  }
  body.vertices = (body.vertices * size).colwise() + middle;
  BoundBySphere(&body);
  return body;
}

}  // namespace halfstep
