// report.html of an episode: what it holds, its size, and who writes it.

#include "experiments/live/episode_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "experiments/live/messages.h"
#include "experiments/report/live_page.h"
#include "experiments/report/report_page.h"
#include "experiments/report/report_walk.h"
#include "experiments/run/exit_status.h"
#include "tests/experiments/child_process.h"
#include "tests/live/small_files.h"
#include "tests/refusal_of.h"
#include "tests/temporary_folder.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

json DataOf(const std::string& page) {
  const std::string begin = "id=\"data\">";
  const size_t from = page.find(begin) + begin.size();
  return json::parse(page.substr(from, page.find("</script", from) - from));
}

std::string PolicyOf(const std::string& page) {
  const std::string begin = "http-equiv=\"Content-Security-Policy\" content=\"";
  const size_t from = page.find(begin) + begin.size();
  return page.substr(from, page.find('"', from) - from);
}

std::map<std::string, std::vector<json>> ByType(const json& messages) {
  std::map<std::string, std::vector<json>> by_type;
  for (const json& message : messages) by_type[message["type"]].push_back(message);
  return by_type;
}

class EpisodeReportTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!HasReport()) GTEST_SKIP() << "this build has no report";
  }
};

TEST_F(EpisodeReportTest, ALivePageTalksToItsSocketOnly) {
  const std::string socket = "ws://127.0.0.1:8080/abc/socket";
  const std::string policy = PolicyOf(LivePage(socket));
  EXPECT_THAT(policy, HasSubstr("default-src 'none'; script-src 'sha256-"));
  EXPECT_TRUE(policy.ends_with("; connect-src " + socket)) << policy;
  EXPECT_EQ(DataOf(LivePage(socket)), json::object());
  EXPECT_THROW(LivePage("ws://here; script-src *"), std::logic_error);
}

TEST_F(EpisodeReportTest, ARecordingTalksToNobody) {
  const std::string hostile = "</script><script>alert(1)</script>";
  const std::string page = RecordingPage({{"messages", json::array()}, {"outcome", hostile}});
  EXPECT_TRUE(PolicyOf(page).ends_with("; connect-src 'none'")) << PolicyOf(page);
  EXPECT_EQ(DataOf(page)["outcome"], hostile);
  EXPECT_THAT(page, Not(HasSubstr(hostile)));
}

// An episode in lockstep in which a bar jumps into the way, as the command writes it.
class WrittenEpisode : public EpisodeReportTest {
 protected:
  void SetUp() override {
    EpisodeReportTest::SetUp();
    if (IsSkipped()) return;
    WriteSmallWorld(place_.path(),
                    "script: [{at_s: 1.2, do: jump, obstacle: bar, xyz: [0.75, 0.1, 0.02]}], ");
    const Outcome outcome =
        Halfstep(place_.path(), {"live", "small.yaml", "--out", "one", "--quiet"});
    ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  }
  Outcome Report(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"report", "one"});
    return Halfstep(place_.path(), more);
  }
  TemporaryFolder place_;
};

TEST_F(WrittenEpisode, HoldsTheRecordAndCanBeWrittenAgain) {
  const std::string page = ReadText(place_ / "one/report.html");
  EXPECT_LT(page.size(), 5'000'000u);
  const json data = DataOf(page);
  std::map<std::string, std::vector<json>> messages = ByType(data["messages"]);
  const json manifest = json::parse(ReadText(place_ / "one/manifest.json"));
  EXPECT_TRUE(manifest["files"].contains("report.html"));
  ASSERT_EQ(messages["walk"].size(), manifest["walks"].get<size_t>());
  EXPECT_EQ(messages["end"].at(0)["ending"], manifest["ending"]);
  EXPECT_EQ(messages["hello"].at(0)["obstacles"].at(0)["name"], "bar");
  EXPECT_FALSE(messages["world"].empty());
  EXPECT_FALSE(messages["grant"].empty());
  EXPECT_EQ(data["clock"], "lockstep");
  // The obstacle in its own frame: 0.03 x 0.3 x 0.04 m about its middle, in 0.1 mm.
  const json& drawn = messages["draw"].at(0)["scene"]["obstacles"].at(0);
  for (size_t i = 0; i < drawn["vertices"].size(); ++i) {
    EXPECT_EQ(std::abs(drawn["vertices"][i].get<int>()), (std::array{150, 1500, 200})[i % 3]);
  }
  // What computing took differs from run to run, and is not in it.
  EXPECT_FALSE(messages["walk"].back().contains("plan_s"));
  EXPECT_EQ(data["motion"]["support"].get<std::string>().size(),
            data["motion"]["columns"]["t_s"]["delta"].size());

  const Outcome verified = Halfstep(place_.path(), {"verify", "one"});
  EXPECT_EQ(verified.status, kSuccess) << verified.out << verified.err;
  const Outcome again = Report({"--out", "page.html", "--quiet"});
  EXPECT_EQ(again.status, kSuccess) << again.err;
  EXPECT_EQ(ReadText(place_ / "page.html"), page);
  fs::remove(place_ / "one/report.html");
  EXPECT_EQ(Report().status, kSuccess);
  EXPECT_EQ(ReadText(place_ / "one/report.html"), page);
  EXPECT_EQ(Halfstep(place_.path(), {"verify", "one"}).status, kSuccess);
}

TEST_F(WrittenEpisode, WithAnotherSceneIsRefused) {
  const fs::path scene = place_ / "one/inputs/scene/bar.yaml";
  WriteText(scene, ReadText(scene) + "\n# changed\n");
  const Outcome outcome = Report();
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("the files of the scene are not those of this episode"));
}

TEST_F(EpisodeReportTest, TheMotionHasEverySoManiethRowAndTheLast) {
  const TemporaryFolder folder;
  const auto shown = [&](int rows) {
    std::string text = "t_s,support,x_m,y_m\n";
    for (int i = 0; i < rows; ++i) {
      text += Formatted("%.3f,%s,%d,0\n", 0.005 * i, i % 2 == 0 ? "left" : "both", i);
    }
    WriteText(folder / "trajectory.csv", text);
    return MotionJson(folder / "trajectory.csv", {"x_m"}, 0.02);
  };
  const auto deltas = [&](int rows) { return shown(rows)["columns"]["x_m"]["delta"].dump(); };
  EXPECT_EQ(deltas(10), "[0,400000,400000,100000]");  // 0, 4, 8, 9
  EXPECT_EQ(shown(10)["support"], "lllb");
  EXPECT_EQ(deltas(9), "[0,400000,400000]");
  EXPECT_EQ(deltas(2), "[0,100000]");  // of two rows none is left out
  EXPECT_EQ(deltas(1), "[0]");
  EXPECT_THAT(RefusalOf([&] { shown(0); }), HasSubstr("trajectory.csv: no rows"));
  EXPECT_THAT(RefusalOf([&] { (void)MotionJson(folder / "trajectory.csv", {"z_m"}, 0.02); }),
              testing::AnyOf(HasSubstr("no rows"), HasSubstr("no column 'z_m'")));
}

TEST_F(EpisodeReportTest, FootstepsOfARecordedWalkFollowThoseOfTheOneBefore) {
  const SmallWorld& small = SmallWorld::Get();
  LiveConfig config = small.config;
  Scene scene;
  scene.obstacles = {Bar("bar", 0.75, 2.0)};
  config.live.script = {Event(1.2, "jump", "bar", {0.75, 0.1, 0.02})};
  const PlayedEpisode played = Play(scene, config);
  ASSERT_GT(played.episode.walks.size(), 1u);
  Place place = small.place;
  place.scene = scene;
  Episode episode = played.episode;
  const TemporaryFolder folder;
  WriteText(folder / "trajectory.csv", "");
  episode.begun.clear();
  const std::vector<ExecutedWalk> walks = std::exchange(episode.walks, {});
  // Without walks there is no motion, and nothing is read of the folder.
  EXPECT_TRUE(DataOf(EpisodeReport(episode, config, place, folder.path()))["motion"].is_null());
  episode.walks = walks;
  const std::string header = [&] {
    std::string names;
    const json hello = HelloMessage(config, place.robot, scene, {});
    for (const json& name : hello["columns"]) {
      names += (names.empty() ? "" : ",") + name.get<std::string>();
    }
    return names;
  }();
  const auto columns = static_cast<size_t>(std::ranges::count(header, ','));
  std::string row = "0";
  for (size_t i = 0; i < columns; ++i) row += ",0";
  WriteText(folder / "trajectory.csv", header + "\n" + row + "\n");
  const json data = DataOf(EpisodeReport(episode, config, place, folder.path()));
  std::map<std::string, std::vector<json>> messages = ByType(data["messages"]);
  json footsteps = json::array(), live;
  for (size_t i = 0; i < walks.size(); ++i) {
    const json& shown = messages["walk"].at(i);
    footsteps.erase(footsteps.begin() + shown["same"].get<long>(), footsteps.end());
    for (const json& footstep : shown["footsteps"]) footsteps.push_back(footstep);
    json message = WalkMessage(walks[i], i);
    MakeWhole(std::move(live), &message);
    live = std::move(message);
    ASSERT_EQ(footsteps.size(), live["footsteps"].size());
    for (size_t k = 0; k < footsteps.size(); ++k) {
      EXPECT_EQ(footsteps[k]["foot"], live["footsteps"][k]["foot"]);
      EXPECT_NEAR(footsteps[k]["x_m"].get<double>(), live["footsteps"][k]["x_m"].get<double>(),
                  1e-6);
    }
  }

  // More than an hour of worlds: fewer of them are shown, and the page says so. Of hand-overs in a
  // row those of walks that are shown are told, and the first, which may be why the robot stopped.
  for (const char* what : {"unsafe", "handed_over", "handed_over", "handed_over", "stopped"}) {
    episode.events.push_back({.t = episode.end, .what = what, .walk = 1, .text = {}});
  }
  episode.walks.resize(std::max<size_t>(3, walks.size()), walks.back());
  const World world = episode.worlds.back();
  for (int i = 0; i < 40'000; ++i) {
    episode.worlds.push_back(world);
    episode.known.push_back(episode.known.back() + 0.1);
  }
  const std::string page = EpisodeReport(episode, config, place, folder.path());
  EXPECT_LT(page.size(), 5'000'000u);
  EXPECT_THAT(
      DataOf(page)["outcome"].get<std::string>(),
      testing::ContainsRegex(
          "of worlds, walks and grants one in [0-9]+ is shown, the motion every [0-9.]+ s"));
  std::string last;
  messages = ByType(DataOf(page)["messages"]);
  for (const json& event : messages["event"]) {
    last += event["event"].get<std::string>() + " ";
  }
  EXPECT_TRUE(last.ends_with("unsafe handed_over stopped ")) << last;
}

}  // namespace
}  // namespace halfstep
