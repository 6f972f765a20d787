#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "smoothing/walk/homotopy_parameters.h"
#include "smoothing/walk/parameter_table.h"

namespace halfstep {

/// The walk in these files: parameters of the sequence whose columns are there, the others as
/// planned or as `fixed` has them. Columns that a run's tables hold besides are allowed; those that
/// name the row (junction, half_step, kind, support) must be right, and so must the durations and
/// height scales in overlaps.csv where half_steps.csv does not say them; the others are not looked
/// at. Throws InputError with a complaint `file:line:column: column: …` for each mistake: another
/// number of rows, columns that are unknown or there twice, what is not a finite number, values out
/// of range, overlaps above their natural bounds, the two half-steps of a step that disagree about
/// it, and values other than those of `fixed`.
HomotopyParameters ReadGivenWalk(const GivenWalkFiles& files, const HalfStepSequence& sequence,
                                 const std::vector<FixedParameter>& fixed);

/// The same from the tables of a method's folder, which have all columns that a run writes.
/// Families whose table is not there, as overlaps.csv of the planned motion, are as planned.
/// `before`: the sequence is the end of a walk, so many half-steps are before it, and overlaps.csv
/// begins with the overlap between the last of them and the first of these.
HomotopyParameters ReadParameters(const std::filesystem::path& folder,
                                  const HalfStepSequence& sequence, int before = 0);

/// Sorts files of the command line by their columns: the one with overlaps, and the one with rows
/// of half-steps. Throws InputError for a file that is neither, and for two of a kind.
GivenWalkFiles SortGivenFiles(const std::vector<std::string>& paths);

}  // namespace halfstep
