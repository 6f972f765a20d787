// What a certificate names are the bytes that were parsed, not what lies there when it is written.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "experiments/run/complete_manifest.h"
#include "experiments/run/experiment_run.h"
#include "experiments/verify/verify_run.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "tests/verify/verified_here.h"
#include "wpg/files/sha256.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

struct CopiedConfig {
  CopiedConfig() {
    const fs::path source(InSources());
    for (const char* file : {"configs/fig5_box.yaml", "scenes/box.yaml"}) {
      WriteText(folder / file, ReadText(source / "experiments" / file));
    }
  }
  fs::path scene() const { return folder / "scenes/box.yaml"; }
  TemporaryFolder folder;
};

TEST(InputFiles, SceneEditedDuringARunIsNotTheOneOfTheCertificate) {
  const CopiedConfig place;
  const std::string parsed = CombinedSha256(LoadScene(place.scene().string()).files);
  const RunHooks hooks{.progress = [](const std::string&, double) {}, .stop = {}};
  ExperimentRun run(LoadConfig((place.folder / "configs/fig5_box.yaml").string(),
                               {{"smoothing.methods", "[dichotomy]"}}),
                    hooks);
  run.Smooth(hooks);
  run.Certify({});
  // The box grows into the way before the certificate is written.
  WriteText(place.scene(), ReadText(place.scene()) + "# edited\n");
  RunFolder folder(place.folder / "run", /*overwrite=*/false);
  run.Write(&folder);
  CompleteManifest(run.experiment().robot, run.experiment().scene, &folder);
  folder.Publish();

  const auto certificate =
      nlohmann::json::parse(ReadText(place.folder / "run/dichotomy/certificate.json"));
  const auto manifest = nlohmann::json::parse(ReadText(place.folder / "run/manifest.json"));
  EXPECT_EQ(certificate["sha256"]["scene"], parsed);
  EXPECT_EQ(manifest["scene_sha256"], parsed);
  EXPECT_NE(CombinedSha256(LoadScene(place.scene().string()).files), parsed);
  for (const auto& result : VerifyProved({.run = (place.folder / "run").string()})) {
    // What was parsed is nowhere: it was not copied, for another file lay there by then.
    EXPECT_FALSE(result.verified);
    EXPECT_FALSE(result.readable);
    EXPECT_THAT(result.complaints.front(), testing::HasSubstr("scene: not found"));
  }
}

TEST(InputFiles, MeshesAndUrdfCountWithTheirNamesAndLengths) {
  const RobotModel robot = LoadRobot(InSources("wpg/robots/hrp2.yaml"));
  ASSERT_GT(robot.files.size(), 2u);
  EXPECT_EQ(robot.files[0].name, "hrp2.yaml");
  EXPECT_EQ(robot.files[1].name, "hrp2.urdf");
  for (const InputFile& file : robot.files) {
    const std::string bytes = ReadText(file.path);
    EXPECT_EQ(file.bytes, bytes.size()) << file.path;
    EXPECT_EQ(file.sha256, Sha256(bytes)) << file.path;
  }
}

// Bytes that move from one file to the next, or names that run into each other, are another list.
TEST(InputFiles, NoTwoListsHaveOneHash) {
  const auto hash = [](std::vector<std::pair<std::string, std::string>> files) {
    std::vector<InputFile> records;
    for (const auto& [name, bytes] : files) records.push_back(RecordOf(name, bytes));
    return CombinedSha256(records);
  };
  EXPECT_EQ(hash({{"a", "xy"}, {"b", "z"}}), hash({{"a", "xy"}, {"b", "z"}}));
  const std::vector<std::string> all = {
      hash({{"a", "xy"}, {"b", "z"}}), hash({{"a", "x"}, {"b", "yz"}}),
      hash({{"b", "xy"}, {"a", "z"}}), hash({{"a", "xyz"}}),
      hash({{"ab", "xyz"}}),           hash({{"a", ""}, {"b", "xyz"}}),
      hash({{"a\n1:b", "xyz"}}),       hash({})};
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
}

}  // namespace
}  // namespace halfstep
