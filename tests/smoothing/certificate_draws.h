#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/scene/scene.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "tests/smoothing/test_walks.h"
#include "tests/wpg/generated_robots.h"
#include "tests/wpg/shipped_robots.h"
#include "wpg/geometry/foothold.h"
#include "wpg/motion/lipm.h"

namespace halfstep {

/// HRP-2, the three generated robots, and the other shipped ones.
inline std::vector<RobotModel> RobotsOfAllKinds() {
  std::vector<RobotModel> robots = {Hrp2()};
  for (const GeneratedRobot& robot : GeneratedRobots()) {
    robots.push_back(TemporaryRobot(robot).Load());
  }
  robots.push_back(ShippedRobot("wren"));
  robots.push_back(ShippedRobot("bison"));
  return robots;
}

/// The generated robots whose hip or ankle axes do not meet.
inline std::vector<RobotModel> RobotsWithOffsets() {
  std::vector<RobotModel> robots;
  for (const GeneratedRobot& robot : OffsetRobots()) {
    robots.push_back(TemporaryRobot(robot).Load());
  }
  return robots;
}

/// A shipped robot, or one with offset legs.
inline RobotModel RobotNamed(const std::string& name) {
  for (const GeneratedRobot& robot : OffsetRobots()) {
    if (robot.name == name) return TemporaryRobot(robot).Load();
  }
  return ShippedRobot(name);
}

/// How varied random walks of a robot are.
struct WalkVariety {
  double stride = 1.0;  ///< how far the feet go, about 1: to the ends of a robot's reach
  double shortest = 0.8, longest = 2.5;  ///< half-step durations [s]
  double lowest = 0.03, highest = 0.25;  ///< of HRP-2's via points [m]
};

/// A random plan of `steps` steps, scaled to a robot's legs, anywhere on the floor.
inline HalfStepSequence DrawSequence(const RobotModel& robot, int steps, const WalkVariety& variety,
                                     WalkDraw* draw) {
  const double hips = robot.waist_height + robot.legs[0].hip_B.z();
  const double size = hips / 0.65, width = robot.standing_width;
  std::array<Foothold, 2> feet = {Foothold::Level({0, 0.5 * width, 0}),
                                  Foothold::Level({0, -0.5 * width, 0})};
  const std::array<Foothold, 2> start = feet;
  Side side = draw->Uniform(0, 1) < 0.5 ? Side::kLeft : Side::kRight;
  std::vector<Footstep> footsteps;
  for (int i = 0; i < steps; ++i, side = Opposite(side)) {
    const double x = variety.stride * size * draw->Uniform(-0.15, 0.25);
    const double y = Sign(side) * (width + variety.stride * size * draw->Uniform(-0.02, 0.08));
    const double yaw = variety.stride * draw->Uniform(-0.3, 0.3);
    Foothold& foot = feet[static_cast<size_t>(Index(side))];
    foot = feet[static_cast<size_t>(Index(Opposite(side)))] * Foothold::Level({x, y, yaw});
    const double height = size * draw->Uniform(variety.lowest, variety.highest);
    footsteps.push_back({.side = side,
                         .X_WF = foot,
                         .via_height = height,
                         .duration = draw->Uniform(variety.shortest, variety.longest)});
  }
  const double shift = draw->Uniform(0.03, 0.2), delay = draw->Uniform(0.02, 0.2);
  const HalfStepShape shape{.shift = shift, .foot_delay = delay};
  const double via_lateral = width * draw->Uniform(1.05, 1.25);
  return Moved(draw->Pose(2.0, 3.0), MakeSequence(start, footsteps, via_lateral, shape,
                                                  std::make_shared<Lipm>(robot.com_height)));
}

enum class SceneKind { kCylinders, kClutter, kFence };

/// Obstacles of one kind around a walk's feet and legs: upright and lying cylinders of 1 to 3 cm,
/// boxes at all heights, thin upright plates (0.1 mm to 2 cm) across; all times `size`.
inline Scene DrawScene(const SuperposedWalk& walk, SceneKind kind, int count, WalkDraw* draw,
                       double size = 1.0) {
  Scene scene;
  scene.name = "drawn";
  for (int i = 0; i < count; ++i) {
    const WalkState x = walk.At(draw->Uniform(0.0, walk.duration())).value;
    const Side side = draw->Uniform(0, 1) < 0.5 ? Side::kLeft : Side::kRight;
    const Pose2 X_WF = FootPose(x, side);
    const double r = size * draw->Uniform(0.0, 0.3), direction = draw->Uniform(-3.14, 3.14);
    const Pose2 X_FO{r * std::cos(direction), r * std::sin(direction), draw->Uniform(-3.14, 3.14)};
    Obstacle obstacle{.name = "o" + std::to_string(i), .shape = Sphere{0.01}};
    double z = 0.0;
    switch (kind) {
      case SceneKind::kCylinders: {
        const double height = size * draw->Uniform(0.01, 0.1);
        obstacle.shape = Cylinder{size * draw->Uniform(0.01, 0.03), height};
        z = 0.5 * height;
        break;
      }
      case SceneKind::kClutter:
        obstacle.shape = MakeBox({size * draw->Uniform(0.02, 0.3), size * draw->Uniform(0.02, 0.3),
                                  size * draw->Uniform(0.02, 0.3)});
        z = size * draw->Uniform(0.0, 0.7);
        break;
      case SceneKind::kFence: {
        const double thickness = size * 1e-4 * std::pow(200.0, draw->Uniform(0, 1));
        const double height = size * draw->Uniform(0.02, 0.12);
        obstacle.shape = Box{{thickness, size * draw->Uniform(0.05, 0.6), height}};
        z = 0.5 * height + (draw->Uniform(0, 1) < 0.3 ? size * draw->Uniform(0.0, 0.3) : 0.0);
        break;
      }
    }
    obstacle.X_WO = ToIsometry(X_WF * X_FO, z);
    if (kind == SceneKind::kClutter) {
      obstacle.X_WO.rotate(Eigen::AngleAxisd(draw->Uniform(-0.5, 0.5), Eigen::Vector3d::UnitX()));
    }
    scene.obstacles.push_back(std::move(obstacle));
  }
  return scene;
}

/// A walk among obstacles.
struct WalkNearLimit {
  Scene scene;
  HalfStepSequence sequence;
  HomotopyParameters parameters;
};

/// A random walk of 2 to 6 half-steps that, sampled every 5 ms, keeps every margin `spare` × its
/// scale beyond what `limits` demand, and hardly more: it is as far along a random way from the
/// planned motion as that allows. None when the drawn plan itself does not keep them, or when no
/// margin stops the way. The way leads along overlaps alone, or along `all` families of homotopy
/// parameters, footsteps included.
inline std::optional<WalkNearLimit> DrawNearLimit(const RobotModel& robot, SceneKind kind,
                                                  MarginLimits limits, double spare, WalkDraw* draw,
                                                  bool all = false) {
  for (MarginFamily family : AllMarginFamilies()) {
    limits.demanded_of(family) += spare * Scale(family);
  }
  const auto feasible = [&](const Scene& scene, const SuperposedWalk& walk, double period) {
    const MarginEvaluator evaluator(robot, scene, limits);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    return SampledFeasibility(evaluator, period).Check(walk, {0.0, walk.duration()}, &scratch);
  };
  const int steps = 1 + static_cast<int>(draw->Uniform(0, 3));
  const WalkVariety variety{
      .stride = 0.7, .shortest = 1.2, .longest = 2.2, .lowest = 0.05, .highest = 0.2};
  WalkNearLimit drawn{
      .scene = {}, .sequence = DrawSequence(robot, steps, variety, draw), .parameters = {}};
  const HalfStepSequence& sequence = drawn.sequence;
  const SuperposedWalk planned(sequence, PlannedMotion(sequence));
  if (feasible({}, planned, 0.02).verdict != Verdict::kFeasible) return std::nullopt;

  const HomotopyParameters plan = PlannedMotion(sequence);
  HomotopyParameters farthest = all ? draw->Parameters(sequence, 0.0, 0.0) : plan;
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    farthest.overlaps[static_cast<size_t>(i)] =
        draw->Uniform(0.4, 1.0) * NaturalOverlapBound(farthest, i);
  }
  drawn.scene = DrawScene(SuperposedWalk(sequence, farthest), kind, 12, draw, LegScale(robot));
  for (;;) {  // without the obstacles that stand in the planned way
    const Feasibility answer = feasible(drawn.scene, planned, 0.02);
    if (answer.verdict == Verdict::kFeasible) break;
    if (answer.witness.family != MarginFamily::kClearance) return std::nullopt;
    auto& obstacles = drawn.scene.obstacles;
    obstacles.erase(obstacles.begin() + answer.witness.other);
  }
  double low = 0.0, high = 1.0;
  const auto at = [&](double lambda) {
    drawn.parameters = farthest;
    for (double& overlap : drawn.parameters.overlaps) overlap *= lambda;
    for (const HomotopyParameter& parameter : AllParameters(sequence)) {
      if (!all || parameter.family == ParameterFamily::kOverlap) continue;
      const double from = parameter.in(plan);
      parameter.in(drawn.parameters) = from + lambda * (parameter.in(farthest)-from);
    }
    if (all) ClampOverlaps(plan, &drawn.parameters);
    const SuperposedWalk walk(sequence, drawn.parameters);
    return feasible(drawn.scene, walk, 0.005).verdict == Verdict::kFeasible;
  };
  if (at(1.0)) return std::nullopt;
  while (high - low > 1e-4) {
    const double middle = 0.5 * (low + high);
    (at(middle) ? low : high) = middle;
  }
  if (!at(low)) return std::nullopt;
  return drawn;
}

}  // namespace halfstep
