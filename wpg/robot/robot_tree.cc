#include "wpg/robot/robot_tree.h"

#include <algorithm>
#include <utility>

#include "wpg/files/number_text.h"
#include "wpg/files/yaml_fields.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_fields.h"

namespace halfstep {

WholeRobot LoadWholeRobot(const std::string& yaml_path) {
  const std::string text = ReadYamlFile(yaml_path);
  RobotFile file = ReadRobotFile(yaml_path, text);
  RobotModel model = BuildRobot(yaml_path, text, file);
  RobotTree tree{std::move(*file.urdf), -1, {}, {}};
  tree.waist = tree.urdf.FindLink(file.waist_link);
  for (size_t side = 0; side < 2; ++side) {
    tree.feet[side] = tree.urdf.FindLink(file.legs[side].foot_link);
  }
  for (const double degrees : file.posture_deg) tree.posture.push_back(DegreesToRadians(degrees));
  return {std::move(model), std::move(tree)};
}

std::vector<double> JointAngles(const RobotModel& robot, const RobotTree& tree,
                                const std::array<Vector6d, 2>& q) {
  std::vector<double> angles = tree.posture;
  for (size_t i = 0; i < angles.size(); ++i) {
    for (size_t leg = 0; leg < 2; ++leg) {
      for (size_t j = 0; j < 6; ++j) {
        if (robot.legs[leg].joints[j].name != tree.urdf.joints[i].name) continue;
        angles[i] = q[leg][static_cast<Eigen::Index>(j)];
      }
    }
  }
  return angles;
}

std::vector<int> JointsInFileOrder(const UrdfTree& urdf) {
  std::vector<int> joints;
  for (size_t i = 0; i < urdf.joints.size(); ++i) {
    if (urdf.joints[i].kind == UrdfJoint::Kind::kRevolute) joints.push_back(static_cast<int>(i));
  }
  const auto place = [&](int joint) {
    const UrdfPlace& at = Nth(urdf.joints, joint).place;
    return std::pair(at.line, at.column);
  };
  std::sort(joints.begin(), joints.end(), [&](int a, int b) { return place(a) < place(b); });
  return joints;
}

}  // namespace halfstep
