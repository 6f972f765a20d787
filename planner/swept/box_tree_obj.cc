#include "planner/swept/box_tree_obj.h"

#include <map>
#include <vector>

#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3i;

class Occupied {
 public:
  explicit Occupied(const std::vector<BoxTree::CellBox>& boxes) {
    for (const auto& box : boxes) size_ = size_.cwiseMax(box.upper);
    cells_.assign(Index(Vector3i(size_.x(), 0, 0)), false);
    for (const auto& box : boxes) {
      for (int x = box.lower.x(); x < box.upper.x(); ++x) {
        for (int y = box.lower.y(); y < box.upper.y(); ++y) {
          for (int z = box.lower.z(); z < box.upper.z(); ++z) cells_[Index({x, y, z})] = true;
        }
      }
    }
  }
  bool At(const Vector3i& cell) const {
    if ((cell.array() < 0).any() || (cell.array() >= size_.array()).any()) return false;
    return cells_[Index(cell)];
  }

 private:
  size_t Index(const Vector3i& cell) const {
    return static_cast<size_t>((int64_t{cell.x()} * size_.y() + cell.y()) * size_.z() + cell.z());
  }
  Vector3i size_ = Vector3i::Zero();
  std::vector<bool> cells_;
};

class ObjText {
 public:
  explicit ObjText(const BoxTree& tree) : tree_(tree) {}

  // Corners in order; lattice coordinates.
  void Quad(const std::array<Vector3i, 4>& corners) {
    faces_ += "f";
    for (const Vector3i& corner : corners) {
      const auto [at, fresh] = numbers_.try_emplace({corner.x(), corner.y(), corner.z()},
                                                    static_cast<int>(numbers_.size()) + 1);
      if (fresh) {
        const Eigen::Vector3d p = tree_.Corner(corner);
        vertices_ += Formatted("v %.6f %.6f %.6f\n", p.x(), p.y(), p.z());
      }
      faces_ += " " + std::to_string(at->second);
    }
    faces_ += "\n";
  }
  std::string Text() const { return vertices_ + faces_; }

 private:
  const BoxTree& tree_;
  std::map<std::array<int, 3>, int> numbers_;
  std::string vertices_, faces_;
};

}  // namespace

std::string BoxTreeObj(const BoxTree& tree) {
  const std::vector<BoxTree::CellBox> boxes = tree.SolidBoxes();
  const Occupied occupied(boxes);
  ObjText text(tree);
  for (const auto& box : boxes) {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (const bool upper : {false, true}) {
        // Along v, runs of cells with nothing beyond the face.
        for (int i = box.lower[u]; i < box.upper[u]; ++i) {
          int run = box.lower[v];
          for (int j = box.lower[v]; j <= box.upper[v]; ++j) {
            Vector3i beyond;
            beyond[axis] = upper ? box.upper[axis] : box.lower[axis] - 1;
            beyond[u] = i;
            beyond[v] = j;
            if (j < box.upper[v] && !occupied.At(beyond)) continue;
            if (run < j) {
              std::array<Vector3i, 4> corners;
              for (int k = 0; k < 4; ++k) {
                Vector3i& corner = Nth(corners, upper ? k : 3 - k);
                corner[axis] = upper ? box.upper[axis] : box.lower[axis];
                corner[u] = i + (k == 1 || k == 2 ? 1 : 0);
                corner[v] = k >= 2 ? j : run;
              }
              text.Quad(corners);
            }
            run = j + 1;
          }
        }
      }
    }
  }
  return text.Text();
}

}  // namespace halfstep
