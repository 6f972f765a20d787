#include "smoothing/methods/repeated_steps.h"

#include <vector>

#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr int kStride = 4;  // half-steps until the same foot does the same

}  // namespace

HomotopyParameters RepeatSteps(const HalfStepSequence& sequence, const HomotopyParameters& at,
                               int first, int last) {
  const std::vector<double> planned = PlannedMotion(sequence).durations;
  HomotopyParameters like = at;
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    if (traits.move != nullptr) continue;
    std::vector<double>& values = like.of(family);
    for (size_t i = 0; i < values.size(); ++i) {
      const auto [from, to] = traits.half_steps(static_cast<int>(i));
      if (to < first || to > last || from < kStride) continue;
      const int before = traits.index_at(from - kStride);
      values[i] = Nth(values, before);
      if (family == ParameterFamily::kDuration) values[i] *= planned[i] / Nth(planned, before);
    }
  }
  return like;
}

}  // namespace halfstep
