#include "wpg/geometry/convex_body.h"
#include "wpg/nth.h"

extern "C" {  // its C++ interface does not compile as C++20
#include <libqhull_r/libqhull_r.h>
}

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "wpg/geometry/distinct_normals.h"
#include "wpg/geometry/outside_bound.h"

namespace halfstep {
namespace {

constexpr double kThinnest = 1e-9;    // of the size: below it a hull counts as flat.
constexpr double kMerged = 1e-12;     // of the size: below it two points are one.
constexpr double kSameNormal = 1e-9;  // distance of unit normals of coplanar faces.

[[noreturn]] void Refuse(const std::string& why) {
  throw std::runtime_error("no convex hull: " + why);
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
  DistinctNormals distinct(kSameNormal);
  for (const Eigen::Vector3d& n : normals) distinct.Add(n);
  const std::vector<Eigen::Vector3d>& kept = distinct.kept();
  return Eigen::Map<const Eigen::Matrix3Xd>(kept.front().data(), 3,
                                            static_cast<Eigen::Index>(kept.size()));
}

// Indices of the points without those within `tolerance` of one that is kept. They are ordered
// along a direction that no edge is likely to be perpendicular to, so that the look back is short.
std::vector<Eigen::Index> Merged(const Eigen::Matrix3Xd& points, double tolerance) {
  const Eigen::Vector3d along = Eigen::Vector3d(0.62349, 0.21773, 0.75091).normalized();
  std::vector<Eigen::Index> sorted(static_cast<size_t>(points.cols()));
  std::iota(sorted.begin(), sorted.end(), Eigen::Index{0});
  const Eigen::RowVectorXd height = along.transpose() * points;
  std::sort(sorted.begin(), sorted.end(), [&](Eigen::Index a, Eigen::Index b) {
    return height[a] < height[b] || (height[a] == height[b] && a < b);
  });
  std::vector<Eigen::Index> kept;
  for (const Eigen::Index point : sorted) {
    bool again = false;
    for (size_t i = kept.size();
         i-- > 0 && !again && height[point] - height[kept[i]] <= tolerance;) {
      again = (points.col(kept[i]) - points.col(point)).squaredNorm() <= tolerance * tolerance;
    }
    if (!again) kept.push_back(point);
  }
  return kept;
}

}  // namespace

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
  const Eigen::Matrix3Xd scaled = (points.colwise() - middle) / size;
  const std::vector<Eigen::Index> merged = Merged(scaled, kMerged);
  if (merged.size() < 4) Refuse("the points are (nearly) coplanar, collinear or coincident");
  const Eigen::Matrix3Xd local = scaled(Eigen::all, merged);
  const Faces faces = RunQhull(local);

  ConvexBody body;
  std::vector<Eigen::Index> vertices;  // columns of `points`
  std::unordered_map<int, int> renumbered;
  for (Eigen::Vector3i triangle : faces.triangles) {
    for (int& corner : triangle) {
      const auto [place, fresh] = renumbered.try_emplace(corner, static_cast<int>(vertices.size()));
      if (fresh) vertices.push_back(Nth(merged, corner));
      corner = place->second;
    }
    body.triangles.push_back(triangle);
  }
  body.normals = Distinct(faces.normals);
  body.vertices = scaled(Eigen::all, vertices);
  for (const Eigen::Vector3d& n : body.normals.colwise()) {
    if (Support(body, n) + Support(body, -n) < kThinnest)
      Refuse("the points are (nearly) coplanar");
  }
  body.vertices = points(Eigen::all, vertices);
  std::sort(vertices.begin(), vertices.end());
  std::vector<Eigen::Index> others;  // vertices are not outside
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (!std::binary_search(vertices.begin(), vertices.end(), i)) others.push_back(i);
  }
  if (!others.empty()) body.ball_radius = OutsideBound(body, points(Eigen::all, others));
  BoundBySphere(&body);
  return body;
}

}  // namespace halfstep
