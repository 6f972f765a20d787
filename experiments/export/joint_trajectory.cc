#include "experiments/export/joint_trajectory.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/export/message_float.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

std::string FloatList(const std::vector<double>& by_joint, const std::vector<int>& joints) {
  std::string text = "[";
  for (const int joint : joints) {
    text += (text.size() == 1 ? "" : ", ") + MessageFloat(Nth(by_joint, joint));
  }
  return text + "]";
}

std::string DurationText(double t) {
  const long nanoseconds = std::lround(t * 1e9);
  return "{sec: " + std::to_string(nanoseconds / 1000000000) +
         ", nanosec: " + std::to_string(nanoseconds % 1000000000) + "}";
}

}  // namespace

std::string JointTrajectoryYaml(const RobotModel& robot, const RobotTree& tree,
                                const std::vector<int>& joints,
                                const std::vector<JointMotion>& motion) {
  RobotTree still = tree;  // joints outside the legs have no speeds
  still.posture.assign(tree.posture.size(), 0.0);
  std::string text = "header:\n  stamp: {sec: 0, nanosec: 0}\n  frame_id: \"\"\njoint_names:\n";
  for (const int joint : joints) {
    // A text of JSON is one of YAML.
    const nlohmann::json name = Nth(tree.urdf.joints, joint).name;
    text += "- " + name.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  }
  text += "points:\n";
  for (const JointMotion& point : motion) {
    text +=
        "- positions: " + FloatList(JointAngles(robot, tree, point.row.q), joints) +
        "\n  velocities: " + FloatList(JointAngles(robot, still, point.speeds), joints) +
        "\n  accelerations: " + FloatList(JointAngles(robot, still, point.accelerations), joints) +
        "\n  effort: []\n  time_from_start: " + DurationText(point.row.t) + "\n";
  }
  return text;
}

}  // namespace halfstep
