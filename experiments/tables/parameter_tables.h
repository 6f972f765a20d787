#pragma once

#include "experiments/tables/csv_columns.h"
#include "experiments/tables/csv_writer.h"
#include "smoothing/walk/homotopy_parameters.h"

namespace halfstep {

/// The column of a family.
CsvColumn ColumnOf(ParameterFamily family);

/// Which columns half_steps.csv has: those that it always has; with those of forms; with those of
/// the moves of footsteps; with those of the waist's rise, too.
enum class HalfStepsExtent { kTimes, kForms, kFootsteps, kHeights };
/// Which half_steps.csv of a walk has: as far as values are not the plan's, and all where soles
/// stand at different heights.
HalfStepsExtent ExtentOf(const HalfStepSequence& sequence, const HomotopyParameters& parameters);
/// The families whose values stand in half_steps.csv, in the order of their columns.
std::vector<ParameterFamily> FamiliesOfHalfSteps(HalfStepsExtent extent);
/// The columns of half_steps.csv.
CsvColumns HalfStepsColumns(HalfStepsExtent extent);
/// half_steps.csv: one row a half-step, with where the homotopy ended.
/// `before` half-steps are before those of the sequence, which begin at `begin` [s].
CsvFile HalfStepsCsv(const HalfStepSequence& sequence, const HomotopyParameters& parameters,
                     int before = 0, double begin = 0.0);

}  // namespace halfstep
