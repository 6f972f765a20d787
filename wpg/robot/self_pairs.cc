#include "wpg/robot/self_pairs.h"

#include <algorithm>

namespace halfstep {
namespace {

// "hip" or "ankle" when both joints are of one leg and their axes meet there, else "".
std::string MeetingPoint(const std::vector<int>& joints,
                         const std::array<std::array<int, 6>, 2>& leg_joints) {
  for (const std::array<int, 6>& leg : leg_joints) {
    const auto among = [&](auto begin, auto end) {
      return std::all_of(joints.begin(), joints.end(),
                         [&](int joint) { return std::find(begin, end, joint) != end; });
    };
    if (among(leg.begin(), leg.begin() + 3)) return "hip";
    if (among(leg.begin() + 4, leg.end())) return "ankle";
  }
  return "";
}

// Why two links are not watched; "" when they are.
std::string WhyNotWatched(const UrdfTree& urdf, const std::vector<ExcludedPair>& excluded, int a,
                          int b, const std::array<std::array<int, 6>, 2>& leg_joints) {
  for (const ExcludedPair& pair : excluded) {
    const int first = urdf.FindLink(pair.links[0]), second = urdf.FindLink(pair.links[1]);
    if ((first == a && second == b) || (first == b && second == a)) {
      return "excluded by the robot file" + (pair.why.empty() ? "" : ": " + pair.why);
    }
  }
  const std::vector<int> joints = JointsBetween(urdf, a, b);
  const auto name = [&](size_t i) { return urdf.joints[static_cast<size_t>(joints[i])].name; };
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
    const int index = urdf.links[static_cast<size_t>(lower)].joint;
    const UrdfJoint& joint = urdf.joints[static_cast<size_t>(index)];
    if (joint.kind != UrdfJoint::Kind::kFixed) joints.push_back(index);
    lower = joint.parent;
  }
  return joints;
}

SelfPairs BuildSelfPairs(const UrdfTree& urdf, const std::vector<ExcludedPair>& excluded,
                         const LinkBodies& all,
                         const std::array<std::array<int, 6>, 2>& leg_joints) {
  SelfPairs pairs;
  for (size_t a = 0; a < all.bodies.size(); ++a) {
    for (size_t b = a + 1; b < all.bodies.size(); ++b) {
      const RobotBody &first = all.bodies[a], &second = all.bodies[b];
      if (first.leg == second.leg && first.link == second.link) continue;
      const int i = static_cast<int>(a), j = static_cast<int>(b);
      const std::string why = WhyNotWatched(urdf, excluded, all.links[a], all.links[b], leg_joints);
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
