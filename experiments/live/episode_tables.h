#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/live/episode.h"
#include "experiments/tables/csv_columns.h"

namespace halfstep {

/// A table of an episode's folder by its name.
struct EpisodeTable {
  std::string name;  ///< "worlds"
  CsvFile file;      ///< its columns and text
};

/// How much of an episode has been written: counts of its lists.
struct EpisodeProgress {
  /// Of worlds, walks, grants, half-steps that began, and events.
  size_t worlds = 0, walks = 0, grants = 0, begun = 0, events = 0;

  /// All of an episode.
  static EpisodeProgress Of(const Episode& episode) {
    return {episode.worlds.size(), episode.walks.size(), episode.grants.size(),
            episode.begun.size(), episode.events.size()};
  }
  bool operator==(const EpisodeProgress&) const = default;
};

/// The tables of an episode, with the rows of what `written` does not have yet; columns:
/// experiments/episodes.md, "The folder of an episode". A row refers to rows of tables that come
/// before its own.
std::vector<EpisodeTable> EpisodeTables(const Episode& episode, const EpisodeProgress& written);

/// The tables of its walk with this index: "walks/007/footsteps", half_steps, overlaps; of its
/// tail.
std::vector<EpisodeTable> WalkTables(const Episode& episode, size_t walk);

/// The folder of a walk that was handed over, from 0: "walks/007".
std::string WalkFolder(size_t walk);

}  // namespace halfstep
