#include <algorithm>
#include <cmath>

#include "smoothing/margins/family_class.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// How far inside its level the outline of a standing sole lies [m] (LevelBorders): the distance
// from the nearest place where the level ends or something stands on it; +∞ for a foot in the air,
// −∞ for one that stands at the height of no level. Absent where one level is everywhere. There are
// rows where footsteps move (SlackSink::footsteps_move). Subject: Index(Side). Other: the solid.
class FootholdMargin final : public WholeFamily {
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

  explicit FootholdMargin(const MarginPlace& place) : WholeFamily(kTraits), place_(place) {
    for (const Eigen::Vector2d& corner : place.robot.sole_outline.colwise()) {
      reach_ = std::max(reach_, corner.norm());
    }
  }

  bool present(const MarginLimits&) const override { return !place_.levels.empty(); }
  int count() const override { return 2; }

  std::string Subject(const Margin& margin) const override {
    const std::string foot = FootName(margin);
    if (margin.subject < 0 || margin.other < 0) return foot;
    return foot + " - " + Nth(place_.scene.ground->Solids(), margin.other).name;
  }

  std::vector<Side> PlacedFeet(const Margin& margin) const override {
    if (margin.subject < 0) return {};
    return {static_cast<Side>(margin.subject)};
  }

  Margin Least(Instant* at, double) const override {
    Margin least = Of(kUnlimited, -1);
    for (Side side : {Side::kLeft, Side::kRight}) Lower(OfSole(*at, side), &least);
    return least;
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    if (!rows->footsteps_move) return;
    // Smooth but where another border becomes the nearest, as the distance of no_step.
    constexpr double kStep = 1e-6;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Margin margin = OfSole(*at, side);
      if (std::isinf(margin.value)) continue;
      const WalkState& x = at->jet().value;
      const int level = LevelOf(x, side);
      rows->AddAlong(margin.value, [&](size_t i) {
        const WalkState move = kStep * rows->sensitivities[i].jet.value;
        return (Nearest(FootPose(x + move, side), level).distance -
                Nearest(FootPose(x - move, side), level).distance) /
               (2.0 * kStep);
      });
    }
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    for (Side side : {Side::kLeft, Side::kRight}) {
      // A sole that stands does not move: its quantities change by 0 and rounding.
      const int foot = FootIndex(side);
      const IntervalMotion& motion = interval.motion;
      const double moved =
          Hypot(motion.Change(foot), motion.Change(foot + 1)) + reach_ * motion.Change(foot + 3);
      const Margin margin = OfSole(interval.mid, side);
      tightest->Add(margin, (std::isinf(margin.value) ? 0.0 : moved) + interval.mid.rounding());
    }
  }

 private:
  int LevelOf(const WalkState& x, Side side) const {
    return place_.levels.LevelAt(x[FootIndex(side) + 2]);
  }
  LevelBorders::Nearest Nearest(const Pose2& X_WF, int level) const {
    return place_.levels.NearestTo(place_.robot.sole_outline, X_WF, level);
  }

  // +∞ while it is in the air.
  Margin OfSole(const Instant& at, Side side) const {
    Margin margin = Of(kUnlimited, Index(side));
    if (at.walk().InAir(at.at(), side)) return margin;
    const WalkState& x = at.jet().value;
    MarginScratch::OnLevel& last = Nth(at.scratch().on_level, Index(side));
    const Foothold X_WF(FootPose(x, side), x[FootIndex(side) + 2]);
    if (!last.known || last.X_WF != X_WF) {
      const int level = LevelOf(x, side);
      last = {X_WF,
              level < 0 ? LevelBorders::Nearest{-kUnlimited, -1} : Nearest(X_WF.Planar(), level),
              true};
    }
    margin.value = last.nearest.distance;
    margin.other = last.nearest.solid;
    return margin;
  }

  const MarginPlace& place_;
  double reach_ = 0.0;  // of the outline from the sole's centre [m]
};

}  // namespace

const FamilyClass& ClassOf(TagOf<FootholdMargin>) { return kClassOf<FootholdMargin>; }

}  // namespace halfstep
