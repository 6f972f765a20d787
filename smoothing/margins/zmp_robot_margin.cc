#include <algorithm>
#include <optional>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/support_edges.h"
#include "smoothing/margins/support_family.h"
#include "wpg/motion/sole_shadows.h"

namespace halfstep {
namespace {

// Where the robot's ZMP is in the plane of the soles that stand, or halfway between them, and what
// it is to be inside of there: the soles where they are level, else the hull of their shadows.
class Balance {
 public:
  // None where nothing can be said, or the floor does not push.
  static std::optional<Balance> At(Instant* at) {
    const RobotDynamics* dynamics = at->dynamics();
    if (dynamics == nullptr) return std::nullopt;
    const StandingHeights heights = at->heights();
    const auto zmp = dynamics->Zmp(heights.middle());
    if (!zmp) return std::nullopt;
    Balance balance(at, *zmp);
    if (!heights.level()) {
      balance.shadows_.emplace(at->jet().value, heights, at->robot().sole_size, *dynamics);
    }
    return balance;
  }

  const Eigen::Vector2d& zmp() const { return zmp_; }
  SupportEdges Edges() const {
    return shadows_ ? SupportEdges(&at_, *shadows_) : SupportEdges(&at_);
  }
  double Margin() const { return shadows_ ? shadows_->Margin() : at_.support().Margin(zmp_); }
  // For all times at which the ZMP is no farther from here than `drift` says.
  double LeastOver(const ZmpDrift& drift) const {
    if (shadows_) return shadows_->LeastOver(drift);
    const SupportEdges edges = Edges();
    double least = Margin();
    edges.ForEach([&](int i, const Eigen::Vector2d& inward) {
      least = std::min(least, edges.Inside(i, inward, zmp_) - drift.Along(inward));
    });
    return least;
  }

 private:
  Balance(Instant* at, const Eigen::Vector2d& zmp) : at_(*at), zmp_(zmp) {}

  Instant& at_;
  Eigen::Vector2d zmp_;
  std::optional<SoleShadows> shadows_;
};

// Distance of the whole robot's ZMP inside the support polygon [m], negative outside: masses and
// inertias of all links, angular momentum included, where the family `zmp` has a point mass. Where
// two soles stand at different heights, it is how far the line of the ZMPs may be moved aside
// before it misses their hull in space: the ZMP's distance inside the hull of the soles' shadows.
// Subject: the step in the air, or −1. Where nothing is demanded (kNotDemanded) it has no rows,
// and its proofs say nothing; where the robot's masses are not known, or the floor does not push,
// it reads −∞. Source: wpg/README.md, "Dynamics of the whole robot", "Soles at different heights".
class ZmpRobotMargin final : public SupportFamily {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kZmpRobot,
      .name = "zmp_robot",
      .unit = "m",
      .key = "zmp_robot_m",
      .meaning =
          "ZMP of the whole robot, with all links' masses, inside the support polygon; none: not "
          "demanded",
      .remedy =
          "a longer `half_step.duration_s` or a lower `half_step.via_height_m` (the legs' momentum "
          "moves the ZMP), or another `half_step.support_point_m` where it is missed at rest on "
          "one "
          "foot",
      .sentence = {"the robot's ZMP is {amount} inside the support polygon",
                   "the robot's ZMP is {amount} outside the support polygon"},
      .coverage = kCoveredWithMasses,
      .scope = MarginScope::kRobot,
      .scale = 0.01,
      .demanded = 0.01,
      .raised = true,
      .cost = MarginCost::kJointSpeeds,
      .row = MarginFamily::kZmpRobot,
      .may_be_none = true,
      .untold = kNeedsGround,
      .in_tube = [](const TubeShift& shift) { return shift.tube.zmp + shift.sole; },
  };

  explicit ZmpRobotMargin(const MarginPlace&) : SupportFamily(kTraits) {}

  Margin Least(Instant* at, double) const override {
    const auto balance = Balance::At(at);
    if (!balance) return Of(-kUnlimited, at->step_in_air());
    Margin least = Of(kUnlimited, -1);
    Lower(Of(balance->Margin(), at->step_in_air()), &least);
    return least;
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    if (at->demanded(family()) == kNotDemanded) return;
    const auto balance = Balance::At(at);
    if (!balance) return;
    const Eigen::Vector2d& zmp = balance->zmp();
    const SupportEdges edges = balance->Edges();
    edges.ForEach([&](int i, const Eigen::Vector2d& inward) {
      rows->AddOfPosture(at, edges.Inside(i, inward, zmp), [&](PostureGradient* of) {
        *of = GradientOf(at, at->dynamics()->ZmpGradient(inward, edges.HeightBeside(i, zmp)));
        of->jet.value += edges.BySoles(i, inward, zmp);
      });
    });
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    Instant& mid = interval.mid;
    const int step = mid.step_in_air();
    if (mid.demanded(family()) == kNotDemanded) {
      tightest->Add(Of(kUnlimited, step), 0.0);
      return;
    }
    const auto balance = Balance::At(&mid);
    if (!balance) {
      tightest->Add(Of(-kUnlimited, step), 0.0);
      return;
    }
    const double margin = balance->Margin();
    double least = margin;
    if (margin >= mid.demanded(family())) {
      const auto least_over = [&](const ZmpDrift& drift) {
        return balance->LeastOver(drift) - interval.SolesOff(margin, drift);
      };
      least = least_over(interval.zmp_drift());
      const bool decided = least >= mid.demanded(family());
      const ContactRate* rate = decided ? nullptr : interval.contact_rate();
      if (rate != nullptr) {
        least = std::max(least, least_over(ZmpDrift::At(*rate, mid.dynamics()->contact()[5])));
      }
    }
    tightest->Add(Of(margin, step), margin - least);
  }
};

}  // namespace

const FamilyClass& ClassOf(TagOf<ZmpRobotMargin>) { return kClassOf<ZmpRobotMargin>; }

}  // namespace halfstep
