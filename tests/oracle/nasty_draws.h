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
  kMoving,            ///< obstacles that move by waypoints, or are known to some centimetres
  // Over levels.
  kStairs,     ///< up or down, step over step or both feet on each tread
  kPlatforms,  ///< up, along and down, of one height
  kStones,     ///< one for each footstep, higher and lower, over nothing or out of the floor
  kBlocks,     ///< side by side, a row for each foot
};
constexpr int kNumSceneKinds = 15;  ///< on the flat floor
constexpr int kNumLevelKinds = 4;   ///< after these
/// The kinds over levels, one after the other and again from the first.
inline SceneKind LevelKind(unsigned k) {
  return static_cast<SceneKind>(kNumSceneKinds + static_cast<int>(k) % kNumLevelKinds);
}
inline bool IsOverLevels(SceneKind kind) { return static_cast<int>(kind) >= kNumSceneKinds; }
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

/// A plan of one to three steps with random values of every family of parameters; one in five is
/// 900 m away with yaws of many turns. Half of the plans have a form a step or half-step, some of
/// them rest at junctions, or have footsteps that are moved.
WalkPlan DrawPlan(const PlainRobot& robot, Draw* draw);
/// A step towards a plan that is feasible: slower, forms nearer to the plain ones, less moved.
void Calm(WalkPlan* plan);
/// Largest overlap of junction i by smoothing/README.md, "Natural bounds" [s].
double NaturalBound(const WalkPlan& plan, size_t junction);

/// A walk over drawn levels of that kind, in its scene: heights in proportion to the robot's size
/// (1: rises to 15 cm). With obstacles, areas, or things that move, in half of the draws.
void DrawLevels(SceneKind kind, const PlainRobot& robot, Draw* draw, WalkPlan* plan,
                PlainScene* scene);
/// Calm, the waist a little lower, all heights of the ground a quarter less.
void CalmOverLevels(const PlainRobot& robot, WalkPlan* plan, PlainScene* scene);

/// `size` of the robot: PlainRobot::size.
PlainScene DrawNastyScene(SceneKind kind, const WalkPlan& plan, double size, Draw* draw);
/// One obstacle of a kind, somewhere about the feet; not kHugeMeshes, kFarVertices, kNested,
/// kNoStep.
PlainObstacle DrawObstacle(SceneKind kind, const ClosedFormWalk& walk, double size, Draw* draw);
/// A small area of the ground about the feet.
Polygon DrawArea(const ClosedFormWalk& walk, double size, Draw* draw);
/// Somewhere about the feet and legs of a walk, in W [m]; over levels from the lower foot up.
Eigen::Vector3d NearTheWay(const ClosedFormWalk& walk, double size, Draw* draw);
/// Waypoints that lead an obstacle past the walk, or not, and how well its place is known.
void AddMotion(const ClosedFormWalk& walk, double size, Draw* draw, PlainObstacle* obstacle);

}  // namespace halfstep::oracle
