// A run or an episode is known by what it holds, not by where it lies: it is verified wherever its
// folder went, whatever halfstep ships there, and files that are nowhere are "not found", which is
// not the word for a forgery.

#include <gmock/gmock.h>

#include "experiments/tables/run_inputs.h"
#include "experiments/verify/verify_run.h"
#include "tests/places.h"
#include "tests/verify/tampered_episode.h"
#include "tests/verify/verify_mutation.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Verifies a folder from another working directory, by a command whose data lie elsewhere: there a
// robot by the name of HRP-2 is another one.
Outcome VerifiedElsewhere(const fs::path& folder) {
  const TemporaryFolder data, somewhere;
  fs::copy(InSources("wpg/robots"), data / "robots", fs::copy_options::recursive);
  TamperedRun::Replace(data / "robots/hrp2.yaml", "RLEG_JOINT3: [2, 150]", "RLEG_JOINT3: [3, 149]");
  Child child({"verify", folder.string()},
              {.working_directory = somewhere.path(),
               .environment = {{"HALFSTEP_DATA", data.path().string()}}});
  return child.Wait();
}

// A run of a shipped robot and scene, made where only these are.
fs::path MakeRun(const fs::path& place, const std::vector<std::string>& sets = {}) {
  std::vector<std::string> arguments = {"run",
                                        InSources("experiments/configs/fig5_box.yaml"),
                                        "--quiet",
                                        "--out",
                                        "run",
                                        "--set",
                                        "smoothing.methods=[]"};
  for (const std::string& set : sets) arguments.insert(arguments.end(), {"--set", set});
  const Outcome outcome = Halfstep(place, arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return place / "run";
}

TEST(Identity, ARunIsVerifiedWhereverItGoes) {
  const TemporaryFolder made, gone;
  const fs::path run = MakeRun(made.path());
  EXPECT_TRUE(fs::exists(run / "inputs/robot/hrp2.urdf"));
  EXPECT_TRUE(fs::exists(run / "inputs/robot/hrp2/waist.obj"));
  EXPECT_TRUE(fs::exists(run / "inputs/scene/box.yaml"));
  const fs::path deeper = gone / "a/b/c/run";
  fs::create_directories(deeper.parent_path());
  fs::rename(run, deeper);
  const Outcome moved = VerifiedElsewhere(deeper);
  EXPECT_EQ(moved.status, 0) << moved.out << moved.err;
  // All that reads a run finds them there as well.
  EXPECT_EQ(Halfstep(gone.path(), {"report", "a/b/c/run"}).status, 0);
  EXPECT_EQ(Halfstep(gone.path(), {"certify", "a/b/c/run", "--quiet"}).status, 0);
  EXPECT_EQ(VerifiedElsewhere(deeper).status, 0);
  EXPECT_EQ(
      Halfstep(gone.path(), {"run", "a/b/c/run/config.yaml", "--quiet", "--out", "again"}).status,
      0);
  EXPECT_EQ(ReadText(gone / "again/raw/trajectory.csv"), ReadText(deeper / "raw/trajectory.csv"));
}

TEST(Identity, AnEpisodeIsVerifiedWhereverItGoes) {
  const TamperedEpisode episode;
  const TemporaryFolder gone;
  const fs::path deeper = gone / "a/b/c/episode";
  fs::create_directories(deeper.parent_path());
  fs::copy(episode.folder(), deeper, fs::copy_options::recursive);
  fs::remove_all(episode.folder().parent_path());
  const Outcome outcome = VerifiedElsewhere(deeper);
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

// Where the certificate says that its robot lies is a place to look, not what it is about.
TEST(Identity, ThePlaceThatACertificateNamesIsNotWhatItIsAbout) {
  TamperedRun run;
  run.EditJson([](nlohmann::ordered_json& j) { j["robot"] = "../robots/none.yaml"; });
  run.Rehash();
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, 0) << outcome.out;
}

// A scene that is too large is not taken in; it is found by its hash where it was.
TEST(Identity, WhatIsNowhereIsNotFoundAndNoForgery) {
  const TemporaryFolder place;
  const std::string scene = ReadText(InSources("experiments/scenes/box.yaml"));
  std::string mesh =
      "v 1 2 0\nv 1.1 2 0\nv 1 2.1 0\nv 1 2 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  mesh.append(kMostInputBytes, '#');
  mesh += "\n";
  WriteText(place / "large.obj", mesh);
  WriteText(place / "large.yaml",
            scene + "  - name: far\n    mesh: {file: large.obj}\n    pose: {xyz: [0, 0, 0]}\n");
  const fs::path run = MakeRun(place.path(), {"scene='" + (place / "large.yaml").string() + "'"});
  EXPECT_FALSE(fs::exists(run / "inputs/scene"));
  EXPECT_EQ(VerifiedElsewhere(run).status, 0) << VerifiedElsewhere(run).err;
  fs::create_directories(place / "elsewhere");
  for (const char* file : {"large.obj", "large.yaml"}) {
    fs::rename(place / file, place / "elsewhere" / file);
  }
  Outcome outcome = VerifiedElsewhere(run);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("scene: not found: its files are not in the folder"));
  EXPECT_THAT(outcome.out + outcome.err, testing::Not(HasSubstr("NOT verified")));
  // Another file in its place is not the one that is sought.
  WriteText(place / "large.yaml", scene);
  outcome = VerifiedElsewhere(run);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("scene: not found"));
  EXPECT_EQ(Halfstep(place.path(), {"verify", "run", "--scene", "elsewhere/large.yaml"}).status, 0);
}

// What lies in the folder belongs to it.
TEST(Identity, ACopyThatWasChangedIsAForgery) {
  TamperedRun run;
  TamperedRun::Replace(run.scene(), "obstacles:", "obstacles:  ");
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out,
              HasSubstr("inputs/scene/box.yaml: not the one that manifest.json lists"));
}

}  // namespace
}  // namespace halfstep
