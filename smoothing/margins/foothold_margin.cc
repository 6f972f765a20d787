#include <algorithm>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/standing_sole_family.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// How far inside its level the outline of a standing sole lies [m] (LevelBorders): the distance
// from the nearest place where the level ends or something stands on it; −∞ for one that stands at
// the height of no level. Absent where one level is everywhere. Subject: Index(Side). Other: the
// solid.
class FootholdMargin final : public StandingSoleFamily<FootholdMargin> {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kFoothold,
      .name = "foothold",
      .unit = "m",
      .key = "foothold_m",
      .meaning = "standing sole inside one level of uneven ground",
      .remedy = "other footsteps",
      .sentence = {"the {subject} is {amount} inside its level",
                   "the {subject} reaches {amount} over the edge of its level"},
      .coverage = kCoveredOnRequest,
      .scope = MarginScope::kRobot,
      .scale = 0.01,
      .demanded = 0.005,
      .raised = false,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kFloor,
      .may_be_absent = true,
      .untold = {" cannot be told, since the sole stands at the height of no level,",
                 " cannot be told: a sole stands at the height of no level"},
  };

  explicit FootholdMargin(const MarginPlace& place) : StandingSoleFamily(kTraits), place_(place) {
    for (const Eigen::Vector2d& corner : place.robot.sole_outline.colwise()) {
      reach_ = std::max(reach_, corner.norm());
    }
  }

  bool present(const MarginLimits&) const override { return Watches(); }

  std::string Subject(const Margin& margin) const override {
    const std::string foot = FootName(margin);
    if (margin.subject < 0 || margin.other < 0) return foot;
    return foot + " - " + Nth(place_.scene.ground->Solids(), margin.other).name;
  }

  bool Watches() const { return !place_.levels.empty(); }
  double Reach() const { return reach_; }
  auto DistanceOf(const WalkState& x, Side side) const {
    return [this, level = LevelOf(x, side)](const Pose2& X_WF) {
      return Nearest(X_WF, level).distance;
    };
  }
  Margin Standing(const Instant& at, Side side) const {
    const WalkState& x = at.jet().value;
    MarginScratch::OnLevel& last = Nth(at.scratch().on_level, Index(side));
    const Foothold X_WF(FootPose(x, side), x[FootIndex(side) + 2]);
    if (!last.known || last.X_WF != X_WF) {
      const int level = LevelOf(x, side);
      last = {X_WF,
              level < 0 ? LevelBorders::Nearest{-kUnlimited, -1} : Nearest(X_WF.Planar(), level),
              true};
    }
    Margin margin = Of(last.nearest.distance, Index(side));
    margin.other = last.nearest.solid;
    return margin;
  }

 private:
  int LevelOf(const WalkState& x, Side side) const {
    return place_.levels.LevelAt(x[FootIndex(side) + 2]);
  }
  LevelBorders::Nearest Nearest(const Pose2& X_WF, int level) const {
    return place_.levels.NearestTo(place_.robot.sole_outline, X_WF, level);
  }

  const MarginPlace& place_;
  double reach_ = 0.0;  // of the outline from the sole's centre [m]
};

}  // namespace

const FamilyClass& ClassOf(TagOf<FootholdMargin>) { return kClassOf<FootholdMargin>; }

}  // namespace halfstep
