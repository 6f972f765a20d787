#include "smoothing/methods/path_rules.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace halfstep {

FeasiblePath::Rules DemandedRules(const OverlapProgram& program, StretchProofs* proofs) {
  return {.cost = [&program](const HomotopyParameters& p) { return program.Cost(p); },
          .prove =
              [proofs](const SuperposedWalk& walk, double, MarginEvaluator::Scratch* scratch) {
                return proofs->Refusals(walk, scratch);
              }};
}

FeasiblePath::Rules SafestRules(const OverlapProgram& program, const FeasibilityTest& test,
                                bool within_limit) {
  // What lies between the table's instants may be a little worse than what they show.
  constexpr double kBetween = 0.01;
  const auto within = std::make_shared<bool>(within_limit);
  return {
      .cost =
          [&program, within](const HomotopyParameters& p) {
            const double cost = program.Cost(p);
            // Never is less proved than what is demanded.
            if (cost > 0.0) return std::numeric_limits<double>::infinity();
            return *within ? std::min(0.0, cost + kBetween) : 0.0;
          },
      .prove =
          [&test](const SuperposedWalk& walk, double cost, MarginEvaluator::Scratch* scratch) {
            MarginLimits limits = test.evaluator().limits();
            for (MarginFamily family : AllMarginFamilies()) {
              if (!Traits(family).raised) continue;
              limits.demanded_of(family) -= cost * Scale(family);
            }
            const MarginEvaluator raised = test.evaluator().WithLimits(limits);
            return StretchProofs(*test.Over(raised), walk.num_half_steps()).Refusals(walk, scratch);
          },
      .accepted = [within](const HomotopyParameters&) { *within = true; },
      .improvement = 1e-3,
      .local = false};
}

}  // namespace halfstep
