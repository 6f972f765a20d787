#include "experiments/live/episode_files.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/build_info.h"
#include "experiments/config/experiment.h"
#include "experiments/run/complete_manifest.h"
#include "experiments/tables/csv_writer.h"
#include "experiments/tables/parameter_tables.h"
#include "experiments/tables/result_tables.h"
#include "wpg/files/sha256.h"
#include "wpg/files/text.h"

namespace halfstep {

using enum CsvType;

namespace {

std::string OrNone(const std::string& text) { return text.empty() ? "none" : text; }

}  // namespace

CsvFile EventsCsv(const Episode& episode) {
  CsvWriter csv({{"t_s", kNumber, "s", "when"},
                 {"event", kString, "",
                  "measured, lost, contradicted, begins, handed_over, refused, unsafe, stopped"},
                 {"world", kInteger, "", "version that was known then"},
                 {"walk", kInteger, "", "in execution then, from 0"},
                 {"half_step", kInteger, "", "that it is about, from 1; 0: none"},
                 {"text", kString, "", "in words"}});
  for (const EpisodeEvent& event : episode.events) {
    csv.Cell(event.t).Cell(event.what).Cell(event.version).Cell(event.walk);
    csv.Cell(event.half_step + 1).Cell(OrNone(event.text)).EndRow();
  }
  return csv.file();
}

CsvFile WorldsCsv(const Episode& episode) {
  CsvWriter csv(
      {{"world", kInteger, "", "version, from 0"},
       {"known_s", kNumber, "s", "when it became known"},
       {"measured_s", kNumber, "s", "when it was measured"},
       {"sound_since", kInteger, "", "what was proved against earlier worlds is void"},
       {"goal_x_m", kNumber, "m", "centre of the goal, x", "W"},
       {"goal_y_m", kNumber, "m", "centre of the goal, y", "W"},
       {"areas", kString, "", "no-step areas that are there, from 1, separated by blanks"}});
  for (size_t k = 0; k < episode.worlds.size(); ++k) {
    const World& world = episode.worlds[k];
    csv.Cell(world.version).Cell(episode.known[k]).Cell(world.measured_at).Cell(world.sound_since);
    csv.Cell(world.goal.X_WG.x).Cell(world.goal.X_WG.y);
    std::string areas;
    for (const size_t area : world.areas)
      areas += (areas.empty() ? "" : " ") + std::to_string(area + 1);
    csv.Cell(OrNone(areas)).EndRow();
  }
  return csv.file();
}

CsvFile ObstaclesCsv(const Episode& episode) {
  CsvColumns columns = {{"world", kInteger, "", "version"},
                        {"obstacle", kString, "", "name in the scene"}};
  for (const char* axis : {"x", "y", "z"}) {
    columns.push_back(
        {std::string(axis) + "_m", kNumber, "m", "origin of its frame as measured", "W"});
  }
  for (const char* part : {"qw", "qx", "qy", "qz"}) {
    columns.push_back({part, kNumber, "1", "its orientation, a unit quaternion", "W"});
  }
  columns.push_back({"error_m", kNumber, "m", "r"});
  columns.push_back({"speed_m_s", kNumber, "m/s", "v"});
  columns.push_back({"horizon_s", kNumber, "s", "H"});
  CsvWriter csv(columns);
  for (const World& world : episode.worlds) {
    for (const Obstacle& obstacle : world.scene.obstacles) {
      const Eigen::Vector3d p = obstacle.X_WO.translation();
      const Eigen::Quaterniond q(obstacle.X_WO.linear());
      csv.Cell(world.version).Cell(obstacle.name).Cell(p.x()).Cell(p.y()).Cell(p.z());
      csv.Cell(q.w()).Cell(q.x()).Cell(q.y()).Cell(q.z());
      const ObstacleMotion& motion = obstacle.motion;
      csv.Cell(motion.error).Cell(motion.speed).Cell(motion.horizon).EndRow();
    }
  }
  return csv.file();
}

CsvFile PlansCsv(const Episode& episode) {
  CsvWriter csv({{"walk", kInteger, "", "from 0"},
                 {"handed_over_s", kNumber, "s", "when it took the place of the one before"},
                 {"kind", kString, "", "changed, shortened, resumed or smoothed"},
                 {"asked_s", kNumber, "s", "when work on it began"},
                 {"measured_s", kNumber, "s", "when the world that it was made for was measured"},
                 {"first_changed", kInteger, "", "half-step, from 1"},
                 {"footsteps", kInteger, "", "of the whole walk"},
                 {"duration_s", kNumber, "s", "of the whole walk"},
                 {"reason", kString, "", "in words"}});
  for (size_t k = 0; k < episode.walks.size(); ++k) {
    const ExecutedWalk& walk = episode.walks[k];
    csv.Cell(static_cast<long>(k)).Cell(walk.t).Cell(Name(walk.kind)).Cell(walk.asked);
    csv.Cell(walk.measured).Cell(walk.first_changed + 1).Cell(walk.plan.sequence.num_steps());
    csv.Cell(DurationOf(walk.plan.parameters)).Cell(OrNone(walk.reason)).EndRow();
  }
  return csv.file();
}

CsvFile GrantsCsv(const Episode& episode) {
  CsvWriter csv({{"grant", kInteger, "", "from 0"},
                 {"t_s", kNumber, "s", "from when on it counted"},
                 {"walk", kInteger, "", "that it is about"},
                 {"world", kInteger, "", "version that it was proved against"},
                 {"proved_from_s", kNumber, "s", "nothing before was looked at"},
                 {"through", kInteger, "", "half-steps up to this one may begin, from 1"},
                 {"valid_until_s", kNumber, "s", "as long as they end by then; inf: no limit"}});
  for (size_t k = 0; k < episode.grants.size(); ++k) {
    const EpisodeGrant& one = episode.grants[k];
    csv.Cell(static_cast<long>(k)).Cell(one.t).Cell(one.walk).Cell(one.grant.version);
    csv.Cell(one.grant.proved_at).Cell(one.grant.through + 1).Cell(one.grant.valid_until).EndRow();
  }
  return csv.file();
}

CsvFile BegunCsv(const Episode& episode) {
  CsvWriter csv({{"half_step", kInteger, "", "that began, from 1"},
                 {"grant", kInteger, "", "that allowed it"}});
  for (const BegunHalfStep& one : episode.begun)
    csv.Cell(one.half_step + 1).Cell(one.grant).EndRow();
  return csv.file();
}

CsvFile TimingsCsv(const Episode& episode) {
  CsvWriter csv({{"walk", kInteger, "", "from 0"},
                 {"check_s", kNumber, "s", "of computing: what is safe"},
                 {"plan_s", kNumber, "s", "of computing: footsteps"},
                 {"smooth_s", kNumber, "s", "of computing: overlaps"}});
  for (size_t k = 0; k < episode.walks.size(); ++k) {
    const ExecutedWalk& walk = episode.walks[k];
    csv.Cell(static_cast<long>(k))
        .Cell(walk.check_s)
        .Cell(walk.plan_s)
        .Cell(walk.smooth_s)
        .EndRow();
  }
  return csv.file();
}

std::string WalkFolder(size_t walk) { return Formatted("walks/%03zu", walk); }

namespace {

void WriteTrajectory(const Episode& episode, const Replanner& replanner, RunFolder* folder) {
  // Margins of each instant are those in the world that was known then.
  size_t version = 0;
  std::unique_ptr<const MarginEvaluator> evaluator;
  const auto at = [&](double t) -> const MarginEvaluator& {
    size_t now = version;
    while (now + 1 < episode.known.size() && episode.known[now + 1] <= t) ++now;
    if (!evaluator || now != version) {
      evaluator =
          std::make_unique<const MarginEvaluator>(replanner.robot(), episode.worlds[now].scene,
                                                  replanner.config().experiment.smoothing.limits);
    }
    version = now;
    return *evaluator;
  };
  const SuperposedWalk walk = episode.Executed();
  const double end = std::min(walk.duration(), episode.end);
  const double period = replanner.config().experiment.output_period;
  WriteCsv("trajectory", TrajectoryCsv(walk, end, period, at), folder);
}

std::string ManifestJson(const Episode& episode, const LiveConfig& config,
                         const std::string& resolved) {
  nlohmann::ordered_json manifest = {{"format", 2},
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
                                     {"walks", episode.walks.size()}};
  return manifest.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

void WriteEpisode(const Episode& episode, const Replanner& replanner, const Scene& scene,
                  RunFolder* folder) {
  WriteCsv("events", EventsCsv(episode), folder);
  WriteCsv("worlds", WorldsCsv(episode), folder);
  WriteCsv("obstacles", ObstaclesCsv(episode), folder);
  WriteCsv("plans", PlansCsv(episode), folder);
  WriteCsv("grants", GrantsCsv(episode), folder);
  WriteCsv("begun", BegunCsv(episode), folder);
  WriteCsv("timings", TimingsCsv(episode), folder);
  for (size_t k = 0; k < episode.walks.size(); ++k) {
    const WalkPlan& plan = episode.walks[k].plan;
    const std::string place = WalkFolder(k) + "/";
    WriteCsv(place + "footsteps", FootstepsCsv(plan.sequence), folder);
    WriteCsv(place + "half_steps", HalfStepsCsv(plan.sequence, plan.parameters), folder);
  }
  if (!episode.walks.empty()) WriteTrajectory(episode, replanner, folder);
  LiveConfig moved = replanner.config();
  moved.experiment = MovedTo(folder->path(), moved.experiment);
  const std::string resolved = WriteYaml([&](Fields& fields) { DeclareFields(fields, &moved); });
  folder->Write("config.yaml", resolved);
  folder->Write("manifest.json", ManifestJson(episode, replanner.config(), resolved));
  CompleteManifest(replanner.robot(), scene, folder);
}

}  // namespace halfstep
