#include "experiments/checker/jointed_robot.h"

#include <algorithm>

#include "wpg/files/input_error.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_bodies.h"

namespace halfstep::checker {
namespace {

// Frames of a URDF are of doubles, so that their rotations keep lengths to less than this, over
// chains of a thousand of them.
constexpr double kRoundedUp = 1.0 + 1e-12;

}  // namespace

JointedRobot::JointedRobot(UrdfTree urdf, const std::map<std::string, std::string>& packages,
                           bool dae_up_axis)
    : urdf_(std::move(urdf)) {
  Complaints complaints;
  for (size_t i = 0; i < urdf_.links.size(); ++i) {
    int count = 0;
    for (ConvexBody& shape :
         LinkShapes(urdf_, static_cast<int>(i), packages, dae_up_axis, &complaints)) {
      Body body{.name = urdf_.links[i].name, .link = static_cast<int>(i)};
      if (++count > 1) body.name += "#" + std::to_string(count);
      body.reach = kRoundedUp * (shape.center.norm() + shape.radius);
      body.shape = std::move(shape);
      bodies_.push_back(std::move(body));
    }
  }
  complaints.ThrowIfAny();
}

const UrdfJoint& JointedRobot::JointOf(int link) const {
  return Nth(urdf_.joints, Nth(urdf_.links, link).joint);
}

std::vector<Frame> JointedRobot::Frames(const Frame& X_WRoot,
                                        const std::vector<Interval>& q) const {
  std::vector<Frame> frames(urdf_.links.size(), X_WRoot);
  for (size_t i = 1; i < frames.size(); ++i) {
    const UrdfJoint& joint = JointOf(static_cast<int>(i));
    frames[i] = After(Nth(frames, joint.parent), joint, Nth(q, urdf_.links[i].joint));
  }
  return frames;
}

std::vector<int> JointedRobot::Above(int link) const {
  std::vector<int> links = {link};
  while (Nth(urdf_.links, links.back()).joint >= 0) links.push_back(JointOf(links.back()).parent);
  return links;
}

// Down from the body to where both chains meet, and up to the link: what lies between a joint's
// origin and the body's points are the offsets on that way, in whatever way joints turn. On the way
// up the joint of a link has its origin at that link's frame.
std::vector<JointedRobot::Lever> JointedRobot::Levers(const Body& body, int link,
                                                      const std::vector<double>& slides) const {
  const std::vector<int> above = Above(body.link);
  const std::vector<int> others = link < 0 ? std::vector<int>() : Above(link);
  std::vector<Lever> levers;
  double reach = body.reach;
  const auto pass = [&](int at, bool down) {
    const int index = Nth(urdf_.links, at).joint;
    const UrdfJoint& joint = Nth(urdf_.joints, index);
    const bool turns = joint.kind == UrdfJoint::Kind::kRevolute;
    if (turns && down) levers.push_back({index, reach});
    reach = kRoundedUp * (reach + joint.X_ParentChild.translation().norm());
    if (joint.slides) {
      levers.push_back({index, kRoundedUp});
      reach = kRoundedUp * (reach + Nth(slides, index));
    }
    if (turns && !down) levers.push_back({index, reach});
  };
  size_t i = 0;
  for (; std::ranges::find(others, above[i]) == others.end(); ++i) {
    if (Nth(urdf_.links, above[i]).joint < 0) {
      levers.push_back({-1, reach});
      return levers;
    }
    pass(above[i], true);
  }
  for (auto at = std::ranges::find(others, above[i]); at != others.begin();) pass(*--at, false);
  return levers;
}

int JointedRobot::Rigid(int link) const {
  while (Nth(urdf_.links, link).joint >= 0 && !JointOf(link).moves()) {
    link = JointOf(link).parent;
  }
  return link;
}

bool JointedRobot::AreNeighbours(int link_a, int link_b) const {
  const int a = Rigid(link_a), b = Rigid(link_b);
  const auto parent = [this](int link) {
    return Nth(urdf_.links, link).joint < 0 ? -1 : Rigid(JointOf(link).parent);
  };
  return a == b || parent(a) == b || parent(b) == a;
}

}  // namespace halfstep::checker
