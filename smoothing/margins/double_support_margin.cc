#include <string>
#include <vector>

#include "smoothing/margins/family_class.h"

namespace halfstep {
namespace {

// A ZMP's shift may be shorter than demanded by this [s], so that one of exactly the demanded
// length counts, whatever its product is rounded to.
constexpr double kTolerance = 1e-12;

// Rows are there for so long before t1 and after t2, as a fraction of T: programs watch instants
// just outside of the shift, which move with it, so that no search leaves the row by a shorter one.
constexpr double kBeside = 1e-8;

// Calls visit(i) for each half-step i whose ZMP goes from foot to foot at the instant, t1 and t2
// included, and `beside` of T before and after.
template <typename Visit>
void ForEachShift(const Instant& at, double beside, const Visit& visit) {
  const SuperposedWalk& walk = at.walk();
  const LocalTime& named = at.at();
  const auto local = [&](int i) {
    return named.tau + (walk.start_of(named.half_step) - walk.start_of(i));
  };
  int i = named.half_step;
  while (i + 1 < walk.num_half_steps() && local(i + 1) > 0.0) ++i;
  for (; i >= 0 && local(i) < walk.tracks(i).duration(); --i) {
    const double wider = beside * walk.tracks(i).duration();
    if (local(i) < walk.tracks(i).t1() - wider || local(i) > walk.tracks(i).t2() + wider) continue;
    visit(i);
  }
}

double ShiftOf(const Instant& at, int i) {
  const HalfStep& half_step = at.walk().half_step(i);
  return half_step.shape.shift * half_step.duration + kTolerance;
}

// How long the ZMP of a half-step goes from foot to foot, 2δT [s]; +∞ while none does. It bounds
// from below how long both feet stand between two steps. Present where it is demanded. Subject: the
// half-step. Source: smoothing/README.md, "At most one foot in the air".
class DoubleSupportMargin final : public WholeFamily {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kDoubleSupport,
      .name = "double_support",
      .unit = "s",
      .key = "double_support_s",
      .meaning =
          "how long each half-step's ZMP goes from foot to foot, and so both feet stand between "
          "two steps; none: not demanded",
      .remedy =
          "a longer `half_step.zmp_shift_s`, which a longer `half_step.duration_s` makes room for",
      .sentence = {"{subject} changes support in {amount}",
                   "{subject} changes support in {amount}"},
      .coverage = kCoveredOnRequest,
      .scope = MarginScope::kRobot,
      .scale = 0.01,
      .demanded = kNotDemanded,
      .raised = false,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kDoubleSupport,
      .may_be_none = true,
      .most = 2.0,
      .may_be_absent = true,
  };

  explicit DoubleSupportMargin(const MarginPlace&) : WholeFamily(kTraits) {}

  bool present(const MarginLimits& limits) const override {
    return limits.demanded_of(MarginFamily::kDoubleSupport) != kNotDemanded;
  }
  int count() const override { return 1; }
  std::string Subject(const Margin& margin) const override {
    return margin.subject < 0 ? "no half-step" : "half-step " + std::to_string(margin.subject + 1);
  }
  std::vector<Side> PlacedFeet(const Margin&) const override { return {}; }

  Margin Least(Instant* at, double) const override {
    Margin least = Of(kUnlimited, -1);
    ForEachShift(*at, 0.0, [&](int i) { Lower(Of(ShiftOf(*at, i), i), &least); });
    return least;
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    ForEachShift(*at, kBeside, [&](int i) {
      rows->AddAlong(ShiftOf(*at, i), [&](size_t p) {
        const HomotopyParameter& along = rows->sensitivities[p].parameter;
        const HalfStep& half_step = at->walk().half_step(i);
        if (along == HomotopyParameter{ParameterFamily::kDuration, i}) {
          return half_step.shape.shift;
        }
        return along == HomotopyParameter{ParameterFamily::kZmpShift, i} ? half_step.duration : 0.0;
      });
    });
  }

 protected:
  // Shifts begin and end at knots, where intervals end: the shifts of the midpoint are those of the
  // interval, and they do not change.
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    tightest->Add(Least(&interval.mid, kUnlimited), 0.0);
  }
};

}  // namespace

const FamilyClass& ClassOf(TagOf<DoubleSupportMargin>) { return kClassOf<DoubleSupportMargin>; }

}  // namespace halfstep
