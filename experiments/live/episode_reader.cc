#include "experiments/live/episode_reader.h"

#include <algorithm>
#include <charconv>
#include <ranges>
#include <string_view>

#include "experiments/live/episode_tables.h"
#include "experiments/live/judged_promise.h"
#include "experiments/live/promise_words.h"
#include "experiments/live/recorded_tables.h"
#include "experiments/tables/csv_reader.h"
#include "experiments/tables/given_walk_file.h"
#include "experiments/tables/json_file.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

void ReadWorlds(const RecordedTables& tables, const LiveConfig& config, const Place& place,
                Episode* episode) {
  const CsvTable table = tables.Of("worlds");
  const std::vector<double> known = table.Numbers("known_s"),
                            measured = table.Numbers("measured_s"), x = table.Numbers("goal_x_m"),
                            y = table.Numbers("goal_y_m");
  const std::vector<int> version = Integers(table, "world"), sound = Integers(table, "sound_since");
  const std::vector<std::string> areas = table.Texts("areas");
  for (size_t k = 0; k < known.size(); ++k) {
    World world;
    world.version = version[k];
    world.measured_at = measured[k];
    world.sound_since = sound[k];
    world.goal = GoalOn(config.experiment.goal, *place.scene.ground);
    world.goal.X_WG.x = x[k];
    world.goal.X_WG.y = y[k];
    world.scene = place.scene.Emptied();
    for (const auto word : std::views::split(areas[k], ' ')) {
      const std::string_view text(word.begin(), word.end());
      if (text == "none") break;
      const double area = ParseNumber(text).value - 1.0;  // no number: −1, which is no index
      const size_t index = IndexIn(place.scene.no_step.size(), area, table, k, "areas");
      world.areas.push_back(index);
      world.scene.no_step.push_back(place.scene.no_step[index]);
    }
    episode->worlds.push_back(std::move(world));
    episode->known.push_back(known[k]);
  }
}

void ReadObstacles(const RecordedTables& tables, const Place& place, Episode* episode) {
  const CsvTable table = tables.Of("obstacles");
  const std::vector<std::string> names = table.Texts("obstacle");
  std::vector<std::vector<double>> numbers;
  for (const char* column : {"world", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz", "error_m",
                             "speed_m_s", "horizon_s"}) {
    numbers.push_back(table.Numbers(column));
  }
  for (size_t row = 0; row < names.size(); ++row) {
    const auto at = [&](size_t column) { return numbers[column][row]; };
    const auto world = std::ranges::find(episode->worlds, static_cast<int>(at(0)), &World::version);
    if (world == episode->worlds.end()) continue;  // killed before its row was written
    const auto shape = std::ranges::find(place.scene.obstacles, names[row], &Obstacle::name);
    if (shape == place.scene.obstacles.end()) {
      throw InputError({table.path + Formatted(":%zu: obstacle: ", row + 2) + Quote(names[row]) +
                        " is not in the scene (valid: the name of one of its obstacles)"});
    }
    Obstacle obstacle = *shape;
    obstacle.X_WO.translation() = Eigen::Vector3d(at(1), at(2), at(3));
    obstacle.X_WO.linear() =
        Eigen::Quaterniond(at(4), at(5), at(6), at(7)).normalized().toRotationMatrix();
    obstacle.motion = {.waypoints = {},
                       .error = at(8),
                       .speed = at(9),
                       .measured_at = world->measured_at,
                       .horizon = at(10)};
    world->scene.obstacles.push_back(std::move(obstacle));
  }
}

// The end of a walk whose beginning is that of the walk before it, which has `most` half-steps.
WalkTail ReadWalk(const RecordedTables& tables, size_t walk, const LiveConfig& config,
                  const Place& place, int most) {
  const CsvTable table = tables.Of(WalkFolder(walk) + "/footsteps");
  const std::vector<std::string> feet = table.Texts("foot");
  const std::vector<double> x = table.Numbers("x_m"), y = table.Numbers("y_m"),
                            yaw = table.Numbers("yaw_rad"), via = table.Numbers("via_height_m"),
                            duration = table.Numbers("duration_s");
  const std::vector<double> z = table.Has("z_m") ? table.Numbers("z_m") : std::vector<double>{};
  constexpr std::array kSides = {Side::kLeft, Side::kRight};
  std::array<Foothold, 2> start;
  std::vector<Footstep> footsteps;
  for (size_t row = 0; row < feet.size(); ++row) {
    const Side side = Named(kSides, feet[row], table, row);
    const LevelChoice on{.z = z.empty() ? std::nullopt : std::optional(z[row])};
    const Foothold X_WF = OnGround(*place.scene.ground, place.robot, {x[row], y[row], yaw[row]},
                                   table.path + Formatted(":%zu", row + 2), on);
    if (row < 2) {
      Nth(start, Index(side)) = X_WF;
    } else {
      footsteps.push_back({side, X_WF, via[row], duration[row]});
    }
  }
  if (footsteps.empty()) throw InputError({table.path + ": no footsteps"});
  const HalfStepConfig& half_step = config.experiment.half_step;
  const CsvTable half_steps = tables.Of(WalkFolder(walk) + "/half_steps");
  const std::vector<int> number = Integers(half_steps, "half_step");
  WalkTail tail{.first = number.empty() ? 0 : number.front() - 1, .plan = {}};
  if (tail.first < 0 || tail.first > most || tail.first % 2 != 0) {
    throw InputError({half_steps.path + Formatted(":2: half_step: %d (valid: odd, from 1 to %d)",
                                                  tail.first + 1, most + 1)});
  }
  const HalfStepShape shape = ShapeOf(half_step);
  tail.plan.sequence = MakeSequence(start, footsteps, half_step.via_lateral, shape,
                                    MotionModelOf(place.robot, shape));
  tail.plan.parameters =
      ReadParameters(tables.folder() / WalkFolder(walk), tail.plan.sequence, tail.first);
  if (tail.first == 0) return tail;
  tail.begin = half_steps.Numbers("start_s").front();
  tail.overlap = tables.Of(WalkFolder(walk) + "/overlaps").Numbers("overlap_s").front();
  return tail;
}

// Puts it in place of the end of a walk. `path`: of its tables.
void JoinRead(const WalkTail& tail, const std::string& path, WalkPlan* whole) {
  Join(tail, whole);
  if (tail.first == 0) return;
  const double most = NaturalOverlapBound(whole->parameters, tail.first - 1) + kOverlapTolerance;
  if (tail.overlap >= -kLongestRest && tail.overlap <= most) return;
  throw InputError(
      {path + Formatted("/overlaps.csv:2: overlap_s: %g (valid: up to %g)", tail.overlap, most)});
}

void ReadWalks(const RecordedTables& tables, const LiveConfig& config, const Place& place,
               Episode* episode) {
  const CsvTable table = tables.Of("plans"), timings = tables.Of("timings");
  const std::vector<double> t = table.Numbers("handed_over_s"), asked = table.Numbers("asked_s"),
                            measured = table.Numbers("measured_s"),
                            check = timings.Numbers("check_s"), plan = timings.Numbers("plan_s"),
                            smooth = timings.Numbers("smooth_s");
  const std::vector<double> effort =
      timings.Has("effort") ? timings.Numbers("effort") : std::vector<double>(check.size());
  const std::vector<int> first = Integers(table, "first_changed");
  const std::vector<std::string> kinds = table.Texts("kind"), reasons = table.Texts("reason");
  if (check.size() < t.size()) throw InputError({timings.path + ": has fewer rows than plans.csv"});
  WalkPlan whole;
  for (size_t k = 0; k < t.size(); ++k) {
    const WalkTail tail = ReadWalk(tables, k, config, place, whole.sequence.size());
    JoinRead(tail, (tables.folder() / WalkFolder(k)).string(), &whole);
    episode->walks.push_back({.t = t[k],
                              .kind = Named(kProposalKinds, kinds[k], table, k),
                              .reason = reasons[k] == "none" ? "" : reasons[k],
                              .tail = tail,
                              .first_changed = first[k] - 1,
                              .asked = asked[k],
                              .measured = measured[k],
                              .check_s = check[k],
                              .plan_s = plan[k],
                              .smooth_s = smooth[k],
                              .effort = effort[k]});
  }
}

void ReadGrants(const RecordedTables& tables, Episode* episode) {
  const CsvTable table = tables.Of("grants"), begun = tables.Of("begun");
  const std::vector<double> t = table.Numbers("t_s"), from = table.Numbers("proved_from_s"),
                            until = table.Numbers("valid_until_s"), walk = table.Numbers("walk");
  const std::vector<int> version = Integers(table, "world"), through = Integers(table, "through");
  for (size_t k = 0; k < t.size(); ++k) {
    const size_t of = IndexIn(episode->walks.size(), walk[k], table, k, "walk");
    episode->grants.push_back({t[k],
                               static_cast<int>(of),
                               {.version = version[k],
                                .proved_at = from[k],
                                .through = through[k] - 1,
                                .valid_until = until[k]}});
  }
  const std::vector<int> half_step = Integers(begun, "half_step");
  const std::vector<double> grant = begun.Numbers("grant");
  for (size_t k = 0; k < half_step.size(); ++k) {
    const size_t by = IndexIn(t.size(), grant[k], begun, k, "grant");
    episode->begun.push_back({half_step[k] - 1, static_cast<int>(by)});
  }
}

void ReadEvents(const RecordedTables& tables, Episode* episode) {
  const CsvTable table = tables.Of("events");
  const std::vector<double> t = table.Numbers("t_s");
  const std::vector<std::string> what = table.Texts("event"), text = table.Texts("text");
  const std::vector<int> version = Integers(table, "world"), walk = Integers(table, "walk"),
                         half_step = Integers(table, "half_step");
  for (size_t k = 0; k < t.size(); ++k) {
    episode->events.push_back({.t = t[k],
                               .what = what[k],
                               .version = version[k],
                               .walk = walk[k],
                               .half_step = half_step[k] - 1,
                               .text = text[k] == "none" ? "" : text[k]});
  }
}

Episode ReadTables(const RecordedTables& tables, const LiveConfig& config, const Place& place) {
  Episode episode;
  ReadWorlds(tables, config, place, &episode);
  ReadObstacles(tables, place, &episode);
  ReadWalks(tables, config, place, &episode);
  ReadGrants(tables, &episode);
  ReadEvents(tables, &episode);
  return episode;
}

}  // namespace

Episode ReadEpisode(const fs::path& folder, const LiveConfig& config, const Place& place) {
  Episode episode = ReadTables({folder, false}, config, place);
  const fs::path path = folder / "manifest.json";
  try {
    const nlohmann::json manifest = ReadJsonObject(path);
    const auto ending = manifest.at("ending").get<std::string>();
    const auto named =
        std::ranges::find(kEpisodeEndings, ending, [](EpisodeEnding one) { return Name(one); });
    if (named == kEpisodeEndings.end())
      throw InputError({path.string() + ": ending: " + Quote(ending)});
    episode.ending = *named;
    episode.message = manifest.at("message").get<std::string>();
    episode.waited = manifest.at("waited_s").get<double>();
    episode.stopped = manifest.at("stopped").get<bool>();
    episode.end = manifest.at("end_s").get<double>();
    episode.promise = PromiseOf(manifest.at("promise"));
  } catch (const nlohmann::json::exception& error) {
    throw InputError({path.string() + ": is not an episode's manifest: " + error.what()});
  }
  return episode;
}

Episode ReadJournal(const fs::path& folder, const LiveConfig& config, const Place& place) {
  const RecordedTables tables(folder, true);
  Episode episode = ReadTables(tables, config, place);
  const CsvTable clock = tables.Of("clock");
  if (clock.rows.size() != 1 || episode.walks.empty() || episode.begun.empty()) {
    throw InputError({folder.string() + ": the episode was killed before the robot began to walk"});
  }
  episode.waited = clock.Numbers("waited_s")[0];
  episode.end = clock.Numbers("now_s")[0];
  episode.ending = EpisodeEnding::kKilled;
  episode.message = "the process was killed";
  // Whether the walk in execution was cut.
  for (const EpisodeEvent& event : episode.events) {
    if (event.what == "stopped") episode.stopped = true;
    if (event.what == "handed_over") episode.stopped = false;
  }
  // What clients did to the world is not in the script of a killed episode.
  episode.promise = JudgePromise(episode, nullptr, place, config.live);
  return episode;
}

}  // namespace halfstep
