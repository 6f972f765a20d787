#include <algorithm>
#include <vector>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/foot_solids.h"
#include "smoothing/margins/rounding.h"
#include "wpg/elementary.h"

namespace halfstep {
namespace {

// While the swing foot moves horizontally [m]: the height of its sole above the floor, and its
// distance from the solids of the ground (SolidGap), at most the clearance cap. Before its
// horizontal motion begins and after it ends, the foot may touch what is below it and the margin is
// +∞. Subject: Index(Side). Other: the solid, as Scene::NameOf counts.
class FloorMargin final : public WholeFamily {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kFloor,
      .name = "floor",
      .unit = "m",
      .key = "floor_m",
      .meaning = "height of the sole while it moves horizontally",
      .remedy = "a higher `half_step.via_height_m`, a longer `half_step.foot_delay`",
      .sentence = {"the {subject} is only {amount} high while it moves",
                   "the {subject} is only {amount} high while it moves"},
      .coverage = kAlwaysCovered,
      .scope = MarginScope::kRobot,
      .scale = 0.01,
      .demanded = 0.005,
      .raised = false,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kFloor,
      .in_tube = [](const TubeShift& shift) { return shift.sole; },
      .of_two = {"the {first} is only {amount} from {second} while it moves",
                 "the {first} is {amount} inside {second} while it moves"},
  };

  explicit FloorMargin(const MarginPlace& place)
      : WholeFamily(kTraits), place_(place), floor_(place.scene.ground->Floor()) {}

  int count() const override { return place_.solids.empty() ? 1 : 2; }  // floor, nearest solid

  std::string Subject(const Margin& margin) const override {
    const std::string foot = FootName(margin);
    return margin.other < 0 ? foot : foot + " - " + place_.scene.NameOf(margin.other);
  }
  std::vector<Side> PlacedFeet(const Margin&) const override { return {}; }

  Margin Least(Instant* at, double enough) const override {
    Margin least = Of(kUnlimited, -1);
    if (!IsWatched(*at)) return least;
    Lower(OfFloor(*at), &least);
    if (place_.solids.empty()) return least;
    std::vector<SolidGap> gaps;
    const double cap = std::min(enough, CapOf(at->limits()));
    place_.solids.Near(SoleOf(*at), cap, &gaps);
    if (gaps.empty()) Lower(Of(cap, Index(at->swing())), &least);
    for (const SolidGap& gap : gaps) Lower(OfSolid(*at, gap), &least);
    return least;
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    if (!IsWatched(*at)) return;
    const int foot = FootIndex(at->swing());
    rows->Add(OfFloor(*at).value, [foot] {
      WalkJet gradient;
      gradient.value[foot + 2] = 1.0;
      return gradient;
    });
    if (place_.solids.empty() || !(rows->cutoff_margin() > 0.0)) return;
    std::vector<SolidGap> gaps;
    const Foothold X_WF = SoleOf(*at);
    place_.solids.Near(X_WF, rows->cutoff_margin(), &gaps);
    for (const SolidGap& gap : gaps) {
      rows->Add(gap.Distance(), [&] {
        WalkJet gradient;
        gradient.value.segment<4>(foot) = place_.solids.Gradient(X_WF, gap);
        return gradient;
      });
    }
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    const Instant& mid = interval.mid;
    const IntervalMotion& motion = interval.motion;
    if (!IsWatched(mid)) {
      tightest->Add(Of(kUnlimited, -1), 0.0);
      tightest->count = count();
      return;
    }
    const int foot = FootIndex(mid.swing());
    const WalkState& x = motion.jet.value;
    const double rounding = PlanarRounding(x[foot], x[foot + 1]) + DistanceRounding(x);
    const double lifted = motion.Change(foot + 2);
    tightest->Add(OfFloor(mid), lifted + rounding);
    if (place_.solids.empty()) return;
    const double moved = Hypot(motion.Change(foot), motion.Change(foot + 1)) +
                         place_.solids.reach() * motion.Change(foot + 3);
    // Solids that may come nearer than this within the interval.
    constexpr double kMore = 1e-3;
    const double cap =
        interval.with_margins ? CapOf(mid.limits()) : std::max(mid.demanded(family()), 0.0) + kMore;
    std::vector<SolidGap> gaps;
    place_.solids.Near(SoleOf(mid), cap + moved + lifted, &gaps);
    tightest->Add(Of(cap, Index(mid.swing())), 0.0);
    for (const SolidGap& gap : gaps) {
      const Margin margin = OfSolid(mid, gap);
      tightest->Add(margin, margin.value - gap.LeastAfter(moved, lifted) + rounding);
    }
    tightest->count = count();
  }

 private:
  static bool IsWatched(const Instant& at) {
    return at.step_in_air() >= 0 && at.walk().MovesHorizontally(at.step_in_air(), at.at());
  }
  static Foothold SoleOf(const Instant& at) {
    const WalkState& x = at.jet().value;
    return {FootPose(x, at.swing()), x[FootIndex(at.swing()) + 2]};
  }
  // Solids that are farther are not told apart [m].
  static double CapOf(const MarginLimits& limits) {
    return std::max(ClearanceCap(limits), 2.0 * limits.demanded_of(MarginFamily::kFloor));
  }
  Margin OfFloor(const Instant& at) const {
    return Of(at.jet().value[FootIndex(at.swing()) + 2] - floor_, Index(at.swing()));
  }
  Margin OfSolid(const Instant& at, const SolidGap& gap) const {
    const int first = static_cast<int>(place_.scene.obstacles.size());
    return Of(gap.Distance(), Index(at.swing()), first + gap.solid);
  }

  const MarginPlace& place_;
  double floor_;  // [m]
};

}  // namespace

const FamilyClass& ClassOf(TagOf<FloorMargin>) { return kClassOf<FloorMargin>; }

}  // namespace halfstep
