#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "tests/verify/verified_here.h"
#include "wpg/files/sha256.h"

namespace halfstep {

inline constexpr char kEpisodeScene[] =
    "name: beside\n"
    "obstacles:\n"
    "  - name: bar\n"
    "    box: {size_m: [0.1, 0.1, 1.0]}\n"
    "    pose: {xyz: [0.4, 1.5, 0.5]}\n"
    "    motion: {speed_m_s: 0.05}\n";

// Two half-steps on coarse cells. A bar jumps beside the way, and later the goal goes on.
inline constexpr char kEpisodeConfig[] =
    "name: beside\n"
    "robot: ../robots/hrp2.yaml\n"
    "scene: scene.yaml\n"
    "goal: {x_m: 0.4, y_m: 0.1, radius_m: 0.05}\n"
    "half_step: {duration_s: 1.5, zmp_shift_s: 0.075}\n"
    "smoothing: {margins: {double_support_s: 0.075}}\n"
    "step_set: {x_min_m: 0, x_max_m: 0.2, y_min_m: -0.21, y_max_m: -0.21, spacing_m: 0.2, "
    "yaws_rad: [0]}\n"
    "swept_volumes: {cell_m: 0.05, displacement_m: 0.05, cache: cache}\n"
    "planner: {unimproved_nodes: 0, max_nodes: 2000}\n"
    "output: {period_s: 0.01}\n"
    "live:\n"
    "  horizon_s: 4\n"
    "  sensing: {rests_after_s: 0.5}\n"
    "  script:\n"
    "    - {at_s: 0.3, do: jump, obstacle: bar, xyz: [0.4, 0.95, 0.5]}\n"
    "    - {at_s: 1.5, do: goal, goal_m: [0.6, 0.1]}\n";

// A folder of an episode, with its own copy of robot and scene. The episode is made once a build.
class TamperedEpisode {
 public:
  TamperedEpisode() {
    const std::string build =
        std::to_string(std::filesystem::last_write_time(CommandFile()).time_since_epoch().count());
    const std::filesystem::path made =
        InBuild("verify_episode_") + Sha256(build + kEpisodeScene + kEpisodeConfig).substr(0, 16);
    if (!std::filesystem::exists(made)) {
      const std::filesystem::path mine = made.string() + "." + std::to_string(getpid());
      Make(mine);
      std::error_code lost_the_race;
      std::filesystem::rename(mine, made, lost_the_race);
      if (lost_the_race) std::filesystem::remove_all(mine);
    }
    std::filesystem::copy(made, place_.path(), std::filesystem::copy_options::recursive);
  }

  std::filesystem::path folder() const { return place_ / "walk/episode"; }
  /// In this process.
  Outcome Verify() const { return VerifiedHere({.run = folder().string()}); }

  void Rehash() const {
    const std::filesystem::path manifest = folder() / "manifest.json";
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(ReadText(manifest));
    json["config_sha256"] = Sha256(ReadText(folder() / "config.yaml"));
    const nlohmann::ordered_json listed = json["files"];
    for (const auto& item : listed.items()) {
      if (!std::filesystem::exists(folder() / item.key())) continue;
      const std::string bytes = ReadText(folder() / item.key());
      json["files"][item.key()] = {{"bytes", bytes.size()}, {"sha256", Sha256(bytes)}};
    }
    WriteText(manifest, json.dump(2) + "\n");
  }

 private:
  static void Make(const std::filesystem::path& place) {
    std::filesystem::create_directories(place / "walk");
    std::filesystem::copy(InSources("wpg/robots"), place / "robots",
                          std::filesystem::copy_options::recursive);
    WriteText(place / "walk/scene.yaml", kEpisodeScene);
    WriteText(place / "walk/walk.yaml", kEpisodeConfig);
    const Outcome outcome =
        Halfstep(place / "walk", {"live", "walk.yaml", "--quiet", "--out", "episode"});
    if (outcome.status != 0) throw std::runtime_error("halfstep live: " + outcome.err);
  }

  TemporaryFolder place_;
};

}  // namespace halfstep
