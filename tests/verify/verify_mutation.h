#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/scene/scene.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "tests/verify/scaled_hrp2.h"
#include "tests/verify/verified_here.h"
#include "wpg/files/sha256.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// What the run to be tampered with is made of.
struct TamperedWalk {
  std::string config = "fig5_box";          ///< a shipped one
  std::vector<std::string> overrides = {};  ///< KEY=VALUE
  std::optional<double> com_height = {};    ///< of the robot [m]; none: as shipped
  std::optional<double> acceleration = {};  ///< limit of every leg joint [rad/s²]; none: none
  std::string robot = "hrp2";               ///< a shipped one
  double size = 1;                          ///< of the robot: HRP-2, its lengths times this
};

/// A run with its own copy of robot and scene, to be tampered with; by default of the Fig. 5 walk.
/// Scenes are copied for that one and for `crossing`; for `platform_15cm` a scene with a platform
/// of 10 cm is written, which an override has to name. The run itself is made once a build by the
/// command and copied for each object.
class TamperedRun {
 public:
  explicit TamperedRun(const TamperedWalk& walk = {}) : robot_(walk.robot), scene_(SceneOf(walk)) {
    namespace fs = std::filesystem;
    std::string name = Version() + " " + walk.config;
    for (const std::string& item : walk.overrides) name += " " + item;
    if (walk.com_height) name += " " + std::to_string(*walk.com_height);
    if (walk.acceleration) name += " acceleration " + std::to_string(*walk.acceleration);
    if (walk.size != 1) name += " size " + std::to_string(walk.size);
    if (walk.robot != "hrp2") name += " robot " + walk.robot;
    const fs::path made = InBuild("verify_run_") + Sha256(name).substr(0, 16);
    if (!fs::exists(made)) {
      const fs::path mine = made.string() + "." + std::to_string(getpid());
      Make(mine, walk);
      std::error_code lost_the_race;
      fs::rename(mine, made, lost_the_race);
      if (lost_the_race) fs::remove_all(mine);
    }
    fs::copy(made, place_.path(), fs::copy_options::recursive);
  }

  std::filesystem::path run() const { return place_ / "run"; }
  std::filesystem::path trajectory() const { return run() / "dichotomy/trajectory.csv"; }
  std::filesystem::path certificate() const { return run() / "dichotomy/certificate.csv"; }
  std::filesystem::path json() const { return run() / "dichotomy/certificate.json"; }
  /// The copies in the run.
  std::filesystem::path scene() const { return run() / "inputs/scene" / scene_; }
  std::filesystem::path urdf() const { return run() / "inputs/robot/hrp2.urdf"; }

  /// Of the dichotomy, in this process.
  Outcome Verify() const { return VerifiedHere({.run = run().string(), .method = "dichotomy"}); }

  /// Cells of a CSV, the header first, and back.
  using Table = std::vector<std::vector<std::string>>;
  static Table Cells(const std::string& text) {
    Table table(1, {""});
    bool quoted = false;  // quotes stay part of their cells
    for (const char c : text) {
      if (c == '"') quoted = !quoted;
      if (c == '\n') {
        table.push_back({""});
      } else if (c == ',' && !quoted) {
        table.back().emplace_back();
      } else {
        table.back().back() += c;
      }
    }
    table.pop_back();
    return table;
  }
  static void Write(const std::filesystem::path& path, const Table& table) {
    std::string text;
    for (const auto& row : table) {
      for (size_t i = 0; i < row.size(); ++i) text += (i == 0 ? "" : ",") + row[i];
      text += '\n';
    }
    WriteText(path, text);
  }
  void EditTrajectory(const std::function<void(Table&)>& edit) { EditCsv(trajectory(), edit); }
  void EditCertificate(const std::function<void(Table&)>& edit) { EditCsv(certificate(), edit); }
  void EditJson(const std::function<void(nlohmann::ordered_json&)>& edit) {
    EditJsonFile(json(), edit);
  }
  /// Edits the cells of any table of the run.
  static void EditCsv(const std::filesystem::path& path, const std::function<void(Table&)>& edit) {
    Table table = Cells(ReadText(path));
    edit(table);
    Write(path, table);
  }
  /// Replaces the first occurrence of a text in a file.
  static void Replace(const std::filesystem::path& path, const std::string& old,
                      const std::string& by) {
    std::string text = ReadText(path);
    const size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    WriteText(path, text.replace(at, old.size(), by));
  }

  /// Edits the manifest.
  void EditManifest(const std::function<void(nlohmann::ordered_json&)>& edit) const {
    EditJsonFile(run() / "manifest.json", edit);
  }

  /// Makes every hash and length that the run states those of the files as they are now, of all its
  /// methods: what a forger would do.
  void Rehash() const {
    const auto robot = LoadRobot((run() / "inputs/robot" / (robot_ + ".yaml")).string()).files;
    std::vector<InputFile> scene;
    if (!scene_.empty()) scene = LoadScene(this->scene().string()).files;
    for (const auto& folder : std::filesystem::directory_iterator(run())) {
      const auto certificate = folder.path() / "certificate.json";
      if (!folder.is_directory() || !std::filesystem::exists(certificate)) continue;
      EditJsonFile(certificate, [&](nlohmann::ordered_json& document) {
        nlohmann::ordered_json& hashes = document["sha256"];
        for (const char* file : {"trajectory.csv", "certificate.csv"}) {
          if (!std::filesystem::exists(folder.path() / file)) continue;
          hashes[file] = Sha256(ReadText(folder.path() / file));
        }
        hashes["robot"] = CombinedSha256(robot);
        hashes["scene"] = CombinedSha256(scene);
      });
    }
    EditManifest([&](nlohmann::ordered_json& manifest) {
      if (std::filesystem::exists(run() / "config.yaml")) {
        manifest["config_sha256"] = Sha256(ReadText(run() / "config.yaml"));
      }
      manifest["robot_sha256"] = CombinedSha256(robot);
      manifest["scene_sha256"] = CombinedSha256(scene);
      const auto list = [](const std::vector<InputFile>& files) {
        nlohmann::ordered_json items = nlohmann::ordered_json::array();
        for (const InputFile& file : files) {
          items.push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
        }
        return items;
      };
      manifest["inputs"]["robot"] = list(robot);
      manifest["inputs"]["scene"] = list(scene);
      const nlohmann::ordered_json listed = manifest["files"];
      for (const auto& item : listed.items()) {
        if (!std::filesystem::exists(run() / item.key())) continue;
        const std::string bytes = ReadText(run() / item.key());
        manifest["files"][item.key()] = {{"bytes", bytes.size()}, {"sha256", Sha256(bytes)}};
      }
    });
  }

 private:
  // Names the build of the command that makes the run.
  static std::string Version() {
    return std::to_string(
        std::filesystem::last_write_time(CommandFile()).time_since_epoch().count());
  }

  static std::string SceneOf(const TamperedWalk& walk) {
    for (const std::string& item : walk.overrides) {
      if (item == "scene=none") return "";
    }
    return walk.config == "fig5_box"        ? "box.yaml"
           : walk.config == "crossing"      ? "crossing_bar.yaml"
           : walk.config == "platform_15cm" ? "platform_10cm.yaml"
                                            : "";
  }

  static void Make(const std::filesystem::path& place, const TamperedWalk& walk) {
    namespace fs = std::filesystem;
    const fs::path source(InSources());
    fs::create_directories(place);
    fs::copy(source / "wpg/robots", place / "robots", fs::copy_options::recursive);
    fs::create_directories(place / "scenes");
    for (const char* scene : {"box.yaml", "crossing_bar.yaml"}) {
      fs::copy(source / "experiments/scenes" / scene, place / "scenes" / scene);
    }
    WriteText(
        place / "scenes/platform_10cm.yaml",
        "name: platform_10cm\nsurfaces:\n  - name: platform\n    polygon_m: [[0.14, -1], [0.7, "
        "-1], [0.7, 1], [0.14, 1]]\n    height_m: 0.1\n");
    // An area that no sole may touch, 10 cm and more beside the feet.
    WriteText(place / "scenes/box.yaml",
              "no_step:\n  - name: aside\n    polygon_m: [[-0.5, 0.3], [0.7, 0.3], [0.7, 0.4], "
              "[-0.5, 0.4]]\n" +
                  ReadText(place / "scenes/box.yaml"));
    if (walk.com_height) {
      Replace(place / "robots/hrp2.yaml", "\ncom_height_m: 0.814",
              "\ncom_height_m: " + std::to_string(*walk.com_height));
    }
    GiveHrp2Efforts(place / "robots");
    if (walk.acceleration) {
      std::string limits = "acceleration_limits_rad_s2:\n";
      for (const std::string side : {"L", "R"}) {
        for (const char joint : {'0', '1', '2', '3', '4', '5'}) {
          limits +=
              "  " + side + "LEG_JOINT" + joint + ": " + std::to_string(*walk.acceleration) + "\n";
        }
      }
      WriteText(place / "robots/hrp2.yaml", ReadText(place / "robots/hrp2.yaml") + limits);
    }
    if (walk.size != 1) ScaleHrp2(place / "robots", walk.size);
    const std::string config = "configs/" + walk.config + ".yaml";
    fs::create_directories(place / "configs");
    fs::copy(source / "experiments" / config, place / config);
    std::vector<std::string> arguments = {"run", config, "--quiet", "--out", "run"};
    for (const std::string& item : {"robot=../robots/" + walk.robot + ".yaml",
                                    std::string("smoothing.methods=[dichotomy]")}) {
      arguments.insert(arguments.end(), {"--set", item});
    }
    for (const std::string& item : walk.overrides) {
      arguments.insert(arguments.end(), {"--set", item});
    }
    const Outcome outcome = Halfstep(place, arguments);
    if (outcome.status != 0) throw std::runtime_error("halfstep run: " + outcome.err);
    // The run has its own copies of what it used; each object would copy all of the rest.
    for (const char* used : {"robots", "scenes", "configs"}) fs::remove_all(place / used);
  }

  static void EditJsonFile(const std::filesystem::path& path,
                           const std::function<void(nlohmann::ordered_json&)>& edit) {
    nlohmann::ordered_json document = nlohmann::ordered_json::parse(ReadText(path));
    edit(document);
    WriteText(path, document.dump(2) + "\n");
  }

  TemporaryFolder place_;
  std::string robot_, scene_;  // of the robot and the scene's file; "": no scene of its own
};

}  // namespace halfstep
