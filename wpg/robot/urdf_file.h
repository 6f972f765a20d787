#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <string_view>
#include <vector>

#include "wpg/files/input_file.h"
#include "wpg/robot/urdf_check.h"

namespace halfstep {

/// Collision geometry of a link, as the URDF states it.
struct UrdfCollision {
  /// What the shape is.
  enum class Kind { kBox, kSphere, kCylinder, kMesh };
  Kind kind = Kind::kBox;          ///< of this shape
  Eigen::Vector3d size{0, 0, 0};   ///< box: edges; sphere: radius; cylinder: radius, length [m].
  std::string mesh;                ///< file name as written.
  Eigen::Vector3d scale{1, 1, 1};  ///< of a mesh, along its axes
  /// Where the shape lies in the link's frame.
  Eigen::Isometry3d X_LinkShape = Eigen::Isometry3d::Identity();
  UrdfPlace place;  ///< for complaints
};

/// A link as the URDF states it.
struct UrdfLink {
  std::string name;                                   ///< unique in the file
  double mass = 0.0;                                  ///< [kg]
  Eigen::Vector3d com{0, 0, 0};                       ///< in the link frame [m].
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the CoM, link's axes [kg m²].
  int joint = -1;                                     ///< the joint that moves it; −1: root.
  std::vector<UrdfCollision> collisions;              ///< in file order
  UrdfPlace place;                                    ///< for complaints
};

/// Whether a mesh whose file's name ends like that is among a link's collision shapes.
bool HasMesh(const UrdfLink& link, std::string_view ending = "");

/// A joint as the URDF states it.
struct UrdfJoint {
  /// How it moves: not, by a turn within limits, or in another way.
  enum class Kind { kFixed, kRevolute, kOther };
  std::string name;                                                 ///< unique in the file
  Kind kind = Kind::kFixed;                                         ///< of this joint
  int parent = -1;                                                  ///< link index.
  int child = -1;                                                   ///< link index.
  Eigen::Isometry3d X_ParentChild = Eigen::Isometry3d::Identity();  ///< at angle 0.
  Eigen::Vector3d axis{1, 0, 0};                                    ///< unit, in the child's frame.
  double lower = 0.0;               ///< [rad], or [m] where it slides
  double upper = 0.0;               ///< the same
  bool turns_freely = false;        ///< continuous: limited to one turn for legs alone
  bool slides = false;              ///< prismatic, which is of kind kOther
  double max_speed = 0.0;           ///< [rad/s]
  double max_effort = 0.0;          ///< [N m]; 0: not told
  std::string mimics;               ///< the joint that it follows; "": none
  std::vector<std::string> faults;  ///< for which it can be no joint of a leg: complaints
  UrdfPlace place;                  ///< for complaints

  bool moves() const { return kind == Kind::kRevolute || slides; }  ///< by one number
};

/// A URDF's kinematic tree, masses and collision geometry as plain values. Links come after the
/// links that they hang on: links[0] is the root.
struct UrdfTree {
  std::string file;                   ///< its path, for complaints.
  std::string name;                   ///< of `<robot>`; may be ""
  InputFile source;                   ///< what was read.
  std::vector<UrdfLink> links;        ///< in file order
  std::vector<UrdfJoint> joints;      ///< in file order
  std::vector<std::string> warnings;  ///< what was repaired or left out (CheckUrdf)

  int FindLink(const std::string& name) const;  ///< index, −1: unknown.
  /// Turns the frame of a link by `R_OldNew`. Nothing moves: all that is stated in that frame is
  /// stated anew.
  void TurnFrame(int link, const Eigen::Matrix3d& R_OldNew);
  /// Poses of all links in the root's frame for joint positions by index [rad]; joints of kind
  /// kOther stay at 0.
  std::vector<Eigen::Isometry3d> LinkPoses(const std::vector<double>& q) const;
};

/// Reads and checks a URDF file. Throws InputError with every complaint (see CheckUrdf).
UrdfTree ReadUrdf(const std::string& path);
/// The same for a text; `path` stands for it in complaints.
UrdfTree ParseUrdf(const std::string& path, const std::string& text);

}  // namespace halfstep
