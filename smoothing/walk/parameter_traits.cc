#include "smoothing/walk/parameter_families.h"

#include "wpg/nth.h"

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

double* ParameterFamilyTraits::number_of(HalfStep* half_step) const {
  if (number != nullptr) return &(half_step->*number);
  return shape != nullptr ? &(half_step->shape.*shape) : nullptr;
}

double ParameterFamilyTraits::planned(const HalfStepSequence& sequence, int index) const {
  if (part == ParameterPart::kBegin) return 0.0 - Nth(sequence.half_steps, index + 1).rest;
  HalfStep half_step = Nth(sequence.half_steps, half_steps(index).first).half_step;
  const double* value = number_of(&half_step);
  return value != nullptr && !factor ? *value : unmoved;
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
