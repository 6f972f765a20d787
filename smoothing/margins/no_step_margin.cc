#include "smoothing/margins/family_class.h"
#include "smoothing/margins/standing_sole_family.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Distance of a standing foot from the no-step areas [m], by the outline of what touches the floor
// (NoStepAreas). Subject: Index(Side). Other: the area.
class NoStepMargin final : public StandingSoleFamily<NoStepMargin> {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kNoStep,
      .name = "no_step",
      .unit = "m",
      .key = "no_step_m",
      .meaning = "standing sole to no-step areas; touching is never allowed",
      .remedy = "other footsteps",
      .sentence = kOfALimit,
      .coverage = kAlwaysCovered,
      .scope = MarginScope::kScene,
      .scale = 0.01,
      .demanded = 0.0,
      .raised = false,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kFloor,
      .in_tube = [](const TubeShift& shift) { return shift.sole; },
  };

  explicit NoStepMargin(const MarginPlace& place) : StandingSoleFamily(kTraits), place_(place) {}

  std::string Subject(const Margin& margin) const override {
    if (margin.subject < 0) return "both feet";
    const std::string foot = FootName(margin);
    // As the scene file counts them.
    return margin.other < 0 ? foot : foot + " - no_step[" + std::to_string(margin.other) + "]";
  }

  bool Watches() const { return !place_.areas.empty(); }
  double Reach() const { return place_.areas.sole_reach(); }
  auto DistanceOf(const WalkState&, Side) const {
    return [this](const Pose2& X_WF) { return place_.areas.NearestTo(X_WF).distance; };
  }
  Margin Standing(const Instant& at, Side side) const {
    MarginScratch::Standing& standing = Nth(at.scratch().standing, Index(side));
    const Pose2 X_WF = FootPose(at.jet().value, side);
    if (!standing.known || standing.X_WF != X_WF) {
      standing = {X_WF, place_.areas.NearestTo(X_WF), true};
    }
    Margin margin = Of(standing.nearest.distance, Index(side));
    margin.other = standing.nearest.area;
    return margin;
  }

 private:
  const MarginPlace& place_;
};

}  // namespace

const FamilyClass& ClassOf(TagOf<NoStepMargin>) { return kClassOf<NoStepMargin>; }

}  // namespace halfstep
