#pragma once

#include <array>
#include <random>
#include <string>

#include "tests/oracle/closed_form_walk.h"
#include "tests/oracle/plain_robot.h"
#include "tests/oracle/plain_scene.h"

namespace halfstep::oracle {

/// What stands in the way.
enum class SceneKind : int {
  kThinPlates,   ///< 0.01 to 1 mm
  kNeedles,      ///< 0.1 to 1 mm thick
  kTinySpheres,  ///< of about 1 mm
  kPrimitives,
  kClosedMeshes,
  kOpenMeshes,
  kFlippedMeshes,     ///< all triangles or some turn inwards
  kDoubledMeshes,     ///< every triangle twice, both ways round or the same
  kDegenerateMeshes,  ///< with triangles without area, repeated and unused points
  kHugeMeshes,        ///< triangles of 100 m to 100 km
  kFarVertices,       ///< plates, with points 1 km to 1e15 m away
  kNested,            ///< solids in solids, rooms and shells around the robot
  kNoStep,            ///< areas of the floor
  kClouds,            ///< points with balls of some centimetres
};
constexpr int kNumSceneKinds = 14;
const char* NameOf(SceneKind kind);

/// Random numbers, reproducible from the seed.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double Logarithmic(double low, double high);
  int Below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  bool Chance(double probability) { return Uniform(0, 1) < probability; }
  Eigen::Vector3d Vector(double low, double high) {
    const double x = Uniform(low, high), y = Uniform(low, high);
    return {x, y, Uniform(low, high)};
  }

 private:
  std::mt19937 random_;
};

/// A plan of one to three steps with random overlaps (up to `fullness` of their natural bounds),
/// heights and durations; one in five is 900 m away with yaws of many turns.
WalkPlan DrawPlan(const PlainRobot& robot, Draw* draw);
/// Largest overlap of junction i by smoothing/README.md, "Natural bounds" [s].
double NaturalBound(const WalkPlan& plan, size_t junction);

PlainScene DrawNastyScene(SceneKind kind, const WalkPlan& plan, Draw* draw);

}  // namespace halfstep::oracle
