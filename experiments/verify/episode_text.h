#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/walk_text.h"
#include "wpg/files/input_file.h"

namespace halfstep::verify {

/// What manifest.json says of an episode; nothing of it is believed.
struct EpisodeManifest {
  /// As the episode was asked for; hashes as hexadecimal text.
  std::string name, config_sha256, robot_sha256, scene_sha256, clock, policy, ending;
  std::vector<InputFile> robot_files, scene_files;  ///< without paths
  std::map<std::string, InputFile> files;           ///< of the episode, by relative path
  long seed = 0, walks = 0;                         ///< of the noise; walks that were handed over
  double waited = 0, end = 0;                       ///< before time 0, and at the end [s]
  bool stopped = false;  ///< the last walk was cut after the last half-step that began
  std::vector<NotCoveredItem> not_covered;  ///< by its proofs
};

/// Whether the text of a manifest.json says that it is of an episode. Throws InputError for what is
/// no JSON object.
bool IsOfEpisode(const std::string& path, const std::string& text);

/// Throws InputError for what is no manifest of an episode.
EpisodeManifest ReadEpisodeManifest(const std::string& path, const std::string& text);

/// A row of worlds.csv.
struct WorldRow {
  int world = 0;                   ///< its version
  double known = 0, measured = 0;  ///< [s]
  int sound_since = 0;             ///< the earliest version that none contradicts
  Eigen::Vector2d goal{0, 0};      ///< its centre, in W [m]
  std::vector<size_t> areas;       ///< no-step areas of the scene that are there, from 0
};

/// A row of obstacles.csv.
struct ObstacleRow {
  int world = 0;                             ///< version of the world
  std::string name;                          ///< of the obstacle
  Eigen::Vector3d place{0, 0, 0};            ///< of its frame's origin, in W [m]
  std::array<double, 4> turn{1, 0, 0, 0};    ///< of its frame, a quaternion w, x, y, z
  double error = 0, speed = 0, horizon = 0;  ///< r [m], v [m/s], H [s]
};

/// A row of plans.csv; most of what it says of why and how a walk was made is not read.
struct PlanRow {
  std::string kind;        ///< why the walk was proposed
  double handed_over = 0;  ///< [s]
  int footsteps = 0;       ///< of the walk
  double duration = 0;     ///< [s]
};

/// A row of grants.csv. Half-steps count from 1; `through` 0: none may begin.
struct GrantRow {
  double t = 0;             ///< [s]
  int walk = 0, world = 0;  ///< numbers of both
  double proved_from = 0;   ///< [s]
  int through = 0;          ///< the latest half-step, from 1, that may begin
  double valid_until = 0;   ///< [s]
};

/// A row of begun.csv: a half-step, from 1, and a grant, from 0.
struct BegunRow {
  int half_step = 0, grant = 0;  ///< from 1; from 0
};

/// A row of events.csv; half-step 0: none.
struct EventRow {
  double t = 0;                            ///< [s]
  std::string what;                        ///< what happened
  int world = 0, walk = 0, half_step = 0;  ///< numbers of what it is about
};

/// A walk of an episode as its three files say it, from the step on that changed; what is before is
/// that of the walk before it.
struct EpisodeWalkText {
  std::vector<FootstepRow> footsteps;   ///< footsteps.csv; first both soles where these begin
  std::vector<HalfStepRow> half_steps;  ///< half_steps.csv
  std::vector<double> overlaps;         ///< overlaps.csv [s]; where `first` > 0 also that before it
  int first = 0;                        ///< half-step of the walk that half_steps[0] is
};

/// The tables of an episode as they are read. Numbers that name a row of another table need not
/// name one (CheckEpisodeNumbers).
struct EpisodeText {
  std::vector<WorldRow> worlds;        ///< worlds.csv
  std::vector<ObstacleRow> obstacles;  ///< obstacles.csv
  std::vector<PlanRow> plans;          ///< plans.csv
  std::vector<GrantRow> grants;        ///< grants.csv
  std::vector<BegunRow> begun;         ///< begun.csv
  std::vector<EventRow> events;        ///< events.csv
  std::vector<EpisodeWalkText> walks;  ///< one for each row of plans.csv
};

/// The folder of a walk, from 0: "walks/007".
std::string FolderOfWalk(size_t walk);

/// Reads the tables of an episode with so many walks. Throws InputError for what is no such table.
EpisodeText ReadEpisode(const std::filesystem::path& folder, size_t walks);

}  // namespace halfstep::verify
