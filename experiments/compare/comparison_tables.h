#pragma once

#include <string>
#include <vector>

#include "experiments/compare/comparison.h"
#include "experiments/tables/csv_columns.h"

namespace halfstep {

/// Columns of comparison.csv; with gap_lipm where a run knows a bound.
CsvColumns ComparisonColumns(bool with_bound);
/// Each table of a comparison; columns: experiments/files.md.
CsvFile ComparisonCsv(const Comparison& comparison);
/// The staircases of PerformanceProfiles().
CsvFile PerformanceProfileCsv(const Comparison& comparison);
/// The incumbents of every method, from the planned motion to its end.
CsvFile AnytimeCsv(const Comparison& comparison);
/// One row a method, of Means().
CsvFile MeansCsv(const Comparison& comparison);

/// Which runs were compared, each with the SHA-256 of its manifest, and by which program.
std::string ComparisonManifest(const std::vector<RunRecord>& runs);

/// What `halfstep compare` prints: a table of each case, then the means of each method.
std::string ComparisonScreen(const Comparison& comparison);

}  // namespace halfstep
