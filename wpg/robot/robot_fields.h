#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wpg/files/fields.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {

struct RobotModel;

/// The foot of one leg.
struct LegFile {
  std::string foot_link;         ///< by its URDF name
  std::vector<double> sole_xyz;  ///< in the frame of the foot's link [m].
  std::vector<double> sole_rpy;  ///< [rad]; empty: zero.
};

/// A pair of links that is not checked for contact.
struct ExcludedPair {
  std::vector<std::string> links;  ///< two URDF names
  std::string why;                 ///< for people: why they cannot touch
};

/// A robot file as it is written: each value is valid by itself, and joint angles are in the file's
/// unit.
struct RobotFile {
  std::string name;                             ///< of the robot; default: the file's stem
  std::string urdf_path;                        ///< relative to the robot file
  std::optional<UrdfTree> urdf;                 ///< read as soon as its path is known.
  std::map<std::string, std::string> packages;  ///< ROS packages in mesh names → their folders
  /// "applied": DAE meshes are turned by their `up_axis`; "ignored": they are not.
  std::string dae_up_axis = "ignored";
  std::string waist_link;         ///< by its URDF name
  std::vector<double> waist_rpy;  ///< waist frame in that of its link [rad]; empty: the same.
  /// Above the floor while standing [m]; none: found from the posture.
  std::optional<double> com_height;
  std::optional<double> lift;                   ///< RobotModel::largest_lift [m]
  double support_point = 0.0;                   ///< RobotModel::support_point [m]
  std::array<LegFile, 2> legs;                  ///< by Index(Side)
  std::vector<double> sole_size;                ///< length and width [m]
  std::vector<double> posture_deg;              ///< by URDF joint index
  std::vector<std::vector<double>> limits_deg;  ///< by URDF joint index; empty: the URDF's
  /// By URDF joint index [N m]; 0: the URDF does not say, none: the file says so itself.
  std::vector<std::optional<double>> effort_limits;
  /// By URDF joint index [rad/s²]; none: the file states no limit.
  std::vector<std::optional<double>> acceleration_limits;
  std::vector<ExcludedPair> excluded;     ///< pairs that are not checked
  std::map<std::string, int> mesh_parts;  ///< link → convex parts of each of its meshes
  int hull_vertices = 64;                 ///< at most, of a mesh's hull, or of a part's
  std::vector<std::string> warnings;      ///< about what the file says and nothing needs
};

/// Declares the keys of a robot file (wpg/README.md, "Robots") and reads the URDF on the way, since
/// joints, links and packages are keys and choices. Throws InputError for a bad URDF.
void DeclareFields(Fields& fields, RobotFile* file);

/// The rotation by roll, pitch and yaw about fixed axes [rad]; the identity when there are none.
Eigen::Matrix3d RotationOf(const std::vector<double>& rpy);

/// A robot file's text and its URDF, in which the frame of the waist's link is the waist frame B.
/// `urdf`, unless it is null, is taken in place of the file that the text names. Throws InputError
/// for keys that are not valid by themselves.
RobotFile ReadRobotFile(const std::string& yaml_path, const std::string& text,
                        const UrdfTree* urdf = nullptr);
/// What of a robot is built.
enum class RobotParts {
  kAll,
  kLegs,  ///< without bodies and what is found from them: no mesh is read
};
/// The model of a robot file as it was read from that text. Throws InputError for keys that do not
/// go together.
RobotModel BuildRobot(const std::string& yaml_path, const std::string& text, RobotFile file,
                      RobotParts parts = RobotParts::kAll);

}  // namespace halfstep
