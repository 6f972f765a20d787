#include "planner/swept/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <sstream>

#include "planner/collision/convex_distance.h"
#include "planner/swept/box_tree_obj.h"
#include "planner/swept/box_tree_query.h"
#include "planner/swept/swept_volume_bytes.h"
#include "tests/planner/swept_volume_draws.h"

namespace halfstep {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A lump of overlapping balls of cells.
VoxelGrid Lump(SweptDraw* draw, double cell = 0.05) {
  VoxelGrid grid({-0.5, -0.6, 0.0}, {0.5, 0.6, 1.1}, cell);
  for (int ball = 0; ball < 4; ++ball) {
    const Vector3d center = draw->Point({-0.3, -0.4, 0.2}, {0.3, 0.4, 0.9});
    const double radius = draw->Uniform(0.05, 0.2);
    for (int x = 0; x < grid.size().x(); ++x) {
      for (int y = 0; y < grid.size().y(); ++y) {
        for (int z = 0; z < grid.size().z(); ++z) {
          const Vector3d p = grid.origin() + cell * Vector3d(x + 0.5, y + 0.5, z + 0.5);
          if ((p - center).norm() < radius) grid.Occupy(x, y, z);
        }
      }
    }
  }
  return grid;
}

// Node i + 1 within the first box of node i, and a solid box at the end.
BoxTree Chain(int levels) {
  BoxTree tree;
  for (int i = 0; i < levels; ++i) {
    BoxNode node;
    for (int c = 0; c < 4; ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        node.lower[axis][c] = c == 0 ? 2 : 1;
        node.upper[axis][c] = c == 0 ? 4 : 0;
      }
      node.child[c] = c > 0 ? BoxNode::kAbsent : i + 1 < levels ? i + 1 : BoxNode::kSolid;
    }
    tree.nodes.push_back(node);
  }
  return tree;
}

TEST(BoxTreeTest, SolidBoxesAreTheOccupiedCellsEachOnce) {
  SweptDraw draw(1);
  for (int trial = 0; trial < 5; ++trial) {
    const VoxelGrid grid = Lump(&draw);
    const BoxTree tree = BoxTree::Build(grid);
    EXPECT_TRUE(tree.IsSound());
    std::map<std::array<int, 3>, int> covered;
    for (const auto& box : tree.SolidBoxes()) {
      for (int x = box.lower.x(); x < box.upper.x(); ++x) {
        for (int y = box.lower.y(); y < box.upper.y(); ++y) {
          for (int z = box.lower.z(); z < box.upper.z(); ++z) ++covered[{x, y, z}];
        }
      }
    }
    size_t occupied = 0;
    for (int x = 0; x < grid.size().x(); ++x) {
      for (int y = 0; y < grid.size().y(); ++y) {
        for (int z = 0; z < grid.size().z(); ++z) {
          if (!grid.Occupied(x, y, z)) continue;
          ++occupied;
          EXPECT_EQ((covered[{x, y, z}]), 1);
        }
      }
    }
    EXPECT_EQ(covered.size(), occupied);
    EXPECT_LT(tree.SolidBoxes().size(), occupied);
  }
}

TEST(BoxTreeTest, BytesOfVolumesTooFarAwayToTellCellsApartAreRefused) {
  SweptDraw draw(2);
  const BoxTree near = BoxTree::Build(Lump(&draw));
  ASSERT_TRUE(ParseVolumes(VolumeBytes(near), 1, near.cell));
  for (const double far : {1e4, 1e280, std::numeric_limits<double>::quiet_NaN()}) {
    BoxTree moved = near;
    moved.origin.y() = far;
    EXPECT_FALSE(ParseVolumes(VolumeBytes(moved), 1, near.cell)) << far;
    moved = near;
    moved.parts[0].z() = -far;
    EXPECT_FALSE(ParseVolumes(VolumeBytes(moved), 1, near.cell)) << far;
  }
}

TEST(BoxTreeTest, BytesThatGoOnOrAreUnsoundAreRefused) {
  const BoxTree tree = Chain(3);
  EXPECT_TRUE(ParseVolumes(VolumeBytes(tree), 1, tree.cell));
  EXPECT_FALSE(ParseVolumes(VolumeBytes(tree) + '\0', 1, tree.cell));
  EXPECT_FALSE(ParseVolumes(VolumeBytes(Chain(86)), 1, tree.cell));
}

TEST(BoxTreeTest, HasOnePointForEachConnectedPart) {
  VoxelGrid grid({0, 0, 0}, {1, 1, 1}, 0.1);
  EXPECT_TRUE(BoxTree::Build(grid).nodes.empty());
  for (int x = 2; x < 6; ++x) grid.Occupy(x, 3, 3);
  for (int y = 3; y < 8; ++y) grid.Occupy(5, y, 3);
  EXPECT_EQ(BoxTree::Build(grid).parts.size(), 1u);
  grid.Occupy(8, 8, 8);
  const BoxTree tree = BoxTree::Build(grid);
  EXPECT_EQ(tree.parts.size(), 2u);
  for (const Vector3d& part : tree.parts) EXPECT_TRUE(tree.Contains(part));
}

// Whatever the bytes are: either they are told to be unsound, or walking them ends.
TEST(BoxTreeTest, DamagedNodesAreToldOrHarmless) {
  SweptDraw draw(2);
  const BoxTree tree = BoxTree::Build(Lump(&draw));
  int told = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    BoxTree damaged = tree;
    const size_t node = static_cast<size_t>(draw.Index(static_cast<int>(tree.nodes.size())));
    unsigned char bytes[sizeof(BoxNode)];
    std::memcpy(bytes, &damaged.nodes[node], sizeof bytes);
    bytes[draw.Index(sizeof(BoxNode))] ^= static_cast<unsigned char>(1 << draw.Index(8));
    std::memcpy(&damaged.nodes[node], bytes, sizeof bytes);
    if (!damaged.IsSound()) {
      ++told;
      continue;
    }
    (void)Meets(damaged, OrientedBox{.center = {0, 0, 0.5}, .half = {0.01, 5, 5}});
  }
  EXPECT_GT(told, 1000);
}

TEST(BoxTreeTest, ForgedTreesAreUnsound) {
  EXPECT_TRUE(Chain(85).IsSound());
  EXPECT_FALSE(Chain(86).IsSound()) << "deeper than a walk's stack";
  for (const bool upper : {false, true}) {
    BoxTree outside = Chain(3);
    (upper ? outside.nodes[2].upper : outside.nodes[2].lower)[1][0] = upper ? 5 : 1;
    EXPECT_FALSE(outside.IsSound()) << "leaves its parent";
  }
  BoxTree box = Chain(3);
  for (int axis = 0; axis < 3; ++axis) {
    box.nodes[1].lower[axis][3] = 2;
    box.nodes[1].upper[axis][3] = 3;
  }
  EXPECT_FALSE(box.IsSound()) << "a box where no child is";
}

ConvexBody BoxOf(const BoxTree& tree, const BoxTree::CellBox& cells, Vector3d* center) {
  const Vector3d lower = tree.Corner(cells.lower), upper = tree.Corner(cells.upper);
  *center = 0.5 * (lower + upper);
  return MakeBox(upper - lower);
}

// Distance of a posed body from the nearest of the solid boxes, from both sides.
ConvexDistance BruteForce(const BoxTree& tree, const ConvexBody& body, const Eigen::Isometry3d& X) {
  ConvexDistance nearest;
  nearest.lower = nearest.upper = 1e9;
  for (const auto& cells : tree.SolidBoxes()) {
    Vector3d center;
    const ConvexBody box = BoxOf(tree, cells, &center);
    const Eigen::Isometry3d X_BoxBody = Eigen::Translation3d(-center) * X;
    const ConvexDistance here =
        FindConvexDistance(box, body, X_BoxBody, -X_BoxBody.translation(), kConverge);
    nearest.lower = std::min(nearest.lower, here.lower);
    nearest.upper = std::min(nearest.upper, here.upper);
  }
  return nearest;
}

// Answers against brute force, apart by more than 0.1 mm or overlapping.
template <typename Ask>
void ExpectExact(unsigned seed, bool upright, double extra, const ConvexBody& body,
                 const Ask& ask) {
  SweptDraw draw(seed);
  const BoxTree tree = BoxTree::Build(Lump(&draw, 0.1));
  int met = 0, missed = 0;
  for (int trial = 0; trial < 70; ++trial) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() = draw.Turn(upright);
    X.translation() = draw.Point({-0.7, -0.7, 0.0}, {0.7, 0.7, 1.1});
    const bool meets = ask(tree, X);
    const ConvexDistance truth = BruteForce(tree, body, X);
    if (truth.lower > extra * std::sqrt(3.0) + 1e-4) {
      EXPECT_FALSE(meets) << "distance " << truth.lower << ", trial " << trial;
      ++missed;
    } else if (truth.upper <= extra) {
      EXPECT_TRUE(meets) << "distance " << truth.upper << ", trial " << trial;
      ++met;
    }
  }
  EXPECT_GT(met, 3);
  EXPECT_GT(missed, 3);
}

TEST(BoxTreeQueryTest, BoxesMeetExactlyWhatTheSolidBoxesMeet) {
  for (const bool upright : {true, false}) {
    for (const double extra : {0.0, 0.05}) {
      const Vector3d size(0.3, 0.1, 0.4);
      ExpectExact(3, upright, extra, MakeBox(size),
                  [&](const BoxTree& tree, const Eigen::Isometry3d& X) {
                    return Meets(tree, {X.translation(), 0.5 * size, X.linear()}, extra);
                  });
    }
  }
}

TEST(BoxTreeQueryTest, RoundBodiesMeetExactlyWhatTheSolidBoxesMeet) {
  const auto ask = [](const RoundBody& body) {
    return [body](const BoxTree& tree, const Eigen::Isometry3d& X) {
      return Meets(tree, body, X.translation(), X.linear());
    };
  };
  for (const bool upright : {true, false}) {
    ExpectExact(4, upright, 0, MakeSphere(0.15), ask({.ball_radius = 0.15}));
    ExpectExact(5, upright, 0, MakeCapsule(0.1, 0.4),
                ask({.half_length = 0.2, .ball_radius = 0.1}));
    ExpectExact(6, upright, 0, MakeCylinder(0.2, 0.3),
                ask({.half_length = 0.15, .disc_radius = 0.2}));
  }
}

TEST(BoxTreeQueryTest, TrianglesMeetExactlyWhatTheSolidBoxesMeet) {
  SweptDraw draw(7);
  TriangleMesh mesh;
  mesh.vertices.resize(3, 3);
  mesh.vertices.col(0) << 0.3, -0.1, 0.05;
  mesh.vertices.col(1) << -0.2, 0.2, -0.1;
  mesh.vertices.col(2) << -0.1, -0.3, 0.2;
  mesh.triangles = Eigen::Vector3i(0, 1, 2);
  ConvexBody body;
  body.vertices = mesh.vertices;
  BoundBySphere(&body);
  const TriangleTree triangles(mesh);
  for (const bool upright : {true, false}) {
    ExpectExact(8, upright, 0, body, [&](const BoxTree& tree, const Eigen::Isometry3d& X) {
      return Meets(tree, triangles, X.translation(), X.linear());
    });
  }
}

TEST(BoxTreeQueryTest, ContainmentEitherWayMeets) {
  SweptDraw draw(9);
  const BoxTree tree = BoxTree::Build(Lump(&draw));
  const auto largest = [](const auto& a, const auto& b) {
    return (a.upper - a.lower).minCoeff() < (b.upper - b.lower).minCoeff();
  };
  const auto boxes = tree.SolidBoxes();
  const auto& box = *std::max_element(boxes.begin(), boxes.end(), largest);
  const Vector3d inside = 0.5 * (tree.Corner(box.lower) + tree.Corner(box.upper));
  EXPECT_TRUE(Meets(tree, OrientedBox{.center = inside, .half = {1e-3, 1e-3, 1e-3}}));
  EXPECT_TRUE(Meets(tree, RoundBody{.ball_radius = 1e-3}, inside, Matrix3d::Identity()));
  EXPECT_TRUE(Meets(tree, OrientedBox{.center = inside, .half = {500, 500, 500}}));
  EXPECT_TRUE(Meets(tree, RoundBody{.ball_radius = 500}, inside, Matrix3d::Identity()));
  EXPECT_FALSE(Meets(tree, OrientedBox{.center = {0, 0, -3}, .half = {500, 500, 1}}));
}

// Each edge of the outer faces is run through as often one way as the other, cell by cell.
TEST(BoxTreeObjTest, SurfaceIsClosedAndEnclosesTheVolume) {
  SweptDraw draw(10);
  const BoxTree tree = BoxTree::Build(Lump(&draw, 0.1));
  std::istringstream text(BoxTreeObj(tree));
  std::vector<Vector3d> vertices;
  double volume = 0;
  std::string word;
  while (text >> word) {
    if (word == "v") {
      Vector3d v;
      text >> v.x() >> v.y() >> v.z();
      vertices.push_back(v);
    } else if (word == "f") {
      size_t k[4];
      for (size_t& i : k) text >> i;
      const auto at = [&](int i) { return vertices.at(k[i] - 1); };
      volume += at(0).dot(at(1).cross(at(2))) / 6 + at(0).dot(at(2).cross(at(3))) / 6;
    }
  }
  EXPECT_NEAR(volume, tree.Volume(), 1e-5);
}

}  // namespace
}  // namespace halfstep
