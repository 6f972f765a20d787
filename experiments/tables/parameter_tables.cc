#include "experiments/tables/parameter_tables.h"

#include <algorithm>
#include <string>

namespace halfstep {

using enum CsvType;

namespace {

HalfStepsExtent ExtentOf(ParameterFamily family) {
  const ParameterFamilyTraits& traits = Traits(family);
  if (traits.of_heights) return HalfStepsExtent::kHeights;
  if (traits.move != nullptr) return HalfStepsExtent::kFootsteps;
  return traits.of_form ? HalfStepsExtent::kForms : HalfStepsExtent::kTimes;
}

}  // namespace

HalfStepsExtent ExtentOf(const HalfStepSequence& sequence, const HomotopyParameters& parameters) {
  const bool level = std::ranges::all_of(sequence.half_steps, [](const PlacedHalfStep& placed) {
    return placed.half_step.X_SF.height == 0.0;
  });
  if (!level) return HalfStepsExtent::kHeights;
  const HomotopyParameters planned = PlannedMotion(sequence);
  HalfStepsExtent extent = HalfStepsExtent::kTimes;
  for (const ParameterFamily family : AllParameterFamilies()) {
    if (parameters.of(family) != planned.of(family)) extent = std::max(extent, ExtentOf(family));
  }
  return extent;
}

std::vector<ParameterFamily> FamiliesOfHalfSteps(HalfStepsExtent extent) {
  std::vector<ParameterFamily> families;
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    if (!traits.joins() && ExtentOf(family) <= extent) families.push_back(family);
  }
  std::ranges::stable_sort(families, {}, [](ParameterFamily f) { return Traits(f).rank; });
  return families;
}

CsvColumn ColumnOf(ParameterFamily family) {
  const ParameterFamilyTraits& traits = Traits(family);
  return {std::string(traits.column), kNumber, traits.unit.empty() ? "1" : std::string(traits.unit),
          std::string(traits.meaning)};
}

CsvColumns HalfStepsColumns(HalfStepsExtent extent) {
  CsvColumns columns = {
      {"half_step", kInteger, "", "from 1"},
      {"kind", kString, "", "up or down"},
      {"support", kString, "", "foot that carries: left or right"},
      {"start_s", kNumber, "s", "when it begins"},
  };
  for (const ParameterFamily family : FamiliesOfHalfSteps(extent)) {
    columns.push_back(ColumnOf(family));
  }
  return columns;
}

CsvFile HalfStepsCsv(const HalfStepSequence& sequence, const HomotopyParameters& parameters,
                     int before, double begin) {
  const HalfStepsExtent extent = ExtentOf(sequence, parameters);
  const std::vector<ParameterFamily> families = FamiliesOfHalfSteps(extent);
  CsvWriter csv(HalfStepsColumns(extent));
  double start = begin;
  for (size_t i = 0; i < sequence.half_steps.size(); ++i) {
    const HalfStep& half_step = sequence.half_steps[i].half_step;
    csv.Cell(before + static_cast<long>(i) + 1)
        .Cell(half_step.kind == HalfStepKind::kUp ? "up" : "down");
    csv.Cell(Name(half_step.support)).Cell(start);
    for (const ParameterFamily family : families) {
      const int index = Traits(family).index_at(static_cast<int>(i));
      csv.Cell(HomotopyParameter{family, index}.in(parameters));
    }
    csv.EndRow();
    if (i < parameters.overlaps.size()) start += parameters.durations[i] - parameters.overlaps[i];
  }
  return csv.file();
}

}  // namespace halfstep
