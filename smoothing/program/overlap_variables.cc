#include "smoothing/program/overlap_variables.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfstep {
namespace {

using Family = HomotopyParameter::Family;

constexpr double kBoundSmoothing = 1e-3;  // [s] below the natural bound where both sides meet

}  // namespace

OverlapVariables::OverlapVariables(const HalfStepSequence& sequence, ParameterTable table,
                                   bool resting)
    : sequence_(sequence), table_(std::move(table)), resting_(resting), start_(table_.Start()) {
  for (const ParameterRow& row : table_.rows()) {
    index_.push_back(row.fixed ? -1 : size());
    if (!row.fixed) variables_.push_back(row.parameter);
  }
}

Eigen::VectorXd OverlapVariables::lower() const {
  Eigen::VectorXd lower(size());
  for (int v = 0; v < size(); ++v) lower[v] = table_.row(at(v)).lower;
  return lower;
}

Eigen::VectorXd OverlapVariables::upper() const {
  Eigen::VectorXd upper(size());
  for (int v = 0; v < size(); ++v) {
    upper[v] = at(v).family == Family::kOverlap ? 1.0 : table_.row(at(v)).upper;
  }
  return upper;
}

OverlapVariables::Bound OverlapVariables::OverlapBound(int junction,
                                                       const HomotopyParameters& at) const {
  const auto [a, b] = NaturalBoundOf(at, junction);
  const size_t i = static_cast<size_t>(junction);
  const double u = a * at.durations[i], v = b * at.durations[i + 1];
  const bool shifts = KindOfJunction(junction) == JunctionKind::kUpDown;
  const auto moves = [&](int half_step) {
    return table_.free({Family::kDuration, half_step}) ||
           (shifts && table_.free({Family::kZmpShift, half_step}));
  };
  if (!moves(junction) && !moves(junction + 1)) return {.value = std::min(u, v)};
  // (u + v)/2 − √((u − v)²/4 + ε²) ≤ min(u, v)
  const double half = 0.5 * (u - v);
  const double root = std::sqrt(half * half + kBoundSmoothing * kBoundSmoothing);
  const double by_u = 0.5 - 0.5 * half / root, by_v = 0.5 + 0.5 * half / root;
  const double flight = shifts ? -0.5 : 0.0;  // u = (1 − shift)·T/2, and v
  return {.value = 0.5 * (u + v) - root,
          .by_duration = {a * by_u, b * by_v},
          .by_shift = {flight * at.durations[i] * by_u, flight * at.durations[i + 1] * by_v}};
}

Eigen::VectorXd OverlapVariables::ToVariables(const HomotopyParameters& parameters) const {
  Eigen::VectorXd x(size());
  for (int v = 0; v < size(); ++v) {
    x[v] = at(v).in(parameters);
    if (at(v).family == Family::kOverlap) {
      x[v] = std::clamp(x[v] / OverlapBound(at(v).index, parameters).value, 0.0, 1.0);
    }
  }
  return x;
}

HomotopyParameters OverlapVariables::ToParameters(const Eigen::VectorXd& x) const {
  HomotopyParameters parameters = start_;
  for (int v = size() - 1; v >= 0; --v) {  // what bounds overlaps before these
    double& value = at(v).in(parameters);
    if (at(v).family == Family::kOverlap) {
      value = std::clamp(x[v], 0.0, 1.0) * OverlapBound(at(v).index, parameters).value;
    } else if (at(v).family == Family::kDuration) {
      // Some solvers leave bounds a little; fixed overlaps must fit.
      value = std::max(x[v], table_.row(at(v)).lower);
    } else {
      value = Traits(at(v).family).of_form
                  ? std::clamp(x[v], table_.row(at(v)).lower, table_.row(at(v)).upper)
                  : x[v];
    }
  }
  return parameters;
}

std::vector<int> OverlapVariables::Band(int half_step) const {
  constexpr int kNear = 3;
  std::vector<int> band;
  for (int v = 0; v < size(); ++v) {
    const ParameterFamilyTraits& traits = Traits(at(v).family);
    const auto [first, last] = traits.half_steps(at(v).index);
    const int from = resting_ ? half_step - kNear : 0, to = half_step + kNear;
    const bool inside = from <= first && last <= to, touches = from <= last && first <= to;
    if (traits.joins() ? inside : touches) band.push_back(v);
  }
  return band;
}

}  // namespace halfstep
