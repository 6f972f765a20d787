// A first SIGTERM at any moment ends every command soon, whatever it is doing.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <random>
#include <thread>

#include "experiments/commands/commands.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// Small triangles about the way of a walk, as a binary STL; nothing in them is closed.
void WriteSoup(const fs::path& path, int triangles) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> x(-1.0f, 4.0f), y(0.75f, 2.0f), z(0.0f, 2.0f);
  std::normal_distribution<float> edge(0.0f, 0.02f);
  std::string bytes(80, ' ');
  const auto add = [&bytes](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(static_cast<std::uint32_t>(triangles));
  for (int i = 0; i < triangles; ++i) {
    const float centre[] = {x(random), i % 2 == 0 ? y(random) : -y(random), z(random)};
    for (int k = 0; k < 3; ++k) add(0.0f);
    for (int k = 0; k < 9; ++k) add(centre[k % 3] + edge(random));
    add(std::uint16_t{0});
  }
  WriteText(path, bytes);
}

// Sends SIGTERM after `wait` to a command that would work for minutes. One that is still there
// after 30 s is ended by SIGALRM.
Outcome Stopped(const fs::path& place, const std::vector<std::string>& command,
                std::chrono::milliseconds wait) {
  const auto seconds = static_cast<unsigned>(wait.count() / 1000 + 31);
  Child child(command, {.working_directory = place, .before_exec = [seconds] {
                          alarm(seconds);
                          return true;
                        }});
  std::this_thread::sleep_for(wait);
  child.Signal(SIGTERM);
  const Outcome outcome = child.Wait();
  EXPECT_NE(outcome.signal, SIGALRM) << command.front() << " went on";
  if (outcome.signal == 0) {
    EXPECT_THAT(outcome.status, testing::AnyOf(kSuccess, kInterrupted)) << outcome.err;
  }
  return outcome;
}

TEST(StoppedCommand, RunAmongManyTrianglesEnds) {
  const TemporaryFolder place;
  WriteSoup(place / "soup.stl", 160'000);
  WriteText(place / "soup.yaml",
            "name: soup\nobstacles:\n  - {name: soup, mesh: {file: soup.stl}, pose: {xyz: [0, 0, "
            "0]}}\n");
  const std::string scene = "scene=" + (place / "soup.yaml").string();
  for (const int wait : {100, 700, 2500}) {
    const Outcome outcome =
        Stopped(place.path(), {"run", ShippedConfig("bar_8cm"), "--set", scene, "--out", "a"},
                std::chrono::milliseconds(wait));
    EXPECT_TRUE(outcome.status == kInterrupted || outcome.signal == SIGTERM);
    if (fs::exists(place / "a")) {
      CheckRunIsWhole(place / "a", {"dichotomy", "dichotomy_published"});
      fs::remove_all(place / "a");
    }
  }
}

TEST(StoppedCommand, EveryCommandEndsAndLeavesWholeFiles) {
  const TemporaryFolder place;
  const std::string walk = ShippedConfig("bar_8cm");
  const std::string robots = InSources("wpg/robots/");
  ASSERT_EQ(Halfstep(place.path(), {"run", walk, "--out", "a", "--quiet"}).status, kSuccess);
  const std::string cache = "swept_volumes.cache=" + (place / "cache").string();
  WriteText(place / "sweep.yaml",
            "config: " + walk +
                "\nvary:\n  - {key: output.period_s, from: 0.01, to: 0.2, step: "
                "0.01}\n");
  const std::vector<std::vector<std::string>> commands = {
      {"run", walk, "--out", "b", "--set", "smoothing.dichotomy.tolerance_s=1e-6", "--set",
       "smoothing.dichotomy.passes=100"},
      {"certify", "a", "--set", "smoothing.resolution_s=1e-7"},
      {"verify", "a"},
      {"compare", "a", "a", "--out", "c"},
      {"bake", ShippedConfig("island"), "--set", cache},
      {"plan", ShippedConfig("clutter"), "--set", cache},
      {"list", "half-steps", ShippedConfig("island")},
      {"sweep", "sweep.yaml", "--out", "s", "--jobs", "1"},
      {"robot", robots + "hrp2.urdf", "--package", "hrp2_bodies=" + robots + "hrp2", "--out",
       "r.yaml"},
      {"robot", "hrp2", "--check"},
  };
  std::mt19937 random(11);
  for (const std::vector<std::string>& command : commands) {
    SCOPED_TRACE(command.front());
    std::uniform_int_distribution<int> wait(10, 600);
    Stopped(place.path(), command, std::chrono::milliseconds(wait(random)));
    CheckRunIsWhole(place / "a", {"dichotomy", "dichotomy_published"});
  }
  if (fs::exists(place / "r.yaml")) LoadRobot((place / "r.yaml").string());
  for (const auto& entry : fs::directory_iterator(place.path())) {
    EXPECT_THAT(entry.path().filename().string(), testing::Not(testing::StartsWith(".r")));
  }
  if (fs::exists(place / "b")) CheckRunIsWhole(place / "b", {"dichotomy", "dichotomy_published"});
}

}  // namespace
}  // namespace halfstep
