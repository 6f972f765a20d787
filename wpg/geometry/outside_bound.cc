#include "wpg/geometry/outside_bound.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr double kGoodBound = 1e-14;  // of the size: an outside distance that needs no second look.
constexpr double kSamePlane = 1e-9;   // of the reach: faces that a ray may leave through.

// The distance to a point that is a convex combination of vertices, found where the ray from the
// centre leaves the hull.
class Outside {
 public:
  explicit Outside(const ConvexBody& body) : body_(body) {
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
    const Eigen::Vector3i& t = Nth(body_.triangles, face);
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = body_.vertices.col(t[k]) - center_;
    return corners;
  }
  // Distance of a point to one of the tetrahedron of a face and the centre.
  double OverFace(Eigen::Index face, const Eigen::Vector3d& point) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int corner : Nth(body_.triangles, face)) {
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

double OutsideBound(const ConvexBody& body, const Eigen::Matrix3Xd& points) {
  return Outside(body).Of(points);
}

}  // namespace halfstep
