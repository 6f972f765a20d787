#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/tables/run_record.h"

namespace halfstep {

/// How many targets there are.
constexpr int kNumTargets = 3;
/// What counts as solved, by the gap to the best: within 1 %, within 5 %, and ∞: the method was not
/// interrupted. The walk is certified and the method's own (MethodRecord::solved).
constexpr std::array<double, kNumTargets> kTargets = {0.01, 0.05,
                                                      std::numeric_limits<double>::infinity()};

/// What it took a method to reach a target.
struct RuntimeToTarget {
  double wall = 0.0;    ///< [s]
  double effort = 0.0;  ///< Work::effort
};

/// One method in one case, beside the best of that case.
struct ComparedMethod {
  MethodRecord record;  ///< what its run folder says
  /// (cost − best)/|best|; +inf when the walk is not certified or not the method's own; nan for raw
  /// where the objective is not `fastest`: run folders do not hold its cost.
  double gap = 0.0;
  /// What it took until each target was first met; none: it was not met, a failure.
  std::array<std::optional<RuntimeToTarget>, kNumTargets> reached;
};

/// The methods that worked on one problem: a scenario with one objective.
struct ComparedCase {
  /// What the methods of the case have in common; problem: RunRecord::problem.
  std::string scenario, objective, problem;
  int half_steps = 0;                   ///< of the walk
  std::vector<NotCovered> not_covered;  ///< RunRecord::not_covered, of its first run
  /// Cost of the cheapest certified walk of its own that any method has, raw included for
  /// `fastest`; none when there is no such walk.
  std::optional<double> best_cost;
  std::string best_method;              ///< "run folder: method" of that walk
  std::vector<ComparedMethod> methods;  ///< raw first
};

/// A method as it is compared over cases: the same solver with other variables or
/// another objective is another one. Only cases of its objective count for it.
struct MethodKey {
  std::string name, variables, objective;  ///< as in MethodRecord
  bool operator==(const MethodKey&) const = default;
};

/// All runs that are compared.
struct Comparison {
  std::vector<ComparedCase> cases;  ///< in the order of appearance
  std::vector<MethodKey> methods;   ///< of all cases, in the order of appearance, without raw
};

/// Brings the methods together by scenario and the objective that each pursued. Targets of
/// `fastest` are tested along the way, by the durations in iterates.csv; it has no costs, so for
/// other objectives they are tested at the end only. Throws InputError when runs of one scenario
/// are not about the same problem, or when a method is there twice with different options or
/// results.
Comparison Compare(const std::vector<RunRecord>& runs);

/// The record of a case for a method; null when it was not run there, which counts as a failure.
const ComparedMethod* Find(const ComparedCase& one, const MethodKey& method);

/// One curve of a performance profile: the fraction of all cases that a method solved within
/// `ratio` times the least work of any method there. Work below 1 ms or an effort of 0.001 counts
/// as that. Source: [DolanMore2002].
struct ProfileCurve {
  int target = 0;        ///< of kTargets
  bool by_wall = false;  ///< the work is wall time [s]; else effort
  MethodKey method;      ///< whose curve this is
  std::vector<std::pair<double, double>>
      points;  ///< (ratio ≥ 1, fraction), both rising; a staircase
};
/// A curve for each target, each kind of work and each method, in this order.
std::vector<ProfileCurve> PerformanceProfiles(const Comparison& comparison);

/// A method over all cases. A failure counts as ten times the largest work that met the target in
/// that case, and as speed-up 1; cases that nobody solved are left out of the means of work.
struct MethodMeans {
  MethodKey method;  ///< whose means these are
  /// Cases of its objective; those where it was not run; those where its walk is certified.
  int cases = 0, missing = 0, certified = 0;
  std::array<int, kNumTargets> solved{};  ///< by target of kTargets: cases that it solved
  /// Cases where it was interrupted, or has no certified walk of its own.
  int failed() const { return cases - solved.back(); }
  double speedup = 1.0;  ///< geometric mean
  /// Shifted geometric means exp(mean log(v + s)) − s with s = 0.1 s and an effort of 0.1; nan
  /// when no case counts.
  std::array<RuntimeToTarget, kNumTargets> work;
};
/// One entry for each method of the comparison, in its order.
std::vector<MethodMeans> Means(const Comparison& comparison);

}  // namespace halfstep
