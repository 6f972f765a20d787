#include "smoothing/walk/homotopy_parameters.h"

#include <algorithm>
#include <cmath>

#include "wpg/check.h"

namespace halfstep {

HomotopyParameters PlannedMotion(const HalfStepSequence& sequence) {
  HomotopyParameters parameters;
  parameters.overlaps.assign(static_cast<size_t>(sequence.num_junctions()), 0.0);
  parameters.height_scales.assign(static_cast<size_t>(sequence.num_steps()), 1.0);
  for (const PlacedHalfStep& placed : sequence.half_steps) {
    parameters.durations.push_back(placed.half_step.duration);
  }
  return parameters;
}

double& HomotopyParameter::in(HomotopyParameters& parameters) const {
  std::vector<double>& values = family == Family::kOverlap       ? parameters.overlaps
                                : family == Family::kHeightScale ? parameters.height_scales
                                                                 : parameters.durations;
  return values.at(static_cast<size_t>(index));
}

std::vector<HomotopyParameter> AllParameters(const HalfStepSequence& sequence) {
  using Family = HomotopyParameter::Family;
  std::vector<HomotopyParameter> all;
  for (int i = 0; i < sequence.num_junctions(); ++i) all.push_back({Family::kOverlap, i});
  for (int j = 0; j < sequence.num_steps(); ++j) all.push_back({Family::kHeightScale, j});
  for (int i = 0; i < sequence.size(); ++i) all.push_back({Family::kDuration, i});
  return all;
}

double NaturalOverlapBound(const HalfStepSequence& sequence, const std::vector<double>& durations,
                           int junction) {
  const size_t i = static_cast<size_t>(junction);
  const HalfStepShape& before = sequence.half_steps[i].half_step.shape;
  const HalfStepShape& after = sequence.half_steps[i + 1].half_step.shape;
  if (KindOfJunction(junction) == JunctionKind::kUpDown) {
    return std::min((1.0 - before.t2()) * durations[i], after.t1() * durations[i + 1]);
  }
  return std::min(durations[i], durations[i + 1]);
}

void CheckParameters(const HalfStepSequence& sequence, const HomotopyParameters& parameters) {
  HALFSTEP_CHECK(parameters.overlaps.size() == static_cast<size_t>(sequence.num_junctions()) &&
                     parameters.height_scales.size() == static_cast<size_t>(sequence.num_steps()) &&
                     parameters.durations.size() == static_cast<size_t>(sequence.size()),
                 parameters.overlaps.size()
                     << " overlaps, " << parameters.height_scales.size() << " height scales, "
                     << parameters.durations.size() << " durations for " << sequence.size()
                     << " half-steps");
  for (double eta : parameters.height_scales) {
    HALFSTEP_CHECK(std::isfinite(eta) && eta >= 0.0, "height scale " << eta);
  }
  for (double T : parameters.durations) HALFSTEP_CHECK(std::isfinite(T) && T > 0.0, "T = " << T);
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    const double overlap = parameters.overlaps[static_cast<size_t>(i)];
    const double bound = NaturalOverlapBound(sequence, parameters.durations, i);
    HALFSTEP_CHECK(overlap >= 0.0 && overlap <= bound + 1e-12,
                   "overlap " << overlap << " s of junction " << i << ", bound " << bound << " s");
  }
}

}  // namespace halfstep
