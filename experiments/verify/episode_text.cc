#include "experiments/verify/episode_text.h"

#include <charconv>
#include <string_view>

#include "experiments/verify/csv_text.h"
#include "experiments/verify/json_text.h"
#include "experiments/verify/run_manifest.h"
#include "wpg/files/text.h"

namespace halfstep::verify {
namespace {

using nlohmann::json;

constexpr long kMostWalks = 100000;

std::vector<InputFile> ListedInputs(const JsonMember& inputs, const std::string& key) {
  std::vector<InputFile> files;
  for (const JsonMember& item : inputs.Items(key)) {
    files.push_back(ListedFile(item, item.String("name")));
  }
  return files;
}

// "1 3" as 0 and 2; "none" as nothing.
std::vector<size_t> Areas(const CsvText& csv, size_t row, size_t column) {
  const std::string& cell = csv.Cell(row, column);
  std::vector<size_t> areas;
  if (cell == "none") return areas;
  std::string_view rest = cell;
  while (true) {
    size_t area = 0;
    const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), area);
    if (error != std::errc() || area == 0) {
      csv.Refuse(row, column, "is no list of areas (valid: none, or numbers from 1 on)");
    }
    areas.push_back(area - 1);
    rest.remove_prefix(static_cast<size_t>(stop - rest.data()));
    if (rest.empty()) return areas;
    if (rest.front() != ' ') csv.Refuse(row, column, "is no list of areas");
    rest.remove_prefix(1);
  }
}

CsvText Table(const std::filesystem::path& folder, const char* file,
              const std::vector<std::string>& header) {
  const std::string path = (folder / file).string();
  return {path, ReadBytes(path), header};
}

std::vector<WorldRow> ReadWorlds(const std::filesystem::path& folder) {
  const CsvText csv =
      Table(folder, "worlds.csv",
            {"world", "known_s", "measured_s", "sound_since", "goal_x_m", "goal_y_m", "areas"});
  std::vector<WorldRow> rows;
  for (size_t i = 0; i < csv.size(); ++i) {
    rows.push_back({.world = csv.Whole(i, 0, 0),
                    .known = csv.Number(i, 1),
                    .measured = csv.Number(i, 2),
                    .sound_since = csv.Whole(i, 3, 0),
                    .goal = {csv.Number(i, 4), csv.Number(i, 5)},
                    .areas = Areas(csv, i, 6)});
  }
  return rows;
}

std::vector<ObstacleRow> ReadObstacles(const std::filesystem::path& folder) {
  const CsvText csv = Table(folder, "obstacles.csv",
                            {"world", "obstacle", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz",
                             "error_m", "speed_m_s", "horizon_s"});
  std::vector<ObstacleRow> rows;
  for (size_t i = 0; i < csv.size(); ++i) {
    const auto number = [&](size_t column) { return csv.Number(i, column); };
    rows.push_back({.world = csv.Whole(i, 0, 0),
                    .name = csv.Cell(i, 1),
                    .place = {number(2), number(3), number(4)},
                    .turn = {number(5), number(6), number(7), number(8)},
                    .error = number(9),
                    .speed = number(10),
                    .horizon = number(11)});
  }
  return rows;
}

std::vector<PlanRow> ReadPlans(const std::filesystem::path& folder) {
  const CsvText csv = Table(folder, "plans.csv",
                            {"walk", "handed_over_s", "kind", "asked_s", "measured_s",
                             "first_changed", "footsteps", "duration_s", "reason"});
  std::vector<PlanRow> rows;
  for (size_t i = 0; i < csv.size(); ++i) {
    (void)csv.Whole(i, 0, 0);
    csv.CheckFirst(i, static_cast<int>(i));
    rows.push_back({.kind = csv.Cell(i, 2),
                    .handed_over = csv.Number(i, 1),
                    .footsteps = csv.Positive(i, 6),
                    .duration = csv.Number(i, 7)});
  }
  return rows;
}

std::vector<GrantRow> ReadGrants(const std::filesystem::path& folder) {
  const CsvText csv =
      Table(folder, "grants.csv",
            {"grant", "t_s", "walk", "world", "proved_from_s", "through", "valid_until_s"});
  std::vector<GrantRow> rows;
  for (size_t i = 0; i < csv.size(); ++i) {
    (void)csv.Whole(i, 0, 0);
    csv.CheckFirst(i, static_cast<int>(i));
    rows.push_back({.t = csv.Number(i, 1),
                    .walk = csv.Whole(i, 2, 0),
                    .world = csv.Whole(i, 3, 0),
                    .proved_from = csv.Number(i, 4),
                    .through = csv.Whole(i, 5, 0),
                    .valid_until = csv.Number(i, 6)});
  }
  return rows;
}

std::vector<BegunRow> ReadBegun(const std::filesystem::path& folder) {
  const CsvText csv = Table(folder, "begun.csv", {"half_step", "grant"});
  std::vector<BegunRow> rows;
  for (size_t i = 0; i < csv.size(); ++i) {
    rows.push_back({.half_step = csv.Positive(i, 0), .grant = csv.Whole(i, 1, 0)});
  }
  return rows;
}

std::vector<EventRow> ReadEvents(const std::filesystem::path& folder) {
  const CsvText csv =
      Table(folder, "events.csv", {"t_s", "event", "world", "walk", "half_step", "text"});
  std::vector<EventRow> rows;
  for (size_t i = 0; i < csv.size(); ++i) {
    rows.push_back({.t = csv.Number(i, 0),
                    .what = csv.Cell(i, 1),
                    .world = csv.Whole(i, 2, 0),
                    .walk = csv.Whole(i, 3, -1),
                    .half_step = csv.Whole(i, 4, 0)});
  }
  return rows;
}

}  // namespace

bool IsOfEpisode(const std::string& path, const std::string& text) {
  const json document = ParseJson(path, text);
  return document.is_object() && document.contains("kind") && document["kind"] == "episode";
}

EpisodeManifest ReadEpisodeManifest(const std::string& path, const std::string& text) {
  const json document = ParseJson(path, text);
  const JsonMember root(path, document, "");
  if (root.Whole("format") != 2) root.Fail("format: only 2 is known");
  if (root.String("program") != "halfstep") root.Fail("program: is not halfstep");
  if (!document.contains("stopped") || !document["stopped"].is_boolean()) {
    root.Fail("stopped: is not true or false");
  }
  const JsonMember inputs = root.Object("inputs");
  const EpisodeManifest m{.name = root.String("name"),
                          .config_sha256 = root.String("config_sha256"),
                          .robot_sha256 = root.String("robot_sha256"),
                          .scene_sha256 = root.String("scene_sha256"),
                          .clock = root.String("clock"),
                          .policy = root.String("policy"),
                          .ending = root.String("ending"),
                          .robot_files = ListedInputs(inputs, "robot"),
                          .scene_files = ListedInputs(inputs, "scene"),
                          .files = ListedFiles(root),
                          .seed = root.Whole("seed"),
                          .walks = root.Whole("walks"),
                          .waited = root.Number("waited_s"),
                          .end = root.Number("end_s"),
                          .stopped = document["stopped"].get<bool>(),
                          .not_covered = NotCoveredItems(root)};
  if (m.walks < 0 || m.walks > kMostWalks) root.Fail("walks: out of range (valid: 0 … 100000)");
  return m;
}

std::string FolderOfWalk(size_t walk) { return Formatted("walks/%03zu", walk); }

EpisodeText ReadEpisode(const std::filesystem::path& folder, size_t walks) {
  EpisodeText text{.worlds = ReadWorlds(folder),
                   .obstacles = ReadObstacles(folder),
                   .plans = ReadPlans(folder),
                   .grants = ReadGrants(folder),
                   .begun = ReadBegun(folder),
                   .events = ReadEvents(folder),
                   .walks = {}};
  for (size_t k = 0; k < walks; ++k) {
    const auto read = [&](const char* file, const auto& reader) {
      const std::string path = (folder / FolderOfWalk(k) / file).string();
      return reader(path, ReadBytes(path));
    };
    EpisodeWalkText& walk = text.walks.emplace_back();
    walk.half_steps = read("half_steps.csv", [&](const std::string& path, const std::string& csv) {
      return ReadHalfStepsFrom(path, csv, &walk.first);
    });
    walk.footsteps = read("footsteps.csv", [&](const std::string& path, const std::string& csv) {
      return ReadFootstepsAfter(path, csv, walk.first / 2);
    });
    walk.overlaps = read("overlaps.csv", [&](const std::string& path, const std::string& csv) {
      return ReadOverlapsOfEpisode(path, csv, walk.first);
    });
  }
  return text;
}

}  // namespace halfstep::verify
