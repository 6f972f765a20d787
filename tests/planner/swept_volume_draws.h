#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "planner/swept/swept_volume.h"
#include "planner/swept/swept_volume_bake.h"
#include "planner/swept/swept_volume_query.h"
#include "tests/places.h"
#include "wpg/motion/half_step_tracks.h"
#include "wpg/motion/lipm.h"
#include "wpg/motion/posture.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

inline const RobotModel& SweptRobot() {
  static const RobotModel robot = LoadRobot(InSources("wpg/robots/hrp2.yaml"));
  return robot;
}
inline Lipm LipmOf(const RobotModel& robot) { return Lipm(robot.com_height); }

/// A few elements of HRP-2, to the front, aside, behind and turned.
inline StepSet FewHalfSteps() {
  StepSet set;
  set.prototype.duration = 1.6;
  set.placements = {Foothold::Level({0.2, -0.2, 0.25}), Foothold::Level({-0.15, -0.25, 0.0}),
                    Foothold::Level({0.05, -0.3, -0.25})};
  return set;
}
/// Coarse, so that tests are quick; sound all the same.
inline SweptVolumeOptions CoarseOptions() { return {.cell = 0.03, .displacement = 0.01}; }
inline const SweptVolumes& CoarseVolumes() {
  static const SweptVolumes volumes = *BakeSweptVolumes(
      SweptRobot(), LipmOf(SweptRobot()), FewHalfSteps(), CoarseOptions(), {.threads = 1});
  return volumes;
}

class SweptDraw {
 public:
  explicit SweptDraw(unsigned long seed) : random_(seed) {}
  double Uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random_);
  }
  int Index(int size) { return std::uniform_int_distribution<int>(0, size - 1)(random_); }
  Side AnySide() { return Index(2) == 0 ? Side::kLeft : Side::kRight; }
  Eigen::Vector3d Direction() {
    while (true) {
      const double x = Uniform(-1, 1), y = Uniform(-1, 1), z = Uniform(-1, 1);
      const Eigen::Vector3d v(x, y, z);
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }
  Eigen::Vector3d Point(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
    const double x = Uniform(lower.x(), upper.x()), y = Uniform(lower.y(), upper.y());
    return {x, y, Uniform(lower.z(), upper.z())};
  }
  Eigen::Matrix3d Turn(bool upright) {
    const Eigen::Vector3d axis = upright ? Eigen::Vector3d(0, 0, 1) : Direction();
    return Eigen::AngleAxisd(Uniform(-std::numbers::pi, std::numbers::pi), axis).toRotationMatrix();
  }
  Pose2 Floor(double reach) {
    const double x = Uniform(-reach, reach), y = Uniform(-reach, reach);
    return {x, y, Uniform(-std::numbers::pi, std::numbers::pi)};
  }
  /// A point on the surface of a body where a random direction is farthest, its vertices and what
  /// lies between them, in the body's link frame.
  Eigen::Vector3d SurfacePoint(const ConvexBody& body) {
    Eigen::Vector3d point = SupportPoint(body, Direction());
    if (!body.triangles.empty() && Index(2) == 0) {
      const Eigen::Vector3i& t =
          body.triangles[static_cast<size_t>(Index(static_cast<int>(body.triangles.size())))];
      double u = Uniform(0, 1), v = Uniform(0, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      point = (1 - u - v) * body.vertices.col(t[0]) + u * body.vertices.col(t[1]) +
              v * body.vertices.col(t[2]);
    }
    return point;
  }

 private:
  std::mt19937_64 random_;
};

/// A random point of the robot's bodies at a random time of a half-step, in S.
struct BodyPoint {
  size_t body = 0;
  double tau = 0.0;
  Eigen::Vector3d p_S{0, 0, 0};
};
inline BodyPoint DrawBodyPoint(const RobotModel& robot, const HalfStep& half_step,
                               const HalfStepTracks& tracks, SweptDraw* draw) {
  BodyPoint point;
  point.tau = draw->Uniform(0, half_step.duration);
  point.body = static_cast<size_t>(draw->Index(static_cast<int>(robot.bodies.size())));
  const RobotBody& body = robot.bodies[point.body];
  const Posture posture = SolvePosture(robot, tracks.At(point.tau).value);
  point.p_S = posture.OfBody(body) * draw->SurfacePoint(body.shape);
  return point;
}

/// The tree's cells, less those that have a free neighbour.
inline BoxTree Eroded(const BoxTree& tree) {
  const Eigen::Vector3d middle = Eigen::Vector3d::Constant(0.5 * tree.cell);
  VoxelGrid full(tree.Lower() + middle, tree.Upper() - middle, tree.cell);
  const Eigen::Vector3i shift =
      ((tree.origin - full.origin()) / tree.cell).array().round().matrix().cast<int>();
  for (const auto& box : tree.SolidBoxes()) {
    for (int x = box.lower.x(); x < box.upper.x(); ++x) {
      for (int y = box.lower.y(); y < box.upper.y(); ++y) {
        for (int z = box.lower.z(); z < box.upper.z(); ++z) {
          full.Occupy(x + shift.x(), y + shift.y(), z + shift.z());
        }
      }
    }
  }
  VoxelGrid less(tree.Lower() + middle, tree.Upper() - middle, tree.cell);
  const Eigen::Vector3i size = full.size();
  for (int x = 1; x + 1 < size.x(); ++x) {
    for (int y = 1; y + 1 < size.y(); ++y) {
      for (int z = 1; z + 1 < size.z(); ++z) {
        if (full.Occupied(x, y, z) && full.Occupied(x - 1, y, z) && full.Occupied(x + 1, y, z) &&
            full.Occupied(x, y - 1, z) && full.Occupied(x, y + 1, z) &&
            full.Occupied(x, y, z - 1) && full.Occupied(x, y, z + 1)) {
          less.Occupy(x, y, z);
        }
      }
    }
  }
  return BoxTree::Build(less);
}

/// Whether the legs reach and keep their joint limits at 60 instants: a sampled stand-in for the
/// certificate of robot-only margins, of which smoothing knows.
inline bool SeemsWalkable(const RobotModel& robot, const HalfStep& half_step) {
  const HalfStepTracks tracks(half_step, LipmOf(robot));
  for (int k = 0; k < 60; ++k) {
    const double tau = half_step.duration * k / 59;
    const Posture posture = SolvePosture(robot, tracks.At(tau).value);
    if (!posture.reachable) return false;
    for (size_t s = 0; s < 2; ++s) {
      for (size_t j = 0; j < 6; ++j) {
        const double q = posture.ik[s].q[static_cast<Eigen::Index>(j)];
        if (q < robot.legs[s].joints[j].lower || q > robot.legs[s].joints[j].upper) return false;
      }
    }
  }
  return true;
}
/// Elements of the published grid that seem walkable and whose soles do not overlap.
inline StepSet WalkableSet(const RobotModel& robot) {
  return MakeStepSet(StepGrid{}, HalfStep{}, [&](const HalfStep& half_step) {
    return std::abs(half_step.X_SF.y) > 1.1 * robot.sole_size.y() &&
           SeemsWalkable(robot, half_step);
  });
}

/// `count` upright or tilted boxes in a room of 2·reach, half of those on the floor.
inline Scene DrawBoxes(int count, double reach, bool upright, SweptDraw* draw) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d size = draw->Point({0.05, 0.05, 0.05}, {0.4, 0.4, 1.0});
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.linear() = draw->Turn(upright);
    X_WO.translation() = draw->Point({-reach, -reach, 0}, {reach, reach, 0});
    X_WO.translation().z() = 0.5 * size.z() + (upright ? 0.0 : draw->Uniform(0, 0.5));
    scene.obstacles.push_back({"box " + std::to_string(i), Box{size}, X_WO});
  }
  return scene;
}

}  // namespace halfstep
