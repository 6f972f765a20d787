#include "wpg/geometry/direction_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Points = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
using List = std::vector<int32_t>;

constexpr int kMostSquares = 64;  // along an edge of the cube
// By how much more than another a point reaches that excludes it, of the largest coordinate. The
// rounding of all products that are compared, and of the square that a direction belongs to, is
// below 40 epsilon.
constexpr double kBeyond = 256 * std::numeric_limits<double>::epsilon();
// Components of directions whose products neither overflow nor lose digits.
constexpr double kLeast = 1e-150, kLargest = 1e150;

// Through the cube's face 2·axis (towards +) or 2·axis + 1 (towards −), at (a, b) ∈ [−1, 1]².
Eigen::Vector3d Through(int face, double a, double b) {
  const int axis = face / 2;
  Eigen::Vector3d direction;
  direction[axis] = face % 2 == 0 ? 1.0 : -1.0;
  direction[(axis + 1) % 3] = a;
  direction[(axis + 2) % 3] = b;
  return direction;
}

// What is left of `among` for the directions through a square with these corners. A product is
// linear in between, so what exceeds at the corners exceeds everywhere.
List Farthest(const Points& points, const List& among,
              const std::array<Eigen::Vector3d, 4>& corners, double beyond) {
  const auto n = static_cast<Eigen::Index>(among.size());
  Eigen::Matrix<double, 4, Eigen::Dynamic> reach(4, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d point = points.col(Nth(among, i));
    for (int k = 0; k < 4; ++k) reach(k, i) = Nth(corners, k).dot(point);
  }
  // The farthest in the middle and at the corners are compared with all.
  std::array<Eigen::Index, 5> rivals{};
  for (int k = 0; k < 4; ++k) reach.row(k).maxCoeff(&Nth(rivals, k));
  reach.colwise().sum().maxCoeff(&rivals[4]);
  List left;
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool exceeded = std::any_of(rivals.begin(), rivals.end(), [&](Eigen::Index rival) {
      return ((reach.col(rival) - reach.col(i)).array() > beyond).all();
    });
    if (!exceeded) left.push_back(Nth(among, i));
  }
  return left;
}

// The lists of a face's squares, from those of larger squares.
class FaceLists {
 public:
  FaceLists(const Points& points, int face, int squares)
      : points_(points),
        face_(face),
        squares_(squares),
        beyond_(kBeyond * points.cwiseAbs().maxCoeff()),
        lists_(static_cast<size_t>(squares) * static_cast<size_t>(squares)) {
    List all(static_cast<size_t>(points.cols()));
    std::iota(all.begin(), all.end(), 0);
    Cut(0, 0, squares, all);
  }
  const std::vector<List>& lists() const { return lists_; }

 private:
  void Cut(int i, int j, int width, const List& among) {
    const auto at = [&](int k) { return -1.0 + 2.0 * k / squares_; };
    List left = Farthest(
        points_, among,
        {Through(face_, at(i), at(j)), Through(face_, at(i + width), at(j)),
         Through(face_, at(i), at(j + width)), Through(face_, at(i + width), at(j + width))},
        beyond_);
    if (width == 1) {
      Nth(lists_, i * squares_ + j) = std::move(left);
      return;
    }
    const int half = width / 2;
    for (const int di : {0, half}) {
      for (const int dj : {0, half}) Cut(i + di, j + dj, half, left);
    }
  }

  const Points& points_;
  const int face_, squares_;
  const double beyond_;
  std::vector<List> lists_;
};

}  // namespace

DirectionMap::DirectionMap(const Points& points) {
  HALFSTEP_CHECK(points.cols() > 0 && points.allFinite(), points.cols() << " points");
  // About as many squares as points.
  const auto along = static_cast<unsigned>(std::sqrt(static_cast<double>(points.cols()) / 6));
  squares_ = static_cast<int>(std::min<unsigned>(std::bit_ceil(along + 1), kMostSquares));
  starts_ = {0};
  for (int face = 0; face < 6; ++face) {
    const FaceLists face_lists(points, face, squares_);
    for (const List& list : face_lists.lists()) {
      points_.insert(points_.end(), list.begin(), list.end());
      starts_.push_back(static_cast<uint32_t>(points_.size()));
    }
  }
}

std::span<const int32_t> DirectionMap::Along(const Eigen::Vector3d& direction) const {
  if (squares_ == 0) return {};
  const Eigen::Vector3d size = direction.cwiseAbs();
  int axis = size.y() > size.x() ? 1 : 0;
  if (size.z() > size[axis]) axis = 2;
  const double largest = size[axis];
  if (!(largest > kLeast && largest < kLargest)) return {};
  const double half = 0.5 * squares_;
  // std::min takes what is not a number for the last square.
  const auto square = [&](double component) {
    return static_cast<int>(std::min(squares_ - 1.0, (component / largest + 1.0) * half));
  };
  const int face = 2 * axis + (direction[axis] > 0 ? 0 : 1);
  const int i = square(direction[(axis + 1) % 3]), j = square(direction[(axis + 2) % 3]);
  const int place = (face * squares_ + i) * squares_ + j;
  const uint32_t begin = Nth(starts_, place);
  return {&points_[begin], Nth(starts_, place + 1) - begin};
}

}  // namespace halfstep
