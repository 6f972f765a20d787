#include "experiments/live/episode_tables.h"

#include <ranges>

#include "experiments/tables/csv_writer.h"
#include "experiments/tables/parameter_tables.h"
#include "experiments/tables/result_tables.h"
#include "wpg/files/text.h"

namespace halfstep {

using enum CsvType;

namespace {

std::string OrNone(const std::string& text) { return text.empty() ? "none" : text; }

CsvFile EventsCsv(const Episode& episode, size_t from) {
  CsvWriter csv({{"t_s", kNumber, "s", "when"},
                 {"event", kString, "",
                  "measured, lost, contradicted, commanded, begins, near, early, late, pushed, "
                  "handed_over, refused, unsafe, stopped"},
                 {"world", kInteger, "", "version that was known then"},
                 {"walk", kInteger, "", "in execution then, from 0"},
                 {"half_step", kInteger, "", "that it is about, from 1; 0: none"},
                 {"text", kString, "", "in words"}});
  for (const EpisodeEvent& event : episode.events | std::views::drop(from)) {
    csv.Cell(event.t).Cell(event.what).Cell(event.version).Cell(event.walk);
    csv.Cell(event.half_step + 1).Cell(OrNone(event.text)).EndRow();
  }
  return csv.file();
}

CsvFile WorldsCsv(const Episode& episode, size_t from) {
  CsvWriter csv(
      {{"world", kInteger, "", "version, from 0"},
       {"known_s", kNumber, "s", "when it became known"},
       {"measured_s", kNumber, "s", "when it was measured"},
       {"sound_since", kInteger, "", "what was proved against earlier worlds is void"},
       {"goal_x_m", kNumber, "m", "centre of the goal, x", "W"},
       {"goal_y_m", kNumber, "m", "centre of the goal, y", "W"},
       {"areas", kString, "", "no-step areas that are there, from 1, separated by blanks"}});
  for (size_t k = from; k < episode.worlds.size(); ++k) {
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

CsvFile ObstaclesCsv(const Episode& episode, size_t from) {
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
  for (const World& world : episode.worlds | std::views::drop(from)) {
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

CsvFile PlansCsv(const Episode& episode, size_t from) {
  CsvWriter csv({{"walk", kInteger, "", "from 0"},
                 {"handed_over_s", kNumber, "s", "when it took the place of the one before"},
                 {"kind", kString, "", "changed, shortened, resumed, smoothed or commanded"},
                 {"asked_s", kNumber, "s", "when work on it began"},
                 {"measured_s", kNumber, "s", "when the world that it was made for was measured"},
                 {"first_changed", kInteger, "", "half-step, from 1"},
                 {"footsteps", kInteger, "", "of the whole walk"},
                 {"duration_s", kNumber, "s", "of the whole walk"},
                 {"reason", kString, "", "in words"}});
  for (size_t k = from; k < episode.walks.size(); ++k) {
    const ExecutedWalk& walk = episode.walks[k];
    csv.Cell(static_cast<long>(k)).Cell(walk.t).Cell(Name(walk.kind)).Cell(walk.asked);
    csv.Cell(walk.measured).Cell(walk.first_changed + 1).Cell(walk.tail.size() / 2);
    csv.Cell(walk.tail.end()).Cell(OrNone(walk.reason)).EndRow();
  }
  return csv.file();
}

CsvFile GrantsCsv(const Episode& episode, size_t from) {
  CsvWriter csv({{"grant", kInteger, "", "from 0"},
                 {"t_s", kNumber, "s", "from when on it counted"},
                 {"walk", kInteger, "", "that it is about"},
                 {"world", kInteger, "", "version that it was proved against"},
                 {"proved_from_s", kNumber, "s", "nothing before was looked at"},
                 {"through", kInteger, "", "half-steps up to this one may begin, from 1"},
                 {"valid_until_s", kNumber, "s", "as long as they end by then; inf: no limit"}});
  for (size_t k = from; k < episode.grants.size(); ++k) {
    const EpisodeGrant& one = episode.grants[k];
    csv.Cell(static_cast<long>(k)).Cell(one.t).Cell(one.walk).Cell(one.grant.version);
    csv.Cell(one.grant.proved_at).Cell(one.grant.through + 1).Cell(one.grant.valid_until).EndRow();
  }
  return csv.file();
}

CsvFile BegunCsv(const Episode& episode, size_t from) {
  CsvWriter csv({{"half_step", kInteger, "", "that began, from 1"},
                 {"grant", kInteger, "", "that allowed it"}});
  for (const BegunHalfStep& one : episode.begun | std::views::drop(from))
    csv.Cell(one.half_step + 1).Cell(one.grant).EndRow();
  return csv.file();
}

CsvFile TimingsCsv(const Episode& episode, size_t from) {
  CsvWriter csv({{"walk", kInteger, "", "from 0"},
                 {"check_s", kNumber, "s", "of computing: what is safe"},
                 {"plan_s", kNumber, "s", "of computing: footsteps"},
                 {"smooth_s", kNumber, "s", "of computing: overlaps"},
                 {"effort", kNumber, "1", "of computing, as counted, about seconds of one core"}});
  for (size_t k = from; k < episode.walks.size(); ++k) {
    const ExecutedWalk& walk = episode.walks[k];
    csv.Cell(static_cast<long>(k))
        .Cell(walk.check_s)
        .Cell(walk.plan_s)
        .Cell(walk.smooth_s)
        .Cell(walk.effort)
        .EndRow();
  }
  return csv.file();
}

CsvFile OverlapsOf(const WalkTail& tail) {
  CsvWriter csv({OverlapsColumns().front(), ColumnOf(ParameterFamily::kOverlap)});
  if (tail.first > 0) csv.Cell(tail.first).Cell(tail.overlap).EndRow();
  for (size_t j = 0; j < tail.plan.parameters.overlaps.size(); ++j) {
    csv.Cell(tail.first + static_cast<long>(j) + 1).Cell(tail.plan.parameters.overlaps[j]).EndRow();
  }
  return csv.file();
}

}  // namespace

std::vector<EpisodeTable> EpisodeTables(const Episode& episode, const EpisodeProgress& written) {
  return {{"obstacles", ObstaclesCsv(episode, written.worlds)},
          {"worlds", WorldsCsv(episode, written.worlds)},
          {"timings", TimingsCsv(episode, written.walks)},
          {"plans", PlansCsv(episode, written.walks)},
          {"grants", GrantsCsv(episode, written.grants)},
          {"begun", BegunCsv(episode, written.begun)},
          {"events", EventsCsv(episode, written.events)}};
}

std::string WalkFolder(size_t walk) { return Formatted("walks/%03zu", walk); }

std::vector<EpisodeTable> WalkTables(const Episode& episode, size_t walk) {
  const WalkTail& tail = episode.walks[walk].tail;
  const WalkPlan& plan = tail.plan;
  const std::string place = WalkFolder(walk) + "/";
  return {
      {place + "footsteps", FootstepsCsv(plan.sequence, tail.first / 2)},
      {place + "half_steps", HalfStepsCsv(plan.sequence, plan.parameters, tail.first, tail.begin)},
      {place + "overlaps", OverlapsOf(tail)}};
}

}  // namespace halfstep
