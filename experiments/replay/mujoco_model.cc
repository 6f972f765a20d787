#include "experiments/replay/mujoco_model.h"

#include <array>

#include "wpg/files/number_text.h"

namespace halfstep::replay {
namespace {

using Eigen::Isometry3d;

// Half of the thickness of a sole's box [m].
constexpr double kSoleHalf = 0.005;

template <typename Vector>
std::string Numbers(const Vector& values) {
  std::string text;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    text += (i == 0 ? "" : " ") + ShortestText(values[i]);
  }
  return text;
}

std::string Attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + value + "\"";
}

std::string PlaceAttributes(const Isometry3d& X) {
  const Eigen::Quaterniond q(X.linear());
  return Attribute("pos", Numbers(X.translation().eval())) +
         Attribute("quat", Numbers(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z())));
}

class Writer {
 public:
  Writer(const RobotModel& robot, const RobotTree& tree, const ModelOptions& options)
      : robot_(robot), tree_(tree), options_(options) {}

  std::string Text() {
    text_ = "<mujoco" + Attribute("model", robot_.name) + ">\n";
    text_ +=
        "  <compiler angle=\"radian\" balanceinertia=\"true\" boundmass=\"1e-4\" "
        "boundinertia=\"1e-6\"/>\n";
    text_ += "  <option integrator=\"implicit\" cone=\"elliptic\"" +
             Attribute("timestep", ShortestText(options_.timestep)) + "/>\n  <worldbody>\n";
    text_ +=
        "    <geom name=\"floor\" type=\"plane\" size=\"0 0 1\" contype=\"1\" conaffinity=\"0\"" +
        Contact() + "/>\n";
    AddLink(0, "    ");
    text_ += "  </worldbody>\n  <actuator>\n";
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

  void AddLink(int index, const std::string& indent) {
    const UrdfLink& link = tree_.urdf.links[static_cast<size_t>(index)];
    const std::string inner = indent + "  ";
    Isometry3d X = Isometry3d::Identity();
    std::string joint_text = "<freejoint/>";
    if (link.joint >= 0) {
      const UrdfJoint& joint = tree_.urdf.joints[static_cast<size_t>(link.joint)];
      X = joint.X_ParentChild;
      joint_text.clear();
      if (IsLegJoint(joint.name)) {
        joint_text = "<joint" + Attribute("name", joint.name) +
                     Attribute("axis", Numbers(joint.axis)) +
                     Attribute("armature", ShortestText(options_.armature)) + "/>";
      } else if (joint.kind == UrdfJoint::Kind::kRevolute) {
        const double angle = tree_.posture[static_cast<size_t>(link.joint)];
        X.rotate(Eigen::AngleAxisd(angle, joint.axis));
      }
    }
    text_ += indent + "<body" + Attribute("name", link.name) + PlaceAttributes(X) + ">\n";
    if (!joint_text.empty()) text_ += inner + joint_text + "\n";
    if (link.mass > 0) AddMass(link, inner);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      if (tree_.feet[static_cast<size_t>(Index(side))] == index) AddSole(side, inner);
    }
    for (size_t child = 0; child < tree_.urdf.links.size(); ++child) {
      const int joint = tree_.urdf.links[child].joint;
      if (joint >= 0 && tree_.urdf.joints[static_cast<size_t>(joint)].parent == index) {
        AddLink(static_cast<int>(child), inner);
      }
    }
    text_ += indent + "</body>\n";
  }

  void AddMass(const UrdfLink& link, const std::string& indent) {
    const Eigen::Matrix3d& I = link.inertia;
    Eigen::Matrix<double, 6, 1> inertia;
    inertia << I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2);
    text_ += indent + "<inertial" + Attribute("pos", Numbers(link.com)) +
             Attribute("mass", ShortestText(link.mass)) +
             Attribute("fullinertia", Numbers(inertia)) + "/>\n";
  }

  // Its lower face is the sole.
  void AddSole(Side side, const std::string& indent) {
    const Leg& leg = robot_.legs[static_cast<size_t>(Index(side))];
    const Isometry3d X_FootSole = leg.joints[5].X_BLink.inverse() * leg.X_BSole;
    const Isometry3d X = X_FootSole * Eigen::Translation3d(0, 0, kSoleHalf);
    const Eigen::Vector3d half(robot_.sole_size.x() / 2, robot_.sole_size.y() / 2, kSoleHalf);
    text_ += indent + "<geom" + Attribute("name", std::string(Name(side)) + "_sole") +
             " type=\"box\" mass=\"0\" contype=\"0\" conaffinity=\"1\"" +
             Attribute("size", Numbers(half)) + PlaceAttributes(X) + Contact() + "/>\n";
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
  std::string text_;
};

}  // namespace

std::string MujocoModel(const RobotModel& robot, const RobotTree& tree,
                        const ModelOptions& options) {
  return Writer(robot, tree, options).Text();
}

}  // namespace halfstep::replay
