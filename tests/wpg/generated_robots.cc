#include "tests/wpg/generated_robots.h"

#include <unistd.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "wpg/check.h"

namespace halfstep {

std::string generated::Text(const Eigen::Vector3d& v) {
  std::ostringstream out;
  out.precision(17);
  out << v.x() << " " << v.y() << " " << v.z();
  return out.str();
}

namespace {

using generated::Text;

// Roll, pitch, yaw about fixed axes.
Eigen::Vector3d Rpy(const Eigen::Matrix3d& R) {
  return {std::atan2(R(2, 1), R(2, 2)), std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0))),
          std::atan2(R(1, 0), R(0, 0))};
}

std::string Link(const std::string& name, double mass, const std::string& shape) {
  return "<link name='" + name + "'><inertial><mass value='" + std::to_string(mass) +
         "'/><inertia ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.01'/></inertial>" +
         shape + "</link>\n";
}

std::string Collision(const Eigen::Vector3d& xyz, const Eigen::Matrix3d& R,
                      const std::string& geometry) {
  return "<collision><origin xyz='" + Text(xyz) + "' rpy='" + Text(Rpy(R)) + "'/><geometry>" +
         geometry + "</geometry></collision>";
}

}  // namespace

std::vector<GeneratedRobot> GeneratedRobots() {
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {{.name = "xyz_offset_knee",
           .axes = {x, y, z, y, y, x},
           .thigh = {0.02, 0.03, -0.32},
           .shank = {-0.03, -0.01, -0.28},
           .right_sign = -1},
          {.name = "yxz_roll_before_pitch",
           .axes = {y, x, z, y, x, y},
           .thigh = {0, 0.015, -0.25},
           .shank = {0.03, -0.02, -0.31},
           .slide = {0.02, -0.03, 0.04, 0.01, 0.02, -0.015}},
          {.name = "zyx_canted",
           .axes = {Eigen::Vector3d(0, 0.35, 1), Eigen::Vector3d(0.1, 1, 0),
                    Eigen::Vector3d(1, 0.1, 0.2), Eigen::Vector3d(0.05, 1, 0.02), y,
                    Eigen::Vector3d(1, 0.25, 0)},
           .thigh = {0.01, 0.02, -0.36},
           .shank = {0, 0, -0.33},
           .slide = {0.02, 0.03, 0, 0.01, 0, -0.02},
           .frame_tilt = 0.4}};
}

std::vector<GeneratedRobot> OffsetRobots() {
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), none(0, 0, 0);
  return {{.name = "pitch_ahead",
           .axes = {z, x, y, y, y, x},
           .thigh = {-0.05, 0, -0.37},
           .shank = {0, 0, -0.42},
           .foot = {0.04, 0, -0.08},
           .offset = {none, none, Eigen::Vector3d(0.05, 0.0225, -0.066), none, none, none}},
          {.name = "ankle_apart",
           .axes = {z, x, y, y, y, x},
           .thigh = {0, 0, -0.35},
           .shank = {0, 0, -0.35},
           .offset = {none, none, Eigen::Vector3d(0.01, 0, 0), none, none,
                      Eigen::Vector3d(0.01, 0, -0.04)}},
          {.name = "none_meet",
           .axes = {y, Eigen::Vector3d(1, 0, -0.17), z, y, y, x},
           .thigh = {-0.02, 0, -0.28},
           .shank = {0, 0, -0.3},
           .foot = {0.03, 0, -0.05},
           .right_sign = -1,
           .offset = {none, Eigen::Vector3d(0, 0.05, -0.03), Eigen::Vector3d(0.025, 0.05, -0.1),
                      none, none, Eigen::Vector3d(0, 0, -0.0176)}}};
}

Leg MakeLeg(const GeneratedRobot& robot, Side side) {
  const Eigen::DiagonalMatrix<double, 3> mirror(1, Sign(side), 1);
  const double turn = side == Side::kLeft ? 1.0 : -robot.right_sign;
  Leg leg;
  leg.hip_B = mirror * robot.hip;
  leg.ankle_B = mirror * (robot.hip + robot.thigh + robot.shank);
  leg.X_BSole = Eigen::Isometry3d::Identity();
  leg.X_BSole.translation() = leg.ankle_B + mirror * robot.foot;
  for (size_t i = 0; i < 6; ++i) {
    LegJoint& joint = leg.joints[i];
    joint.name = std::string(Name(side)) + "_joint" + std::to_string(i);
    const Eigen::Vector3d axis = mirror * robot.axes[i].normalized();
    joint.axis_B = turn * axis;
    const Eigen::Vector3d center =
        i < 3 ? leg.hip_B
              : (i == 3 ? Eigen::Vector3d(mirror * (robot.hip + robot.thigh)) : leg.ankle_B);
    joint.point_B = center + robot.slide[i] * axis;
    joint.max_speed = 4 + 0.5 * static_cast<double>(i);
    joint.X_BLink = Eigen::Isometry3d::Identity();
    const double tilt = robot.frame_tilt * static_cast<double>(i);
    const Eigen::Vector3d tilt_axis = mirror * Eigen::Vector3d(0.6, 0.0, 0.8);
    joint.X_BLink.linear() = Eigen::AngleAxisd(Sign(side) * tilt, tilt_axis).toRotationMatrix();
    joint.X_BLink.translation() = joint.point_B;
  }
  Eigen::Isometry3d X_BStanding = leg.X_BSole;
  const double height = -(robot.thigh + robot.shank).z() * 0.93;
  X_BStanding.translation() = mirror * (robot.hip + robot.foot + Eigen::Vector3d(0, 0, -height));
  // Knee in front, the rest turned as little as possible.
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [branch, q] : SolveLegIkAll(leg, X_BStanding)) {
    const bool forward = LegForwardKinematics(leg, q)[3].translation().x() >
                         X_BStanding.translation().x() - robot.foot.x();
    if (forward && q.norm() < least) {
      least = q.norm();
      leg.branch = branch;
      leg.standing_q = q;
    }
  }
  HALFSTEP_CHECK(std::isfinite(least), robot.name << " cannot stand");
  for (size_t i = 0; i < 6; ++i) {
    LegJoint& joint = leg.joints[i];
    joint.lower = leg.standing_q[static_cast<Eigen::Index>(i)] - 1;
    joint.upper = leg.standing_q[static_cast<Eigen::Index>(i)] + 1;
    // The sole stays level when axes are moved.
    joint.point_B += mirror * robot.offset[i];
    joint.X_BLink.translation() = joint.point_B;
  }
  return leg;
}

std::string GeneratedUrdf(const GeneratedRobot& robot) {
  std::ostringstream urdf;
  urdf.precision(17);
  urdf << "<robot name='" << robot.name << "'>\n"
       << Link("waist", 20,
               Collision({0, 0, 0.15}, Eigen::Matrix3d::Identity(), "<box size='0.2 0.3 0.2'/>"));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Leg leg = MakeLeg(robot, side);
    const std::string prefix = std::string(Name(side));
    Eigen::Isometry3d X_BParent = Eigen::Isometry3d::Identity();
    for (size_t i = 0; i < 6; ++i) {
      const LegJoint& joint = leg.joints[i];
      const Eigen::Isometry3d X_LinkB = joint.X_BLink.inverse();
      // In the link's frame, a shape that stands upright in the waist's at q = 0.
      const auto shape = [&](const Eigen::Vector3d& at_B, const std::string& geometry) {
        return Collision(X_LinkB * at_B, X_LinkB.linear(), geometry);
      };
      const Eigen::Vector3d knee_B = leg.joints[3].point_B;
      std::string body;
      if (i == 2) body = shape((leg.hip_B + knee_B) / 2, "<box size='0.08 0.07 0.22'/>");
      if (i == 3) {
        body = shape((knee_B + leg.ankle_B) / 2, "<cylinder radius='0.04' length='0.24'/>");
      }
      if (i == 4) body = shape(leg.ankle_B, "<sphere radius='0.035'/>");
      if (i == 5) {
        const Eigen::Vector3d above = leg.X_BSole.translation() + Eigen::Vector3d(0, 0, 0.02);
        body = shape(above, "<box size='0.2 0.11 0.04'/>");
      }
      const std::string link = prefix + "_link" + std::to_string(i);
      const Eigen::Isometry3d X_ParentLink = X_BParent.inverse() * joint.X_BLink;
      urdf << Link(link, 1.5, body) << "<joint name='" << joint.name
           << "' type='revolute'><parent link='"
           << (i == 0 ? "waist" : prefix + "_link" + std::to_string(i - 1)) << "'/><child link='"
           << link << "'/><origin xyz='" << Text(X_ParentLink.translation()) << "' rpy='"
           << Text(Rpy(X_ParentLink.linear())) << "'/><axis xyz='"
           << Text(X_LinkB.linear() * joint.axis_B) << "'/><limit lower='" << joint.lower
           << "' upper='" << joint.upper << "' velocity='" << joint.max_speed
           << "' effort='100'/></joint>\n";
      X_BParent = joint.X_BLink;
    }
  }
  urdf << "</robot>\n";
  return urdf.str();
}

std::string GeneratedYaml(const GeneratedRobot& robot, const std::string& urdf_name) {
  constexpr double kDegrees = 180 / 3.14159265358979323846;
  std::ostringstream legs, posture;
  legs.precision(17), posture.precision(17);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Leg leg = MakeLeg(robot, side);
    const Eigen::Isometry3d X_FootSole = leg.joints[5].X_BLink.inverse() * leg.X_BSole;
    const Eigen::Vector3d p = X_FootSole.translation();
    const Eigen::Vector3d rpy = kDegrees * Rpy(X_FootSole.linear());
    legs << "  " << Name(side) << ": {foot_link: " << Name(side) << "_link5, sole_xyz: [" << p.x()
         << ", " << p.y() << ", " << p.z() << "], sole_rpy_deg: [" << rpy.x() << ", " << rpy.y()
         << ", " << rpy.z() << "]}\n";
    for (size_t i = 0; i < 6; ++i) {
      posture << "  " << leg.joints[i].name << ": "
              << kDegrees * leg.standing_q[static_cast<Eigen::Index>(i)] << "\n";
    }
  }
  return "name: " + robot.name + "\nurdf: " + urdf_name + "\nwaist_link: waist\nlegs:\n" +
         legs.str() + "sole_size_m: [0.2, 0.11]\nstanding_posture_deg:\n" + posture.str();
}

TemporaryRobot::TemporaryRobot(const std::string& name, const std::string& urdf,
                               const std::string& yaml)
    : folder_(
          std::filesystem::temp_directory_path() /
          ("halfstep_" + name + "_" + std::to_string(getpid()) + "_" + std::to_string(Count()))) {
  std::filesystem::create_directories(folder_);
  std::ofstream(folder_ / "robot.urdf") << urdf;
  std::ofstream(folder_ / "robot.yaml") << yaml;
}

TemporaryRobot::~TemporaryRobot() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

int TemporaryRobot::Count() {
  static std::atomic<int> count = 0;
  return count++;
}

}  // namespace halfstep
