#include "smoothing/margins/clearance_margin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/nth.h"

namespace halfstep {

int ClearanceMargin::count() const { return static_cast<int>(place_.robot.bodies.size()); }

std::string ClearanceMargin::Subject(const Margin& margin) const {
  const std::string body = BodyName(place_.robot, margin.subject);
  return margin.other < 0 ? body : body + " - " + Nth(place_.scene.obstacles, margin.other).name;
}

Margin ClearanceMargin::Least(Instant* at, double enough) const {
  if (!at->reachable()) return Of(-std::numeric_limits<double>::infinity(), -1);
  const double cap = std::min(enough, ClearanceCap(at->limits()));
  return place_.clearances.NearestObstacle(at->posture(), at->t(), cap, &at->scratch().bodies);
}

std::optional<Margin> ClearanceMargin::FirstBelow(Instant* at, double demanded) const {
  if (!at->reachable()) return Of(-std::numeric_limits<double>::infinity(), -1);
  return place_.clearances.FirstBodyBelow(at->posture(), at->t(), demanded, &at->scratch().bodies);
}

void ClearanceMargin::AddBelow(Instant* at, double demanded, std::vector<Margin>* below) const {
  if (!at->reachable()) return below->push_back(Of(-std::numeric_limits<double>::infinity(), -1));
  const BodyClearances& clearances = place_.clearances;
  BodyClearances::Scratch& scratch = at->scratch().bodies;
  for (size_t b = 0; b < clearances.num_bodies(); ++b) {
    if (clearances.BodyClears(b, at->posture(), at->t(), demanded, &scratch)) continue;
    below->push_back(clearances.OfBody(b, at->posture(), at->t(), demanded, &scratch));
  }
}

void ClearanceMargin::AddRows(Instant* at, SlackSink* rows) const {
  if (!at->regular()) return;
  const Posture& posture = at->posture();
  const BodyClearances& clearances = place_.clearances;
  BodyClearances::Scratch& scratch = at->scratch().bodies;
  const double far = rows->cutoff_margin();
  for (size_t b = 0; b < place_.robot.bodies.size(); ++b) {
    if (clearances.BodyClears(b, posture, at->t(), far, &scratch)) continue;
    const auto nearest = clearances.NearestTo(b, posture, at->t(), far, &scratch);
    if (nearest.obstacle < 0) continue;
    const Separation& gap = nearest.separation;
    const auto derivative = [&](size_t i) {
      return gap.normal_W.dot(
          PointTangent(place_.robot.bodies[b], posture, rows->tangents[i], gap.point_a_W));
    };
    // As time goes on the obstacle moves, and what is known of it changes.
    const Obstacle& obstacle = Nth(place_.scene.obstacles, nearest.obstacle);
    const Eigen::Vector3d velocity =
        obstacle.motion.VelocityAt(obstacle.X_WO, at->t(), gap.point_b_W);
    const double rate = -gap.normal_W.dot(velocity) - obstacle.motion.UncertaintyRateAt(at->t());
    rows->Add(nearest.margin, derivative, rate);
  }
}

Margin ClearanceMargin::OfGroup(uint16_t body) const { return Of(std::nan(""), body); }

FamilyProof ClearanceMargin::Prove(const MarginInterval& interval,
                                   std::vector<uint16_t>* open) const {
  const BodyClearances& clearances = place_.clearances;
  const Posture& posture = interval.motion.posture;
  BodyClearances::Scratch& scratch = interval.mid.scratch().bodies;
  const double demanded = interval.mid.demanded(family());
  const double rounding = interval.mid.rounding();
  const double cap = interval.mid.limits().clearance_cap;
  const double t = interval.mid.t();
  const double half_width = interval.motion.half_width;
  FamilyProof proof;
  std::erase_if(*open, [&](uint16_t body) {
    if (proof.violated) return false;
    const double bound = interval.motion.displacement[body] + rounding;  // of the body alone
    if (clearances.BodyClears(body, posture, t, demanded + bound, &scratch, half_width)) {
      if (interval.with_margins) {
        const double enough = std::max(cap, demanded + bound + rounding);
        const Margin margin = clearances.OfBody(body, posture, t, enough, &scratch, half_width);
        const double of_obstacle =
            margin.other < 0 ? 0.0 : clearances.obstacle_speed(margin.other) * half_width;
        proof.held.Add(margin, bound + of_obstacle);
      }
      return true;
    }
    if (!clearances.BodyClears(body, posture, t, demanded, &scratch)) {
      proof.violated = clearances.OfBody(body, posture, t, 1.0, &scratch);
    }
    return false;
  });
  return proof;
}

}  // namespace halfstep
