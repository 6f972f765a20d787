#pragma once

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace halfstep::oracle {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// A robot read by the oracle's own few lines from its YAML file, URDF and OBJ meshes. They read
/// what HRP-2's files hold and no more: no rpy, mesh bodies only. Anything else throws
/// std::runtime_error.
struct PlainRobot {
  /// Of what no file limits.
  static constexpr double kUnknown = std::numeric_limits<double>::infinity();
  struct Joint {
    std::string name, child, parent;
    bool turns = false;
    Eigen::Vector3d xyz{0, 0, 0}, axis{0, 0, 1};
    double lower = 0, upper = 0, speed = 0;  ///< [rad], [rad/s]
    double standing = 0;                     ///< angle while standing [rad]
    double effort = kUnknown;                ///< that it gives either way [N m]
    double acceleration = kUnknown;          ///< that it is allowed either way [rad/s²]
  };
  struct Link {
    std::string name, mesh;
    double mass = 0;
    Eigen::Vector3d com{0, 0, 0};
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the CoM, axes of the link [kg m²]
    int joint = -1;                                     ///< that moves it
    int parent = -1;
  };
  struct Body {
    std::string name;  ///< of its link
    int link = -1;
    std::vector<Eigen::Vector3d> points;  ///< whose convex hull it is, in the link's frame [m]
    Eigen::Vector3d center{0, 0, 0};
    double radius = 0;  ///< of a ball around the center that holds it [m]
  };
  struct Leg {
    std::array<int, 6> joints{};
    int foot_link = -1;
    Eigen::Vector3d sole{0, 0, 0};  ///< in the frame of that link [m]
    /// Whether three hip joints are in one point, and two ankle joints in one.
    bool axes_meet = true;
  };

  explicit PlainRobot(const std::string& yaml_path);

  int waist = -1;  ///< link
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Body> bodies;
  std::array<Leg, 2> legs;                                                 ///< left, right
  double com_height = 0, waist_height = 0, com_x = 0, standing_width = 0;  ///< [m]
  Eigen::Vector2d sole_size{0, 0};                                         ///< [m]
  std::vector<std::array<std::string, 2>> excluded;  ///< links, as the YAML file names them
  std::vector<std::array<int, 2>> watched;           ///< pairs of bodies

  double mass = 0;  ///< of all links [kg]
  /// Height of the hips while standing, 0.7 m being 1: what drawn walks and scenes are scaled by.
  double size() const { return (waist_height + HipInWaist(0).z()) / 0.7; }

  /// Poses of all links in the waist frame, legs at `q`, all else standing.
  std::vector<Eigen::Isometry3d> PlaceLinks(const std::array<Vector6, 2>& q) const;
  /// One leg's angles while standing [rad].
  Vector6 Standing(int leg) const;
  /// Links of the leg and, last, its sole, in the waist frame.
  std::array<Eigen::Isometry3d, 7> PlaceLeg(int leg, const Vector6& q) const;
  /// Columns: twist (turn about x y z, then velocity of the sole's centre) in the waist frame for
  /// each joint's speed.
  Eigen::Matrix<double, 6, 6> Jacobian(int leg,
                                       const std::array<Eigen::Isometry3d, 7>& placed) const;
  /// Hip and ankle: the points where three and two axes meet, or nearest to these at q = 0, then
  /// fixed on thigh and shank.
  Eigen::Vector3d HipInWaist(int leg) const;
  Eigen::Vector3d AnkleInSole(int leg) const;  ///< where the axes meet
  /// Their distance, which the knee alone changes [m]; and how far they are apart at most.
  double HipToAnkle(int leg, double knee) const;
  double LongestReach(int leg) const;
  /// Newton's method from `q`, with steps halved until the error falls. False: it does not reach.
  bool SolveLeg(int leg, const Eigen::Isometry3d& X_BSole, Vector6* q) const;

 private:
  int LinkNamed(const std::string& name) const;
  int JointNamed(const std::string& name) const;
  void ReadUrdf(const std::string& path);
  void ReadYaml(const std::string& path);
  void ReadMeshes(const std::string& folder);
  void FindLegs();
  void ChoosePairs();
  bool JoinedAtOnePoint(int a, int b) const;
};

}  // namespace halfstep::oracle
