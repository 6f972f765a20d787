// What `halfstep init` writes can be run as it is, and after its comments are taken away.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "experiments/run/exit_status.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/patterns.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

TEST(InitCommand, WritesAConfigThatRuns) {
  const TemporaryFolder place;
  const Outcome outcome = Halfstep(place.path(), {"init", "walk"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_EQ(outcome.out, "written: walk.yaml\nnext:    halfstep run walk.yaml\n");
  EXPECT_EQ(Halfstep(place.path(), {"run", "walk.yaml", "--quiet"}).status, kSuccess);
}

TEST(InitCommand, ItsCommentsAreKeysOfTheRobot) {
  for (const std::string robot : {"hrp2", "wren", "bison"}) {
    const TemporaryFolder place;
    ASSERT_EQ(Halfstep(place.path(), {"init", "walk", "--robot", robot}).status, kSuccess);
    std::string text = ReadText(place / "walk.yaml");
    text = AllReplaced(text, "\n# (half_step|smoothing)", "\n$1");
    text = AllReplaced(text, "\n#   ", "\n  ");
    text = AllReplaced(text, "methods: .*", "methods: [dichotomy]");
    WriteText(place / "all.yaml", text);
    const Outcome outcome = Halfstep(place.path(), {"run", "all.yaml", "--quiet"});
    EXPECT_EQ(outcome.status, kSuccess) << text << outcome.err;
  }
}

TEST(InitCommand, NamesASceneAndAGoal) {
  const TemporaryFolder place;
  std::filesystem::create_directory(place / "configs");
  WriteText(place / "floor.yaml", "no_step: []\n");
  ASSERT_EQ(Halfstep(place.path(),
                     {"init", "configs/there", "--scene", "floor.yaml", "--goal", "1", "-0.2"})
                .status,
            kSuccess);
  const std::string text = ReadText(place / "configs/there.yaml");
  EXPECT_THAT(text, HasSubstr("\nscene: ../floor.yaml "));
  EXPECT_THAT(text, HasSubstr("\ngoal: {x_m: 1, y_m: -0.2, "));
}

TEST(InitCommand, LeadsUpStairs) {
  const TemporaryFolder place;
  const Outcome outcome =
      Halfstep(place.path(), {"init", "up", "--robot", "bison", "--stairs", "0.1"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("written: up_scene.yaml\nwritten: up.yaml\n"));
  EXPECT_THAT(ReadText(place / "up_scene.yaml"), HasSubstr("rise_m: 0.1,"));
  const Outcome run = Halfstep(place.path(), {"run", "up.yaml", "--out", "run"});
  EXPECT_EQ(run.status, kSuccess) << run.err;
  EXPECT_THAT(run.out, HasSubstr("raw                    converged        certified"));
  EXPECT_THAT(ReadText(place / "run/footsteps.csv"), HasSubstr(",0.3"));  // the third tread
  // Nothing is lost, and nothing is written of what is no flight.
  const Outcome there = Halfstep(place.path(), {"init", "up.yaml", "--stairs"});
  EXPECT_EQ(there.status, kBadInput);
  for (const std::string steep : {"-0.1", "1.5", "nan"}) {
    const Outcome refused = Halfstep(place.path(), {"init", "no", "--stairs=" + steep});
    EXPECT_EQ(refused.status, kBadInput);
    EXPECT_THAT(refused.err, HasSubstr("RISE: " + steep)) << refused.err;
  }
  const Outcome half = Halfstep(place.path(), {"init", "no", "--stairs", "0.1", "0.3", "2.5"});
  EXPECT_THAT(half.err, HasSubstr("COUNT: 2.5 (valid: whole, from 1 to 50)"));
  EXPECT_FALSE(std::filesystem::exists(place / "no.yaml"));
  EXPECT_FALSE(std::filesystem::exists(place / "no_scene.yaml"));
}

TEST(InitCommand, RefusesWhatItWouldLose) {
  const TemporaryFolder place;
  WriteText(place / "walk.yaml", "mine");
  const Outcome there = Halfstep(place.path(), {"init", "walk"});
  EXPECT_EQ(there.status, kBadInput);
  EXPECT_EQ(there.err, "walk.yaml: is there already (--overwrite replaces it)\n");
  EXPECT_EQ(ReadText(place / "walk.yaml"), "mine");
  const Outcome robot = Halfstep(place.path(), {"init", "other", "--robot", "hrp"});
  EXPECT_EQ(robot.status, kBadInput);
  EXPECT_THAT(robot.err, HasSubstr("no such robot: 'hrp' (did you mean 'hrp2'? valid: "));
  EXPECT_EQ(Halfstep(place.path(), {"init", "=sum"}).status, kBadInput);
  EXPECT_FALSE(std::filesystem::exists(place / "other.yaml"));
}

}  // namespace
}  // namespace halfstep
