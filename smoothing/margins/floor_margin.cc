#include "smoothing/margins/family_class.h"
#include "smoothing/margins/swing_foot_family.h"

namespace halfstep {
namespace {

// Height of the swing sole above the floor while it moves horizontally [m]. Before its horizontal
// motion begins and after it ends, the foot may touch the floor and the margin is +∞. Subject:
// Index(Side).
class FloorMargin final : public SwingFootFamily<FloorMargin> {
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
  };

  explicit FloorMargin(const MarginPlace& place)
      : SwingFootFamily(kTraits), floor_(place.scene.ground->Floor()) {}

  bool Watches(const Instant& at) const {
    return at.walk().MovesHorizontally(at.step_in_air(), at.at());
  }
  double Value(const Instant& at) const { return at.jet().value[Height(at)] - floor_; }
  void AddRow(Instant* at, SlackSink* rows) const {
    const int z = Height(*at);
    rows->Add(Value(*at), [z] {
      WalkJet gradient;
      gradient.value[z] = 1.0;
      return gradient;
    });
  }
  double Change(const MarginInterval& interval) const {
    return interval.motion.Change(Height(interval.mid));
  }

 private:
  static int Height(const Instant& at) { return FootIndex(at.swing()) + 2; }

  double floor_;  // [m]
};

}  // namespace

const FamilyClass& ClassOf(TagOf<FloorMargin>) { return kClassOf<FloorMargin>; }

}  // namespace halfstep
