#include "smoothing/margins/family_class.h"
#include "smoothing/margins/swing_foot_family.h"
#include "wpg/rounded.h"

namespace halfstep {
namespace {

// Limit − speed of the swing sole's centre [m/s]; +∞ without a limit and while both feet stand.
// Subject: Index(Side).
class FootSpeedMargin final : public SwingFootFamily<FootSpeedMargin> {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kFootSpeed,
      .name = "foot_speed",
      .unit = "m/s",
      .key = "foot_speed_m_s",
      .meaning = "inside the foot speed limit",
      .remedy = "a longer `half_step.duration_s`, shorter steps",
      .sentence = kOfALimit,
      .coverage = {.why_not_demandable = AlwaysDemandable, .limit = &MarginLimits::foot_speed},
      .scope = MarginScope::kRobot,
      .scale = 0.1,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kFootSpeed,
  };

  explicit FootSpeedMargin(const MarginPlace&) : SwingFootFamily(kTraits) {}

  bool Watches(const Instant& at) const { return at.limits().foot_speed.has_value(); }
  double Value(const Instant& at) const {
    return *at.limits().foot_speed - Velocity(at.jet(), at).norm();
  }
  void AddRow(Instant* at, SlackSink* rows) const {
    const Eigen::Vector3d velocity = Velocity(at->jet(), *at);
    const double speed = velocity.norm();
    if (speed <= 1e-6) return;
    rows->Add(*at->limits().foot_speed - speed, [&] {
      WalkJet gradient;
      gradient.first.segment<3>(FootIndex(at->swing())) = -velocity / speed;
      return gradient;
    });
  }
  double Change(const MarginInterval& interval) const {
    const IntervalMotion& motion = interval.motion;
    const int foot = FootIndex(interval.mid.swing());
    return motion.half_width * motion.second.segment<3>(foot).norm() +
           motion.off.first.segment<3>(foot).sum() +
           4.0 * kRoundoff * motion.jet.first.segment<3>(foot).norm();
  }

 private:
  static Eigen::Vector3d Velocity(const WalkJet& jet, const Instant& at) {
    return jet.first.segment<3>(FootIndex(at.swing()));
  }
};

}  // namespace

const FamilyClass& ClassOf(TagOf<FootSpeedMargin>) { return kClassOf<FootSpeedMargin>; }

}  // namespace halfstep
