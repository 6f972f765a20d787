#include "smoothing/methods/incumbent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

namespace {

// A half-step that was refused for the m-th time is longer by kLonger·2^m of its T. One at which
// samples are violated begins as one that was refused kHeld times.
constexpr double kLonger = 0.01;
constexpr int kHeld = 3, kMostTimes = 5;

}  // namespace

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
      // a + (b - a) is not always b, and b may be where the range ends.
      values[k] = part == 1.0 ? to[k] : values[k] + part * (to[k] - values[k]);
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

// Half-steps of a step share numbers, so they stay together. They go half of the way that they
// went, at last or `wholly` none of it.
void HoldBack(size_t first, size_t last, bool wholly, std::vector<double>* lambda) {
  constexpr double kLeastPart = 0.3;
  for (size_t i = first / 2 * 2; i < std::min(lambda->size(), last / 2 * 2 + 2); ++i) {
    double& part = (*lambda)[i];
    part = !wholly && part > kLeastPart ? 0.5 * part : 0.0;
  }
}

std::vector<double> AllBut(const std::vector<bool>& held, size_t n) {
  std::vector<double> lambda(n, 1.0);
  for (size_t i = 0; i < held.size(); ++i) {
    if (held[i]) HoldBack(i, i, true, &lambda);
  }
  return lambda;
}

}  // namespace

HomotopyParameters Incumbent::Beside(const HomotopyParameters& candidate,
                                     const std::vector<bool>& held) const {
  return Between(candidate, AllBut(held, candidate.durations.size()));
}

HomotopyParameters Incumbent::Lengthened(const HomotopyParameters& candidate,
                                         const std::vector<int>& times) const {
  HomotopyParameters point = candidate;
  for (size_t k = 0; k < rules_.longest.size(); ++k) {
    if (times[k] == 0) continue;
    double& T = point.durations[k];
    T = std::max(T, std::min(rules_.longest[k], T * (1.0 + std::ldexp(kLonger, times[k]))));
  }
  return point;
}

double Incumbent::Toward(const HomotopyParameters& candidate, int attempts,
                         const std::vector<bool>& held) {
  refusals_.clear();
  const size_t n = candidate.durations.size();
  const bool lengthens = !rules_.longest.empty();
  std::vector<double> lambda = AllBut(lengthens ? std::vector<bool>() : held, n);
  std::vector<int> times(n, 0);
  for (size_t k = 0; k < held.size(); ++k) times[k] = held[k] ? kHeld : 0;
  std::vector<Margin> refusals;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (Replace(Between(Lengthened(candidate, times), lambda), &refusals)) {
      return std::accumulate(lambda.begin(), lambda.end(), 0.0) / static_cast<double>(n);
    }
    if (refusals.empty()) break;  // it would not cost less
    if (attempt == 0) refusals_ = refusals;
    if (!rules_.local) {
      for (double& part : lambda) part *= 0.5;
      continue;
    }
    const std::vector<double> before = lambda;
    bool longer = false;
    for (const Margin& refusal : refusals) {
      const size_t k = static_cast<size_t>(refusal.at.half_step), first = k > 0 ? k - 1 : 0;
      if (lengthens && times[k] < kMostTimes) {
        for (size_t i = first; i <= k; ++i) ++times[i];
        longer = true;
      } else {
        HoldBack(first, k + 1, false, &lambda);
      }
    }
    if (!longer && lambda == before) break;  // what is refused does not move
  }
  return 0.0;
}

Incumbent::Rules DemandedRules(const OverlapProgram& program, StretchProofs* proofs) {
  std::vector<double> longest;
  for (const ParameterRow& row : program.variables().table().rows()) {
    if (row.parameter.family == ParameterFamily::kDuration) longest.push_back(row.upper);
  }
  if (!program.options().parameters.durations) longest.clear();
  return {.cost = [&program](const HomotopyParameters& p) { return program.Cost(p); },
          .prove =
              [proofs](const SuperposedWalk& walk, double, MarginEvaluator::Scratch* scratch) {
                return proofs->Refusals(walk, scratch);
              },
          .longest =
              program.options().parameters.durations ? std::move(longest) : std::vector<double>()};
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
