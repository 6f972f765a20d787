#include "experiments/survey/limbs.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Vector3d;

constexpr size_t kFewest = 4;  // moving joints of what may be a leg
// Of a limb's length: between distances that a mirror image has as well; between lengths and first
// joints of legs that differ; by how much deeper these reach than any mirror images.
constexpr double kSame = 0.05, kAlike = 0.1, kDeeper = 0.1;

constexpr std::string_view kOfArms[] = {"shoulder", "elbow", "wrist",  "arm",
                                        "hand",     "thumb", "finger", "gripper"};
constexpr std::string_view kOfLegs[] = {"leg",   "hip",  "thigh", "knee",   "shin",
                                        "shank", "calf", "ankle", "crotch", "foot"};

// Moving joints from the root to a link, the nearest to the root first.
std::vector<int> JointsAbove(const UrdfTree& urdf, int link) {
  std::vector<int> joints;
  for (int joint; (joint = Nth(urdf.links, link).joint) >= 0;) {
    const UrdfJoint& at = Nth(urdf.joints, joint);
    if (MeansToMove(at)) joints.push_back(joint);
    link = at.parent;
  }
  std::reverse(joints.begin(), joints.end());
  return joints;
}

// Links that a moving joint moves and that move no further one: ends of limbs.
std::vector<int> EndsOfLimbs(const UrdfTree& urdf) {
  std::vector<bool> is_end(urdf.links.size(), true);
  std::vector<int> ends;
  for (size_t link = urdf.links.size(); link-- > 1;) {
    const UrdfJoint& joint = Nth(urdf.joints, urdf.links[link].joint);
    if (MeansToMove(joint)) {
      if (is_end[link]) ends.push_back(static_cast<int>(link));
      Nth(is_end, joint.parent) = false;
    } else if (!is_end[link]) {
      Nth(is_end, joint.parent) = false;
    }
  }
  return ends;
}

// How many of the leading joints both have: chains of one tree part once.
size_t Common(const std::vector<int>& a, const std::vector<int>& b) {
  const size_t most = std::min(a.size(), b.size());
  return static_cast<size_t>(
      std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(most), b.begin()).first -
      a.begin());
}

bool HasWord(const std::string& name, std::string_view word) {
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  return std::search(name.begin(), name.end(), word.begin(), word.end(), same) != name.end();
}

class LegSearch {
 public:
  explicit LegSearch(const UrdfTree& urdf)
      : urdf_(urdf), X_(urdf.LinkPoses(std::vector<double>(urdf.joints.size(), 0.0))) {}

  std::optional<Limbs> Find(std::optional<Limbs>* arms) {
    std::vector<int> ends = EndsOfLimbs(urdf_);
    std::ranges::reverse(ends);  // so that the first in the file comes first
    std::vector<std::vector<int>> above;
    for (const int end : ends) above.push_back(JointsAbove(urdf_, end));
    for (size_t i = 0; i < ends.size(); ++i) {
      for (size_t k = i + 1; k < ends.size(); ++k) {
        const size_t fewest = std::min(above[i].size(), above[k].size());
        // Where they share so many there are fewer for each.
        if (fewest < kFewest || above[i][fewest - kFewest] == above[k][fewest - kFewest]) continue;
        const auto own = static_cast<std::ptrdiff_t>(Common(above[i], above[k]));
        Judge({{ends[i], ends[k]},
               {std::vector<int>(above[i].begin() + own, above[i].end()),
                std::vector<int>(above[k].begin() + own, above[k].end())}});
      }
    }
    *arms = arms_.limbs;
    const bool differ = alike_.limbs && (!mirrored_.limbs ||
                                         alike_.depth < mirrored_.depth - kDeeper * alike_.length);
    return differ ? alike_.limbs : mirrored_.limbs;
  }

 private:
  struct Best {
    double depth = std::numeric_limits<double>::infinity();  // mean height of what is reached [m]
    double length = 0.0;                                     // of the longer one [m]
    std::optional<Limbs> limbs;
  };

  Vector3d At(int joint) const { return Nth(X_, Nth(urdf_.joints, joint).child).translation(); }

  double LengthOf(const std::vector<int>& joints) const {
    double length = 0.0;
    for (size_t i = 1; i < joints.size(); ++i) length += (At(joints[i]) - At(joints[i - 1])).norm();
    return length;
  }

  // Whether joints of the one are as far from each other as those of the other.
  bool AreMirrored(const Limbs& limbs, double length) const {
    const auto& [a, b] = limbs.joints;
    if (a.size() != b.size()) return false;
    for (size_t i = 0; i < a.size(); ++i) {
      for (size_t k = i + 1; k < a.size(); ++k) {
        const double off = (At(a[i]) - At(a[k])).norm() - (At(b[i]) - At(b[k])).norm();
        if (std::abs(off) > kSame * length) return false;
      }
    }
    return true;
  }

  // Whether most joints have a name of arms, and none one of legs.
  bool IsArm(const std::vector<int>& joints) const {
    size_t of_arm = 0;
    for (const int index : joints) {
      const UrdfJoint& joint = Nth(urdf_.joints, index);
      const std::string& link = Nth(urdf_.links, joint.child).name;
      const auto named = [&](std::string_view word) {
        return HasWord(joint.name, word) || HasWord(link, word);
      };
      if (std::ranges::any_of(kOfLegs, named)) return false;
      if (std::ranges::any_of(kOfArms, named)) ++of_arm;
    }
    return 2 * of_arm > joints.size();
  }

  static void Keep(double depth, double length, const Limbs& limbs, Best* best) {
    if (depth < best->depth) *best = {depth, length, limbs};
  }

  void Judge(const Limbs& limbs) {
    const auto& [a, b] = limbs.joints;
    const double of_a = LengthOf(a), of_b = LengthOf(b), length = std::max(of_a, of_b);
    const double top_a = At(a.front()).z(), top_b = At(b.front()).z();
    const double depth = 0.5 * (top_a - of_a + top_b - of_b);
    const bool alike =
        std::abs(of_a - of_b) <= kAlike * length && std::abs(top_a - top_b) <= kAlike * length;
    if (!alike || depth >= std::max(mirrored_.depth, alike_.depth)) return;
    if (IsArm(a) && IsArm(b)) return Keep(depth, length, limbs, &arms_);
    Keep(depth, length, limbs, AreMirrored(limbs, length) ? &mirrored_ : &alike_);
  }

  const UrdfTree& urdf_;
  const std::vector<Eigen::Isometry3d> X_;
  Best mirrored_, alike_, arms_;
};

}  // namespace

bool MeansToMove(const UrdfJoint& joint) {
  return joint.kind != UrdfJoint::Kind::kFixed || !joint.faults.empty();
}

Limbs LimbsOf(const UrdfTree& urdf, int a, int b) {
  Limbs limbs{{a, b}, {JointsAbove(urdf, a), JointsAbove(urdf, b)}};
  const size_t common = Common(limbs.joints[0], limbs.joints[1]);
  for (std::vector<int>& own : limbs.joints) {
    own.erase(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(common));
  }
  return limbs;
}

std::optional<Limbs> FindLegPair(const UrdfTree& urdf, std::optional<Limbs>* arms) {
  return LegSearch(urdf).Find(arms);
}

}  // namespace halfstep
