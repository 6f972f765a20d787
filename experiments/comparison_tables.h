#pragma once

#include <string>
#include <vector>

#include "experiments/comparison.h"

namespace halfstep {

/// The text of each table of a comparison; columns: experiments/README.md.
std::string ComparisonCsv(const Comparison& comparison);
std::string PerformanceProfileCsv(const Comparison& comparison);
/// The incumbents of every method, from the planned motion to its end.
std::string AnytimeCsv(const Comparison& comparison);
std::string MeansCsv(const Comparison& comparison);

/// Which runs were compared, each with the SHA-256 of its manifest, and by which program.
std::string ComparisonManifest(const std::vector<RunRecord>& runs);

/// What `halfstep compare` prints: a table of each case, then the means of each method.
std::string ComparisonScreen(const Comparison& comparison);

}  // namespace halfstep
