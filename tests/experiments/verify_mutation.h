#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/checked_file.h"
#include "planner/scene.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/temporary_folder.h"
#include "wpg/robot_model.h"

namespace halfstep {

/// A run of the Fig. 5 walk with its own copy of robot and scene, to be tampered with. The run
/// itself is made once a build by the command and copied for each object.
class TamperedRun {
 public:
  TamperedRun() {
    namespace fs = std::filesystem;
    const fs::path made = fs::path(HALFSTEP_BINARY_DIR) / ("verify_run_" + Version());
    if (!fs::exists(made)) {
      const fs::path mine = made.string() + "." + std::to_string(getpid());
      Make(mine);
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
  std::filesystem::path scene() const { return place_ / "scenes/box.yaml"; }
  std::filesystem::path urdf() const { return place_ / "robots/hrp2.urdf"; }

  Outcome Verify() const {
    return Halfstep(place_.path(), {"verify", "run", "--method", "dichotomy"});
  }

  /// Cells of a CSV, the header first, and back.
  using Table = std::vector<std::vector<std::string>>;
  static Table Cells(const std::string& text) {
    Table table(1, {""});
    for (const char c : text) {
      if (c == '\n') {
        table.push_back({""});
      } else if (c == ',') {
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
    nlohmann::ordered_json document = nlohmann::ordered_json::parse(ReadText(json()));
    edit(document);
    WriteText(json(), document.dump(2) + "\n");
  }
  /// Replaces the first occurrence of a text in a file.
  static void Replace(const std::filesystem::path& path, const std::string& old,
                      const std::string& by) {
    std::string text = ReadText(path);
    const size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    WriteText(path, text.replace(at, old.size(), by));
  }

  /// Makes the certificate's hashes those of the files as they are now.
  void Rehash() {
    EditJson([&](nlohmann::ordered_json& document) {
      const auto of = [](const std::vector<std::string>& files) {
        std::string bytes;
        for (const std::string& file : files) bytes += ReadText(file);
        return HexSha256(bytes);
      };
      nlohmann::ordered_json& hashes = document["sha256"];
      hashes["trajectory.csv"] = HexSha256(ReadText(trajectory()));
      hashes["certificate.csv"] = HexSha256(ReadText(certificate()));
      hashes["robot"] = of(LoadRobot((place_ / "robots/hrp2.yaml").string()).files);
      hashes["scene"] = of(LoadScene(scene().string()).files);
    });
  }

 private:
  // Names the build of the command that makes the run.
  static std::string Version() {
    return std::to_string(
        std::filesystem::last_write_time(HALFSTEP_COMMAND).time_since_epoch().count());
  }

  static void Make(const std::filesystem::path& place) {
    namespace fs = std::filesystem;
    const fs::path source(HALFSTEP_SOURCE_DIR);
    fs::create_directories(place);
    fs::copy(source / "wpg/robots", place / "robots", fs::copy_options::recursive);
    fs::create_directories(place / "scenes");
    fs::copy(source / "experiments/scenes/box.yaml", place / "scenes/box.yaml");
    // An area that no sole may touch, 10 cm and more beside the feet.
    WriteText(place / "scenes/box.yaml",
              "no_step:\n  - name: aside\n    polygon_m: [[-0.5, 0.3], [0.7, 0.3], [0.7, 0.4], [-0.5, 0.4]]\n" +
                  ReadText(place / "scenes/box.yaml"));
    fs::create_directories(place / "configs");
    fs::copy(source / "experiments/configs/fig5_box.yaml", place / "configs/fig5_box.yaml");
    const Outcome outcome =
        Halfstep(place, {"run", "configs/fig5_box.yaml", "--quiet", "--out", "run", "--set",
                         "robot=../robots/hrp2.yaml", "--set", "smoothing.methods=[dichotomy]"});
    if (outcome.status != 0) throw std::runtime_error("halfstep run: " + outcome.err);
  }

  void EditCsv(const std::filesystem::path& path, const std::function<void(Table&)>& edit) {
    Table table = Cells(ReadText(path));
    edit(table);
    Write(path, table);
  }

  TemporaryFolder place_;
};

}  // namespace halfstep
