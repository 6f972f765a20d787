#include "smoothing/methods/incumbent.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

Incumbent::Incumbent(const HalfStepSequence& sequence, Rules rules, HomotopyParameters start,
                     double cost, MarginEvaluator::Scratch* scratch)
    : sequence_(sequence),
      rules_(std::move(rules)),
      parameters_(std::move(start)),
      cost_(cost),
      scratch_(scratch) {}

HomotopyParameters Incumbent::Between(const HomotopyParameters& candidate,
                                      const std::vector<double>& lambda) const {
  HomotopyParameters point = parameters_;
  for (const ParameterFamily family : AllParameterFamilies()) {
    std::vector<double>& values = point.of(family);
    const std::vector<double>& to = candidate.of(family);
    for (size_t k = 0; k < values.size(); ++k) {
      const auto [first, last] = Traits(family).half_steps(static_cast<int>(k));
      const auto end = std::min(lambda.end(), lambda.begin() + last + 1);
      const double part = *std::min_element(lambda.begin() + first, end);
      values[k] += part * (to[k] - values[k]);
    }
  }
  ClampOverlaps(parameters_, &point);
  return point;
}

bool Incumbent::Replace(const HomotopyParameters& point, std::vector<Margin>* refusals) {
  refusals->clear();
  const double cost = rules_.cost(point);
  if (!(cost < cost_ - rules_.improvement)) return false;
  *refusals = rules_.prove(SuperposedWalk(sequence_, point), cost, scratch_);
  if (!refusals->empty()) {
    ++refused_;
    return false;
  }
  ++accepted_;
  parameters_ = point;
  cost_ = cost;
  if (rules_.accepted) rules_.accepted(point);
  return true;
}

namespace {

// Half-steps of a step share numbers, so they stay together.
void Hold(size_t first, size_t last, std::vector<double>* lambda) {
  for (size_t i = first / 2 * 2; i < std::min(lambda->size(), last / 2 * 2 + 2); ++i) {
    (*lambda)[i] = 0.0;
  }
}

std::vector<double> AllBut(const std::vector<bool>& held, size_t n) {
  std::vector<double> lambda(n, 1.0);
  for (size_t i = 0; i < held.size(); ++i) {
    if (held[i]) Hold(i, i, &lambda);
  }
  return lambda;
}

}  // namespace

HomotopyParameters Incumbent::Beside(const HomotopyParameters& candidate,
                                     const std::vector<bool>& held) const {
  return Between(candidate, AllBut(held, candidate.durations.size()));
}

double Incumbent::Toward(const HomotopyParameters& candidate, int attempts,
                         const std::vector<bool>& held) {
  refusals_.clear();
  const size_t n = candidate.durations.size();
  std::vector<double> lambda = AllBut(held, n);
  std::vector<Margin> refusals;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (Replace(Between(candidate, lambda), &refusals)) {
      return std::accumulate(lambda.begin(), lambda.end(), 0.0) / static_cast<double>(n);
    }
    if (refusals.empty()) break;  // it would not cost less
    if (attempt == 0) refusals_ = refusals;
    if (!rules_.local) {
      for (double& part : lambda) part *= 0.5;
      continue;
    }
    const std::vector<double> before = lambda;
    for (const Margin& refusal : refusals) {
      const size_t k = static_cast<size_t>(refusal.at.half_step);
      Hold(k > 0 ? k - 1 : 0, k + 1, &lambda);
    }
    if (lambda == before) break;  // what is refused does not move
  }
  return 0.0;
}

Incumbent::Rules DemandedRules(const OverlapProgram& program, StretchProofs* proofs) {
  return {.cost = [&program](const HomotopyParameters& p) { return program.Cost(p); },
          .prove =
              [proofs](const SuperposedWalk& walk, double, MarginEvaluator::Scratch* scratch) {
                return proofs->Refusals(walk, scratch);
              }};
}

Incumbent::Rules SafestRules(const OverlapProgram& program, const FeasibilityTest& test,
                             bool within_limit) {
  // What lies between the instants watched may be a little worse than what they show.
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
