#include "experiments/live/episode_files.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/about/build_info.h"
#include "experiments/live/episode_report.h"
#include "experiments/live/episode_tables.h"
#include "experiments/live/promise_words.h"
#include "experiments/run/complete_manifest.h"
#include "experiments/tables/not_covered_json.h"
#include "experiments/tables/result_tables.h"
#include "experiments/tables/run_inputs.h"
#include "smoothing/margins/not_covered_by.h"
#include "wpg/files/sha256.h"

namespace halfstep {

namespace {

void WriteExecuted(const Episode& episode, const LiveConfig& config, const RobotModel& robot,
                   RunFolder* folder) {
  // Margins of each instant are those in the world that was known then.
  size_t version = 0;
  std::unique_ptr<const MarginEvaluator> evaluator;
  const auto at = [&](double t) -> const MarginEvaluator& {
    size_t now = version;
    while (now + 1 < episode.known.size() && episode.known[now + 1] <= t) ++now;
    if (!evaluator || now != version) {
      evaluator = std::make_unique<const MarginEvaluator>(robot, episode.worlds[now].scene,
                                                          config.experiment.smoothing.limits);
    }
    version = now;
    return *evaluator;
  };
  const SuperposedWalk walk = episode.Executed();
  const double end = std::min(walk.duration(), episode.end);
  const double period = config.experiment.output_period.value_or(kRowPeriod);
  WriteTrajectory(walk, end, period, at, folder);
}

std::string ManifestJson(const Episode& episode, const LiveConfig& config, const Place& place,
                         const std::string& resolved) {
  nlohmann::ordered_json manifest = {
      {"format", 2},
      {"kind", "episode"},
      {"program", "halfstep"},
      {"version", kVersion},
      {"commit", kCommit},
      {"build_type", kBuildType},
      {"name", config.experiment.name},
      {"config_sha256", Sha256(resolved)},
      {"seed", config.experiment.seed},
      {"clock", config.live.clock},
      {"policy", config.live.policy},
      {"ending", Name(episode.ending)},
      {"message", episode.message},
      {"waited_s", episode.waited},
      {"end_s", episode.end},
      {"stopped", episode.stopped},
      {"walks", episode.walks.size()},
      {"promise", PromiseJson(episode.promise)},
      {"not_covered",
       NotCoveredJson(NotCoveredBy(place.robot, place.scene, config.experiment.smoothing.limits))}};
  return manifest.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string ResolvedFor(const std::filesystem::path& folder, const LiveConfig& config) {
  LiveConfig moved = config;
  moved.experiment = MovedTo(folder, config.experiment);
  return WriteYaml([&](Fields& fields) { DeclareFields(fields, &moved); });
}

void WriteEpisode(const Episode& episode, const LiveConfig& config, const Place& place,
                  RunFolder* folder) {
  for (const EpisodeTable& table : EpisodeTables(episode, {})) {
    WriteCsv(table.name, table.file, folder);
  }
  for (size_t k = 0; k < episode.walks.size(); ++k) {
    for (const EpisodeTable& table : WalkTables(episode, k)) {
      WriteCsvOfMany(table.name, table.file, folder);
    }
  }
  if (!episode.walks.empty()) WriteExecuted(episode, config, place.robot, folder);
  LiveConfig named = config;
  named.experiment = WithInputs(config.experiment, place.robot, place.scene, folder);
  const std::string resolved = ResolvedFor(folder->path(), named);
  folder->Write("config.yaml", resolved);
  folder->Write("manifest.json", ManifestJson(episode, config, place, resolved));
  WriteEpisodeReport(episode, config, place, folder);
  CompleteManifest(place.robot, place.scene, folder);
}

}  // namespace halfstep
