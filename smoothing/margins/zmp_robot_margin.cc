#include <algorithm>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/support_edges.h"
#include "smoothing/margins/support_family.h"

namespace halfstep {
namespace {

// None where nothing can be said, or the floor does not push.
std::optional<Eigen::Vector2d> ZmpAt(Instant* at) {
  const RobotDynamics* dynamics = at->dynamics();
  return dynamics == nullptr ? std::nullopt : dynamics->Zmp();
}

// Distance of the whole robot's ZMP inside the support polygon [m], negative outside: masses and
// inertias of all links, angular momentum included, where the family `zmp` has a point mass.
// Subject: the step in the air, or −1. Where nothing is demanded (kNotDemanded) it has no rows,
// and its proofs say nothing; where the robot's masses are not known, or the floor does not push,
// it reads −∞. Source: wpg/README.md, "Dynamics of the whole robot".
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
    const auto zmp = ZmpAt(at);
    if (!zmp) return Of(-kUnlimited, at->step_in_air());
    Margin least = Of(kUnlimited, -1);
    Lower(Of(at->support().Margin(*zmp), at->step_in_air()), &least);
    return least;
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    if (at->demanded(family()) == kNotDemanded) return;
    const auto zmp = ZmpAt(at);
    if (!zmp) return;
    const SupportEdges edges(at);
    edges.ForEach([&](int i, const Eigen::Vector2d& inward) {
      rows->AddOfPosture(at, edges.Inside(i, inward, *zmp), [&](PostureGradient* of) {
        *of = GradientOf(at, at->dynamics()->ZmpGradient(inward));
        of->jet.value += edges.BySoles(i, inward, *zmp);
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
    const auto zmp = ZmpAt(&mid);
    if (!zmp) {
      tightest->Add(Of(-kUnlimited, step), 0.0);
      return;
    }
    const SupportEdges edges(&mid);
    const double margin = mid.support().Margin(*zmp);
    double least = margin;
    if (margin >= mid.demanded(family())) {
      const auto least_over = [&](const ZmpDrift& drift) {
        double over = margin;
        edges.ForEach([&](int i, const Eigen::Vector2d& inward) {
          over = std::min(over, edges.Inside(i, inward, *zmp) - drift.Along(inward));
        });
        return over;
      };
      least = least_over(interval.zmp_drift());
      const bool decided = least - mid.place().rounding.zmp >= mid.demanded(family());
      const ContactRate* rate = decided ? nullptr : interval.contact_rate();
      if (rate != nullptr) {
        least = std::max(least, least_over(ZmpDrift::At(*rate, mid.dynamics()->contact()[5])));
      }
    }
    tightest->Add(Of(margin, step), margin - least + mid.place().rounding.zmp);
  }
};

}  // namespace

const FamilyClass& ClassOf(TagOf<ZmpRobotMargin>) { return kClassOf<ZmpRobotMargin>; }

}  // namespace halfstep
