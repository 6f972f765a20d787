#include "experiments/survey/arm_posture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;

constexpr double kTurnStep = 5 * std::numbers::pi / 180;
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
  Limb(const UrdfTree& urdf, int waist, const RobotModel& robot, int joint)
      : urdf_(urdf), waist_(waist), below_(LinksBelow(urdf, joint)), root_(joint) {
    for (size_t i = 0; i < robot.bodies.size(); ++i) {
      const RobotBody& body = robot.bodies[i];
      if (body.leg >= 0) continue;
      const int link = urdf.FindLink(body.name.substr(0, body.name.find('#')));
      if (link < 0 || !Nth(below_, link)) continue;
      bodies_.push_back(static_cast<int>(i));
      links_.push_back(link);
    }
  }

  int root() const { return root_; }
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

  // Whether its mass is on one side of the plane of symmetry.
  bool IsBeside(const std::vector<double>& q) const {
    const std::vector<Isometry3d> X = urdf_.LinkPoses(q);
    const Isometry3d X_BRoot = Nth(X, waist_).inverse();
    double mass = 0.0, moment = 0.0;
    for (size_t i = 0; i < below_.size(); ++i) {
      if (!below_[i]) continue;
      mass += urdf_.links[i].mass;
      moment += urdf_.links[i].mass * (X_BRoot * X[i] * urdf_.links[i].com).y();
    }
    return mass > 0 && std::abs(moment / mass) > kBeside;
  }

 private:
  const UrdfTree& urdf_;
  int waist_;
  std::vector<bool> below_;
  int root_;
  std::vector<int> bodies_, links_;
};

// The limbs that hang beside the plane of symmetry: joints that move one, none of them within
// another.
std::vector<Limb> FindLimbs(const UrdfTree& urdf, int waist, const std::vector<double>& posture,
                            const RobotModel& robot) {
  std::vector<Limb> limbs;
  for (size_t i = 1; i < urdf.links.size(); ++i) {
    const int joint = urdf.links[i].joint;
    if (Nth(urdf.joints, joint).kind != UrdfJoint::Kind::kRevolute) continue;
    const bool within = std::any_of(limbs.begin(), limbs.end(), [&](const Limb& limb) {
      return limb.Has(static_cast<int>(i));
    });
    if (within) continue;
    Limb limb(urdf, waist, robot, joint);
    if (!limb.bodies().empty() && limb.IsBeside(posture)) limbs.push_back(std::move(limb));
  }
  return limbs;
}

}  // namespace

std::vector<bool> BodiesOfLimbs(const UrdfTree& urdf, int waist, const std::vector<double>& posture,
                                const RobotModel& robot) {
  std::vector<bool> of_limb(robot.bodies.size(), false);
  for (const Limb& limb : FindLimbs(urdf, waist, posture, robot)) {
    for (const int body : limb.bodies()) Nth(of_limb, body) = true;
  }
  return of_limb;
}

std::vector<ArmTurn> KeepArmsOff(const UrdfTree& urdf, int waist,
                                 const std::vector<double>& posture, const RobotModel& robot,
                                 const SelfGaps& gaps, double apart) {
  std::vector<ArmTurn> turns;
  for (const Limb& limb : FindLimbs(urdf, waist, posture, robot)) {
    const double is = gaps.FromLegs(limb.bodies(), limb.Displacements(posture, posture), apart);
    if (is >= apart) continue;
    // Its first four joints, from the waist on.
    std::vector<int> joints;
    for (size_t i = 1; i < urdf.links.size() && joints.size() < 4; ++i) {
      const int joint = urdf.links[i].joint;
      if (limb.Has(static_cast<int>(i)) &&
          Nth(urdf.joints, joint).kind == UrdfJoint::Kind::kRevolute) {
        joints.push_back(joint);
      }
    }
    ArmTurn best;
    double farthest = is;
    for (int step = 1; step <= 18 && farthest < apart; ++step) {
      for (const int joint : joints) {
        for (const double sign : {1.0, -1.0}) {
          std::vector<double> turned = posture;
          double& angle = Nth(turned, joint);
          angle += sign * step * kTurnStep;
          const UrdfJoint& limits = Nth(urdf.joints, joint);
          if (angle < limits.lower || angle > limits.upper) continue;
          const double distance =
              gaps.FromLegs(limb.bodies(), limb.Displacements(posture, turned), apart);
          if (distance <= farthest) continue;
          farthest = distance;
          best = {joint, angle,
                  Formatted("keeps the limb %.0f mm off the legs (%.0f mm without)", 1e3 * distance,
                            1e3 * is)};
        }
      }
    }
    if (best.joint >= 0) turns.push_back(best);
  }
  return turns;
}

}  // namespace halfstep
