// Scans of rooms: very many open patches, of which few are asked for, with the same answers.

#include "planner/collision/open_patches.h"

#include <gtest/gtest.h>

#include <random>

#include "planner/collision/mesh_interior.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

double Between(double lower, double upper, std::mt19937* random) {
  return std::uniform_real_distribution<double>(lower, upper)(*random);
}

// A square of two triangles with corners of its own, at `at`, along u and v, turned either way.
TriangleMesh Square(const Vector3d& at, const Vector3d& u, const Vector3d& v, bool turned) {
  TriangleMesh mesh{Eigen::Matrix3Xd(3, 4), Eigen::Matrix3Xi(3, 2)};
  mesh.vertices << at, at + u, at + u + v, at + v;
  mesh.triangles << 0, 0, 1, 2, 2, 3;
  if (turned) mesh.triangles.row(1).swap(mesh.triangles.row(2));
  return mesh;
}

// Walls of a corridor of 8 × 2 × 2.6 m as a scanner leaves them: loose pieces with gaps, of a
// thousandth noise. `cover`: area of the pieces over that of the walls.
std::vector<TriangleMesh> Corridor(double cover, bool turned_at_will, std::mt19937* random) {
  std::vector<TriangleMesh> pieces;
  const int count = static_cast<int>(cover * 2 * 8 * 2.6 / 0.01);
  for (int i = 0; i < count; ++i) {
    const double side = i % 2 == 0 ? -1.0 : 1.0;
    const Vector3d at(Between(-4, 4, random), side + Between(-1e-3, 1e-3, random),
                      Between(0, 2.5, random));
    const bool turned = turned_at_will ? i % 3 == 0 : side > 0;
    pieces.push_back(Square(at, {0.1, 0, 0}, {0, 0, 0.1}, turned));
  }
  return pieces;
}

TEST(OpenPatches, AnswersAreThoseOfAllWindingsOneByOne) {
  std::mt19937 random(1);
  int inside = 0, outside = 0;
  for (const double cover : {0.1, 0.4, 0.8, 1.2, 2.0}) {
    for (const bool turned_at_will : {false, true}) {
      const OpenPatches patches(Corridor(cover, turned_at_will, &random));
      for (int i = 0; i < 40; ++i) {
        const Vector3d p(Between(-5, 5, &random), Between(-1.3, 1.3, &random),
                         Between(-0.3, 3, &random));
        const bool contained = patches.Contain(p);
        ASSERT_EQ(contained, patches.ContainOneByOne(p)) << cover << ": " << p.transpose();
        ++(contained ? inside : outside);
      }
    }
  }
  EXPECT_GT(inside, 50);
  EXPECT_GT(outside, 50);
}

// Pieces of boxes, deep and shallow: a patch by itself may wind more than a half.
TEST(OpenPatches, AnswersAreThoseOfAllWindingsForOpenBoxes) {
  std::mt19937 random(2);
  int inside = 0;
  for (int k = 0; k < 30; ++k) {
    std::vector<TriangleMesh> boxes;
    for (int i = 0; i < 8; ++i) {
      TriangleMesh box =
          FacesOf(MakeBox({Between(0.1, 1, &random), Between(0.1, 1, &random), 0.5}));
      box.vertices.colwise() +=
          Vector3d(Between(-1, 1, &random), Between(-1, 1, &random), Between(-1, 1, &random));
      box.triangles.conservativeResize(3, box.triangles.cols() - 1 - i % 4);
      if (i % 2 == 0) box.triangles.row(1).swap(box.triangles.row(2));
      boxes.push_back(std::move(box));
    }
    const OpenPatches patches(std::move(boxes));
    for (int i = 0; i < 40; ++i) {
      const Vector3d p(Between(-1.5, 1.5, &random), Between(-1.5, 1.5, &random),
                       Between(-1.5, 1.5, &random));
      const bool contained = patches.Contain(p);
      ASSERT_EQ(contained, patches.ContainOneByOne(p)) << k << ": " << p.transpose();
      inside += contained ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 30);
}

// What kept runs from ending: a scanned room covers more than half of all directions, so bounds of
// single patches never added up to less than a half, and every patch was asked for.
TEST(OpenPatches, FewAreAskedForInTheMiddleOfAScannedRoom) {
  std::mt19937 random(3);
  const OpenPatches patches(Corridor(0.8, /*turned_at_will=*/true, &random));
  long asked = 0;
  for (int i = 0; i < 100; ++i) {
    int here = 0;
    const Vector3d p(Between(-3, 3, &random), Between(-0.5, 0.5, &random),
                     Between(0.3, 2, &random));
    patches.Contain(p, &here);
    asked += here;
  }
  EXPECT_LT(asked, 100 * 150) << "of " << Corridor(0.8, true, &random).size() << " each";
}

TEST(OpenPatches, OfNoneNothingIsInside) {
  EXPECT_FALSE(OpenPatches().Contain({0, 0, 0}));
  EXPECT_FALSE(OpenPatches(std::vector<TriangleMesh>()).Contain({0, 0, 0}));
}

}  // namespace
}  // namespace halfstep
