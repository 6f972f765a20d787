#include <algorithm>

#include "smoothing/margins/family_class.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Length of the stretched leg − hip–ankle distance [m] (LegIkSolution::reach_margin). Subject:
// 6·Index(Side) + 3, the knee.
class ReachMargin final : public WholeFamily {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kReach,
      .name = "reach",
      .unit = "m",
      .key = "reach_m",
      .meaning = "leg shorter than stretched",
      .remedy =
          "shorter steps, a lower `half_step.via_height_m`, or knees that are bent more "
          "(`half_step.crouch_m`, or `standing_posture_deg` of the robot file)",
      .sentence = {"the {subject} is {amount} from stretched",
                   "the {subject} is {amount} too short"},
      .coverage = kAlwaysCovered,
      .scope = MarginScope::kRobot,
      .scale = 0.01,
      .demanded = 0.0,
      .raised = false,
      .cost = MarginCost::kPosture,
      .row = MarginFamily::kReach,
  };

  explicit ReachMargin(const MarginPlace&) : WholeFamily(kTraits) {}

  int count() const override { return 2; }

  std::string Subject(const Margin& margin) const override {
    return margin.subject < 6 ? "left leg" : "right leg";
  }

  std::vector<Side> PlacedFeet(const Margin&) const override { return {}; }

  Margin Least(Instant* at, double) const override {
    Margin least = Of(kUnlimited, -1);
    for (int s = 0; s < 2; ++s) {
      Lower(Of(Nth(at->posture().ik, s).reach_margin, 6 * s + 3), &least);
    }
    return least;
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    const Posture& posture = at->posture();
    if (!at->regular()) {
      // Out of reach, or stretched: how far is all that is known.
      const double reach = std::min(posture.ik[0].reach_margin, posture.ik[1].reach_margin);
      rows->Add(std::min(reach, 0.0) - 1e-3, [] { return WalkJet(); });
      return;
    }
    for (size_t s = 0; s < 2; ++s) {
      const Leg& leg = at->robot().legs[s];
      if (!leg.closed_form()) {
        const double slope = LegLengthAt(leg, posture.ik[s].q[3]).slope;
        rows->AddOfPosture(at, posture.ik[s].reach_margin,
                           [&](PostureGradient* of) { of->q[s][3] = -slope; });
        continue;
      }
      const Eigen::Vector3d hip_to_ankle =
          posture.frames[s].X_BLink[5] * (leg.joints[5].X_BLink.inverse() * leg.ankle_B) -
          leg.hip_B;
      const Eigen::Vector3d along = hip_to_ankle.normalized();
      const Eigen::Vector3d ankle_from_sole =
          hip_to_ankle + leg.hip_B - posture.frames[s].X_BLink[6].translation();
      rows->AddOfPosture(at, posture.ik[s].reach_margin, [&](PostureGradient* of) {
        const double by_turn = -along.dot(Eigen::Vector3d::UnitZ().cross(ankle_from_sole));
        of->sole_B[s] = -along;
        of->jet.value[FootIndex(static_cast<Side>(s)) + 3] = by_turn;
        of->waist_yaw = -by_turn;
      });
    }
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    for (int s = 0; s < 2; ++s) {
      const size_t i = static_cast<size_t>(s);
      tightest->Add(Of(interval.motion.posture.ik[i].reach_margin, 6 * s + 3),
                    interval.motion.leg_length_change[i]);
    }
  }
};

}  // namespace

const FamilyClass& ClassOf(TagOf<ReachMargin>) { return kClassOf<ReachMargin>; }

}  // namespace halfstep
