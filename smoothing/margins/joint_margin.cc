#include <algorithm>
#include <cmath>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/joint_family.h"

namespace halfstep {
namespace {

// Distance of a joint's angle to the nearer of its two limits [rad]; −∞ when its leg does not
// reach. Subject: 6·Index(Side) + joint.
class JointMargin final : public JointFamily {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kJoint,
      .name = "joint",
      .unit = "rad",
      .key = "joint_rad",
      .meaning = "inside the joint limits",
      .remedy =
          "shorter steps, a lower via point, another `standing_posture_deg` or wider "
          "`joint_limits_deg` of the robot file",
      .sentence = kOfALimit,
      .coverage = kAlwaysCovered,
      .scope = MarginScope::kRobot,
      .scale = 0.05,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kPosture,
      .row = MarginFamily::kJoint,
      .in_tube = [](const TubeShift& shift) { return shift.tube.joint; },
  };

  explicit JointMargin(const MarginPlace& place) : JointFamily(kTraits, place) {}

  Margin Least(Instant* at, double) const override {
    Margin least = Of(kUnlimited, -1);
    ForEachJoint([&](size_t s, int j, const LegJoint& joint, int subject) {
      const LegIkSolution& ik = at->posture().ik[s];
      if (ik.status == LegIkStatus::kSolved) {
        Lower(Of(std::min(ik.q[j] - joint.lower, joint.upper - ik.q[j]), subject), &least);
      } else if (j == kKnee) {
        Lower(Of(-kUnlimited, subject), &least);
      }
    });
    return least;
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    if (!at->regular()) return;
    ForEachJoint([&](size_t s, int j, const LegJoint& joint, int) {
      const double q = at->posture().ik[s].q[j];
      rows->AddOfPosture(at, q - joint.lower, [&](PostureGradient* of) { of->q[s][j] = 1.0; });
      rows->AddOfPosture(at, joint.upper - q, [&](PostureGradient* of) { of->q[s][j] = -1.0; });
    });
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    const IntervalMotion& motion = interval.motion;
    const double h = motion.half_width;
    ForEachJoint([&](size_t s, int j, const LegJoint& joint, int subject) {
      const double q = motion.posture.ik[s].q[j], speed = motion.posture.speeds[s][j];
      const double acceleration = motion.joints[s].acceleration[j];
      const LegRounding& off = motion.rounding.legs[s];
      tightest->Add(Of(std::min(q - joint.lower, joint.upper - q), subject),
                    h * (std::abs(speed) + off.speeds[j] + 0.5 * h * acceleration) + off.q[j]);
    });
  }

 private:
  static constexpr int kKnee = 3;  // stands for a leg that does not reach
};

}  // namespace

const FamilyClass& ClassOf(TagOf<JointMargin>) { return kClassOf<JointMargin>; }

}  // namespace halfstep
