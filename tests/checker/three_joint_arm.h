#pragma once

#include <string>

#include "experiments/checker/jointed_robot.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep::checker {

/// An arm of three joints on a base: shoulder about z, elbow and wrist about y, links of 0.4, 0.3
/// and 0.1 m.
inline std::string ArmText() {
  const auto link = [](const std::string& name, const std::string& shape, double x) {
    return "<link name='" + name + "'><collision><origin xyz='" + std::to_string(x) +
           " 0 0'/><geometry>" + shape + "</geometry></collision></link>";
  };
  const auto joint = [](const std::string& name, const std::string& from, const std::string& to,
                        double x, const std::string& axis) {
    return "<joint name='" + name + "' type='revolute'><parent link='" + from + "'/><child link='" +
           to + "'/><origin xyz='" + std::to_string(x) + " 0 0'/><axis xyz='" + axis +
           "'/><limit lower='-2.5' upper='2.5' velocity='3' effort='10'/></joint>";
  };
  return "<robot name='arm'>" + link("base", "<box size='0.1 0.1 0.1'/>", 0) +
         link("upper", "<box size='0.36 0.04 0.04'/>", 0.2) +
         link("fore", "<cylinder radius='0.02' length='0.04'/>", 0.15) +
         link("hand", "<sphere radius='0.04'/>", 0.1) +
         joint("shoulder", "base", "upper", 0.1, "0 0 1") +
         joint("elbow", "upper", "fore", 0.4, "0 1 0") +
         joint("wrist", "fore", "hand", 0.3, "0 1 0") + "</robot>";
}

inline JointedRobot Arm() { return {ParseUrdf("arm.urdf", ArmText()), {}}; }

/// Knots of the arm's joints: t, shoulder, elbow, wrist.
inline Trajectory ArmTrajectory(const std::vector<std::array<double, 4>>& knots) {
  Trajectory trajectory;
  trajectory.file = "arm.csv";
  trajectory.joints = {"shoulder", "elbow", "wrist"};
  trajectory.q.resize(3, std::ssize(knots));
  for (size_t k = 0; k < knots.size(); ++k) {
    trajectory.times.push_back(knots[k][0]);
    for (int j = 0; j < 3; ++j) {
      trajectory.q(j, static_cast<Eigen::Index>(k)) = knots[k][static_cast<size_t>(j + 1)];
    }
  }
  return trajectory;
}

}  // namespace halfstep::checker
