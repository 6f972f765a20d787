#include "experiments/survey/found_legs.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/geometry/side.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr size_t kFewest = 5;  // moving joints of what may be a leg

[[noreturn]] void Refuse(const UrdfTree& urdf, const std::string& sentence) {
  throw InputError({urdf.file + ": " + sentence});
}

// Moving joints from the root to a link, the nearest to the root first.
std::vector<int> JointsAbove(const UrdfTree& urdf, int link) {
  std::vector<int> joints;
  for (int joint; (joint = Nth(urdf.links, link).joint) >= 0;) {
    const UrdfJoint& at = Nth(urdf.joints, joint);
    if (at.kind != UrdfJoint::Kind::kFixed) joints.push_back(joint);
    link = at.parent;
  }
  std::reverse(joints.begin(), joints.end());
  return joints;
}

// Links that a moving joint moves and that move no further one: ends of limbs.
std::vector<int> Ends(const UrdfTree& urdf) {
  std::vector<bool> is_end(urdf.links.size(), true);
  std::vector<int> ends;
  for (size_t link = urdf.links.size(); link-- > 1;) {
    const UrdfJoint& joint = Nth(urdf.joints, urdf.links[link].joint);
    if (joint.kind != UrdfJoint::Kind::kFixed) {
      if (is_end[link]) ends.push_back(static_cast<int>(link));
      Nth(is_end, joint.parent) = false;
    } else if (!is_end[link]) {
      Nth(is_end, joint.parent) = false;
    }
  }
  return ends;
}

// The last link on which both hang. Links come after those that they hang on.
int CommonLink(const UrdfTree& urdf, int a, int b) {
  while (a != b) {
    int& lower = a > b ? a : b;
    lower = Nth(urdf.joints, Nth(urdf.links, lower).joint).parent;
  }
  return a;
}

// A pair of limbs: the moving joints that each has for itself.
struct Limbs {
  std::array<int, 2> ends;
  std::array<std::vector<int>, 2> joints;
};

Limbs LimbsOf(const UrdfTree& urdf, int a, int b) {
  Limbs limbs{{a, b}, {JointsAbove(urdf, a), JointsAbove(urdf, b)}};
  auto& [first, second] = limbs.joints;
  size_t common = 0;
  while (common < std::min(first.size(), second.size()) && first[common] == second[common]) {
    ++common;
  }
  for (std::vector<int>& own : limbs.joints) {
    own.erase(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(common));
  }
  return limbs;
}

Limbs LowestPair(const UrdfTree& urdf) {
  const auto X = urdf.LinkPoses(std::vector<double>(urdf.joints.size(), 0.0));
  const std::vector<int> ends = Ends(urdf);
  double lowest = std::numeric_limits<double>::infinity();
  Limbs best;
  for (size_t i = 0; i < ends.size(); ++i) {
    for (size_t k = i + 1; k < ends.size(); ++k) {
      Limbs limbs = LimbsOf(urdf, ends[i], ends[k]);
      const size_t n = limbs.joints[0].size();
      if (n < kFewest || n != limbs.joints[1].size()) continue;
      const double height = Nth(X, ends[i]).translation().z() + Nth(X, ends[k]).translation().z();
      if (!(height < lowest)) continue;
      lowest = height;
      best = std::move(limbs);
    }
  }
  if (best.joints[0].empty()) {
    Refuse(urdf,
           "no two chains of at least five moving joints each hang on one link: there are no two "
           "legs (valid: two legs of six revolute joints)");
  }
  return best;
}

// −1: the first name is of the left side, +1: the second, 0: they do not tell.
int LeftOf(const std::string& a, const std::string& b) {
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const char x = static_cast<char>(std::tolower(static_cast<unsigned char>(a[i])));
    const char y = static_cast<char>(std::tolower(static_cast<unsigned char>(b[i])));
    if (x == y) continue;
    return x == 'l' && y == 'r' ? -1 : x == 'r' && y == 'l' ? 1 : 0;
  }
  return 0;
}

int LinkNamed(const UrdfTree& urdf, const std::string& name) {
  const int link = urdf.FindLink(name);
  if (link >= 0) return link;
  std::vector<std::string> names;
  for (const UrdfLink& each : urdf.links) names.push_back(each.name);
  Refuse(urdf, "has no link " + Quote(name) + Suggestion(name, names));
}

}  // namespace

FoundLegs FindLegs(const UrdfTree& urdf, const LegNames& names) {
  const bool named = !names.feet[0].empty() && !names.feet[1].empty();
  Limbs limbs = named
                    ? LimbsOf(urdf, LinkNamed(urdf, names.feet[0]), LinkNamed(urdf, names.feet[1]))
                    : LowestPair(urdf);
  FoundLegs found;
  int left = named ? -1 : 0;
  const auto joint_at = [&](size_t limb, size_t i) -> const UrdfJoint& {
    return Nth(urdf.joints, limbs.joints[limb][i]);
  };
  const size_t n = std::min(limbs.joints[0].size(), limbs.joints[1].size());
  if (n < 6) {
    std::string chain;
    for (size_t i = 0; i < n; ++i) chain += (i == 0 ? "" : ", ") + joint_at(0, i).name;
    Refuse(urdf, "a leg of it has " + std::to_string(n) + " moving joints (" + chain +
                     "), so the foot cannot be put everywhere (valid: 6)");
  }
  for (size_t i = 0; i < n && left == 0; ++i)
    left = LeftOf(joint_at(0, i).name, joint_at(1, i).name);
  found.sides_by_name = left != 0;
  if (left == 0) {
    const auto X = urdf.LinkPoses(std::vector<double>(urdf.joints.size(), 0.0));
    const auto y = [&](int end) { return Nth(X, end).translation().y(); };
    left = y(limbs.ends[0]) > y(limbs.ends[1]) ? -1 : 1;
  }
  if (left > 0) std::swap(limbs.joints[0], limbs.joints[1]);
  found.waist = names.waist.empty() ? CommonLink(urdf, joint_at(0, 0).parent, joint_at(1, 0).parent)
                                    : LinkNamed(urdf, names.waist);
  for (size_t side = 0; side < 2; ++side) {
    std::copy_n(limbs.joints[side].begin(), 6, found.joints[side].begin());
    found.feet[side] = joint_at(side, 5).child;
    for (size_t i = 6; i < n; ++i) found.beyond.push_back(joint_at(side, i).name);
  }
  return found;
}

}  // namespace halfstep
