#include <cmath>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/swing_foot_family.h"

namespace halfstep {
namespace {

// Limit − |yaw rate| of the swing sole [rad/s]; +∞ without a limit and while both feet stand.
// Subject: Index(Side).
class FootYawRateMargin final : public SwingFootFamily<FootYawRateMargin> {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kFootYawRate,
      .name = "foot_yaw_rate",
      .unit = "rad/s",
      .key = "foot_yaw_rate_rad_s",
      .meaning = "inside the foot yaw rate limit",
      .remedy = "a longer `half_step.duration_s`, steps that turn less",
      .sentence = kOfALimit,
      .coverage = {.why_not_demandable = AlwaysDemandable, .limit = &MarginLimits::foot_yaw_rate},
      .scope = MarginScope::kRobot,
      .scale = 0.2,
      .demanded = 0.0,
      .raised = false,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kFootYawRate,
  };

  explicit FootYawRateMargin(const MarginPlace&) : SwingFootFamily(kTraits) {}

  bool Watches(const Instant& at) const { return at.limits().foot_yaw_rate.has_value(); }
  double Value(const Instant& at) const {
    return *at.limits().foot_yaw_rate - std::abs(at.jet().first[Yaw(at)]);
  }
  void AddRow(Instant* at, SlackSink* rows) const {
    const int yaw = Yaw(*at);
    const double rate = at->jet().first[yaw];
    if (rate == 0.0) return;
    rows->Add(Value(*at), [&] {
      WalkJet gradient;
      gradient.first[yaw] = rate < 0.0 ? 1.0 : -1.0;
      return gradient;
    });
  }
  double Change(const MarginInterval& interval) const {
    return interval.motion.RateChange(Yaw(interval.mid));
  }

 private:
  static int Yaw(const Instant& at) { return FootIndex(at.swing()) + 3; }
};

}  // namespace

const FamilyClass& ClassOf(TagOf<FootYawRateMargin>) { return kClassOf<FootYawRateMargin>; }

}  // namespace halfstep
