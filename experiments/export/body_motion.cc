#include "experiments/export/body_motion.h"

#include <algorithm>
#include <cmath>

#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/yaml_fields.h"
#include "wpg/motion/posture.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_fields.h"

namespace halfstep {
namespace {

constexpr double kSameInstant = 1e-9;  // a frame this close to the end is at the end [s]

Eigen::Matrix3d WaistTurn(const std::string& robot_yaml) {
  return RotationOf(ReadRobotFile(robot_yaml, ReadYamlFile(robot_yaml)).waist_rpy);
}

// Fills the velocities of a link that a joint connects with a link whose velocities are known.
void Carry(const UrdfJoint& joint, double speed, bool to_child, BodyFrame* frame) {
  const int from = to_child ? joint.parent : joint.child;
  const int to = to_child ? joint.child : joint.parent;
  const Eigen::Vector3d turn = Nth(frame->X_W, joint.child).linear() * (speed * joint.axis);
  const Eigen::Vector3d apart =
      Nth(frame->X_W, joint.child).translation() - Nth(frame->X_W, joint.parent).translation();
  // The child's origin is on the joint's axis, so it moves as a point of the parent.
  if (to_child) {
    Nth(frame->turn, to) = Nth(frame->turn, from) + turn;
    Nth(frame->velocity, to) = Nth(frame->velocity, from) + Nth(frame->turn, from).cross(apart);
  } else {
    Nth(frame->turn, to) = Nth(frame->turn, from) - turn;
    Nth(frame->velocity, to) = Nth(frame->velocity, from) - Nth(frame->turn, to).cross(apart);
  }
}

}  // namespace

BodyMotion::BodyMotion(const std::string& robot_yaml)
    : robot_(LoadWholeRobot(robot_yaml)), R_LinkB_(WaistTurn(robot_yaml)) {
  robot_.tree.urdf.TurnFrame(robot_.tree.waist, R_LinkB_.transpose());
  still_ = robot_.tree;
  still_.posture.assign(still_.posture.size(), 0.0);
  const UrdfTree& urdf = robot_.tree.urdf;
  for (int link = robot_.tree.waist; Nth(urdf.links, link).joint >= 0;) {
    to_waist_.push_back(Nth(urdf.links, link).joint);
    link = Nth(urdf.joints, to_waist_.back()).parent;
  }
}

BodyOrder BodyMotion::Order(bool all_links) const {
  const UrdfTree& urdf = robot_.tree.urdf;
  std::vector<std::vector<int>> below(urdf.links.size());  // joints that hang on a link
  for (size_t j = 0; j < urdf.joints.size(); ++j) {
    Nth(below, urdf.joints[j].parent).push_back(static_cast<int>(j));
  }
  const auto place = [&urdf](int joint) {
    const UrdfPlace& at = Nth(urdf.joints, joint).place;
    return std::pair(at.line, at.column);
  };
  BodyOrder order;
  std::vector<int> open = {0};
  while (!open.empty()) {
    const int link = open.back();
    open.pop_back();
    const int joint = Nth(urdf.links, link).joint;
    const bool moves = joint >= 0 && Nth(urdf.joints, joint).kind == UrdfJoint::Kind::kRevolute;
    if (moves) order.joints.push_back(joint);
    if (moves || joint < 0 || all_links) order.links.push_back(link);
    std::vector<int>& joints = Nth(below, link);
    // The last one is opened first.
    std::ranges::sort(joints, [&](int a, int b) { return place(a) > place(b); });
    for (const int next : joints) open.push_back(Nth(urdf.joints, next).child);
  }
  return order;
}

BodyFrame BodyMotion::At(const SuperposedWalk& walk, double t, const std::string& path) const {
  const auto& [model, tree] = robot_;
  const double at = std::clamp(t, 0.0, walk.duration());
  const WalkJet jet = walk.At(at);
  Posture posture = SolvePosture(model, jet.value);
  if (!posture.reachable || !SolveJointSpeeds(model, jet, &posture)) {
    throw InputError({path + ": at " + ShortestText(at) +
                      " s a leg is stretched so far that its joint speeds have no bound: cannot "
                      "be played (valid: a feasible walk; --method picks one)"});
  }
  BodyFrame frame;
  frame.t = t;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    Nth(frame.stands, Index(side)) = !walk.InAir(walk.Locate(at), side);
  }
  frame.com = {jet.value[kComX], jet.value[kComY], model.com_height + jet.value[kWaistZ]};
  frame.q = JointAngles(model, tree, {posture.ik[0].q, posture.ik[1].q});
  frame.speeds = JointAngles(model, still_, posture.speeds);

  const UrdfTree& urdf = tree.urdf;
  const std::vector<Eigen::Isometry3d> X_Root = urdf.LinkPoses(frame.q);
  Eigen::Isometry3d X_WWaist = posture.X_WB;
  X_WWaist.linear() = posture.X_WB.linear() * R_LinkB_.transpose();
  const Eigen::Isometry3d X_WRoot = X_WWaist * Nth(X_Root, tree.waist).inverse();
  for (const Eigen::Isometry3d& X : X_Root) frame.X_W.push_back(X_WRoot * X);

  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  frame.velocity.assign(urdf.links.size(), zero);
  frame.turn.assign(urdf.links.size(), zero);
  Nth(frame.velocity, tree.waist) = posture.waist_velocity;
  Nth(frame.turn, tree.waist) = jet.first[kWaistYaw] * Eigen::Vector3d::UnitZ();
  std::vector<bool> known(urdf.links.size(), false);
  known[static_cast<size_t>(tree.waist)] = true;
  for (const int joint : to_waist_) {
    Carry(Nth(urdf.joints, joint), Nth(frame.speeds, joint), false, &frame);
    known[static_cast<size_t>(Nth(urdf.joints, joint).parent)] = true;
  }
  for (size_t link = 0; link < urdf.links.size(); ++link) {
    if (known[link]) continue;
    const int joint = urdf.links[link].joint;
    Carry(Nth(urdf.joints, joint), Nth(frame.speeds, joint), true, &frame);
  }
  return frame;
}

std::vector<BodyFrame> FramesOf(const BodyMotion& motion, const SuperposedWalk& walk, int fps,
                                const std::string& path) {
  std::vector<BodyFrame> frames;
  const double rate = static_cast<double>(fps);
  for (long k = 0;; ++k) {
    const double t = static_cast<double>(k) / rate;
    const bool ends = t > walk.duration() - kSameInstant;
    frames.push_back(motion.At(walk, ends ? walk.duration() : t, path));
    frames.back().t = t;
    if (ends) return frames;
  }
}

}  // namespace halfstep
