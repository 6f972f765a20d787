#include "smoothing/walk/parameter_complaint.h"

#include <cmath>

#include "wpg/files/text.h"

namespace halfstep {
namespace {

std::string WithUnit(std::string number, const ParameterFamilyTraits& traits) {
  if (!traits.unit.empty()) number.append(" ").append(traits.unit);
  return number;
}

std::string Named(ParameterFamily family, size_t index, double value) {
  const ParameterFamilyTraits& traits = Traits(family);
  return std::string(traits.name) + WithUnit(Formatted("s[%zu]: %.9g", index, value), traits);
}

std::string Valid(const ParameterFamilyTraits& traits) {
  std::string text = "finite";
  if (std::isfinite(traits.least)) {
    text = WithUnit(Formatted(traits.least_itself ? "at least %.9g" : "above %.9g", traits.least),
                    traits);
  }
  if (!traits.of_form || !std::isfinite(traits.most)) return text;
  return text + WithUnit(Formatted(", at most %.9g", traits.most), traits);
}

}  // namespace

std::string ComplaintAbout(const HalfStepSequence& sequence, const HomotopyParameters& parameters) {
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    const std::vector<double>& values = parameters.of(family);
    const size_t count = static_cast<size_t>(traits.count(sequence));
    if (values.size() != count) {
      return std::string(traits.name) + Formatted("s: %zu numbers (valid: %zu, for %d half-steps)",
                                                  values.size(), count, sequence.size());
    }
    for (size_t i = 0; i < count; ++i) {
      const double value = values[i];
      if (std::isfinite(value) &&
          (value > traits.least || (traits.least_itself && value == traits.least)) &&
          (value <= traits.most || !traits.of_form)) {
        continue;
      }
      return Named(family, i, value) + " (valid: " + Valid(traits) + ")";
    }
  }
  for (int step = 0; step < sequence.num_steps(); ++step) {
    const size_t at = static_cast<size_t>(step);
    const double least = LeastHeightScale(sequence, step);
    if (parameters.height_scales[at] >= least) continue;
    return Named(ParameterFamily::kHeightScale, at, parameters.height_scales[at]) +
           Formatted(" (valid: at least %.9g, so that the foot passes no lower than it stands)",
                     least);
  }
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    const size_t at = static_cast<size_t>(i);
    const double bound = NaturalOverlapBound(parameters, i);
    if (parameters.overlaps[at] <= bound + kOverlapTolerance) continue;
    return Named(ParameterFamily::kOverlap, at, parameters.overlaps[at]) +
           Formatted(
               " (valid: at most %.9g s, the natural bound between half-steps of %.9g s and "
               "%.9g s)",
               bound, parameters.durations[at], parameters.durations[at + 1]);
  }
  return "";
}

}  // namespace halfstep
