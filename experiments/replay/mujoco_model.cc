#include "experiments/replay/mujoco_model.h"

#include <Eigen/Eigenvalues>
#include <array>

#include "experiments/replay/mujoco_geoms.h"
#include "wpg/files/number_text.h"
#include "wpg/geometry/rotation.h"
#include "wpg/nth.h"

namespace halfstep::replay {
namespace {

using Eigen::Isometry3d;

// Half of the thickness of a sole's box [m].
constexpr double kSoleHalf = 0.005;
// Principal moments of inertia below it are raised to it [kg m²]; MuJoCo refuses those of 0, which
// links of sensors have.
constexpr double kLeastInertia = 1e-6;
// Soles touch the floor (bit 1), bodies of the robot touch obstacles (bit 2), nothing else does.
constexpr const char* kFloorBits = " contype=\"1\" conaffinity=\"0\"";
constexpr const char* kSoleBits = " contype=\"0\" conaffinity=\"1\"";
constexpr const char* kObstacleBits = " contype=\"2\" conaffinity=\"0\"";
constexpr const char* kBodyBits = " contype=\"0\" conaffinity=\"2\"";

template <typename Vector>
std::string Numbers(const Vector& values) {
  std::string text;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    text += (i == 0 ? "" : " ") + ShortestText(values[i]);
  }
  return text;
}

std::string PlaceAttributes(const Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  return Attribute("pos", Numbers(X.translation().eval())) +
         Attribute("quat", Numbers(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z())));
}

Eigen::Matrix3d WithLeastInertia(const Eigen::Matrix3d& I) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> moments(I);
  if (moments.eigenvalues()[0] >= kLeastInertia) return I;
  const Eigen::Vector3d raised = moments.eigenvalues().cwiseMax(kLeastInertia);
  const Eigen::Matrix3d& axes = moments.eigenvectors();
  return axes * raised.asDiagonal() * axes.transpose();
}

class Writer {
 public:
  Writer(const RobotModel& robot, const RobotTree& tree, const ModelOptions& options,
         const std::vector<SimulatedObstacle>& obstacles)
      : robot_(robot), tree_(tree), options_(options), obstacles_(obstacles) {}

  std::string Text() {
    text_ = "<mujoco" + Attribute("model", robot_.name) + ">\n";
    text_ += "  <compiler angle=\"radian\" balanceinertia=\"true\" boundmass=\"1e-4\"" +
             Attribute("boundinertia", ShortestText(kLeastInertia)) + "/>\n";
    text_ += "  <option integrator=\"implicit\" cone=\"elliptic\"" +
             Attribute("timestep", ShortestText(options_.timestep)) + "/>\n  <worldbody>\n";
    text_ += std::string("    <geom name=\"floor\" type=\"plane\" size=\"0 0 1\"") + kFloorBits +
             Contact() + "/>\n";
    AddLink(0, "    ");
    for (size_t i = 0; i < obstacles_.size(); ++i) AddObstacle(i);
    text_ += "  </worldbody>\n";
    if (!assets_.empty()) text_ += "  <asset>\n" + assets_ + "  </asset>\n";
    text_ += "  <actuator>\n";
    for (const Leg& leg : robot_.legs) {
      for (const LegJoint& joint : leg.joints) AddServo(joint);
    }
    return text_ + "  </actuator>\n</mujoco>\n";
  }

 private:
  std::string Contact() const {
    return Attribute("friction", ShortestText(options_.friction) + " 0.005 0.0001") +
           Attribute("solref", ShortestText(options_.contact_time) + " 1");
  }

  bool IsLegJoint(const std::string& name) const {
    for (const Leg& leg : robot_.legs) {
      for (const LegJoint& joint : leg.joints) {
        if (joint.name == name) return true;
      }
    }
    return false;
  }

  // The link that joint `joint` of a leg moves; the waist for −1.
  int LinkOf(int leg, int joint) const {
    if (joint < 0) return tree_.waist;
    const std::string& name = Nth(Nth(robot_.legs, leg).joints, joint).name;
    for (const UrdfJoint& one : tree_.urdf.joints) {
      if (one.name == name) return one.child;
    }
    return -1;
  }

  void AddGeom(const ConvexBody& body, const std::string& name, const char* bits,
               const std::string& indent) {
    const MujocoGeom geom = GeomOf(body, name);
    if (!geom.asset.empty()) assets_ += "    " + geom.asset + "\n";
    text_ += indent + "<geom" + Attribute("name", name) + geom.shape + " mass=\"0\"" + bits +
             Contact() + "/>\n";
  }

  // The bodies that are rigid with a link. Without obstacles there is nothing for them to touch.
  void AddBodies(int link, const std::string& indent) {
    if (obstacles_.empty()) return;
    for (size_t i = 0; i < robot_.bodies.size(); ++i) {
      const RobotBody& body = robot_.bodies[i];
      if (LinkOf(body.leg, body.link) != link) continue;
      AddGeom(body.shape, "body_" + std::to_string(i), kBodyBits, indent);
    }
  }

  // Moved from outside, by nothing else.
  void AddObstacle(size_t index) {
    std::string place;
    if (const auto X = obstacles_[index].pose(0.0); options_.obstacles_placed && X) {
      place = PlaceAttributes(*X);
    }
    text_ += "    <body mocap=\"true\"" + place + ">\n";
    AddGeom(obstacles_[index].body, "obstacle_" + std::to_string(index), kObstacleBits, "      ");
    text_ += "    </body>\n";
  }

  void AddLink(int index, const std::string& indent) {
    const UrdfLink& link = Nth(tree_.urdf.links, index);
    const std::string inner = indent + "  ";
    Isometry3d X = Isometry3d::Identity();
    std::string joint_text = "<freejoint/>";
    if (link.joint >= 0) {
      const UrdfJoint& joint = Nth(tree_.urdf.joints, link.joint);
      X = joint.X_ParentChild;
      joint_text.clear();
      if (IsLegJoint(joint.name)) {
        joint_text = "<joint" + Attribute("name", joint.name) +
                     Attribute("axis", Numbers(joint.axis)) +
                     Attribute("armature", ShortestText(options_.armature)) + "/>";
      } else if (joint.kind == UrdfJoint::Kind::kRevolute) {
        const double angle = Nth(tree_.posture, link.joint);
        X.rotate(AxisRotation(angle, joint.axis));
      }
    }
    text_ += indent + "<body" + Attribute("name", BodyName(link.name)) + PlaceAttributes(X) + ">\n";
    if (!joint_text.empty()) text_ += inner + joint_text + "\n";
    if (link.mass > 0) AddMass(link, inner);
    AddBodies(index, inner);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      if (LinkOf(Index(side), 5) == index) AddSole(side, inner);
    }
    for (size_t child = 0; child < tree_.urdf.links.size(); ++child) {
      const int joint = tree_.urdf.links[child].joint;
      if (joint >= 0 && Nth(tree_.urdf.joints, joint).parent == index) {
        AddLink(static_cast<int>(child), inner);
      }
    }
    text_ += indent + "</body>\n";
  }

  void AddMass(const UrdfLink& link, const std::string& indent) {
    const Eigen::Matrix3d I = WithLeastInertia(link.inertia);
    text_ += indent + "<inertial" + Attribute("pos", Numbers(link.com)) +
             Attribute("mass", ShortestText(link.mass));
    if (options_.principal_axes) {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(I);
      Eigen::Matrix3d axes = solver.eigenvectors();
      if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
      const Eigen::Quaterniond q(axes);
      text_ += Attribute("quat", Numbers(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()))) +
               Attribute("diaginertia", Numbers(solver.eigenvalues())) + "/>\n";
      return;
    }
    Eigen::Matrix<double, 6, 1> inertia;
    inertia << I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2);
    text_ += Attribute("fullinertia", Numbers(inertia)) + "/>\n";
  }

  // On the link that the last joint of the leg moves. Its lower face is the sole.
  void AddSole(Side side, const std::string& indent) {
    const Leg& leg = Nth(robot_.legs, Index(side));
    const Isometry3d X_LinkSole = leg.joints[5].X_BLink.inverse() * leg.X_BSole;
    const Isometry3d X = X_LinkSole * Eigen::Translation3d(0, 0, kSoleHalf);
    const Eigen::Vector3d half(robot_.sole_size.x() / 2, robot_.sole_size.y() / 2, kSoleHalf);
    text_ += indent + "<geom" + Attribute("name", std::string(Name(side)) + "_sole") +
             " type=\"box\" mass=\"0\"" + kSoleBits + Attribute("size", Numbers(half)) +
             PlaceAttributes(X) + Contact() + "/>\n";
  }

  // Torque = stiffness (u − q) − damping q̇, where u is the control.
  void AddServo(const LegJoint& joint) {
    text_ += "    <general" + Attribute("name", joint.name) + Attribute("joint", joint.name) +
             " biastype=\"affine\"" + Attribute("gainprm", ShortestText(options_.stiffness)) +
             Attribute("biasprm", "0 " + ShortestText(-options_.stiffness) + " " +
                                      ShortestText(-options_.damping)) +
             "/>\n";
  }

  const RobotModel& robot_;
  const RobotTree& tree_;
  const ModelOptions& options_;
  const std::vector<SimulatedObstacle>& obstacles_;
  std::string text_, assets_;
};

}  // namespace

std::string BodyName(const std::string& link) {
  const std::string taken = "world";
  const bool like_it =
      link.starts_with(taken) && link.find_first_not_of('_', taken.size()) == std::string::npos;
  return like_it ? link + "_" : link;
}

std::string MujocoModel(const RobotModel& robot, const RobotTree& tree, const ModelOptions& options,
                        const std::vector<SimulatedObstacle>& obstacles) {
  return Writer(robot, tree, options, obstacles).Text();
}

}  // namespace halfstep::replay
