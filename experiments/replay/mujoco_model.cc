#include "experiments/replay/mujoco_model.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "experiments/replay/foot_body.h"
#include "experiments/replay/mujoco_geoms.h"
#include "planner/scene/solid_body.h"
#include "wpg/files/number_text.h"
#include "wpg/geometry/rotation.h"
#include "wpg/nth.h"

namespace halfstep::replay {
namespace {

using Eigen::Isometry3d;

// Half of the thickness of a sole's box [m].
constexpr double kSoleHalf = 0.005;
// Half of the thickness of a plate's box, most of which is below the floor [m].
constexpr double kPlateHalf = 0.1;
// Principal moments of inertia below it are raised to it [kg m²]; MuJoCo refuses those of 0, which
// links of sensors have.
constexpr double kLeastInertia = 1e-6;
// Soles touch the ground (bit 1), bodies of the robot touch obstacles (bit 2) and the ground's
// solids (bit 4), nothing else does.
constexpr const char* kFloorBits = " contype=\"1\" conaffinity=\"0\"";
constexpr const char* kSoleBits = " contype=\"0\" conaffinity=\"1\"";
constexpr const char* kObstacleBits = " contype=\"2\" conaffinity=\"0\"";
constexpr const char* kBodyBits = " contype=\"0\" conaffinity=\"2\"";
constexpr const char* kSolidBits = " contype=\"5\" conaffinity=\"0\"";
constexpr const char* kBodyOnSolidsBits = " contype=\"0\" conaffinity=\"6\"";
constexpr const char* kFootOnSolidsBits = " contype=\"0\" conaffinity=\"4\"";

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
             Attribute("timestep", ShortestText(options_.timestep)) + OptionEnd() +
             "  <worldbody>\n";
    AddFloor();
    AddLink(0, "    ", false);
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

  const std::vector<GroundSolid>& solids() const { return options_.floor.ground.solids; }

  // The bodies that are rigid with a link. Without obstacles and solids there is nothing for them
  // to touch.
  void AddBodies(int link, const std::string& indent) {
    if (obstacles_.empty() && solids().empty()) return;
    for (size_t i = 0; i < robot_.bodies.size(); ++i) {
      const RobotBody& body = robot_.bodies[i];
      if (LinkOf(body.leg, body.link) != link) continue;
      const std::string name = "body_" + std::to_string(i);
      const bool of_foot = body.leg >= 0 && body.link == 5;
      AddGeom(body.shape, name, solids().empty() || of_foot ? kBodyBits : kBodyOnSolidsBits,
              indent);
      if (solids().empty() || !of_foot) continue;
      const Isometry3d X_SoleLink = X_LinkSole(static_cast<Side>(body.leg)).inverse();
      if (const auto above = AboveSole(body.shape, X_SoleLink, 2 * kSoleHalf)) {
        AddGeom(*above, name + "_above", kFootOnSolidsBits, indent);
      }
    }
  }

  // Several contacts at once of a sole and a solid that is no box.
  std::string OptionEnd() const {
    for (const GroundSolid& solid : solids()) {
      if (!std::holds_alternative<Box>(BodyOf(solid).shape)) {
        return "><flag multiccd=\"enable\"/></option>\n";
      }
    }
    return "/>\n";
  }

  void AddSolid(size_t index) {
    const Obstacle solid = BodyOf(Nth(solids(), index));
    const std::string name = "solid_" + std::to_string(index);
    MujocoGeom geom;
    if (const Box* const box = std::get_if<Box>(&solid.shape)) {
      geom.shape = " type=\"box\"" + Attribute("size", Numbers((0.5 * box->size).eval()));
    } else {
      geom = GeomOf(std::get<ConvexBody>(solid.shape), name);
      assets_ += "    " + geom.asset + "\n";
    }
    text_ += "    <geom" + Attribute("name", name) + geom.shape +
             PlaceAttributes(options_.floor.X_WFloor * solid.X_WO) + kSolidBits + Contact() +
             "/>\n";
  }

  void AddFloor() {
    const SimulatedFloor& floor = options_.floor;
    const bool level = floor.X_WFloor.matrix().isIdentity(0.0);
    if (floor.ground.floor) {
      text_ += std::string("    <geom name=\"floor\" type=\"plane\" size=\"0 0 1\"") +
               (level ? "" : PlaceAttributes(floor.X_WFloor)) + kFloorBits + Contact() + "/>\n";
    } else {
      text_ += "    <site name=\"floor\"" + PlaceAttributes(floor.X_WFloor) + "/>\n";
    }
    for (size_t i = 0; i < solids().size(); ++i) AddSolid(i);
    for (const FloorPlate& plate : floor.plates) {
      const Eigen::Vector3d half(plate.size.x() / 2, plate.size.y() / 2, kPlateHalf);
      const Isometry3d X = floor.X_WFloor * plate.X_FP * Eigen::Translation3d(0, 0, -kPlateHalf);
      text_ += std::string("    <geom ") + (plate.at_start ? "name=\"start\" " : "") +
               "type=\"box\"" + Attribute("size", Numbers(half)) + PlaceAttributes(X) + kFloorBits +
               Contact() + "/>\n";
    }
  }

  // Moved from outside, by nothing else.
  void AddObstacle(size_t index) {
    std::string place;
    if (const auto X = obstacles_[index].pose(0.0)) {
      place = PlaceAttributes(*X);
    }
    text_ += "    <body mocap=\"true\"" + place + ">\n";
    AddGeom(obstacles_[index].body, "obstacle_" + std::to_string(index), kObstacleBits, "      ");
    text_ += "    </body>\n";
  }

  // `on_leg`: whether a joint of a leg moves the link that this one hangs on.
  void AddLink(int index, const std::string& indent, bool on_leg) {
    const UrdfLink& link = Nth(tree_.urdf.links, index);
    const std::string inner = indent + "  ";
    Isometry3d X = Isometry3d::Identity();
    std::string joint_text = "<freejoint/>";
    if (link.joint >= 0) {
      const UrdfJoint& joint = Nth(tree_.urdf.joints, link.joint);
      X = joint.X_ParentChild;
      joint_text.clear();
      if (IsLegJoint(joint.name)) {
        on_leg = true;
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
    for (const Side side : {Side::kLeft, Side::kRight}) {
      if (options_.ankle && LinkOf(Index(side), 5) == index) AddBush(side, inner);
    }
    if (link.mass > 0) AddMass(link, on_leg ? link.com : ShiftedCom(index), inner);
    AddBodies(index, inner);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      if (LinkOf(Index(side), 5) == index) AddSole(side, inner);
    }
    for (size_t child = 0; child < tree_.urdf.links.size(); ++child) {
      const int joint = tree_.urdf.links[child].joint;
      if (joint >= 0 && Nth(tree_.urdf.joints, joint).parent == index) {
        AddLink(static_cast<int>(child), inner, on_leg);
      }
    }
    text_ += indent + "</body>\n";
  }

  // Of a link that no leg moves.
  Eigen::Vector3d ShiftedCom(int index) const {
    const Eigen::Vector3d& com = Nth(tree_.urdf.links, index).com;
    if (options_.com_shift.isZero(0.0)) return com;
    const std::vector<Isometry3d> X = tree_.urdf.LinkPoses(tree_.posture);
    const Eigen::Vector3d shift_B(options_.com_shift.x(), options_.com_shift.y(), 0.0);
    return com + Nth(X, index).linear().transpose() * (Nth(X, tree_.waist).linear() * shift_B);
  }

  void AddMass(const UrdfLink& link, const Eigen::Vector3d& com, const std::string& indent) {
    const Eigen::Matrix3d I = WithLeastInertia(link.inertia);
    text_ += indent + "<inertial" + Attribute("pos", Numbers(com)) +
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

  // The sole of a leg, seen from the link that its last joint moves.
  Isometry3d X_LinkSole(Side side) const {
    const Leg& leg = Nth(robot_.legs, Index(side));
    return leg.joints[5].X_BLink.inverse() * leg.X_BSole;
  }

  // Hinges without names, which could be those of the URDF's joints.
  void AddBush(Side side, const std::string& indent) {
    const Eigen::Matrix3d R_LinkSole = X_LinkSole(side).linear();
    for (const int axis : {1, 0}) {
      text_ += indent + "<joint" + Attribute("axis", Numbers(R_LinkSole.col(axis).eval())) +
               Attribute("stiffness", ShortestText(options_.ankle->stiffness)) +
               Attribute("damping", ShortestText(options_.ankle->damping)) + "/>\n";
    }
  }

  // On the link that the last joint of the leg moves. Its lower face is the sole.
  void AddSole(Side side, const std::string& indent) {
    const Isometry3d X = X_LinkSole(side) * Eigen::Translation3d(0, 0, kSoleHalf);
    const Eigen::Vector3d half(robot_.sole_size.x() / 2, robot_.sole_size.y() / 2, kSoleHalf);
    text_ += indent + "<geom" + Attribute("name", std::string(Name(side)) + "_sole") +
             " type=\"box\" mass=\"0\"" + kSoleBits + Attribute("size", Numbers(half)) +
             PlaceAttributes(X) + Contact() + "/>\n";
  }

  static std::string TorqueLimit(const LegJoint& joint) {
    if (std::isinf(joint.max_torque)) return "";
    const std::string most = ShortestText(joint.max_torque);
    return " forcelimited=\"true\"" + Attribute("forcerange", "-" + most + " " + most);
  }

  // Torque = stiffness (u − q) − damping q̇, where u is the control.
  void AddServo(const LegJoint& joint) {
    text_ += "    <general" + Attribute("name", joint.name) + Attribute("joint", joint.name) +
             " biastype=\"affine\"" + Attribute("gainprm", ShortestText(options_.stiffness)) +
             Attribute("biasprm", "0 " + ShortestText(-options_.stiffness) + " " +
                                      ShortestText(-options_.damping)) +
             (options_.torque_limits ? TorqueLimit(joint) : "") + "/>\n";
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
