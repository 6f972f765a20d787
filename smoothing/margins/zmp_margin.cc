#include "smoothing/margins/family_class.h"
#include "smoothing/margins/rounding.h"
#include "smoothing/margins/support_edges.h"
#include "smoothing/margins/support_family.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep {
namespace {

// Distance of the ZMP inside the support polygon [m], negative outside.
class ZmpMargin final : public SupportFamily {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kZmp,
      .name = "zmp",
      .unit = "m",
      .key = "zmp_m",
      .meaning = "ZMP inside the support polygon",
      .remedy =
          "a longer `half_step.duration_s` (the shorter a half-step, the farther the ZMP leaves "
          "the soles)",
      .sentence = {"the ZMP is {amount} inside the support polygon",
                   "the ZMP is {amount} outside the support polygon"},
      .coverage = kAlwaysCovered,
      .scope = MarginScope::kRobot,
      .scale = 0.01,
      .demanded = 0.01,
      .raised = true,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kZmp,
  };

  explicit ZmpMargin(const MarginPlace&) : SupportFamily(kTraits) {}

  Margin Least(Instant* at, double) const override {
    Margin least = Of(kUnlimited, -1);
    const double inside = at->support().Margin(at->jet().value.segment<2>(kZmpX));
    Lower(Of(inside, at->step_in_air()), &least);
    return least;
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    const SupportEdges edges(at);
    const Eigen::Vector2d zmp = at->jet().value.segment<2>(kZmpX);
    edges.ForEach([&](int i, const Eigen::Vector2d& inward) {
      rows->Add(edges.Inside(i, inward, zmp), [&] {
        WalkJet gradient;
        gradient.value = edges.BySoles(i, inward, zmp);
        gradient.value.segment<2>(kZmpX) += inward;
        return gradient;
      });
    });
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    const IntervalMotion& motion = interval.motion;
    const double h = motion.half_width;
    const double change =
        h * (motion.jet.first.segment<2>(kZmpX).norm() + motion.off.first.segment<2>(kZmpX).sum() +
             0.5 * h * motion.second.segment<2>(kZmpX).norm()) +
        motion.off.value.segment<2>(kZmpX).sum();
    const WalkState& x = motion.jet.value;
    const SupportPolygon polygon =
        SupportAt(interval.mid.walk(), interval.mid.at(), x, interval.mid.robot().sole_size);
    const double margin = polygon.Margin(x.segment<2>(kZmpX));
    tightest->Add(
        Of(margin, interval.mid.step_in_air()),
        change + SupportRounding(x, motion.off.value, interval.mid.robot().sole_size, margin));
  }
};

}  // namespace

const FamilyClass& ClassOf(TagOf<ZmpMargin>) { return kClassOf<ZmpMargin>; }

}  // namespace halfstep
