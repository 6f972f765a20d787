#pragma once

#include <string>

#include "experiments/live/episode.h"
#include "experiments/live/replanner.h"
#include "experiments/tables/csv_columns.h"
#include "experiments/tables/run_folder.h"

namespace halfstep {

/// Each table of an episode's folder; columns: experiments/README.md, "Episodes".
CsvFile EventsCsv(const Episode& episode);
CsvFile WorldsCsv(const Episode& episode);
CsvFile ObstaclesCsv(const Episode& episode);
CsvFile PlansCsv(const Episode& episode);
CsvFile GrantsCsv(const Episode& episode);
CsvFile BegunCsv(const Episode& episode);
CsvFile TimingsCsv(const Episode& episode);

/// The folder of a walk that was handed over, from 0: "walks/007".
std::string WalkFolder(size_t walk);

/// Writes every file of the folder. Only timings.csv, and what the manifest says of the machine and
/// the time, are not the same whenever the episode is run in lockstep.
void WriteEpisode(const Episode& episode, const Replanner& replanner, const Scene& scene,
                  RunFolder* folder);

}  // namespace halfstep
