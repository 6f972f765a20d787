#include "wpg/robot/urdf_file.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>

#include "wpg/files/regular_file.h"
#include "wpg/geometry/rotation.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::uint64_t kMostUrdfBytes = 16 << 20;

// Keeps what urdfdom would print, warnings too, whatever of it the host program lets pass.
// console_bridge has one handler and one level a process, so one listener at a time.
class Listener : public console_bridge::OutputHandler {
 public:
  Listener() : lock_(Mutex()), level_(console_bridge::getLogLevel()) {
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_WARN);
    console_bridge::useOutputHandler(this);
  }
  ~Listener() override {
    console_bridge::restorePreviousOutputHandler();
    console_bridge::setLogLevel(level_);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  void log(const std::string& text, console_bridge::LogLevel, const char*, int) override {
    text_ += (text_.empty() ? "" : "; ") + text;
  }
  const std::string& text() const { return text_; }

 private:
  static std::mutex& Mutex() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_;
  console_bridge::LogLevel level_;
  std::string text_;
};

Vector3d ToEigen(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Isometry3d ToEigen(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  Isometry3d X = Isometry3d::Identity();
  X.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
  X.translation() = ToEigen(pose.position);
  return X;
}

UrdfCollision ToCollision(const urdf::Collision& collision) {
  UrdfCollision out;
  out.X_LinkShape = ToEigen(collision.origin);
  const urdf::Geometry& geometry = *collision.geometry;
  switch (geometry.type) {
    case urdf::Geometry::BOX:
      out.kind = UrdfCollision::Kind::kBox;
      out.size = ToEigen(static_cast<const urdf::Box&>(geometry).dim);
      break;
    case urdf::Geometry::SPHERE:
      out.kind = UrdfCollision::Kind::kSphere;
      out.size.x() = static_cast<const urdf::Sphere&>(geometry).radius;
      break;
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      out.kind = UrdfCollision::Kind::kCylinder;
      out.size = {cylinder.radius, cylinder.length, 0};
      break;
    }
    case urdf::Geometry::MESH: {
      const auto& mesh = static_cast<const urdf::Mesh&>(geometry);
      out.kind = UrdfCollision::Kind::kMesh;
      out.mesh = mesh.filename;
      out.scale = ToEigen(mesh.scale);
      break;
    }
  }
  return out;
}

UrdfJoint ToJoint(const urdf::Joint& joint, const UrdfFindings& found) {
  UrdfJoint out;
  out.name = joint.name;
  out.X_ParentChild = ToEigen(joint.parent_to_joint_origin_transform);
  out.place = found.joints.at(joint.name);
  if (const auto faults = found.joint_faults.find(joint.name); faults != found.joint_faults.end()) {
    out.faults = faults->second;
  }
  if (joint.type == urdf::Joint::FIXED) return out;
  if (const auto mimics = found.mimics.find(joint.name); mimics != found.mimics.end()) {
    out.mimics = mimics->second;
  }
  out.kind =
      joint.type == urdf::Joint::REVOLUTE ? UrdfJoint::Kind::kRevolute : UrdfJoint::Kind::kOther;
  out.slides = joint.type == urdf::Joint::PRISMATIC;
  if (out.moves()) {
    out.axis = ToEigen(joint.axis).normalized();
    out.lower = joint.limits->lower;
    out.upper = joint.limits->upper;
    out.max_speed = joint.limits->velocity;
    out.max_effort = joint.limits->effort;
    out.turns_freely = found.continuous.contains(joint.name);
  }
  return out;
}

Eigen::Matrix3d InertiaInLink(const urdf::Inertial& inertial) {
  Eigen::Matrix3d inertia;
  inertia << inertial.ixx, inertial.ixy, inertial.ixz,  //
      inertial.ixy, inertial.iyy, inertial.iyz,         //
      inertial.ixz, inertial.iyz, inertial.izz;
  const Eigen::Matrix3d R = ToEigen(inertial.origin).linear();
  return R * inertia * R.transpose();
}

// Appends a link; `joint` leads to it, −1 at the root. Returns its index.
int AddLink(const urdf::Link& link, int joint, const UrdfFindings& found, UrdfTree* tree) {
  const int index = static_cast<int>(tree->links.size());
  UrdfLink& out = tree->links.emplace_back();
  out.name = link.name;
  out.joint = joint;
  out.place = found.links.at(link.name);
  if (joint >= 0) Nth(tree->joints, joint).child = index;
  if (link.inertial) {
    out.mass = link.inertial->mass;
    out.com = ToEigen(link.inertial->origin.position);
    out.inertia = InertiaInLink(*link.inertial);
  }
  for (const auto& collision : link.collision_array) {
    UrdfCollision shape = ToCollision(*collision);
    shape.place = found.collisions.at(link.name).at(out.collisions.size());
    out.collisions.push_back(std::move(shape));
  }
  return index;
}

// Appends the root and all that hangs on it, a link before its children and each child's branch
// before the next child. Not by recursion: a chain may be 5,000 links long.
void AddTree(const urdf::Link& root, const UrdfFindings& found, UrdfTree* tree) {
  struct Open {
    const urdf::Link* link;
    const urdf::Joint* joint;  // null at the root
    int parent;
  };
  std::vector<Open> open = {{&root, nullptr, -1}};
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    int joint = -1;
    if (next.joint != nullptr) {
      joint = static_cast<int>(tree->joints.size());
      tree->joints.push_back(ToJoint(*next.joint, found));
      tree->joints.back().parent = next.parent;
    }
    const int index = AddLink(*next.link, joint, found, tree);
    for (size_t i = next.link->child_links.size(); i-- > 0;) {
      open.push_back({next.link->child_links[i].get(), next.link->child_joints[i].get(), index});
    }
  }
}

// Where the link or joint stands that urdfdom speaks of, "… for Link [CHEST]"; else the robot.
UrdfPlace PlaceOf(const std::string& told, const UrdfFindings& found) {
  for (const auto* named : {&found.links, &found.joints}) {
    for (const auto& [name, place] : *named) {
      if (told.find("[" + name + "]") != std::string::npos) return place;
    }
  }
  return found.robot;
}

// Complains where the model has other links and joints, or a link other shapes or another mass,
// than CheckUrdf found in the text: two readers, one file.
void CheckAgainst(const urdf::ModelInterface& model, const UrdfFindings& found,
                  const std::string& file, Complaints* complaints) {
  const auto differ = [&](const UrdfPlace& at, const std::string& name, const std::string& what) {
    complaints->Add(file, at.line, at.column, name,
                    "urdfdom reads another number of " + what + " than stand in the file");
  };
  if (model.links_.size() != found.links.size()) differ(found.robot, "robot", "links");
  if (model.joints_.size() != found.joints.size()) differ(found.robot, "robot", "joints");
  for (const auto& [name, place] : found.links) {
    const urdf::LinkConstSharedPtr link = model.getLink(name);
    if (!link) {
      complaints->Add(file, place.line, place.column, name, "urdfdom leaves this link out");
      continue;
    }
    const auto collisions = found.collisions.find(name);
    const size_t shapes = collisions == found.collisions.end() ? 0 : collisions->second.size();
    if (link->collision_array.size() != shapes) differ(place, name, "collision shapes");
    const auto mass = found.masses.find(name);
    if ((link->inertial != nullptr) != (mass != found.masses.end()) ||
        (link->inertial && link->inertial->mass != mass->second)) {
      complaints->Add(file, place.line, place.column, name, "urdfdom reads another mass");
    }
  }
}

}  // namespace

bool HasMesh(const UrdfLink& link, std::string_view ending) {
  return std::any_of(link.collisions.begin(), link.collisions.end(), [&](const auto& collision) {
    return collision.kind == UrdfCollision::Kind::kMesh && collision.mesh.ends_with(ending);
  });
}

int UrdfTree::FindLink(const std::string& name) const {
  for (size_t i = 0; i < links.size(); ++i) {
    if (links[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

void UrdfTree::TurnFrame(int link, const Eigen::Matrix3d& R_OldNew) {
  const Eigen::Matrix3d R_NewOld = R_OldNew.transpose();
  UrdfLink& turned = Nth(links, link);
  turned.com = R_NewOld * turned.com;
  turned.inertia = R_NewOld * turned.inertia * R_OldNew;
  for (UrdfCollision& collision : turned.collisions) {
    collision.X_LinkShape.prerotate(R_NewOld);
  }
  for (UrdfJoint& joint : joints) {
    if (joint.child == link) {
      joint.X_ParentChild.rotate(R_OldNew);
      joint.axis = R_NewOld * joint.axis;
    }
    if (joint.parent == link) joint.X_ParentChild.prerotate(R_NewOld);
  }
}

std::vector<Isometry3d> UrdfTree::LinkPoses(const std::vector<double>& q) const {
  std::vector<Isometry3d> X(links.size(), Isometry3d::Identity());
  for (size_t i = 1; i < links.size(); ++i) {
    const int j = links[i].joint;
    const UrdfJoint& joint = Nth(joints, j);
    X[i] = Nth(X, joint.parent) * joint.X_ParentChild;
    if (joint.kind == UrdfJoint::Kind::kRevolute) {
      X[i].rotate(AxisRotation(Nth(q, j), joint.axis));
    }
  }
  return X;
}

UrdfTree ReadUrdf(const std::string& path) {
  return ParseUrdf(path, ReadRegularFile(path, kMostUrdfBytes));
}

UrdfTree ParseUrdf(const std::string& path, const std::string& text) {
  Complaints complaints;
  if (text.empty()) complaints.Add(path, 0, 0, "", "is empty");
  complaints.ThrowIfAny();
  UrdfFindings found = CheckUrdf(text, path, &complaints);
  complaints.ThrowIfAny();
  UrdfTree tree;
  tree.file = path;
  tree.source = RecordOf(path, text);
  tree.warnings = std::move(found.warnings);
  const Listener listener;
  // The byte order mark makes it UTF-8, whatever the file says of its encoding, as CheckUrdf takes
  // it: else characters such as &#282; would make other names.
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF("\xEF\xBB\xBF" + found.text);
  if (!model || !model->getRoot() || !listener.text().empty()) {
    const UrdfPlace at = PlaceOf(listener.text(), found);
    complaints.Add(path, at.line, at.column, "robot", "urdfdom refuses it: " + listener.text());
    complaints.ThrowIfAny();
  }
  CheckAgainst(*model, found, path, &complaints);
  complaints.ThrowIfAny();
  tree.name = model->getName();
  AddTree(*model->getRoot(), found, &tree);
  return tree;
}

}  // namespace halfstep
