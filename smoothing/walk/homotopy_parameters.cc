#include "smoothing/walk/homotopy_parameters.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wpg/check.h"

namespace halfstep {

HomotopyParameters PlannedMotion(const HalfStepSequence& sequence) {
  HomotopyParameters parameters;
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    for (int i = 0; i < traits.count(sequence); ++i) {
      parameters.of(family).push_back(traits.planned(sequence, i));
    }
  }
  return parameters;
}

double NaturalBound::At(double T_before, double T_after) const {
  return std::min(before * T_before, after * T_after);
}

NaturalBound NaturalBoundOf(int junction, double shift_before, double shift_after) {
  if (KindOfJunction(junction) == JunctionKind::kDownUp) return {};
  return {1.0 - HalfStepShape{.shift = shift_before}.t2(),
          HalfStepShape{.shift = shift_after}.t1()};
}

NaturalBound NaturalBoundOf(const HomotopyParameters& parameters, int junction) {
  const size_t i = static_cast<size_t>(junction);
  return NaturalBoundOf(junction, parameters.zmp_shifts[i], parameters.zmp_shifts[i + 1]);
}

double NaturalOverlapBound(const HomotopyParameters& parameters, int junction) {
  const size_t i = static_cast<size_t>(junction);
  return NaturalBoundOf(parameters, junction)
      .At(parameters.durations[i], parameters.durations[i + 1]);
}

void CheckParameters(const HalfStepSequence& sequence, const HomotopyParameters& parameters) {
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    const std::vector<double>& values = parameters.of(family);
    HALFSTEP_CHECK(values.size() == static_cast<size_t>(traits.count(sequence)),
                   values.size() << " values of " << traits.name << " for " << sequence.size()
                                 << " half-steps");
    for (double value : values) {
      HALFSTEP_CHECK(std::isfinite(value) &&
                         (value > traits.least || (traits.least_itself && value == traits.least)) &&
                         (value <= traits.most || !traits.of_form),
                     traits.name << " " << value << " " << traits.unit);
    }
  }
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    const double overlap = parameters.overlaps[static_cast<size_t>(i)];
    const double bound = NaturalOverlapBound(parameters, i);
    HALFSTEP_CHECK(overlap <= bound + kOverlapTolerance,
                   "overlap " << overlap << " s of junction " << i << ", bound " << bound << " s");
  }
}

void ClampOverlaps(const HomotopyParameters& rests, HomotopyParameters* parameters) {
  for (int i = 0; i < static_cast<int>(parameters->overlaps.size()); ++i) {
    const double least = std::min(0.0, rests.overlaps[static_cast<size_t>(i)]);
    double& overlap = parameters->overlaps[static_cast<size_t>(i)];
    overlap = std::clamp(overlap, least, NaturalOverlapBound(*parameters, i));
  }
}

double DurationOf(const HomotopyParameters& parameters) {
  return std::accumulate(parameters.durations.begin(), parameters.durations.end(), 0.0) -
         std::accumulate(parameters.overlaps.begin(), parameters.overlaps.end(), 0.0);
}

}  // namespace halfstep
