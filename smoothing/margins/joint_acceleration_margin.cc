#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/joint_family.h"
#include "wpg/motion/dynamics_slope.h"
#include "wpg/nth.h"
#include "wpg/robot/acceleration_limits.h"
#include "wpg/robot/gravity.h"

namespace halfstep {
namespace {

std::string StatesNoLimits(const RobotModel& robot) {
  if (HasAccelerationLimits(robot)) return "";
  return "the robot file states no limits (`acceleration_limits_rad_s2`)";
}

std::optional<NotCovered> AssumedLimits(const RobotModel& robot, const Scene&) {
  if (!robot.assumed_acceleration) return std::nullopt;
  return AssumedAccelerations(*robot.assumed_acceleration);
}

// ∂q̈/∂parameter along each parameter.
std::vector<ByLegs> AccelerationSlopes(Instant* at, SlackSink* rows) {
  std::vector<ByLegs> slopes;
  for (size_t i = 0; i < rows->sensitivities.size(); ++i) {
    const PostureTangent& tangent = rows->Tangents(at)[i];
    const DynamicsSlope slope(at->robot(), at->jet(), at->posture(), *at->motion(),
                              {rows->sensitivities[i].jet, tangent.q, tangent.speeds});
    slopes.push_back({slope.accelerations(Side::kLeft), slope.accelerations(Side::kRight)});
  }
  return slopes;
}

// Limit − |q̈| of a leg joint [rad/s²]; +∞ for a joint of which no limit is stated or assumed; −∞
// when a leg does not reach or is stretched to the singularity. Subject: 6·Index(Side) + joint.
// Present where the robot has a limit of any leg joint; where nothing is demanded
// (kNotDemanded) it has no rows, and its proofs say nothing. Masses need not be known. Source:
// wpg/README.md, "Dynamics of the whole robot"; smoothing/README.md, "Joint accelerations between
// instants".
class JointAccelerationMargin final : public JointSizeFamily<JointAccelerationMargin> {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kJointAcceleration,
      .name = "joint_acceleration",
      .unit = "rad/s²",
      .key = "joint_acceleration_rad_s2",
      .meaning =
          "inside the acceleration limits of the legs' joints, where the robot file states these "
          "or "
          "`smoothing.limits` assumes them; none: not demanded",
      .remedy =
          "a longer `half_step.duration_s`, shorter steps, a lower `half_step.via_height_m`; "
          "`acceleration_limits_rad_s2` of the robot file says what the joints are allowed",
      .sentence = kOfALimit,
      .coverage = {.why_not_demandable = StatesNoLimits, .assumes = AssumedLimits},
      .scope = MarginScope::kRobot,
      .scale = 5.0,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kJointSpeeds,
      // A row of its own would be there for robots without limits, too.
      .row = MarginFamily::kJointSpeed,
      .may_be_none = true,
      .most = 500.0,
      .may_be_absent = true,
  };

  explicit JointAccelerationMargin(const MarginPlace& place)
      : JointSizeFamily(kTraits, place), present_(HasAccelerationLimits(place.robot)) {}

  bool present(const MarginLimits&) const override { return present_; }
  int count() const override { return present_ ? 12 : 0; }
  int groups() const override { return present_ ? 1 : 0; }

  static std::optional<ByLegs> ValuesAt(Instant* at) {
    const RobotDynamics* motion = at->motion();
    if (motion == nullptr) return std::nullopt;
    return ByLegs{motion->accelerations(Side::kLeft), motion->accelerations(Side::kRight)};
  }
  static double Limit(const Instant&, const LegJoint& joint) { return joint.max_acceleration; }
  static void AddSize(Instant* at, const JointValue& of, double margin, SlackSink* rows,
                      std::vector<ByLegs>* made) {
    rows->AddAlong(margin, [&](size_t i) {
      if (made->empty()) *made = AccelerationSlopes(at, rows);
      return -of.sign * (*made)[i][of.leg][of.joint];
    });
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    Instant& mid = interval.mid;
    if (mid.demanded(family()) == kNotDemanded) {
      for (int i = 0; i < count(); ++i) tightest->Add(Of(kUnlimited, i), 0.0);
      return;
    }
    const std::optional<ByLegs> accelerations = ValuesAt(&mid);
    const Margin least = accelerations ? LeastOf(mid, *accelerations) : Of(-kUnlimited, -1);
    if (!(least.value >= mid.demanded(family()))) {  // no bound changes that
      tightest->Add(least, 0.0);
      return;
    }
    const RobotDrift& drift = interval.drift();
    ForEachJoint([&](size_t s, int j, const LegJoint& joint, int subject) {
      const double here = std::abs((*accelerations)[s][j]);
      const double change = Nth(drift.legs[s].joints, j).acceleration_drift;
      const double off = drift.rounding.accelerations[s][j];
      // |q̈| grows by no more than q̈ drifts, and to no more than it can be.
      const double rise = interval.motion.joints[s].acceleration[j] - here;
      tightest->Add(Of(Limit(mid, joint) - here, subject),
                    std::max(0.0, std::min(change + off, rise)));
    });
  }

 private:
  const bool present_;
};

}  // namespace

const FamilyClass& ClassOf(TagOf<JointAccelerationMargin>) {
  return kClassOf<JointAccelerationMargin>;
}

}  // namespace halfstep
