#include "wpg/robot/self_pairs.h"

#include <algorithm>
#include <cmath>

#include "wpg/nth.h"

namespace halfstep {
namespace {

// The legs' joints in the URDF and in the model.
struct LegJoints {
  const std::array<std::array<int, 6>, 2>& indices;
  const std::array<Leg, 2>& legs;
};

// Whether the axes of two joints of a leg meet, at any posture: they are neighbours.
bool Meet(const LegJoint& a, const LegJoint& b) {
  constexpr double kMeeting = 1e-6;  // [m]
  return std::abs((b.point_B - a.point_B).dot(a.axis_B.cross(b.axis_B).normalized())) <= kMeeting;
}

// "hip" or "ankle" when both joints are of one leg and their axes meet there, else "".
std::string MeetingPoint(const std::vector<int>& joints, const LegJoints& leg_joints) {
  for (size_t side = 0; side < 2; ++side) {
    const std::array<int, 6>& leg = leg_joints.indices[side];
    const auto index = [&](int joint) {
      return std::find(leg.begin(), leg.end(), joint) - leg.begin();
    };
    const std::ptrdiff_t a = index(joints[0]), b = index(joints[1]);
    const bool hip = a < 3 && b < 3, ankle = a >= 4 && a < 6 && b >= 4 && b < 6;
    if (!hip && !ankle) continue;
    const Leg& of = leg_joints.legs[side];
    if (!of.closed_form() && !Meet(Nth(of.joints, a), Nth(of.joints, b))) return "";
    return hip ? "hip" : "ankle";
  }
  return "";
}

// Why two links are not watched; "" when they are.
std::string WhyNotWatched(const UrdfTree& urdf, const std::vector<ExcludedPair>& excluded, int a,
                          int b, const LegJoints& leg_joints) {
  for (const ExcludedPair& pair : excluded) {
    const int first = urdf.FindLink(pair.links[0]), second = urdf.FindLink(pair.links[1]);
    if ((first == a && second == b) || (first == b && second == a)) {
      return "excluded by the robot file" + (pair.why.empty() ? "" : ": " + pair.why);
    }
  }
  const std::vector<int> joints = JointsBetween(urdf, a, b);
  const auto name = [&](size_t i) { return Nth(urdf.joints, joints[i]).name; };
  if (joints.size() == 1) return "joined by " + name(0);
  if (joints.size() != 2) return "";
  const std::string point = MeetingPoint(joints, leg_joints);
  return point.empty() ? "" : "joined at the " + point + " by " + name(1) + " and " + name(0);
}

}  // namespace

std::vector<int> JointsBetween(const UrdfTree& urdf, int a, int b) {
  // links are sorted from the root: the later one is never above the earlier one.
  std::vector<int> joints;
  while (a != b) {
    int& lower = a > b ? a : b;
    const int index = Nth(urdf.links, lower).joint;
    const UrdfJoint& joint = Nth(urdf.joints, index);
    if (joint.kind != UrdfJoint::Kind::kFixed) joints.push_back(index);
    lower = joint.parent;
  }
  return joints;
}

SelfPairs BuildSelfPairs(const UrdfTree& urdf, const std::vector<ExcludedPair>& excluded,
                         const LinkBodies& all, const std::array<std::array<int, 6>, 2>& leg_joints,
                         const std::array<Leg, 2>& legs) {
  SelfPairs pairs;
  for (size_t a = 0; a < all.bodies.size(); ++a) {
    for (size_t b = a + 1; b < all.bodies.size(); ++b) {
      const RobotBody &first = all.bodies[a], &second = all.bodies[b];
      if (first.leg == second.leg && first.link == second.link) continue;
      const int i = static_cast<int>(a), j = static_cast<int>(b);
      const std::string why =
          WhyNotWatched(urdf, excluded, all.links[a], all.links[b], {leg_joints, legs});
      if (why.empty()) {
        pairs.watched.push_back({i, j});
      } else {
        pairs.unwatched.push_back({i, j, why});
      }
    }
  }
  return pairs;
}

}  // namespace halfstep
