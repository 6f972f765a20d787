#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/survey/found_legs.h"
#include "experiments/survey/found_soles.h"
#include "experiments/survey/standing.h"
#include "wpg/robot/robot_fields.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// A robot file in the making: what was found of a URDF, and why.
struct RobotDraft {
  std::string name;                             ///< of the robot
  std::filesystem::path path;                   ///< of the robot file, which need not be there
  std::filesystem::path urdf_path;              ///< of the robot, as the user gave it
  std::map<std::string, std::string> packages;  ///< given by the user: name → folder
  UrdfTree urdf;                                ///< with the waist frame in its link
  bool dae_up_axis = false;  ///< whether DAE meshes are turned by their `up_axis`
  FoundLegs legs;            ///< waist, feet and joints
  /// Turns the waist frame B into that of its link; z up.
  Eigen::Matrix3d R_LinkB = Eigen::Matrix3d::Identity();
  std::array<FoundSole, 2> soles;  ///< by Index(Side)
  int hull_vertices = 64;          ///< of a mesh's hull, at most
  double excess = 0.0;             ///< of a body over its mesh's hull with the default of these [m]
  std::map<std::string, int> mesh_parts;         ///< link → convex parts of its meshes
  std::map<std::string, std::string> why_parts;  ///< why it is cut, by the same links
  StandingRequest standing;                      ///< the posture from which the half-steps are made
  std::string why_bend;                          ///< why the knees are bent so little; "": as usual
  std::string why_width;                         ///< why the stance is so wide
  std::optional<double> lift;                    ///< RobotModel::largest_lift [m]
  std::string why_lift;                          ///< why there is one
  double support_point = 0.0;                    ///< RobotModel::support_point [m]
  std::string why_support;                       ///< why it is not 0
  std::vector<double> posture;                   ///< by URDF joint index [rad]
  std::vector<ExcludedPair> excluded;      ///< pairs that are not checked for contact, and why
  std::map<int, std::string> why_posture;  ///< of joints outside the legs, by URDF joint index
};

/// The draft as a robot file, each number with its reason as a comment; of what is not found yet, a
/// comment that says so.
std::string YamlOf(const RobotDraft& draft);

/// The same of a draft that was refused: its first line says so, and each complaint stands at the
/// line that it is about, or else at the end.
std::string RefusedYamlOf(const RobotDraft& draft, const std::vector<std::string>& complaints);

/// The model of that file. Throws InputError where the draft is no robot; complaints are of the
/// file's lines.
RobotModel ModelOf(const RobotDraft& draft, RobotParts parts = RobotParts::kAll);

}  // namespace halfstep
