#include "smoothing/walk/parameter_families.h"

namespace halfstep {

std::string_view ParameterFamilyTraits::table() const {
  return joins() ? "overlaps" : "half_steps";
}

int ParameterFamilyTraits::count(const HalfStepSequence& sequence) const {
  switch (of) {
    case ParameterOf::kJunction:
      return sequence.num_junctions();
    case ParameterOf::kStep:
      return sequence.num_steps();
    case ParameterOf::kHalfStep:
      break;
  }
  return sequence.size();
}

double ParameterFamilyTraits::planned(const HalfStepSequence& sequence, int index) const {
  if (number == nullptr && shape == nullptr) return unmoved;
  const size_t first = static_cast<size_t>(half_steps(index).first);
  const HalfStep& half_step = sequence.half_steps[first].half_step;
  return number != nullptr ? half_step.*number : half_step.shape.*shape;
}

std::pair<int, int> ParameterFamilyTraits::half_steps(int index) const {
  // The landing, the next step, whose support it is, and the half-step that leaves it.
  if (part == ParameterPart::kFootstep) return {2 * index + 1, 2 * index + 4};
  switch (of) {
    case ParameterOf::kJunction:
      return {index, index + 1};
    case ParameterOf::kStep:
      return {2 * index, 2 * index + 1};
    case ParameterOf::kHalfStep:
      break;
  }
  return {index, index};
}

std::string_view Name(ParameterOf of) {
  switch (of) {
    case ParameterOf::kJunction:
      return "junction";
    case ParameterOf::kStep:
      return "step";
    case ParameterOf::kHalfStep:
      break;
  }
  return "half_step";
}

std::string PluralOf(const ParameterFamilyTraits& traits) { return std::string(traits.name) + "s"; }

}  // namespace halfstep
