#include "smoothing/margins/self_clearance_margin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/nth.h"

namespace halfstep {

int SelfClearanceMargin::count() const { return static_cast<int>(place_.clearances.num_pairs()); }

std::string SelfClearanceMargin::Subject(const Margin& margin) const {
  return BodyName(place_.robot, margin.subject) + " - " + BodyName(place_.robot, margin.other);
}

Margin SelfClearanceMargin::Least(Instant* at, double enough) const {
  if (!at->reachable()) return Of(-std::numeric_limits<double>::infinity(), -1);
  const double cap = std::min(enough, ClearanceCap(at->limits()));
  return place_.clearances.NearestPair(at->posture(), cap, &at->scratch().bodies);
}

std::optional<Margin> SelfClearanceMargin::FirstBelow(Instant* at, double demanded) const {
  if (!at->reachable()) return Of(-std::numeric_limits<double>::infinity(), -1);
  return place_.clearances.FirstPairBelow(at->posture(), demanded, &at->scratch().bodies);
}

void SelfClearanceMargin::AddBelow(Instant* at, double demanded, std::vector<Margin>* below) const {
  if (!at->reachable()) return below->push_back(Of(-std::numeric_limits<double>::infinity(), -1));
  const BodyClearances& clearances = place_.clearances;
  BodyClearances::Scratch& scratch = at->scratch().bodies;
  clearances.Place(at->posture(), &scratch);
  for (size_t p = 0; p < clearances.num_pairs(); ++p) {
    if (clearances.PairClears(p, at->posture(), demanded, &scratch)) continue;
    below->push_back(clearances.OfPair(p, at->posture(), demanded, &scratch));
  }
}

void SelfClearanceMargin::AddRows(Instant* at, SlackSink* rows) const {
  if (!at->regular()) return;
  const Posture& posture = at->posture();
  const BodyClearances& clearances = place_.clearances;
  BodyClearances::Scratch& scratch = at->scratch().bodies;
  clearances.Place(posture, &scratch);
  for (size_t p = 0; p < clearances.num_pairs(); ++p) {
    if (clearances.PairClears(p, posture, rows->cutoff_margin(), &scratch)) continue;
    const Separation gap = clearances.SeparationOf(p, posture, &scratch);
    const auto [a, b] = place_.robot.self_pairs[p];
    const RobotBody& first = Nth(place_.robot.bodies, a);
    const RobotBody& second = Nth(place_.robot.bodies, b);
    rows->Add(gap.distance, [&](size_t i) {
      const PostureTangent& tangent = rows->tangents[i];
      return gap.normal_W.dot(PointTangent(first, posture, tangent, gap.point_a_W) -
                              PointTangent(second, posture, tangent, gap.point_b_W));
    });
  }
}

Margin SelfClearanceMargin::OfGroup(uint16_t pair) const {
  const auto [a, b] = place_.robot.self_pairs[pair];
  return Of(std::nan(""), a, b);
}

FamilyProof SelfClearanceMargin::Prove(const MarginInterval& interval,
                                       std::vector<uint16_t>* open) const {
  const BodyClearances& clearances = place_.clearances;
  const IntervalMotion& motion = interval.motion;
  BodyClearances::Scratch& scratch = interval.mid.scratch().bodies;
  const double demanded = interval.mid.demanded(family());
  const double rounding = interval.mid.rounding();
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
    if (clearances.PairClears(pair, motion.posture, demanded + bound, &scratch)) {
      if (interval.with_margins) {
        const double enough = std::max(cap, demanded + bound + rounding);
        proof.held.Add(clearances.OfPair(pair, motion.posture, enough, &scratch), bound);
      }
      return true;
    }
    if (!clearances.PairClears(pair, motion.posture, demanded, &scratch)) {
      proof.violated = clearances.OfPair(pair, motion.posture, 1.0, &scratch);
    }
    return false;
  });
  return proof;
}

}  // namespace halfstep
