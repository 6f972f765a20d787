#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/joint_family.h"
#include "wpg/motion/dynamics_slope.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/leg_torques.h"
#include "wpg/motion/torque_drift.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"
#include "wpg/robot/torque_limits.h"

namespace halfstep {
namespace {

// How the feet carry the robot; none where nothing can be said.
std::optional<FootLoads> LoadsAt(Instant* at) {
  const RobotDynamics* dynamics = at->dynamics();
  const StandingHeights heights = at->heights();
  const auto zmp = dynamics == nullptr ? std::nullopt : dynamics->Zmp(heights.of(Side::kLeft));
  if (!zmp) return std::nullopt;
  if (at->step_in_air() >= 0) return FootLoads::OneFoot(Opposite(at->swing()));
  const WalkState& x = at->jet().value;
  const Eigen::Vector2d& sole_size = at->robot().sole_size;
  if (heights.level()) {
    return FootLoads::BothFeet(FootPose(x, Side::kLeft), FootPose(x, Side::kRight), sole_size,
                               *zmp);
  }
  return FootLoads::OnLevels(x, heights, sole_size,
                             {*zmp, *dynamics->Zmp(heights.of(Side::kRight))});
}

// How far the ZMP goes within an interval in which both feet stand, in the plane of each sole.
double ZmpMoved(const MarginInterval& interval) {
  const ZmpDrift& drift = interval.zmp_drift();
  const StandingHeights heights = interval.mid.heights();
  if (heights.level()) return drift.Most();
  const double half_rise = 0.5 * heights.rise();
  return std::max(drift.Raised(half_rise).Most(), drift.Raised(-half_rise).Most());
}

ByLegs TorquesAt(const RobotDynamics& dynamics, const FootLoads& loads) {
  const auto of = [&](Side side) {
    return LegTorques(dynamics, side, loads.On(side, dynamics.contact()));
  };
  return {of(Side::kLeft), of(Side::kRight)};
}

// ∂torque/∂parameter, along each parameter.
std::vector<ByLegs> TorqueSlopes(Instant* at, const FootLoads& loads, SlackSink* rows) {
  const RobotDynamics& dynamics = *at->dynamics();
  const Vector6d& contact = dynamics.contact();
  std::vector<ByLegs> slopes;
  for (size_t i = 0; i < rows->sensitivities.size(); ++i) {
    const PostureTangent& tangent = rows->Tangents(at)[i];
    const DynamicsSlope slope(at->robot(), at->jet(), at->posture(), dynamics,
                              {rows->sensitivities[i].jet, tangent.q, tangent.speeds});
    const Eigen::Vector2d zmp = dynamics.ZmpSlope(slope.contact(), at->heights().of(Side::kLeft));
    ByLegs& of_legs = slopes.emplace_back();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      Nth(of_legs, Index(side)) =
          LegTorqueSlopes(dynamics, slope, side, loads.On(side, contact),
                          loads.SlopeOn(side, contact, slope.contact(), zmp));
    }
  }
  return slopes;
}

// Torque limit − |torque| of a leg joint [N m], of the whole robot's dynamics: the foot that
// stands alone carries all of what the floor gives, two feet share it (FootLoads). +∞ for a joint
// whose limit is not known; −∞ when a leg does not reach or is stretched to the singularity,
// masses are not known, or the floor does not push. Subject: 6·Index(Side) + joint. Where nothing
// is demanded (kNotDemanded) it has no rows, and its proofs say nothing. Source: wpg/README.md,
// "Joint torques".
class TorqueMargin final : public JointSizeFamily<TorqueMargin> {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kTorque,
      .name = "torque",
      .unit = "N m",
      .key = "torque_n_m",
      .meaning =
          "inside the torque limits of the legs' joints, where these are known; none: not demanded",
      .remedy =
          "a longer `half_step.duration_s`, shorter steps, a lower `half_step.via_height_m`; "
          "`effort_limits_n_m` of the robot file says what the joints give",
      .sentence = kOfALimit,
      .coverage = {.why_not_demandable = TorqueFault},
      .scope = MarginScope::kRobot,
      .scale = 5.0,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kJointSpeeds,
      .row = MarginFamily::kTorque,
      .may_be_none = true,
      .most = 500.0,
  };

  explicit TorqueMargin(const MarginPlace& place) : JointSizeFamily(kTraits, place) {}

  static std::optional<ByLegs> ValuesAt(Instant* at) {
    const auto loads = LoadsAt(at);
    if (!loads) return std::nullopt;
    return TorquesAt(*at->dynamics(), *loads);
  }
  static double Limit(const Instant&, const LegJoint& joint) { return joint.max_torque; }
  static void AddSize(Instant* at, const JointValue& of, double margin, SlackSink* rows,
                      std::vector<ByLegs>* made) {
    rows->AddAlong(margin, [&](size_t i) {
      if (made->empty()) *made = TorqueSlopes(at, *LoadsAt(at), rows);
      return -of.sign * (*made)[i][of.leg][of.joint];
    });
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    Instant& mid = interval.mid;
    const bool demanded = mid.demanded(family()) != kNotDemanded;
    const auto loads = demanded ? LoadsAt(&mid) : std::nullopt;
    if (!loads) {
      for (int i = 0; i < count(); ++i) {
        tightest->Add(Of(demanded ? -kUnlimited : kUnlimited, i), 0.0);
      }
      return;
    }
    const ByLegs torques = TorquesAt(*mid.dynamics(), *loads);
    const Margin least = LeastOf(mid, torques);
    if (!(least.value >= mid.demanded(family()))) {
      tightest->Add(least, 0.0);
      return;
    }
    const bool both = mid.step_in_air() < 0;
    const TorqueDrift drift(interval.motion, interval.drift(), *mid.dynamics(), *loads,
                            both ? ZmpMoved(interval) : 0.0, kGravity,
                            both ? interval.SolesOff(kUnlimited, interval.zmp_drift()) : 0.0);
    const ByLegs drifts = {drift.Of(Side::kLeft), drift.Of(Side::kRight)};
    ForEachJoint([&](size_t s, int j, const LegJoint& joint, int subject) {
      tightest->Add(Of(Limit(mid, joint) - std::abs(torques[s][j]), subject), drifts[s][j]);
    });
  }
};

}  // namespace

const FamilyClass& ClassOf(TagOf<TorqueMargin>) { return kClassOf<TorqueMargin>; }

}  // namespace halfstep
