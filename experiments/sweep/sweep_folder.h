#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/sweep/sweep_config.h"
#include "experiments/tables/csv_columns.h"
#include "wpg/robot/not_covered.h"

namespace halfstep {

/// One thing that certificates of a sweep do not speak of.
struct SweptNotCovered {
  NotCovered thing;  ///< in the same words for all these cases
  size_t cases = 0;  ///< how many
};

/// The folder of a sweep: sweep.yaml and manifest.json (what the sweep is), cases/ID/ (each whole
/// or not there), and runs.csv, timings.csv and not_covered.json when all cases are done.
class SweepFolder {
 public:
  /// Makes the folder, or continues one of the same sweep. Throws InputError when something else is
  /// there: another definition, program or folder; std::runtime_error when it cannot be written.
  SweepFolder(const std::filesystem::path& path, const SweepConfig& sweep);

  const std::filesystem::path& path() const { return path_; }  ///< of the sweep's folder
  /// As it was defined when the folder was made.
  const SweepConfig& sweep() const { return sweep_; }
  /// Folder of a case, whether it is there or not.
  std::filesystem::path CasePath(const SweepCase& one) const { return path_ / "cases" / one.id; }
  /// Whether a case is there and whole.
  bool IsDone(const SweepCase& one) const;

  /// Writes runs.csv and timings.csv, their schemas, and not_covered.json (NotCoveredOf, and of how
  /// many cases each is) from all cases, in their order; removes
  /// what killed processes left behind. Precondition: all are done. Returns the text of runs.csv.
  std::string Collect(const std::vector<SweepCase>& cases) const;

  /// What certificates of the cases do not speak of, in the order of the cases. Throws InputError
  /// for a case's not_covered.json that is none.
  std::vector<SweptNotCovered> NotCoveredOf(const std::vector<SweepCase>& cases) const;

 private:
  std::filesystem::path path_;
  SweepConfig sweep_;
  CsvFile runs_, timings_;  // without rows
  std::string runs_schema_, timings_schema_;
};

}  // namespace halfstep
