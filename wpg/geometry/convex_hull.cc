#include "wpg/geometry/convex_body.h"

extern "C" {  // its C++ interface does not compile as C++20
#include <libqhull_r/libqhull_r.h>
}

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <unordered_map>

namespace halfstep {
namespace {

constexpr double kThinnest = 1e-9;    // of the size: below it a hull counts as flat.
constexpr double kMerged = 1e-12;     // of the size: below it two points are one.
constexpr double kGoodBound = 1e-14;  // of the size: an outside distance that needs no second look.
constexpr double kSamePlane = 1e-9;   // of the reach: faces that a ray may leave through.
constexpr double kSameNormal = 1e-18;  // squared distance of unit normals of coplanar faces.

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

// Bounds how far points lie outside the hull of a body's vertices: by the distance to a point that
// is a convex combination of vertices, found where the ray from the centre leaves the hull.
class OutsideBound {
 public:
  explicit OutsideBound(const ConvexBody& body) : body_(body) {
    // Of extended precision, so that it lies in the hull but for what `rounding_` allows.
    Eigen::Matrix<long double, 3, 1> sum = Eigen::Matrix<long double, 3, 1>::Zero();
    for (const auto& v : body.vertices.colwise()) sum += v.cast<long double>();
    const auto n = static_cast<double>(body.vertices.cols());
    center_ = (sum / static_cast<long double>(n)).cast<double>();
    const double largest = body.vertices.colwise().norm().maxCoeff();
    rounding_ = (16 * std::numeric_limits<double>::epsilon() + n * 1e-19) * largest;
    size_ = (body.vertices.colwise() - center_).colwise().norm().maxCoeff();
    planes_.setZero(static_cast<Eigen::Index>(body.triangles.size()), 3);
    for (Eigen::Index f = 0; f < planes_.rows(); ++f) {
      const Eigen::Matrix3d corners = Corners(f);
      const Eigen::Vector3d n_f =
          (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
      const double height = n_f.dot(corners.col(0));
      if (height > 0) planes_.row(f) = n_f.transpose() / height;
    }
  }

  // The largest over all points [m]; 0 for points that are vertices.
  double Of(const Eigen::Matrix3Xd& points) const {
    constexpr Eigen::Index kBlock = 256;
    double most = 0;
    for (Eigen::Index i = 0; i < points.cols(); i += kBlock) {
      const Eigen::Index n = std::min(kBlock, points.cols() - i);
      const Eigen::Matrix3Xd local = points.middleCols(i, n).colwise() - center_;
      const Eigen::MatrixXd reach = planes_ * local;  // 1 on the plane of a face
      for (Eigen::Index k = 0; k < n; ++k) {
        Eigen::Index first = 0;
        const double farthest = reach.col(k).maxCoeff(&first);
        double bound = OverFace(first, points.col(i + k));
        // Of a flat face in many triangles the ray may leave through another one.
        for (Eigen::Index f = 0; f < planes_.rows() && bound > kGoodBound * size_ + rounding_;
             ++f) {
          if (reach(f, k) < farthest - kSamePlane) continue;
          bound = std::min(bound, OverFace(f, points.col(i + k)));
        }
        most = std::max(most, bound);
      }
    }
    return most;
  }

 private:
  Eigen::Matrix3d Corners(Eigen::Index face) const {
    const Eigen::Vector3i& t = body_.triangles[static_cast<size_t>(face)];
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = body_.vertices.col(t[k]) - center_;
    return corners;
  }
  // Distance of a point to one of the tetrahedron of a face and the centre.
  double OverFace(Eigen::Index face, const Eigen::Vector3d& point) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int corner : body_.triangles[static_cast<size_t>(face)]) {
      nearest = std::min(nearest, (body_.vertices.col(corner) - point).norm());
    }
    if (nearest == 0) return 0;
    const Eigen::Matrix3d corners = Corners(face);
    const Eigen::Vector3d local = point - center_;
    Eigen::Vector3d weights = corners.partialPivLu().solve(local);
    if (weights.allFinite()) {
      weights = weights.cwiseMax(0.0);
      if (const double sum = weights.sum(); sum > 1) weights /= sum;
      nearest = std::min(nearest, (corners * weights - local).norm());
    }
    return nearest + rounding_;
  }

  const ConvexBody& body_;
  Eigen::Vector3d center_;
  double rounding_ = 0.0;
  double size_ = 0.0;
  Eigen::Matrix<double, Eigen::Dynamic, 3> planes_;  // n/h, seen from the centre
};

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
      if (fresh) vertices.push_back(merged[static_cast<size_t>(corner)]);
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
  body.ball_radius = OutsideBound(body).Of(points);
  BoundBySphere(&body);
  return body;
}

}  // namespace halfstep
