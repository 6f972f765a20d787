#include "experiments/survey/arm_posture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/collision/separation.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kTurnStep = 5 * std::numbers::pi / 180;
constexpr int kTurnSteps = 18;
constexpr double kBeside = 0.02;  // a limb's centre of mass is farther from the plane than this [m]

// All joints at or below which a joint's child hangs: links of the limb that it moves.
std::vector<bool> LinksBelow(const UrdfTree& urdf, int joint) {
  std::vector<bool> below(urdf.links.size(), false);
  Nth(below, Nth(urdf.joints, joint).child) = true;
  for (size_t i = 1; i < urdf.links.size(); ++i) {
    if (Nth(below, Nth(urdf.joints, urdf.links[i].joint).parent)) below[i] = true;
  }
  return below;
}

class Limb {
 public:
  Limb(const UrdfTree& urdf, int waist, const std::vector<RobotBody>& bodies, int joint)
      : urdf_(urdf), waist_(waist), below_(LinksBelow(urdf, joint)) {
    for (size_t i = 0; i < bodies.size(); ++i) {
      const RobotBody& body = bodies[i];
      if (body.leg >= 0) continue;
      const int link = urdf.FindLink(body.name.substr(0, body.name.find('#')));
      if (link < 0 || !Nth(below_, link)) continue;
      bodies_.push_back(static_cast<int>(i));
      links_.push_back(link);
    }
  }

  const std::vector<int>& bodies() const { return bodies_; }
  bool Has(int link) const { return Nth(below_, link); }

  std::vector<Isometry3d> PosesInB(const std::vector<double>& q) const {
    const std::vector<Isometry3d> X = urdf_.LinkPoses(q);
    const Isometry3d X_BRoot = Nth(X, waist_).inverse();
    std::vector<Isometry3d> poses;
    for (const int link : links_) poses.push_back(X_BRoot * Nth(X, link));
    return poses;
  }

  // Its bodies' displacements in B between two postures.
  std::vector<Isometry3d> Displacements(const std::vector<double>& from,
                                        const std::vector<double>& to) const {
    const std::vector<Isometry3d> before = PosesInB(from);
    std::vector<Isometry3d> after = PosesInB(to);
    for (size_t i = 0; i < after.size(); ++i) after[i] = after[i] * before[i].inverse();
    return after;
  }

  // Its centre of mass in B; the origin where it has no mass.
  Vector3d CenterOfMass(const std::vector<double>& q) const {
    const std::vector<Isometry3d> X = urdf_.LinkPoses(q);
    const Isometry3d X_BRoot = Nth(X, waist_).inverse();
    double mass = 0.0;
    Vector3d moment = Vector3d::Zero();
    for (size_t i = 0; i < below_.size(); ++i) {
      if (!below_[i]) continue;
      mass += urdf_.links[i].mass;
      moment += urdf_.links[i].mass * (X_BRoot * X[i] * urdf_.links[i].com);
    }
    return mass > 0.0 ? Vector3d(moment / mass) : Vector3d::Zero();
  }

  // Whether its mass is on one side of the plane of symmetry.
  bool IsBeside(const std::vector<double>& q) const {
    return std::abs(CenterOfMass(q).y()) > kBeside;
  }

  // Turns of one of its first four joints by an angle, one way or the other, within limits.
  std::vector<ArmTurn> TurnsBy(double angle, const std::vector<double>& q) const {
    std::vector<ArmTurn> turns;
    int joints = 0;
    for (size_t i = 1; i < urdf_.links.size() && joints < 4; ++i) {
      const int index = urdf_.links[i].joint;
      const UrdfJoint& joint = Nth(urdf_.joints, index);
      if (!below_[i] || joint.kind != UrdfJoint::Kind::kRevolute) continue;
      ++joints;
      for (const double turned : {Nth(q, index) + angle, Nth(q, index) - angle}) {
        if (turned >= joint.lower && turned <= joint.upper) turns.push_back({index, turned, ""});
      }
    }
    return turns;
  }

 private:
  const UrdfTree& urdf_;
  int waist_;
  std::vector<bool> below_;
  std::vector<int> bodies_, links_;
};

// The limbs that hang beside the plane of symmetry: joints that move one, none of them within
// another.
std::vector<Limb> FindLimbs(const UrdfTree& urdf, int waist, const std::vector<double>& posture,
                            const std::vector<RobotBody>& bodies) {
  std::vector<Limb> limbs;
  for (size_t i = 1; i < urdf.links.size(); ++i) {
    const int joint = urdf.links[i].joint;
    if (Nth(urdf.joints, joint).kind != UrdfJoint::Kind::kRevolute) continue;
    const bool within = std::any_of(limbs.begin(), limbs.end(), [&](const Limb& limb) {
      return limb.Has(static_cast<int>(i));
    });
    if (within) continue;
    Limb limb(urdf, waist, bodies, joint);
    if (!limb.bodies().empty() && limb.IsBeside(posture)) limbs.push_back(std::move(limb));
  }
  return limbs;
}

std::vector<double> Turned(std::vector<double> posture, const ArmTurn& turn) {
  Nth(posture, turn.joint) = turn.angle;
  return posture;
}

// The box along B's axes that holds a limb's bodies as they are.
Eigen::AlignedBox3d BoundsOf(const Limb& limb, const std::vector<RobotBody>& bodies) {
  Eigen::AlignedBox3d bounds;
  for (const int body : limb.bodies()) {
    const ConvexBody& shape = Nth(bodies, body).shape;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d d = Vector3d::Unit(axis);
      bounds.max()[axis] = std::max(bounds.max()[axis], Support(shape, d));
      bounds.min()[axis] = std::min(bounds.min()[axis], -Support(shape, -d));
    }
  }
  return bounds;
}

// Pairs of a limb's body, by its index in the limb, and one that is neither of it nor of the legs.
class Apart {
 public:
  Apart(const Limb& limb, const std::vector<RobotBody>& bodies, double apart)
      : limb_(limb), apart_(apart) {
    for (const RobotBody& body : bodies) shapes_.emplace_back(body.shape);
    const std::vector<Isometry3d> as_it_is(limb.bodies().size(), Isometry3d::Identity());
    for (size_t k = 0; k < limb.bodies().size(); ++k) {
      for (size_t other = 0; other < bodies.size(); ++other) {
        if (bodies[other].leg >= 0 || std::ranges::count(limb.bodies(), static_cast<int>(other))) {
          continue;
        }
        if (IsKept(as_it_is, {k, other})) pairs_.emplace_back(k, other);
      }
    }
  }

  // Whether all pairs that are apart as the limb is are so when its bodies are displaced by X_B.
  bool IsKept(const std::vector<Isometry3d>& X_B) const {
    return std::ranges::all_of(pairs_, [&](const auto& pair) { return IsKept(X_B, pair); });
  }

 private:
  bool IsKept(const std::vector<Isometry3d>& X_B, const std::pair<size_t, size_t>& pair) const {
    return Separate(Nth(shapes_, limb_.bodies()[pair.first]), X_B[pair.first], shapes_[pair.second],
                    Isometry3d::Identity())
               .distance >= apart_;
  }

  const Limb& limb_;
  const double apart_;
  std::vector<CollisionShape> shapes_;
  std::vector<std::pair<size_t, size_t>> pairs_;
};

}  // namespace

std::vector<bool> BodiesOfLimbs(const UrdfTree& urdf, int waist, const std::vector<double>& posture,
                                const RobotModel& robot) {
  std::vector<bool> of_limb(robot.bodies.size(), false);
  for (const Limb& limb : FindLimbs(urdf, waist, posture, robot.bodies)) {
    for (const int body : limb.bodies()) Nth(of_limb, body) = true;
  }
  return of_limb;
}

std::vector<ArmTurn> LowerArms(const UrdfTree& urdf, int waist, const std::vector<double>& posture,
                               const std::vector<RobotBody>& bodies, double apart) {
  std::vector<ArmTurn> turns;
  for (const Limb& limb : FindLimbs(urdf, waist, posture, bodies)) {
    const Vector3d sizes = BoundsOf(limb, bodies).sizes();
    if (sizes.y() <= sizes.z()) continue;
    const Apart others(limb, bodies, apart);
    ArmTurn best;
    double lowest = limb.CenterOfMass(posture).z();
    for (int step = 1; step <= kTurnSteps; ++step) {
      for (const ArmTurn& turn : limb.TurnsBy(step * kTurnStep, posture)) {
        const std::vector<double> turned = Turned(posture, turn);
        const double height = limb.CenterOfMass(turned).z();
        if (height >= lowest || !others.IsKept(limb.Displacements(posture, turned))) continue;
        lowest = height;
        best = turn;
      }
    }
    if (best.joint < 0) continue;
    best.why = Formatted("lowers the limb, which stretched %.2f m to the side", sizes.y());
    turns.push_back(best);
  }
  return turns;
}

std::vector<ArmTurn> KeepArmsOff(const UrdfTree& urdf, int waist,
                                 const std::vector<double>& posture, const RobotModel& robot,
                                 const SelfGaps& gaps, double apart) {
  std::vector<ArmTurn> turns;
  for (const Limb& limb : FindLimbs(urdf, waist, posture, robot.bodies)) {
    const double is = gaps.FromLegs(limb.bodies(), limb.Displacements(posture, posture), apart);
    if (is >= apart) continue;
    ArmTurn best;
    double farthest = is;
    for (int step = 1; step <= kTurnSteps && farthest < apart; ++step) {
      for (const ArmTurn& turn : limb.TurnsBy(step * kTurnStep, posture)) {
        const double distance =
            gaps.FromLegs(limb.bodies(), limb.Displacements(posture, Turned(posture, turn)), apart);
        if (distance <= farthest) continue;
        farthest = distance;
        best = turn;
      }
    }
    if (best.joint < 0) continue;
    best.why = Formatted("keeps the limb %.0f mm off the legs (%.0f mm without)", 1e3 * farthest,
                         1e3 * is);
    turns.push_back(best);
  }
  return turns;
}

}  // namespace halfstep
