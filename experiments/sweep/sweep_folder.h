#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/sweep/sweep_config.h"
#include "experiments/tables/csv_columns.h"

namespace halfstep {

/// The folder of a sweep: sweep.yaml and manifest.json (what the sweep is), cases/ID/ (each whole
/// or not there), and runs.csv and timings.csv when all cases are done.
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

  /// Writes runs.csv and timings.csv, and their schemas, from all cases, in their order; removes
  /// what killed processes left behind. Precondition: all are done. Returns the text of runs.csv.
  std::string Collect(const std::vector<SweepCase>& cases) const;

 private:
  std::filesystem::path path_;
  SweepConfig sweep_;
  CsvFile runs_, timings_;  // without rows
  std::string runs_schema_, timings_schema_;
};

}  // namespace halfstep
