#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/run/exit_status.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

// A set of few half-steps on coarse cells, straight ahead, as `--set`.
std::vector<std::string> Coarse(const TemporaryFolder& place, std::vector<std::string> arguments) {
  for (const std::string set :
       {"step_set={x_min_m: 0, x_max_m: 0.2, y_min_m: -0.31, y_max_m: -0.21, spacing_m: 0.1, "
        "yaws_rad: [0]}",
        "planner.effort=0.05", "smoothing.methods=[]", "output.period_s=0.5"}) {
    arguments.insert(arguments.end(), {"--set", set});
  }
  arguments.insert(arguments.end(),
                   {"--set", "swept_volumes={cell_m: 0.03, displacement_m: 0.03, cache: " +
                                 (place / "cache").string() + "}"});
  return arguments;
}

TEST(BenchCommand, ListsAndWritesScenesThatRunTakes) {
  const TemporaryFolder place;
  const std::vector<std::string> some = {
      "bench", "--kinds", "overhead,below", "--difficulties", "2", "--seeds", "2"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), some.begin(), some.end());
    return Halfstep(place.path(), more);
  };
  const Outcome list = with({"--list"});
  ASSERT_EQ(list.status, kSuccess) << list.err;
  const ParsedCsv table(list.out);
  ASSERT_EQ(table.size(), 4u);
  EXPECT_EQ(table.Text(0, "name"), "below_2_001");
  EXPECT_EQ(table.Text(3, "name"), "overhead_2_002");
  EXPECT_EQ(table.Text(0, "headroom_m"), "");
  const Outcome written = with({"--write", "scenes"});
  ASSERT_EQ(written.status, kSuccess) << written.err;
  EXPECT_THAT(written.out, HasSubstr("halfstep run scenes/below_2_001.yaml"));
  EXPECT_EQ(NamesIn(place / "scenes").size(), 2u * 4u + 2u);
  EXPECT_EQ(ReadText(place / "scenes/scenes.csv"), list.out);
  const Outcome twice = with({"--write", "scenes"});
  EXPECT_EQ(twice.status, kBadInput);
  EXPECT_THAT(twice.err, HasSubstr("--write: scenes: is there already (valid: a new folder)"));
}

TEST(BenchCommand, SaysWhatIsWrong) {
  const TemporaryFolder place;
  const auto refusal = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "bench");
    const Outcome outcome = Halfstep(place.path(), arguments);
    EXPECT_EQ(outcome.status, kBadInput) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(refusal({}), HasSubstr("(valid: one of --list, --write FOLDER, --out FOLDER)"));
  EXPECT_THAT(refusal({"--list", "--kinds", "bellow"}), HasSubstr("did you mean 'below'"));
  EXPECT_THAT(refusal({"--list", "--difficulties", "6"}), HasSubstr("6"));
  EXPECT_THAT(refusal({"--list", "--seeds", "0"}), HasSubstr("0"));
  EXPECT_THAT(refusal({"--list", "--robot", "hrp3"}), HasSubstr("hrp2"));
  EXPECT_THAT(refusal({"--out", "b", "--planners", "bset"}),
              HasSubstr("--planners: 'bset': no such planner (did you mean 'best'?"));
  EXPECT_THAT(refusal({"--out", "b", "--footsteps", "none"}),
              HasSubstr("--footsteps: 'none': no such folder"));
  EXPECT_THAT(refusal({"--list", "--footsteps", "none"}), HasSubstr("into --out FOLDER"));
  EXPECT_TRUE(NamesIn(place.path()).empty());
  WriteText(place / "mine/below_7_001.csv", "foot,x_m,y_m,yaw_rad\nleft,0.1,0.105,0\n");
  EXPECT_THAT(refusal({"--out", "b", "--footsteps", "mine"}),
              HasSubstr("below_7_001.csv: is of no scene that was chosen"));
  WriteText(place / "mine/below_1_001.csv", "foot,x_m,y_m,yaw_rad\nleft,far,0.105,0\n");
  EXPECT_THAT(refusal({"--out", "b", "--footsteps", "mine"}), HasSubstr("below_1_001.csv:2"));
  EXPECT_FALSE(std::filesystem::exists(place / "b"));
  WriteText(place / "b/notes.txt", "mine");
  EXPECT_THAT(refusal({"--out", "b"}), HasSubstr("holds something else"));
  EXPECT_THAT(NamesIn(place / "b"), ElementsAre("notes.txt"));
}

TEST(BenchCommand, PlansAndChecksWhatItPlanned) {
  const TemporaryFolder place;
  const std::vector<std::string> one = {"--kinds", "overhead", "--difficulties", "1",
                                        "--seeds", "1",        "--jobs",         "1"};
  std::vector<std::string> plan = {"bench", "--planners", "astar", "--out", "a"};
  plan.insert(plan.end(), one.begin(), one.end());
  const Outcome planned = Halfstep(place.path(), Coarse(place, plan));
  ASSERT_EQ(planned.status, kSuccess) << planned.err;
  const std::string bench = ReadText(place / "a/bench.csv");
  const ParsedCsv table(bench);
  ASSERT_EQ(table.size(), 1u);
  ASSERT_EQ(table.Text(0, "status"), "solved") << bench;
  EXPECT_EQ(table.Text(0, "certified"), "true");
  EXPECT_THAT(planned.out, HasSubstr("overhead  1             1/1  "));

  // Done is done, and other choices are another benchmark.
  const Outcome again = Halfstep(place.path(), Coarse(place, plan));
  EXPECT_THAT(again.out, HasSubstr("1 of 1 cases are done already"));
  EXPECT_EQ(ReadText(place / "a/bench.csv"), bench);
  std::vector<std::string> other = plan;
  other[2] = "rrt";
  EXPECT_EQ(Halfstep(place.path(), Coarse(place, other)).status, kBadInput);

  // What was planned, as what comes from elsewhere: in full, cut short, and through a wall.
  const std::string name = "overhead_1_001.yaml";
  const std::string footsteps = ReadText(place / ("a/footsteps/astar/" + name));
  std::string statuses;
  for (const auto& [folder, text] :
       {std::pair{"whole", footsteps},
        {"short", footsteps.substr(0, footsteps.find("  - ", footsteps.find("  - ") + 1))},
        {"far", "footsteps:\n  - {foot: left, x_m: 3.2, y_m: 0.105}\n"}}) {
    WriteText(place / folder / name, text);
    std::vector<std::string> check = {"bench", "--footsteps", folder, "--out",
                                      std::string(folder) + "_checked"};
    check.insert(check.end(), one.begin(), one.end());
    const Outcome checked = Halfstep(place.path(), Coarse(place, check));
    ASSERT_EQ(checked.status, kSuccess) << checked.err;
    const ParsedCsv rows(ReadText(place / (std::string(folder) + "_checked/bench.csv")));
    statuses += rows.Text(0, "status") + " ";
    if (std::string(folder) != "whole") continue;
    EXPECT_EQ(rows.Text(0, "footsteps"), table.Text(0, "footsteps"));
    EXPECT_EQ(rows.Text(0, "smoothed_s"), table.Text(0, "smoothed_s"));
  }
  EXPECT_EQ(statuses, "solved does_not_arrive not_certified ");
}

}  // namespace
}  // namespace halfstep
