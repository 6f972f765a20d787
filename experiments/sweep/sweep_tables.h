#pragma once

#include <string>

#include "experiments/run/experiment_run.h"
#include "experiments/sweep/sweep_config.h"
#include "experiments/tables/csv_columns.h"

namespace halfstep {

/// runs.csv without rows: case, the keys that vary, the columns of summary.csv that hold no times
/// of a run, message. So the same sweep gives the same bytes.
CsvFile EmptyRuns(const SweepConfig& sweep);
/// timings.csv without rows: what runs.csv leaves out.
CsvFile EmptyTimings();

/// A case's runs.csv and timings.csv.
struct SweepTables {
  CsvFile runs, timings;  ///< one row a method; what depends on the machine is in the second
};
/// One row a method. `wall` is of the whole case [s].
SweepTables TablesOf(const SweepConfig& sweep, const SweepCase& one, const ExperimentRun& run,
                     double wall);
/// One row for a case without a result: method `none`, a status and a message.
SweepTables TablesOfFailure(const SweepConfig& sweep, const SweepCase& one,
                            const std::string& status, const std::string& message, double wall);

}  // namespace halfstep
