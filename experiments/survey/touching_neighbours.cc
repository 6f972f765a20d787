#include "experiments/survey/touching_neighbours.h"

#include <algorithm>

#include "experiments/survey/arm_posture.h"
#include "experiments/survey/stance_search.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/self_pairs.h"

namespace halfstep {
namespace {

bool Names(const ExcludedPair& pair, const std::string& a, const std::string& b) {
  return (pair.links[0] == a && pair.links[1] == b) || (pair.links[0] == b && pair.links[1] == a);
}

}  // namespace

bool AreOfBothLegs(const RobotModel& robot, const SelfGap& gap) {
  const int a = Nth(robot.bodies, gap.a).leg;
  const int b = Nth(robot.bodies, gap.b).leg;
  return a >= 0 && b >= 0 && a != b;
}

std::string LinkOf(const RobotBody& body) { return body.name.substr(0, body.name.find('#')); }

int LegJointsBetween(const UrdfTree& urdf, const FoundLegs& legs, const RobotModel& robot,
                     const SelfGap& gap) {
  const auto link = [&](int body) { return urdf.FindLink(LinkOf(Nth(robot.bodies, body))); };
  int count = 0;
  for (const int joint : JointsBetween(urdf, link(gap.a), link(gap.b))) {
    for (const auto& leg : legs.joints) {
      count += static_cast<int>(std::count(leg.begin(), leg.end(), joint));
    }
  }
  return count;
}

double NearByDesign(const RobotModel& robot) {
  return 1.4 * DefaultLimits(robot).demanded_of(MarginFamily::kSelfClearance);
}

std::string NearnessText(double gap) {
  return gap < 0 ? Formatted("reaches %.1f mm into", -1e3 * gap)
                 : Formatted("comes within %.1f mm of", 1e3 * gap);
}

std::vector<ExcludedPair> NeighboursThatTouch(const UrdfTree& urdf, const FoundLegs& legs,
                                              const std::vector<double>& posture,
                                              const RobotModel& robot, const SelfGaps& gaps) {
  const std::vector<bool> of_limb = BodiesOfLimbs(urdf, legs.waist, posture, robot);
  const double near = NearByDesign(robot);
  std::vector<ExcludedPair> excluded;
  for (const SelfGap& gap : gaps.Nearer(near)) {
    if (AreOfBothLegs(robot, gap) || Nth(of_limb, gap.a) || Nth(of_limb, gap.b)) continue;
    const auto link = [&](int body) { return LinkOf(Nth(robot.bodies, body)); };
    const int joints = LegJointsBetween(urdf, legs, robot, gap);
    if (joints > 2 && gap.standing >= near) continue;
    const auto is_there = [&](const ExcludedPair& pair) {
      return Names(pair, link(gap.a), link(gap.b));
    };
    if (std::any_of(excluded.begin(), excluded.end(), is_there)) continue;
    excluded.push_back({{link(gap.a), link(gap.b)},
                        Formatted("%d joints apart, %.1f mm standing, %.1f mm in six steps", joints,
                                  1e3 * gap.standing, 1e3 * gap.least)});
  }
  return excluded;
}

}  // namespace halfstep
