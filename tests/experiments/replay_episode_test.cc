#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/commands/commands.h"
#include "experiments/replay/simulation.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/experiments/short_episode.h"
#include "tests/replaced.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

// Of the box beside the way, which somebody carries along it, out of the robot's reach and sight.
constexpr const char* kScript =
    "  script:\n"
    "    - {at_s: 0.1, do: lose, for_s: 10}\n"
    "    - {at_s: 0.5, do: carry, obstacle: box, xyz: [0.45, 1.5, 0.15], speed_m_s: 1}\n";

/// An episode in the folder `episode`.
class ReplayEpisodeTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made_ = new TemporaryFolder;
    WriteText(*made_ / "scene.yaml", BoxAside("2.0"));
    WriteText(*made_ / "walk.yaml", kShortEpisode + std::string(kScript));
    const Outcome live =
        Halfstep(made_->path(), {"live", "walk.yaml", "--out", "episode", "--quiet"});
    ASSERT_EQ(live.status, kSuccess) << live.err;
  }
  static void TearDownTestSuite() { delete std::exchange(made_, nullptr); }
  void SetUp() override { fs::copy(made_->path(), place_.path(), fs::copy_options::recursive); }
  // Makes the script tell of something that was not sensed.
  void Tell(const std::string& from, const std::string& to) {
    const fs::path config = place_ / "episode/config.yaml";
    WriteText(config, Replaced(ReadText(config), from, to));
  }
  Outcome Replay(const std::vector<std::string>& more) {
    std::vector<std::string> words = {"replay", "episode"};
    words.insert(words.end(), more.begin(), more.end());
    return Halfstep(place_.path(), words);
  }

  static inline const TemporaryFolder* made_ = nullptr;
  const TemporaryFolder place_;
};

#define SKIP_WITHOUT_MUJOCO() \
  if (!replay::WhyNoSimulation().empty()) GTEST_SKIP() << replay::WhyNoSimulation()

TEST_F(ReplayEpisodeTest, StaysUpTouchesNothingAndWritesItsTable) {
  SKIP_WITHOUT_MUJOCO();
  const Outcome outcome = Replay({"--out", "--json"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  const auto& walk = json["methods"][0];
  EXPECT_EQ(walk["method"], "episode");
  EXPECT_TRUE(walk["stayed_up"]);
  EXPECT_EQ(walk["touches_walking"], 0);
  EXPECT_EQ(walk["touches_at_rest"], 0);
  EXPECT_LT(walk["support_drift"]["largest_shift_m"], 0.01);
  EXPECT_GT(walk["support_drift"]["largest_shift_m"], 0.0);
  EXPECT_LE(walk["support_drift"]["within_window_m"],
            2.0 * walk["support_drift"]["largest_shift_m"].get<double>());
  const ParsedCsv table(ReadText(place_ / "episode/replay.csv"));
  EXPECT_NEAR(table.Number(table.size() - 1, "t_s"), walk["ended_s"], 1e-9);
  for (size_t i = 0; i < table.size(); ++i) EXPECT_EQ(table.Number(i, "touch_n"), 0.0);
  const auto schema = nlohmann::json::parse(ReadText(place_ / "episode/replay.schema.json"));
  EXPECT_EQ(schema["fields"].size(), table.header().size());
}

TEST_F(ReplayEpisodeTest, AnObstacleThatWasNotSensedIsTouched) {
  SKIP_WITHOUT_MUJOCO();
  Tell("xyz: [0.45, 1.5, 0.15]", "xyz: [0.45, 0.0, 0.15]");
  const auto json = nlohmann::json::parse(Replay({"--json"}).out);
  const auto& walk = json["methods"][0];
  ASSERT_GT(walk["touches_walking"], 0);
  const auto& first = walk["touches"][0];
  EXPECT_EQ(first["obstacle"], "box");
  EXPECT_THAT(first["body"].get<std::string>(), HasSubstr("LEG"));
  EXPECT_FALSE(first["at_rest"]);
  EXPECT_GT(first["greatest_force_n"], 1.0);
  EXPECT_GT(first["begin_s"], 0.5);
}

// What is carried against a standing robot is not the robot's doing.
TEST_F(ReplayEpisodeTest, TouchesAtRestAreToldApart) {
  SKIP_WITHOUT_MUJOCO();
  const ParsedCsv walked(ReadText(place_ / "episode/trajectory.csv"));
  const double end = walked.Number(walked.size() - 1, "t_s");
  Tell("at_s: 0.5", "at_s: " + std::to_string(end + 0.1));
  Tell("do: carry", "do: jump");
  Tell("xyz: [0.45, 1.5, 0.15]", "xyz: [0.74, 0.0, 0.15]");
  const Outcome outcome = Replay({});
  EXPECT_THAT(outcome.out, HasSubstr("touches while walking: none\n"));
  EXPECT_THAT(outcome.out, HasSubstr("touches at rest: "));
  EXPECT_THAT(outcome.out, HasSubstr(" and box: "));
}

// The script's time begins when the robot begins to wait.
TEST_F(ReplayEpisodeTest, CountsTheTimeThatTheRobotWaited) {
  SKIP_WITHOUT_MUJOCO();
  const ParsedCsv walked(ReadText(place_ / "episode/trajectory.csv"));
  const double end = walked.Number(walked.size() - 1, "t_s");
  Tell("at_s: 0.5", "at_s: " + std::to_string(end + 5.1));
  Tell("do: carry", "do: jump");
  Tell("xyz: [0.45, 1.5, 0.15]", "xyz: [0.74, 0.0, 0.15]");
  EXPECT_THAT(Replay({}).out, Not(HasSubstr("touches at rest")));
  const fs::path manifest = place_ / "episode/manifest.json";
  WriteText(manifest, Replaced(ReadText(manifest), "\"waited_s\": 0.0", "\"waited_s\": 5.0"));
  EXPECT_THAT(Replay({}).out, HasSubstr("touches at rest: "));
  WriteText(manifest, Replaced(ReadText(manifest), "\"waited_s\": 5.0", "\"waited_s\": \"long\""));
  const Outcome outcome = Replay({});
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("manifest.json: waited_s: is missing or no number"));
}

TEST_F(ReplayEpisodeTest, RefusesAScriptOfAnObstacleThatIsNotThere) {
  Tell("obstacle: box", "obstacle: chair");
  const Outcome outcome = Replay({});
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("live.script[1].obstacle: 'chair' is not in the scene"));
  EXPECT_EQ(outcome.out, "");
}

TEST_F(ReplayEpisodeTest, HasNoMethods) {
  const Outcome outcome = Replay({"--method", "raw"});
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("is an episode, which has one walk"));
}

}  // namespace
}  // namespace halfstep
