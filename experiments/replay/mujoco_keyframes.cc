#include "experiments/replay/mujoco_keyframes.h"

#include <Eigen/Geometry>

#include "experiments/replay/mujoco_geoms.h"
#include "experiments/replay/robot_physics.h"
#include "wpg/files/number_text.h"
#include "wpg/nth.h"

namespace halfstep::replay {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kOutOfSight = -1e4;  // height of obstacles that are not there [m]
constexpr std::string_view kEnd = "</mujoco>\n";

void AppendNumbers(const Eigen::Ref<const Eigen::VectorXd>& values, std::string* text) {
  for (const double value : values) *text += (text->empty() ? "" : " ") + ShortestText(value);
}

void AppendTurn(const Eigen::Matrix3d& R, std::string* text) {
  const Eigen::Quaterniond q(R);
  AppendNumbers(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()), text);
}

/// A joint of a leg: its side, and its number from the hip.
struct LegPlace {
  size_t side = 0;
  Eigen::Index joint = 0;
};

/// Writes the keys of one robot.
class KeyWriter {
 public:
  KeyWriter(const RobotModel& robot, const RobotTree& tree,
            const std::vector<SimulatedObstacle>& obstacles)
      : obstacles_(obstacles), leg_joints_(LegJointsInDepth(robot, tree, 0)) {
    // Nothing that moves lies between the root and the waist.
    X_WaistRoot_ = Nth(tree.urdf.LinkPoses(tree.posture), tree.waist).inverse();
  }

  std::string Key(const JointMotion& motion) const {
    const Isometry3d X_WB = motion.row.X_WB(), X_WRoot = X_WB * X_WaistRoot_;
    const Vector3d turn(0.0, 0.0, motion.waist_yaw_rate);
    const Vector3d arm = X_WRoot.translation() - X_WB.translation();
    std::string qpos, qvel, ctrl;
    AppendNumbers(X_WRoot.translation(), &qpos);
    AppendTurn(X_WRoot.linear(), &qpos);
    // Of the free joint: the origin's motion in W, turning in the root's axes.
    AppendNumbers(motion.waist_velocity + turn.cross(arm), &qvel);
    AppendNumbers(X_WRoot.linear().transpose() * turn, &qvel);
    for (const LegPlace& at : leg_joints_) {
      qpos += " " + ShortestText(motion.row.q[at.side][at.joint]);
      qvel += " " + ShortestText(motion.speeds[at.side][at.joint]);
    }
    for (const Vector6d& q : motion.row.q) AppendNumbers(q, &ctrl);
    const std::string t = ShortestText(motion.row.t);
    return "    <key" + Attribute("name", "t=" + t) + Attribute("time", t) +
           Attribute("qpos", qpos) + Attribute("qvel", qvel) + Attribute("ctrl", ctrl) +
           ObstacleAttributes(motion.row.t) + "/>\n";
  }

 private:
  // The order in which the model has its hinges: depth first from a link, children in their order.
  static std::vector<LegPlace> LegJointsInDepth(const RobotModel& robot, const RobotTree& tree,
                                                int link) {
    std::vector<LegPlace> places;
    for (size_t child = 0; child < tree.urdf.links.size(); ++child) {
      const int index = tree.urdf.links[child].joint;
      if (index < 0) continue;
      const UrdfJoint& joint = Nth(tree.urdf.joints, index);
      if (joint.parent != link) continue;
      for (size_t side = 0; side < 2; ++side) {
        for (size_t j = 0; j < 6; ++j) {
          if (robot.legs[side].joints[j].name != joint.name) continue;
          places.push_back({side, static_cast<Eigen::Index>(j)});
        }
      }
      const std::vector<LegPlace> below = LegJointsInDepth(robot, tree, static_cast<int>(child));
      places.insert(places.end(), below.begin(), below.end());
    }
    return places;
  }

  std::string ObstacleAttributes(double t) const {
    std::string places, turns;
    for (const SimulatedObstacle& obstacle : obstacles_) {
      const Isometry3d X =
          obstacle.pose(t).value_or(Isometry3d(Eigen::Translation3d(0.0, 0.0, kOutOfSight)));
      AppendNumbers(X.translation(), &places);
      AppendTurn(X.linear(), &turns);
    }
    return obstacles_.empty() ? "" : Attribute("mpos", places) + Attribute("mquat", turns);
  }

  const std::vector<SimulatedObstacle>& obstacles_;
  std::vector<LegPlace> leg_joints_;
  Isometry3d X_WaistRoot_;
};

}  // namespace

std::string MujocoKeyframes(const RobotModel& robot, const RobotTree& tree,
                            const SimulatedObstacles& world,
                            const std::vector<JointMotion>& motion) {
  const std::vector<SimulatedObstacle>& obstacles = world.obstacles;
  ModelOptions options = PhysicsOf(robot);
  options.floor.ground = world.ground;
  std::string text = MujocoModel(robot, tree, options, obstacles);
  text.resize(text.size() - kEnd.size());
  if (!obstacles.empty()) {
    text += "  <custom>\n";
    for (size_t i = 0; i < obstacles.size(); ++i) {
      text += "    <text" + Attribute("name", "obstacle_" + std::to_string(i)) +
              Attribute("data", obstacles[i].name) + "/>\n";
    }
    text += "  </custom>\n";
  }
  const KeyWriter writer(robot, tree, obstacles);
  text += "  <keyframe>\n";
  for (const JointMotion& point : motion) text += writer.Key(point);
  return text + "  </keyframe>\n" + std::string(kEnd);
}

}  // namespace halfstep::replay
