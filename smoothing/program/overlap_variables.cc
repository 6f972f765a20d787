#include "smoothing/program/overlap_variables.h"

#include <algorithm>
#include <cmath>

namespace halfstep {
namespace {

using Family = HomotopyParameter::Family;

constexpr double kBoundSmoothing = 1e-3;  // [s] below the natural bound where both sides meet

}  // namespace

OverlapVariables::OverlapVariables(const HalfStepSequence& sequence, bool heights, bool durations)
    : sequence_(sequence),
      heights_(heights),
      durations_(durations),
      planned_(PlannedMotion(sequence)) {
  for (const HomotopyParameter& parameter : AllParameters(sequence)) {
    if (parameter.family == Family::kOverlap ||
        (parameter.family == Family::kHeightScale && heights) ||
        (parameter.family == Family::kDuration && durations)) {
      variables_.push_back(parameter);
    }
  }
}

int OverlapVariables::IndexOf(const HomotopyParameter& parameter) const {
  const int overlaps = sequence_.num_junctions(), steps = sequence_.num_steps();
  switch (parameter.family) {
    case Family::kOverlap:
      return parameter.index;
    case Family::kHeightScale:
      return heights_ ? overlaps + parameter.index : -1;
    case Family::kDuration:
      return durations_ ? overlaps + (heights_ ? steps : 0) + parameter.index : -1;
  }
  return -1;
}

OverlapVariables::Bound OverlapVariables::OverlapBound(int junction,
                                                       const std::vector<double>& durations) const {
  const size_t i = static_cast<size_t>(junction);
  double a = 1.0, b = 1.0;  // of T_i, of T_{i+1}
  if (KindOfJunction(junction) == JunctionKind::kUpDown) {
    a = 1.0 - sequence_.half_steps[i].half_step.shape.t2();
    b = sequence_.half_steps[i + 1].half_step.shape.t1();
  }
  const double u = a * durations[i], v = b * durations[i + 1];
  if (!durations_) return {std::min(u, v), 0.0, 0.0};
  // (u + v)/2 − √((u − v)²/4 + ε²) ≤ min(u, v)
  const double half = 0.5 * (u - v);
  const double root = std::sqrt(half * half + kBoundSmoothing * kBoundSmoothing);
  return {0.5 * (u + v) - root, a * (0.5 - 0.5 * half / root), b * (0.5 + 0.5 * half / root)};
}

Eigen::VectorXd OverlapVariables::ToVariables(const HomotopyParameters& parameters) const {
  Eigen::VectorXd x(size());
  HomotopyParameters copy = parameters;
  for (int v = 0; v < size(); ++v) {
    x[v] = at(v).in(copy);
    if (at(v).family == Family::kOverlap) {
      x[v] = std::clamp(x[v] / OverlapBound(at(v).index, parameters.durations).value, 0.0, 1.0);
    }
  }
  return x;
}

HomotopyParameters OverlapVariables::ToParameters(const Eigen::VectorXd& x) const {
  HomotopyParameters parameters = planned_;
  for (int v = size() - 1; v >= 0; --v) {  // durations before the overlaps they bound
    at(v).in(parameters) =
        at(v).family == Family::kOverlap
            ? std::clamp(x[v], 0.0, 1.0) * OverlapBound(at(v).index, parameters.durations).value
            : x[v];
  }
  return parameters;
}

std::vector<int> OverlapVariables::Band(int half_step) const {
  constexpr int kNear = 3;
  std::vector<int> band;
  const auto add = [&](Family family, int from, int to, int count) {
    for (int i = std::max(from, 0); i <= std::min(to, count - 1); ++i) {
      const int v = IndexOf({family, i});
      if (v >= 0) band.push_back(v);
    }
  };
  const int k = half_step;
  add(Family::kOverlap, k - kNear, k + kNear - 1, sequence_.num_junctions());
  add(Family::kHeightScale, std::max(k - kNear, 0) / 2, (k + kNear) / 2, sequence_.num_steps());
  add(Family::kDuration, k - kNear, k + kNear, sequence_.size());
  return band;
}

}  // namespace halfstep
