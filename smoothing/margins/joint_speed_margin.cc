#include <cmath>
#include <optional>
#include <vector>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/joint_family.h"

namespace halfstep {
namespace {

// Joint speed limit, times MarginLimits::joint_speed_scale, − |q̇| [rad/s]; −∞ when a leg does not
// reach or is stretched to the singularity. Subject: 6·Index(Side) + joint.
class JointSpeedMargin final : public JointSizeFamily<JointSpeedMargin> {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kJointSpeed,
      .name = "joint_speed",
      .unit = "rad/s",
      .key = "joint_speed_rad_s",
      .meaning = "inside the joint speed limits",
      .remedy = "a longer `half_step.duration_s`, a lower `half_step.via_height_m`, shorter steps",
      .sentence = kOfALimit,
      .coverage = kAlwaysCovered,
      .scope = MarginScope::kRobot,
      .scale = 0.5,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kJointSpeeds,
      .row = MarginFamily::kJointSpeed,
      .in_tube = [](const TubeShift& shift) { return shift.tube.joint_speed; },
  };

  explicit JointSpeedMargin(const MarginPlace& place) : JointSizeFamily(kTraits, place) {}

  static std::optional<ByLegs> ValuesAt(Instant* at) {
    if (!at->regular()) return std::nullopt;
    return at->posture().speeds;
  }
  static double Limit(const Instant& at, const LegJoint& joint) {
    return at.limits().joint_speed_scale * joint.max_speed;
  }
  static void AddSize(Instant* at, const JointValue& of, double margin, SlackSink* rows,
                      std::vector<ByLegs>*) {
    rows->AddOfPosture(at, margin, [&](PostureGradient* gradient) {
      gradient->speeds[of.leg][of.joint] = -of.sign;
    });
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    const IntervalMotion& motion = interval.motion;
    ForEachJoint([&](size_t s, int j, const LegJoint& joint, int subject) {
      tightest->Add(
          Of(Limit(interval.mid, joint) - std::abs(motion.posture.speeds[s][j]), subject),
          motion.half_width * motion.joints[s].acceleration[j] + motion.rounding.legs[s].speeds[j]);
    });
  }
};

}  // namespace

const FamilyClass& ClassOf(TagOf<JointSpeedMargin>) { return kClassOf<JointSpeedMargin>; }

}  // namespace halfstep
