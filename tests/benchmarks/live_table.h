#pragma once

#include <vector>

#include "tests/benchmarks/studied_episode.h"

namespace halfstep {

/// Prints the columns of PrintRow.
void PrintHeader();
void PrintRow(const StudiedEpisode& episode);
/// What the bench of live walking asks, over all episodes: a table in Markdown.
void PrintTable(const std::vector<StudiedEpisode>& episodes);
/// What was counted of the parts of answers, and what the processor took for them: a table in
/// Markdown. Of other footsteps that were found, and of other overlaps.
void PrintSpent(const std::vector<Answered>& answers);
/// A histogram of latencies and of what they consist of: rows `part,up_to_s,count`.
void PrintHistogram(const std::vector<StudiedEpisode>& episodes);

}  // namespace halfstep
