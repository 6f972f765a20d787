#include "experiments/compare/comparison.h"

#include <algorithm>
#include <cmath>

#include "wpg/elementary.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr double kRounding = 1e-9;  // relative: a gap of 1 % that is met exactly is met
constexpr RuntimeToTarget kLeast = {.wall = 0.001, .effort = 0.001};
constexpr RuntimeToTarget kShift = {.wall = 0.1, .effort = 0.1};
constexpr double kPenalty = 10.0;

MethodKey KeyOf(const MethodRecord& record) {
  return {record.name, record.variables, record.objective};
}

double Of(const RuntimeToTarget& work, bool by_wall) { return by_wall ? work.wall : work.effort; }

// Puts a method into its case, unless it is there already with the same outcome.
void Add(const MethodRecord& record, ComparedCase* one) {
  for (const ComparedMethod& there : one->methods) {
    if (KeyOf(there.record) != KeyOf(record)) continue;
    const bool same =
        there.record.requested == record.requested && there.record.duration == record.duration &&
        there.record.certified == record.certified && there.record.ending == record.ending;
    if (same) return;
    throw InputError({record.run + ": " + record.name + " on " + Quote(one->scenario) + " is in " +
                      there.record.run +
                      " too, with other options or another outcome (valid: LABEL=RUN tells them "
                      "apart)"});
  }
  one->methods.push_back({.record = record, .gap = 0.0, .reached = {}});
}

ComparedCase& CaseOf(const RunRecord& run, const std::string& objective, Comparison* comparison) {
  for (ComparedCase& one : comparison->cases) {
    if (one.scenario != run.scenario || one.objective != objective) continue;
    if (one.problem != run.problem) {
      throw InputError({run.run + ": is called " + Quote(run.scenario) + " like " +
                        one.methods.front().record.run +
                        ", but its footsteps, robot, scene, limits or demanded margins differ "
                        "(valid: another name, --set name=NAME)"});
    }
    return one;
  }
  ComparedCase& one = comparison->cases.emplace_back();
  one.scenario = run.scenario;
  one.objective = objective;
  one.problem = run.problem;
  one.half_steps = run.half_steps;
  one.not_covered = run.not_covered;
  Add(run.methods.front(), &one);
  return one;
}

bool Within(double value, double best, double target) {
  return value - best <= target * std::abs(best) + kRounding * std::abs(best);
}

// When a method's incumbent first met a finite target; along the way `fastest` is looked at only.
std::optional<RuntimeToTarget> Reached(const ComparedCase& one, const MethodRecord& record,
                                       double target) {
  if (!record.solved() || !one.best_cost) return std::nullopt;
  const RuntimeToTarget end{record.wall, record.effort};
  if (std::isinf(target)) {
    return record.ending == opt::Ending::kInterrupted ? std::nullopt : std::optional(end);
  }
  if (one.objective == "fastest") {
    const MethodRecord& raw = one.methods.front().record;
    if (raw.certified && Within(raw.duration, *one.best_cost, target)) return RuntimeToTarget{};
    for (const IncumbentRecord& incumbent : record.incumbents) {
      if (Within(incumbent.duration, *one.best_cost, target)) {
        return RuntimeToTarget{incumbent.wall, incumbent.effort};
      }
    }
  }
  return Within(record.cost, *one.best_cost, target) ? std::optional(end) : std::nullopt;
}

bool HasCost(const ComparedCase& one, const MethodRecord& record) {
  return !record.raw() || one.objective == "fastest";
}

void Measure(ComparedCase* one) {
  for (const ComparedMethod& method : one->methods) {
    const MethodRecord& record = method.record;
    if (!HasCost(*one, record) || !record.solved() ||
        (one->best_cost && *one->best_cost <= record.cost))
      continue;
    one->best_cost = record.cost;
    one->best_method = record.name;
  }
  for (ComparedMethod& method : one->methods) {
    method.gap = std::numeric_limits<double>::infinity();
    if (!HasCost(*one, method.record)) {
      method.gap = std::nan("");
      continue;
    }
    if (method.record.solved()) {
      const double above = method.record.cost - *one->best_cost;
      method.gap = above == 0.0 ? 0.0 : above / std::abs(*one->best_cost);
    }
    for (size_t k = 0; k < kNumTargets; ++k) {
      method.reached[k] = Reached(*one, method.record, kTargets[k]);
    }
  }
}

// The least (largest) work of any method but raw that met a target in a case.
std::optional<double> Extreme(const ComparedCase& one, size_t target, bool by_wall, bool least) {
  std::optional<double> found;
  for (const ComparedMethod& method : one.methods) {
    if (method.record.raw() || !method.reached[target]) continue;
    const double value = std::max(Of(*method.reached[target], by_wall), Of(kLeast, by_wall));
    if (!found || (least ? value < *found : value > *found)) found = value;
  }
  return found;
}

std::vector<double> Ratios(const Comparison& comparison, const MethodKey& key, size_t target,
                           bool by_wall) {
  std::vector<double> ratios;
  for (const ComparedCase& one : comparison.cases) {
    const ComparedMethod* method = Find(one, key);  // none of another objective
    if (method == nullptr || !method->reached[target]) continue;
    ratios.push_back(std::max(Of(*method->reached[target], by_wall), Of(kLeast, by_wall)) /
                     *Extreme(one, target, by_wall, /*least=*/true));
  }
  std::sort(ratios.begin(), ratios.end());
  return ratios;
}

double MeanWork(const Comparison& comparison, const MethodKey& key, size_t target, bool by_wall) {
  double sum = 0.0;
  int count = 0;
  for (const ComparedCase& one : comparison.cases) {
    if (one.objective != key.objective) continue;
    const std::optional<double> most = Extreme(one, target, by_wall, /*least=*/false);
    if (!most) continue;
    const ComparedMethod* method = Find(one, key);
    const bool solved = method != nullptr && method->reached[target];
    const double value = solved ? Of(*method->reached[target], by_wall) : kPenalty * *most;
    sum += Log(value + Of(kShift, by_wall));
    ++count;
  }
  return count == 0 ? std::nan("") : Exp(sum / count) - Of(kShift, by_wall);
}

}  // namespace

const ComparedMethod* Find(const ComparedCase& one, const MethodKey& method) {
  for (const ComparedMethod& candidate : one.methods) {
    if (KeyOf(candidate.record) == method) return &candidate;
  }
  return nullptr;
}

Comparison Compare(const std::vector<RunRecord>& runs) {
  Comparison comparison;
  for (const RunRecord& run : runs) {
    if (run.methods.size() == 1) CaseOf(run, "fastest", &comparison);
    for (const MethodRecord& record : run.methods) {
      if (record.raw()) continue;
      Add(record, &CaseOf(run, record.objective, &comparison));
      const MethodKey key = KeyOf(record);
      const bool known = std::find(comparison.methods.begin(), comparison.methods.end(), key) !=
                         comparison.methods.end();
      if (!known) comparison.methods.push_back(key);
    }
  }
  for (ComparedCase& one : comparison.cases) Measure(&one);
  return comparison;
}

std::vector<ProfileCurve> PerformanceProfiles(const Comparison& comparison) {
  std::vector<ProfileCurve> curves;
  const auto cases = [&](const MethodKey& key) {
    return std::count_if(comparison.cases.begin(), comparison.cases.end(),
                         [&](const ComparedCase& one) { return one.objective == key.objective; });
  };
  for (size_t target = 0; target < kNumTargets; ++target) {
    for (bool by_wall : {true, false}) {
      const size_t first = curves.size();
      double largest = 1.0;
      for (const MethodKey& key : comparison.methods) {
        ProfileCurve curve{static_cast<int>(target), by_wall, key, {{1.0, 0.0}}};
        const double all = static_cast<double>(cases(key));
        double solved = 0.0;
        for (double ratio : Ratios(comparison, key, target, by_wall)) {
          const double fraction = ++solved / all;
          if (curve.points.back().first == ratio) {
            curve.points.back().second = fraction;
          } else {
            curve.points.emplace_back(ratio, fraction);
          }
          largest = std::max(largest, ratio);
        }
        curves.push_back(std::move(curve));
      }
      for (size_t i = first; i < curves.size(); ++i) {  // all end at the same ratio
        const auto [ratio, fraction] = curves[i].points.back();
        if (ratio < largest) curves[i].points.emplace_back(largest, fraction);
      }
    }
  }
  return curves;
}

std::vector<MethodMeans> Means(const Comparison& comparison) {
  std::vector<MethodMeans> means;
  for (const MethodKey& key : comparison.methods) {
    MethodMeans& mean = means.emplace_back();
    mean.method = key;
    double logs = 0.0;
    for (const ComparedCase& one : comparison.cases) {
      if (one.objective != key.objective) continue;
      ++mean.cases;
      const ComparedMethod* method = Find(one, key);
      if (method == nullptr) {
        ++mean.missing;
        continue;
      }
      if (method->record.certified) ++mean.certified;
      if (method->record.solved()) logs += Log(method->record.speedup);
      for (size_t k = 0; k < kNumTargets; ++k) mean.solved[k] += method->reached[k] ? 1 : 0;
    }
    mean.speedup = Exp(logs / mean.cases);
    for (size_t k = 0; k < kNumTargets; ++k) {
      mean.work[k] = {MeanWork(comparison, key, k, true), MeanWork(comparison, key, k, false)};
    }
  }
  return means;
}

}  // namespace halfstep
