#include <algorithm>
#include <cmath>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/rounding.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Height of a body's lowest point above the floor [m]; −∞ when a leg does not reach. A body on a
// foot may touch the floor (BodyHeights). Subject: index of RobotModel::bodies.
class GroundMargin final : public WholeFamily {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kGround,
      .name = "ground",
      .unit = "m",
      .key = "ground_m",
      .meaning = "lowest point of a body above the floor; feet may touch it",
      .remedy =
          "a higher `half_step.via_height_m`, or knees that are bent less (`standing_posture_deg` "
          "of the robot file)",
      .sentence = {"{subject} is {amount} above the floor",
                   "{subject} is {amount} below the floor"},
      .coverage = kAlwaysCovered,
      .scope = MarginScope::kRobot,
      .scale = 0.01,
      .demanded = 0.0,
      .raised = false,
      .cost = MarginCost::kJointSpeeds,
      .row = MarginFamily::kFloor,
      .in_tube = [](const TubeShift& shift) { return shift.off_feet; },
  };

  explicit GroundMargin(const MarginPlace& place) : WholeFamily(kTraits), place_(place) {}

  int count() const override { return static_cast<int>(place_.robot.bodies.size()); }

  std::string Subject(const Margin& margin) const override {
    return BodyName(place_.robot, margin.subject);
  }

  std::vector<Side> PlacedFeet(const Margin& margin) const override {
    return FootOf(place_.robot, margin.subject);
  }

  Margin Least(Instant* at, double enough) const override {
    if (!at->reachable()) return Of(-kUnlimited, -1);
    return place_.heights.Least(at->posture(), at->jet().value, enough);
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    if (!at->regular()) return;
    const Posture& posture = at->posture();
    for (int b : place_.heights.of_legs()) {
      if (place_.heights.LowestPossible(b, posture) > rows->cutoff_margin()) continue;
      const RobotBody& body = Nth(place_.robot.bodies, b);
      const Eigen::Vector3d lowest = place_.heights.LowestPoint(b, posture);
      rows->AddOfPosture(at, lowest.z() - place_.heights.floor(), [&](PostureGradient* of) {
        of->AddPoint(body, posture, lowest, Eigen::Vector3d::UnitZ());
      });
    }
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    const BodyHeights& heights = place_.heights;
    const IntervalMotion& motion = interval.motion;
    const WalkState& x = motion.jet.value;
    const double rounding = DistanceRounding(x);
    for (int body : heights.on_feet()) {
      const Side side = static_cast<Side>(Nth(place_.robot.bodies, body).leg);
      const double off = motion.off.value[FootIndex(side) + 2];
      const double least = interval.LeastSole(side) - off - heights.floor();
      // On the floor or above it for all t, below it at the midpoint, or neither is known.
      const double margin = heights.OnFoot(body, x);
      const bool open = least < -kSoleRounding && margin > 0.0;
      tightest->Add(Of(open ? std::nan("") : margin, body), 0.0);
    }
    for (int body : heights.of_legs()) {
      const double change = Nth(motion.displacement, body);
      const double possible = heights.LowestPossible(body, motion.posture);
      if (tightest->Pass(possible - change - rounding)) continue;
      tightest->Add(Of(heights.LowestPoint(body, motion.posture).z() - heights.floor(), body),
                    change + rounding);
    }
    tightest->Add(Of(heights.of_waist().value + x[kWaistZ], heights.of_waist().subject),
                  motion.Change(kWaistZ) + rounding);
    tightest->count = count();  // the lowest of the waist's bodies for all
  }

 private:
  const MarginPlace& place_;
};

}  // namespace

const FamilyClass& ClassOf(TagOf<GroundMargin>) { return kClassOf<GroundMargin>; }

}  // namespace halfstep
