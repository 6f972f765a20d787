#include "experiments/survey/found_legs.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "experiments/survey/limbs.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/geometry/side.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr size_t kJoints = 6;       // of a leg
constexpr double kParallel = 0.02;  // |sine| below which axes are parallel by design
constexpr const char* kTwoLegs = " (valid: two legs of six revolute joints)";

[[noreturn]] void Refuse(const UrdfTree& urdf, const std::string& sentence) {
  throw InputError({urdf.file + ": " + sentence});
}

std::string NamesOf(const UrdfTree& urdf, const std::vector<int>& joints) {
  std::string names;
  for (const int joint : joints) {
    names += (names.empty() ? "" : ", ") + Nth(urdf.joints, joint).name;
  }
  return names;
}

std::string JointsInWords(const UrdfTree& urdf, const std::vector<int>& joints) {
  return std::to_string(joints.size()) + " moving joints (" + NamesOf(urdf, joints) + ")";
}

Limbs LegsByStructure(const UrdfTree& urdf) {
  std::optional<Limbs> arms;
  if (const std::optional<Limbs> legs = FindLegPair(urdf, &arms)) return *legs;
  if (arms) {
    Refuse(urdf, "its only two limbs that hang on one link are arms by their names (" +
                     NamesOf(urdf, arms->joints[0]) + "): there are no two legs" + kTwoLegs);
  }
  Refuse(urdf,
         "no two chains of at least four moving joints each hang on one link: there are no two "
         "legs" +
             std::string(kTwoLegs));
}

// Axes of a limb's joints at zero, seen from the root.
std::vector<Eigen::Vector3d> AxesOf(const UrdfTree& urdf, const std::vector<int>& joints) {
  const auto X = urdf.LinkPoses(std::vector<double>(urdf.joints.size(), 0.0));
  std::vector<Eigen::Vector3d> axes;
  for (const int index : joints) {
    const UrdfJoint& joint = Nth(urdf.joints, index);
    axes.push_back(Nth(X, joint.child).linear() * joint.axis);
  }
  return axes;
}

// How a leg of more than six joints is made where its first six are no hip, knee and ankle; ""
// where they are, so that what is beyond are toes. A joint that is not understood has no axis.
std::string WhyNotSix(const UrdfTree& urdf, const std::vector<int>& joints) {
  const auto axes = AxesOf(urdf, joints);
  const auto parallel = [&axes](size_t i) { return axes[i].cross(axes[i + 1]).norm() < kParallel; };
  if (!parallel(0) && !parallel(1) && !parallel(4)) return "";
  const auto name = [&](size_t i) { return Nth(urdf.joints, joints[i]).name; };
  const auto how = [&](size_t i) {
    for (const auto& [one, other] : {std::pair{i, i + 1}, std::pair{i + 1, i}}) {
      if (Nth(urdf.joints, joints[one]).mimics == name(other)) {
        return name(one) + " mimics " + name(other);
      }
    }
    return name(i) + " and " + name(i + 1) + " turn about parallel axes";
  };
  const bool knee = !parallel(0) && !parallel(1) && parallel(3) && !parallel(5);
  if (knee) return "the knee is two joints, " + how(3);
  return "its first six are no hip of three joints, knee and ankle of two, for " +
         how(parallel(0)   ? 0
             : parallel(1) ? 1
                           : 4);
}

// In words: a joint that slides on a link of the limb, where the foot may be.
std::string SlidingOn(const UrdfTree& urdf, const std::vector<int>& joints) {
  for (const UrdfJoint& joint : urdf.joints) {
    if (!joint.slides) continue;
    int on = Nth(urdf.links, joint.parent).joint;
    while (on >= 0 && Nth(urdf.joints, on).kind == UrdfJoint::Kind::kFixed) {
      on = Nth(urdf.links, Nth(urdf.joints, on).parent).joint;
    }
    if (std::ranges::count(joints, on) > 0) return "; " + joint.name + " on it slides";
  }
  return "";
}

// Refuses what are no legs of six joints, toes beyond the sixth aside.
void AskForSixJoints(const UrdfTree& urdf, const Limbs& legs) {
  const auto& [a, b] = legs.joints;
  if (a.size() != b.size()) {
    Refuse(urdf, "one of its legs has " + JointsInWords(urdf, a) + ", the other one " +
                     JointsInWords(urdf, b) + ": they are no mirror images (valid: 6 each)");
  }
  if (a.size() < kJoints) {
    Refuse(urdf, "a leg of it has " + JointsInWords(urdf, a) +
                     ", so the foot cannot be put everywhere" + SlidingOn(urdf, a) + " (valid: 6)");
  }
  if (a.size() == kJoints) return;
  for (const std::vector<int>& joints : legs.joints) {
    if (const std::string why = WhyNotSix(urdf, joints); !why.empty()) {
      Refuse(urdf, "a leg of it has " + JointsInWords(urdf, joints) + ": " + why +
                       " (valid: 6, three of the hip, one of the knee, two of the ankle)");
    }
  }
}

// The last link on which both hang. Links come after those that they hang on.
int CommonLink(const UrdfTree& urdf, int a, int b) {
  while (a != b) {
    int& lower = a > b ? a : b;
    lower = Nth(urdf.joints, Nth(urdf.links, lower).joint).parent;
  }
  return a;
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
                    : LegsByStructure(urdf);
  AskForSixJoints(urdf, limbs);
  FoundLegs found;
  int left = named ? -1 : 0;
  const auto joint_at = [&](size_t limb, size_t i) -> const UrdfJoint& {
    return Nth(urdf.joints, limbs.joints[limb][i]);
  };
  const size_t n = limbs.joints[0].size();
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
    std::copy_n(limbs.joints[side].begin(), kJoints, found.joints[side].begin());
    found.feet[side] = joint_at(side, kJoints - 1).child;
    for (size_t i = kJoints; i < n; ++i) found.beyond.push_back(joint_at(side, i).name);
  }
  return found;
}

}  // namespace halfstep
