#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "wpg/geometry/pose2.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// Which feet stand, as trajectory.csv says it. Single supports have the values of Index(Side).
enum class Support : int { kLeft = 0, kRight = 1, kBoth = 2 };

/// The last columns of trajectory.csv: margins at the row's instant.
constexpr size_t kNumMarginColumns = 10;
/// Their names; the last is there for robots whose file limits joint accelerations.
constexpr std::array<const char*, kNumMarginColumns> kMarginColumns = {
    "zmp_margin_m",
    "joint_margin_rad",
    "joint_speed_margin_rad_s",
    "foot_speed_margin_m_s",
    "clearance_m",
    "self_clearance_m",
    "zmp_robot_margin_m",
    "torque_margin_n_m",
    "friction_margin",
    "joint_acceleration_margin_rad_s2"};
/// How many of them a robot's trajectory has.
size_t NumMarginColumns(const RobotModel& robot);

/// A row of trajectory.csv.
struct PlayedRow {
  double t = 0;                      ///< [s]
  int half_step = 0;                 ///< that has begun last
  Support support = Support::kBoth;  ///< who carries
  Eigen::Vector3d com{0, 0, 0};      ///< in W, as all that follows but q [m]
  Eigen::Vector2d com_velocity{0, 0}, com_acceleration{0, 0}, zmp{0, 0};  ///< [m/s], [m/s²], [m]
  Eigen::Vector4d waist{0, 0, 0, 0};                ///< x, y, z [m], yaw [rad]
  std::array<Eigen::Vector4d, 2> soles;             ///< the same of the sole frames, by Index(Side)
  std::array<Vector6d, 2> q;                        ///< joint angles [rad], by Index(Side)
  std::array<double, kNumMarginColumns> margins{};  ///< by kMarginColumns

  /// Place of a sole, in W, seen from above.
  Pose2 X_WS(int side) const {
    const Eigen::Vector4d& s = Nth(soles, side);
    return {s[0], s[1], s[3]};
  }
  /// Whether the foot of that side carries.
  bool Stands(int side) const {
    return support == Support::kBoth || static_cast<int>(support) == side;
  }
  bool AllFinite() const;  ///< whether no number of the row is infinite or NaN
};

/// Columns of trajectory.csv for a robot.
std::vector<std::string> TrajectoryHeader(const RobotModel& robot);

/// Throws InputError for a text that is no trajectory of this robot.
std::vector<PlayedRow> ReadTrajectory(const std::string& path, const std::string& text,
                                      const RobotModel& robot);

/// Where the robot is at an instant.
struct Placement {
  Eigen::Isometry3d X_WB;                                   ///< the waist's pose in W
  std::array<std::array<Eigen::Isometry3d, 7>, 2> X_BLink;  ///< links and, last, the sole.

  /// Pose of a body, in W.
  Eigen::Isometry3d OfBody(const RobotBody& body) const {
    return body.leg < 0 ? X_WB : X_WB * OfBody_B(body);
  }
  /// Pose of a body in the waist frame B.
  Eigen::Isometry3d OfBody_B(const RobotBody& body) const {
    return body.leg < 0 ? Eigen::Isometry3d::Identity() : Nth(Nth(X_BLink, body.leg), body.link);
  }
};

/// The robot in the posture of a row.
Placement PlaceRobot(const RobotModel& robot, const PlayedRow& row);

/// The motion that a robot plays from a trajectory: waist (x, y, z, yaw) and joint angles linear
/// between rows. Borrows robot and rows. Precondition: at least two rows, increasing times, finite.
class PlayedMotion {
 public:
  /// Both are borrowed.
  PlayedMotion(const RobotModel& robot, const std::vector<PlayedRow>& rows);

  const RobotModel& robot() const { return robot_; }            ///< that moves
  const std::vector<PlayedRow>& rows() const { return rows_; }  ///< at which it is given
  double end() const { return rows_.back().t; }                 ///< of the motion [s]

  /// The row i with t_i ≤ t < t_{i+1} (the last but one at the end), and (t − t_i)/(t_{i+1} − t_i).
  std::pair<size_t, double> Locate(double t) const;
  /// Linear between the two rows around an instant; half-step and support of the earlier one.
  PlayedRow At(double t) const;
  Placement Place(double t) const { return PlaceRow(At(t)); }  ///< at t [s]
  /// As a row says it.
  Placement PlaceRow(const PlayedRow& row) const { return PlaceRobot(robot_, row); }

  /// For each row, a bound C of the way that any point of a body has moved from row 0 to it [m]: Σ
  /// |Δwaist| + |Δyaw|·lever + Σ_j |Δq_j|·r_j, where r_j is the largest distance of the body's
  /// points from a point of joint j's axis over all postures (a sum of link lengths). C is linear
  /// between rows, so C(t') − C(t) bounds the body's motion on [t, t'].
  /// Source: [Schwarzer2005] §4.
  std::vector<double> PathInWorld(const RobotBody& body) const;
  /// The same as seen from the waist, where only the joints of the body's leg count.
  std::vector<double> PathInWaist(const RobotBody& body) const;
  /// A bound of how far any point of a body, seen from the waist, is between rows i and i + 1 from
  /// where it would be if it moved straight and at constant speed from row to row [m]: Σ_jk
  /// |Δq_j||Δq_k| r_max(j,k) / 8, for ‖∂²p/∂q_j∂q_k‖ ≤ r of the outer joint.
  double Sag(const RobotBody& body, size_t i) const;

 private:
  std::array<double, 6> Radii(const RobotBody& body) const;

  const RobotModel& robot_;
  const std::vector<PlayedRow>& rows_;
};

/// An upper bound of the distance of a body's points from `point`, in the body's frame [m].
double FarthestFrom(const ConvexBody& body, const Eigen::Vector3d& point);

}  // namespace halfstep::verify
