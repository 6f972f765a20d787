#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/bench/bench_case.h"
#include "experiments/tables/csv_columns.h"

namespace halfstep {

/// Columns of bench.csv.
CsvColumns BenchColumns();

/// The folder of a benchmark: manifest.json (what it is of), scenes/NAME.yaml and
/// NAME_scene.yaml, cases/ID.csv and ID_timing.csv, footsteps/PLANNER/NAME.yaml of what was solved,
/// and bench.csv and timings.csv when all cases are done. Each file is whole or not there.
class BenchFolder {
 public:
  /// Makes the folder and its scenes, or continues one of the same benchmark. Throws InputError
  /// when something else is there, std::runtime_error when it cannot be written.
  BenchFolder(const std::filesystem::path& path, const BenchSelection& selection,
              const RobotModel& robot);

  std::filesystem::path scenes() const { return path_ / "scenes"; }  ///< folder of the scenes
  /// Whether a case is there and whole.
  bool IsDone(const BenchCase& one) const;
  /// Writes a case. Thread-safe for different cases.
  void Write(const BenchCase& one, const BenchRow& row) const;
  /// Writes bench.csv and timings.csv of all cases, in their order, which must be done; returns
  /// bench.csv.
  std::string Collect(const std::vector<BenchCase>& cases) const;

 private:
  std::filesystem::path CasePath(const BenchCase& one, const std::string& ending) const {
    return path_ / "cases" / (one.Id() + ending);
  }

  std::filesystem::path path_;
  BenchSizes sizes_;
};

/// Writes scenes and configs of a selection, and scenes.csv with their numbers, into a folder.
void WriteBenchScenes(const BenchSelection& selection, const BenchSizes& sizes,
                      const std::filesystem::path& folder);

/// The numbers of scenes, one row each: name, kind, difficulty, seed, bar_m, gap_m, headroom_m.
CsvFile BenchScenesCsv(const BenchSelection& selection, const BenchSizes& sizes);

/// The table of a bench.csv by kind and difficulty, planners beside each other: how many are
/// solved, and medians of these.
std::string BenchTable(const std::string& bench_csv);

}  // namespace halfstep
