#include "smoothing/walk/homotopy_parameters.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "smoothing/walk/parameter_complaint.h"
#include "wpg/check.h"
#include "wpg/nth.h"

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

double LeastHeightScale(const HalfStepSequence& sequence, int step) {
  const HalfStep& up = Nth(sequence.half_steps, 2 * step).half_step;
  const HalfStep& down = Nth(sequence.half_steps, 2 * step + 1).half_step;
  const double highest = std::max({0.0, up.X_SF.height, down.X_SF.height});
  return highest == 0.0 ? 0.0 : highest / up.via_height;
}

void CheckParameters(const HalfStepSequence& sequence, const HomotopyParameters& parameters) {
  const std::string complaint = ComplaintAbout(sequence, parameters);
  HALFSTEP_CHECK(complaint.empty(), complaint);
}

void ClampOverlaps(const HomotopyParameters& rests, HomotopyParameters* parameters) {
  for (int i = 0; i < static_cast<int>(parameters->overlaps.size()); ++i) {
    const double least = std::min(0.0, Nth(rests.overlaps, i));
    double& overlap = Nth(parameters->overlaps, i);
    overlap = std::clamp(overlap, least, NaturalOverlapBound(*parameters, i));
  }
}

double DurationOf(const HomotopyParameters& parameters) {
  return std::accumulate(parameters.durations.begin(), parameters.durations.end(), 0.0) -
         std::accumulate(parameters.overlaps.begin(), parameters.overlaps.end(), 0.0);
}

}  // namespace halfstep
