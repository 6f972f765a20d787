#include <algorithm>
#include <cmath>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/rounding.h"
#include "smoothing/margins/tube_levers.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Distance between two of the robot's own bodies, less how much nearer they may be in a tube [m],
// at most the clearance cap; −∞ when a leg does not reach. Proved pair by pair. Subject and other:
// indices of RobotModel::bodies.
class SelfClearanceMargin final : public MarginStatements {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kSelfClearance,
      .name = "self_clearance",
      .unit = "m",
      .key = "self_clearance_m",
      .meaning = "between the robot's own bodies",
      .remedy =
          "`excluded_self_pairs` of the robot file if these links touch by design, another "
          "`standing_posture_deg`, or a foot that passes farther aside (`half_step.via_lateral_m`)",
      .sentence = {"{first} is {amount} from {second}", "{first} is {amount} inside {second}"},
      .coverage = kAlwaysCovered,
      .scope = MarginScope::kRobot,
      .scale = 0.01,
      .demanded = 0.005,
      .raised = true,
      .cost = MarginCost::kPairs,
      .row = MarginFamily::kSelfClearance,
      // What a tube takes is taken from the margin of each pair.
      .in_tube = [](const TubeShift&) { return 0.0; },
  };

  explicit SelfClearanceMargin(const MarginPlace& place)
      : MarginStatements(kTraits), place_(place), levers_(place.robot) {}

  int count() const override { return static_cast<int>(place_.clearances.num_pairs()); }

  std::string Subject(const Margin& margin) const override {
    return BodyName(place_.robot, margin.subject) + " - " + BodyName(place_.robot, margin.other);
  }

  std::vector<Side> PlacedFeet(const Margin& margin) const override {
    std::vector<Side> feet = FootOf(place_.robot, margin.subject);
    const std::vector<Side> other = FootOf(place_.robot, margin.other);
    if (feet.empty() || other.empty()) return {};  // the other body moves
    feet.insert(feet.end(), other.begin(), other.end());
    return feet;
  }

  Margin Least(Instant* at, double enough) const override {
    if (!at->reachable()) return Of(-kUnlimited, -1);
    const double cap = std::min(enough, ClearanceCap(at->limits()));
    BodyClearances::Scratch& scratch = at->scratch().bodies;
    if (at->limits().tube == Tube{}) {
      return place_.clearances.NearestPair(at->posture(), cap, &scratch);
    }
    place_.clearances.Place(at->posture(), &scratch);
    Margin nearest = Of(cap, -1);
    for (size_t p = 0; p < place_.clearances.num_pairs(); ++p) {
      Lower(OfPair(*at, at->posture(), p, nearest.value), &nearest);
    }
    return nearest;
  }

  std::optional<Margin> FirstBelow(Instant* at, double demanded) const override {
    if (!at->reachable()) return Of(-kUnlimited, -1);
    if (at->limits().tube == Tube{}) {
      return place_.clearances.FirstPairBelow(at->posture(), demanded, &at->scratch().bodies);
    }
    place_.clearances.Place(at->posture(), &at->scratch().bodies);
    for (size_t p = 0; p < place_.clearances.num_pairs(); ++p) {
      if (!place_.clearances.PairClears(p, at->posture(), demanded + NearerBy(*at, p),
                                        &at->scratch().bodies)) {
        return OfPair(*at, at->posture(), p, demanded + 1.0);
      }
    }
    return std::nullopt;
  }

  void AddBelow(Instant* at, double demanded, std::vector<Margin>* below) const override {
    if (!at->reachable()) return below->push_back(Of(-kUnlimited, -1));
    const BodyClearances& clearances = place_.clearances;
    BodyClearances::Scratch& scratch = at->scratch().bodies;
    clearances.Place(at->posture(), &scratch);
    for (size_t p = 0; p < clearances.num_pairs(); ++p) {
      if (clearances.PairClears(p, at->posture(), demanded + NearerBy(*at, p), &scratch)) continue;
      below->push_back(OfPair(*at, at->posture(), p, demanded));
    }
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    if (!at->regular()) return;
    const Posture& posture = at->posture();
    const BodyClearances& clearances = place_.clearances;
    BodyClearances::Scratch& scratch = at->scratch().bodies;
    clearances.Place(posture, &scratch);
    for (size_t p = 0; p < clearances.num_pairs(); ++p) {
      const double nearer = NearerBy(*at, p);
      if (clearances.PairClears(p, posture, rows->cutoff_margin() + nearer, &scratch)) continue;
      const Separation gap = clearances.SeparationOf(p, posture, &scratch);
      const auto [a, b] = place_.robot.self_pairs[p];
      const RobotBody& first = Nth(place_.robot.bodies, a);
      const RobotBody& second = Nth(place_.robot.bodies, b);
      rows->AddOfPosture(at, gap.distance - nearer, [&](PostureGradient* of) {
        of->AddPoint(first, posture, gap.point_a_W, gap.normal_W);
        of->AddPoint(second, posture, gap.point_b_W, -gap.normal_W);
      });
    }
  }

  int groups() const override { return count(); }

  Margin OfGroup(uint16_t pair) const override {
    const auto [a, b] = place_.robot.self_pairs[pair];
    return Of(std::nan(""), a, b);
  }

  FamilyProof Prove(const MarginInterval& interval, std::vector<uint16_t>* open) const override {
    const BodyClearances& clearances = place_.clearances;
    const IntervalMotion& motion = interval.motion;
    BodyClearances::Scratch& scratch = interval.mid.scratch().bodies;
    const double demanded = interval.mid.demanded(family());
    const double rounding = DistanceRounding(motion.jet.value);
    const double cap = interval.mid.limits().clearance_cap;
    FamilyProof proof;
    clearances.Place(motion.posture, &scratch);
    std::erase_if(*open, [&](uint16_t pair) {
      if (proof.violated) return false;
      const auto [i, j] = place_.robot.self_pairs[pair];
      const size_t a = static_cast<size_t>(i), b = static_cast<size_t>(j);
      const double bound = std::min(motion.displacement[a] + motion.displacement[b],
                                    motion.displacement_B[a] + motion.displacement_B[b]) +
                           rounding;
      const double apart = demanded + NearerBy(interval.mid, pair);
      if (clearances.PairClears(pair, motion.posture, apart + bound, &scratch)) {
        if (interval.with_margins) {
          const double enough = std::max(cap, demanded + bound + rounding);
          proof.held.Add(OfPair(interval.mid, motion.posture, pair, enough), bound);
        }
        return true;
      }
      if (!clearances.PairClears(pair, motion.posture, apart, &scratch)) {
        proof.violated = OfPair(interval.mid, motion.posture, pair, 1.0);
      }
      return false;
    });
    return proof;
  }

 private:
  // How much nearer the bodies of a pair may be [m].
  double NearerBy(const Instant& at, size_t pair) const {
    return levers_.NearerBy(pair, at.limits().tube);
  }
  // The margin of a pair that is placed; `cap` where they are farther from each other.
  Margin OfPair(const Instant& at, const Posture& posture, size_t pair, double cap) const {
    const double nearer = NearerBy(at, pair);
    Margin margin = place_.clearances.OfPair(pair, posture, cap + nearer, &at.scratch().bodies);
    margin.value -= nearer;
    return margin;
  }

  const MarginPlace& place_;
  TubeLevers levers_;
};

}  // namespace

const FamilyClass& ClassOf(TagOf<SelfClearanceMargin>) { return kClassOf<SelfClearanceMargin>; }

}  // namespace halfstep
