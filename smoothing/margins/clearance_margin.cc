#include <algorithm>
#include <cmath>

#include "smoothing/margins/family_class.h"
#include "smoothing/margins/rounding.h"
#include "smoothing/margins/tube_levers.h"
#include "smoothing/walk/walk_rounding.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Distance from a body of the robot to the obstacles where they are said to be at that time, less
// how far from there they may be, and less how far the body may be from its place in a tube
// [m]; at most the clearance cap; −∞ when a leg does not reach. The solids of the ground count as
// obstacles at rest, for a body on a foot those alone whose top is above its sole
// (BodyClearances).
// Proved body by body: over an interval each obstacle takes off its own speed times the half
// width, and the solids above the lowest that the sole may be in it count.
// Subject: index of RobotModel::bodies. Other: as Scene::NameOf counts.
class ClearanceMargin final : public MarginStatements {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kClearance,
      .name = "clearance",
      .unit = "m",
      .key = "clearance_m",
      .meaning = "robot to obstacles",
      .remedy = "a higher `half_step.via_height_m`, other footsteps, an obstacle elsewhere",
      .sentence = {"{first} is {amount} from {second}", "{first} is {amount} inside {second}"},
      .coverage = kAlwaysCovered,
      .scope = MarginScope::kScene,
      .scale = 0.01,
      .demanded = 0.005,
      .raised = true,
      .cost = MarginCost::kObstacles,
      .row = MarginFamily::kClearance,
      // What a tube takes is taken from the margin of each body.
      .in_tube = [](const TubeShift&) { return 0.0; },
  };

  explicit ClearanceMargin(const MarginPlace& place)
      : MarginStatements(kTraits), place_(place), levers_(place.robot) {}

  int count() const override { return static_cast<int>(place_.robot.bodies.size()); }

  std::string Subject(const Margin& margin) const override {
    const std::string body = BodyName(place_.robot, margin.subject);
    return margin.other < 0 ? body : body + " - " + place_.scene.NameOf(margin.other);
  }

  std::vector<Side> PlacedFeet(const Margin& margin) const override {
    if (margin.other < 0) return {};
    const Obstacle* obstacle = place_.scene.ObstacleAt(margin.other);
    const bool rests = obstacle == nullptr || obstacle->rests();
    return rests ? FootOf(place_.robot, margin.subject) : std::vector<Side>();
  }

  Margin Least(Instant* at, double enough) const override {
    if (!at->reachable()) return Of(-kUnlimited, -1);
    const double cap = std::min(enough, ClearanceCap(at->limits()));
    BodyClearances::Scratch& scratch = at->scratch().bodies;
    if (at->limits().tube == Tube{}) {
      return place_.clearances.NearestObstacle(at->posture(), at->t(), cap, &scratch);
    }
    Margin nearest = Of(cap, -1);
    for (size_t b = 0; b < place_.clearances.num_bodies(); ++b) {
      Lower(OfBody(*at, at->posture(), b, nearest.value), &nearest);
    }
    return nearest;
  }

  std::optional<Margin> FirstBelow(Instant* at, double demanded) const override {
    if (!at->reachable()) return Of(-kUnlimited, -1);
    if (at->limits().tube == Tube{}) {
      return place_.clearances.FirstBodyBelow(at->posture(), at->t(), demanded,
                                              &at->scratch().bodies);
    }
    for (size_t b = 0; b < place_.clearances.num_bodies(); ++b) {
      if (!place_.clearances.BodyClears(b, at->posture(), at->t(), demanded + WayOf(*at, b),
                                        &at->scratch().bodies)) {
        return OfBody(*at, at->posture(), b, demanded + 1.0);
      }
    }
    return std::nullopt;
  }

  void AddBelow(Instant* at, double demanded, std::vector<Margin>* below) const override {
    if (!at->reachable()) return below->push_back(Of(-kUnlimited, -1));
    const BodyClearances& clearances = place_.clearances;
    BodyClearances::Scratch& scratch = at->scratch().bodies;
    for (size_t b = 0; b < clearances.num_bodies(); ++b) {
      const double apart = demanded + WayOf(*at, b);
      if (clearances.BodyClears(b, at->posture(), at->t(), apart, &scratch)) continue;
      below->push_back(OfBody(*at, at->posture(), b, demanded));
    }
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    if (!at->regular()) return;
    const Posture& posture = at->posture();
    const BodyClearances& clearances = place_.clearances;
    BodyClearances::Scratch& scratch = at->scratch().bodies;
    for (size_t b = 0; b < place_.robot.bodies.size(); ++b) {
      const double way = WayOf(*at, b), far = rows->cutoff_margin() + way;
      if (clearances.BodyClears(b, posture, at->t(), far, &scratch)) continue;
      const auto nearest = clearances.NearestTo(b, posture, at->t(), far, &scratch);
      if (nearest.obstacle < 0) continue;
      const Separation& gap = nearest.separation;
      const auto gradient = [&](PostureGradient* of) {
        of->AddPoint(place_.robot.bodies[b], posture, gap.point_a_W, gap.normal_W);
      };
      // As time goes on the obstacle moves, and what is known of it changes.
      double rate = 0.0;
      if (const Obstacle* obstacle = place_.scene.ObstacleAt(nearest.obstacle)) {
        const Eigen::Vector3d velocity =
            obstacle->motion.VelocityAt(obstacle->X_WO, at->t(), gap.point_b_W);
        rate = -gap.normal_W.dot(velocity) - obstacle->motion.UncertaintyRateAt(at->t());
      }
      rows->AddOfPosture(at, nearest.margin - way, gradient, rate);
    }
  }

  int groups() const override { return count(); }

  Margin OfGroup(uint16_t body) const override { return Of(std::nan(""), body); }

  FamilyProof Prove(const MarginInterval& interval, std::vector<uint16_t>* open) const override {
    const BodyClearances& clearances = place_.clearances;
    const Posture& posture = interval.motion.posture;
    BodyClearances::Scratch& scratch = interval.mid.scratch().bodies;
    const double demanded = interval.mid.demanded(family());
    const double rounding = DistanceRounding(interval.motion.jet.value);
    const double cap = interval.mid.limits().clearance_cap;
    const double t = interval.mid.t();
    // Obstacles move by the exact time.
    const double half_width =
        interval.motion.half_width + TimeRounding(interval.mid.walk(), interval.mid.at().half_step);
    FamilyProof proof;
    std::erase_if(*open, [&](uint16_t body) {
      if (proof.violated) return false;
      const double bound = interval.motion.displacement[body] + rounding;  // of the body alone
      const double apart = demanded + WayOf(interval.mid, body), sinks = Sinks(interval, body);
      if (clearances.BodyClears(body, posture, t, apart + bound, &scratch, half_width, sinks)) {
        if (interval.with_margins) {
          const double enough = std::max(cap, demanded + bound + rounding);
          const Margin margin = OfBody(interval.mid, posture, body, enough, half_width, sinks);
          const double of_obstacle =
              margin.other < 0 ? 0.0 : clearances.obstacle_speed(margin.other) * half_width;
          proof.held.Add(margin, bound + of_obstacle);
        }
        return true;
      }
      if (!clearances.BodyClears(body, posture, t, apart, &scratch)) {
        proof.violated = OfBody(interval.mid, posture, body, 1.0);
      }
      return false;
    });
    return proof;
  }

 private:
  // How far a body may be from its place [m].
  double WayOf(const Instant& at, size_t body) const {
    return levers_.WayOf(body, at.limits().tube);
  }
  // How much lower the sole of a body on a foot may be within an interval, where that matters [m].
  double Sinks(const MarginInterval& interval, size_t b) const {
    const RobotBody& body = place_.robot.bodies[b];
    if (!place_.clearances.has_solids() || !IsOnFoot(body)) return 0.0;
    const Side side = static_cast<Side>(body.leg);
    return std::max(0.0, interval.motion.jet.value[FootIndex(side) + 2] - interval.LeastSole(side));
  }
  // The margin of a body; `cap` where nothing is nearer.
  Margin OfBody(const Instant& at, const Posture& posture, size_t body, double cap,
                double half_width = 0.0, double sinks = 0.0) const {
    const double way = WayOf(at, body);
    Margin margin = place_.clearances.OfBody(body, posture, at.t(), cap + way, &at.scratch().bodies,
                                             half_width, sinks);
    margin.value -= way;
    return margin;
  }

  const MarginPlace& place_;
  TubeLevers levers_;
};

}  // namespace

const FamilyClass& ClassOf(TagOf<ClearanceMargin>) { return kClassOf<ClearanceMargin>; }

}  // namespace halfstep
