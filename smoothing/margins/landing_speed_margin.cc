#include <algorithm>
#include <cmath>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/swing_foot_family.h"
#include "wpg/rounded.h"

namespace halfstep {
namespace {

// Up to here above its landing the limit is what it is; above, it grows with the height [m].
constexpr double kLast = 0.01;

// v·max(1, z/1 cm) − how fast the swing sole sinks [m/s], with its height z above the place where
// it lands and the limit v: the limit itself in the last centimetre; +∞ while both feet stand.
// Present where there is a limit. Subject: Index(Side). Source: smoothing/README.md, "Landing".
class LandingSpeedMargin final : public SwingFootFamily<LandingSpeedMargin> {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kLandingSpeed,
      .name = "landing_speed",
      .unit = "m/s",
      .key = "landing_speed_m_s",
      .meaning = "inside the limit of how fast the sole sinks in its last centimetre",
      .remedy = "a longer `half_step.duration_s`, a lower `half_step.via_height_m`",
      .sentence = kOfALimit,
      .coverage = {.why_not_demandable = AlwaysDemandable,
                   .limit = &MarginLimits::landing_speed,
                   .on_request = true},
      .scope = MarginScope::kRobot,
      .scale = 0.1,
      .demanded = 0.0,
      .raised = false,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kFootSpeed,
      .may_be_absent = true,
  };

  explicit LandingSpeedMargin(const MarginPlace&) : SwingFootFamily(kTraits) {}

  bool present(const MarginLimits& limits) const override {
    return limits.landing_speed.has_value();
  }

  bool Watches(const Instant& at) const { return at.limits().landing_speed.has_value(); }
  double Value(const Instant& at) const {
    return Allowed(at, HeightAbove(at)) + at.jet().first[Height(at)];
  }
  void AddRow(Instant* at, SlackSink* rows) const {
    const int z = Height(*at);
    const bool grows = HeightAbove(*at) > kLast;
    rows->Add(Value(*at), [&] {
      WalkJet gradient;
      gradient.first[z] = 1.0;
      if (grows) gradient.value[z] = *at->limits().landing_speed / kLast;
      return gradient;
    });
  }
  double Change(const MarginInterval& interval) const {
    const Instant& mid = interval.mid;
    const int z = Height(mid);
    const double here = HeightAbove(mid), lower = here - interval.motion.Change(z);
    // Both heights, and their difference from the landing.
    const double off =
        interval.motion.off.value[z] + 4.0 * kRoundoff * std::abs(mid.jet().value[z]);
    return Allowed(mid, here) - Allowed(mid, lower - off) + interval.motion.RateChange(z);
  }

 private:
  static int Height(const Instant& at) { return FootIndex(at.swing()) + 2; }
  static double HeightAbove(const Instant& at) {
    // A walk that stops on one foot has no landing: as if it were back to where the foot came from.
    const int up = 2 * at.step_in_air();
    const int i = up + 1 < at.walk().num_half_steps() ? up + 1 : up;
    const double landing = at.walk().X_WS(i).height + at.walk().half_step(i).X_SF.height;
    return at.jet().value[Height(at)] - landing;
  }
  static double Allowed(const Instant& at, double height) {
    return *at.limits().landing_speed * std::max(1.0, height / kLast);
  }
};

}  // namespace

const FamilyClass& ClassOf(TagOf<LandingSpeedMargin>) { return kClassOf<LandingSpeedMargin>; }

}  // namespace halfstep
