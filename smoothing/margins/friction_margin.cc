#include <algorithm>
#include <optional>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/support_family.h"
#include "wpg/motion/foot_friction.h"

namespace halfstep {
namespace {

// None where nothing can be said.
std::optional<FootFriction> FrictionAt(Instant* at) {
  const RobotDynamics* dynamics = at->dynamics();
  if (dynamics == nullptr) return std::nullopt;
  const StandingHeights heights = at->heights();
  if (heights.level()) return FootFriction::Of(*dynamics, at->support(), heights.middle());
  return FootFriction::OnLevels(*dynamics, at->jet().value, heights, at->robot().sole_size);
}

std::optional<NotCovered> SceneWithoutFriction(const RobotModel&, const Scene& scene) {
  if (scene.friction != Scene{}.friction) return std::nullopt;
  return AssumedFriction(scene.friction);
}

// The floor's friction coefficient (Scene::friction) less the one that the soles need so as not to
// slip or turn, from the whole robot's dynamics. Needed is what suffices for a pressure of two
// points of the support polygon, as far before the ZMP as behind it: (‖f_t‖ + |n_z|/ρ)/f_z with
// the floor's tangential force f_t [N], its yaw moment n_z about the ZMP [N m], its push f_z [N]
// and the distance ρ of the points from the ZMP [m]. Where two soles stand at different heights,
// the polygon is a section between them (SoleSection). −∞ when a leg does not reach or is stretched
// to the singularity, masses are not known, the floor does not push, or the ZMP is outside.
// Subject: the step in the air, or −1. Where nothing is demanded (kNotDemanded) it has no rows,
// and its proofs say nothing. Source: wpg/README.md, "Friction that is needed"; [Caron2015].
class FrictionMargin final : public SupportFamily {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kFriction,
      .name = "friction",
      .unit = "1",
      .key = "friction",
      .meaning =
          "friction coefficient of the scene less what the soles need, yaw moment included; "
          "none: not demanded",
      .remedy =
          "a longer `half_step.duration_s`, a lower `half_step.via_height_m` (the swing leg's "
          "momentum turns the support foot)",
      .sentence = {"{family} of {subject}: {amount} of the floor's is left",
                   "{family} of {subject}: {amount} above the floor's"},
      .coverage = {.why_not_demandable = NeedsMasses, .assumes = SceneWithoutFriction},
      .scope = MarginScope::kRobot,
      .scale = 0.05,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kJointSpeeds,
      .row = MarginFamily::kFriction,
      .may_be_none = true,
      .untold = {kNeedsGround.at_instant,
                 " cannot be enough: the robot's ZMP is not inside the soles"},
  };

  explicit FrictionMargin(const MarginPlace& place) : SupportFamily(kTraits), place_(place) {}

  Margin Least(Instant* at, double) const override {
    const auto friction = FrictionAt(at);
    return Of(friction ? place_.scene.friction - friction->needed() : -kUnlimited,
              at->step_in_air());
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    if (at->demanded(family()) == kNotDemanded) return;
    const auto friction = FrictionAt(at);
    if (!friction) return;
    rows->AddOfPosture(at, place_.scene.friction - friction->needed(),
                       [&](PostureGradient* of) { *of = GradientOf(at, -friction->Gradient()); });
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    Instant& mid = interval.mid;
    if (mid.demanded(family()) == kNotDemanded) {
      tightest->Add(Of(kUnlimited, mid.step_in_air()), 0.0);
      return;
    }
    const Margin margin = Least(&mid, kUnlimited);
    double change = 0.0;
    if (margin.value >= mid.demanded(family())) {
      const auto friction = FrictionAt(&mid);
      const double spare = margin.value - mid.demanded(family());
      const double up = friction->height() - mid.heights().middle();
      const ZmpDrift& zmp = interval.zmp_drift();
      const double inside = friction->inside();
      change = friction->Drift(interval.drift(), up == 0.0 ? zmp : zmp.Raised(up),
                               interval.SolesOff(inside, zmp));
      const ContactRate* rate = change <= spare ? nullptr : interval.contact_rate();
      if (rate != nullptr) {
        const double off =
            interval.SolesOff(inside, ZmpDrift::At(*rate, mid.dynamics()->contact()[5]));
        change = std::min(change, friction->Drift(up == 0.0 ? *rate : rate->Raised(up), off));
      }
    }
    tightest->Add(margin, change);
  }

 private:
  const MarginPlace& place_;
};

}  // namespace

const FamilyClass& ClassOf(TagOf<FrictionMargin>) { return kClassOf<FrictionMargin>; }

}  // namespace halfstep
