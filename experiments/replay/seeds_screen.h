#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/replay/seeded_replay.h"
#include "experiments/replay/suggested_tube.h"
#include "experiments/tables/csv_columns.h"

namespace halfstep::replay {

/// A walk that was played in the worlds of several seeds.
struct SeedsPlayed {
  std::string method;             ///< of a run; "episode"
  double duration = 0.0;          ///< of the walk [s]
  bool obstacles = false;         ///< whether there are any; else nothing is said of touches
  std::vector<SeedReplay> seeds;  ///< at least one
  std::optional<SuggestedTube> tube = std::nullopt;  ///< where it was asked for
};

/// What `halfstep replay --seeds` prints of one walk: lines, each with its end.
std::string SeedsText(const SeedsPlayed& played);

/// The results of simulations.
std::vector<const ReplayResult*> ResultsOf(const std::vector<SeedReplay>& seeds);

/// What is told of one walk as the text of a JSON object.
std::string SeedsPlayedJson(const SeedsPlayed& played);

/// The whole output of `halfstep replay --seeds --json`; parameters as of ReplayJson().
std::string SeedsJson(const std::string& run, const std::vector<std::string>& notes,
                      const std::vector<SeedsPlayed>& all);

/// replays.csv: one row a seed.
CsvFile SeedsCsv(const std::vector<SeedReplay>& seeds);

}  // namespace halfstep::replay
