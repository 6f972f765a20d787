#include "smoothing/proof/interval_statements.h"

#include <algorithm>

#include "smoothing/walk/walk_rounding.h"

namespace halfstep {
namespace {

// Distances are asked only where nothing else is violated.
bool IsDistance(MarginFamily family) { return Traits(family).cost >= MarginCost::kObstacles; }

// In their own order, distances last.
std::vector<MarginFamily> ProofOrder(const MarginEvaluator& evaluator) {
  std::vector<MarginFamily> order;
  for (const MarginFamily family : evaluator.families()) {
    if (!IsDistance(family)) order.push_back(family);
  }
  for (const MarginFamily family : evaluator.families_by_cost()) {
    if (IsDistance(family)) order.push_back(family);
  }
  return order;
}

}  // namespace

IntervalStatements::IntervalStatements(MarginEvaluator evaluator)
    : evaluator_(std::move(evaluator)), bounds_(evaluator_.robot()) {
  for (const MarginFamily family : ProofOrder(evaluator_)) {
    for (int group = 0; group < evaluator_.statements(family).groups(); ++group) {
      all_.push_back({family, static_cast<uint16_t>(group)});
    }
  }
}

OpenGroups IntervalStatements::All() const { return all_; }

std::optional<Margin> IntervalStatements::Prove(const SuperposedWalk& walk, double begin,
                                                double end, OpenGroups* open,
                                                MarginEvaluator::Scratch* scratch,
                                                Certificate* rows) const {
  ++scratch->work.intervals;
  IntervalMotion motion;
  BoundMotion(bounds_, walk, begin, end, &motion);
  const double middle = 0.5 * (begin + end);
  const LocalTime mid = walk.Locate(middle);
  if (!motion.bounded) {
    // Out of reach, or stretched: is it so at the midpoint, or only perhaps around it?
    return evaluator_.FirstViolation(walk, mid, scratch);
  }
  Instant instant(evaluator_.place(), evaluator_.limits(), walk, mid, motion.jet, motion.posture,
                  scratch);
  const MarginInterval interval(&instant, motion, rows != nullptr);
  const auto located = [&](Margin margin) {
    margin.at = mid;
    margin.t = middle;
    return margin;
  };
  std::optional<Margin> violated;
  std::vector<uint16_t> groups;
  size_t kept = 0;
  for (size_t first = 0, last = 0; first < open->size(); first = last) {
    const MarginFamily family = (*open)[first].family;
    groups.clear();
    for (; last < open->size() && (*open)[last].family == family; ++last) {
      groups.push_back((*open)[last].group);
    }
    if (!violated || !IsDistance(family)) {
      const FamilyProof proof = evaluator_.statements(family).Prove(interval, &groups);
      if (rows != nullptr && proof.held.count > 0) {
        rows->push_back(
            {begin, end, family, proof.held.count, located(proof.held.margin), proof.held.bound});
      }
      if (proof.violated && !violated) violated = located(*proof.violated);
    }
    for (const uint16_t group : groups) (*open)[kept++] = {family, group};
  }
  open->erase(open->begin() + static_cast<std::ptrdiff_t>(kept), open->end());
  return violated;
}

void BoundMotion(const MotionBounds& bounds, const SuperposedWalk& walk, double begin, double end,
                 IntervalMotion* motion) {
  const LocalTime mid = walk.Locate(0.5 * (begin + end));
  const WalkJet rounding = RoundingAt(walk, mid);
  const WalkState second = walk.SecondBounds(begin, end) + SecondRounding(walk, begin, end);
  bounds.Bound(walk.At(mid), second, 0.5 * (end - begin), motion, &rounding);
}

}  // namespace halfstep
