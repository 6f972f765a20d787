// A sweep ends in the same bytes however it gets there.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <set>
#include <thread>

#include "experiments/commands/commands.h"
#include "experiments/report/report_page.h"
#include "experiments/sweep/sweep_case.h"
#include "experiments/sweep/sweep_config.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/fixture_check.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

class RefusedSweep : public testing::TestWithParam<std::string> {};
TEST_P(RefusedSweep, SaysWhy) {
  CheckFixture(GetParam(), [](const std::string& path) { LoadSweep(path, {}, /*check=*/true); });
}
INSTANTIATE_TEST_SUITE_P(Sweep, RefusedSweep, testing::ValuesIn(Fixtures("sweep")), FixtureName);

std::string Shipped(const std::string& name) {
  return InSources("experiments/sweeps/") + name + ".yaml";
}

TEST(SweepCases, AreAllCombinationsTheFirstKeySlowest) {
  SweepConfig config;
  config.vary = {{.key = "a", .values = {"1", "2"}, .zip = "w"},
                 {.key = "b", .values = {"x", "y", "z"}, .zip = ""},
                 {.key = "c", .values = {"3", "4"}, .zip = "w"}};
  std::vector<std::string> texts;
  std::set<std::string> ids;
  for (const SweepCase& one : SweepCases(config)) {
    texts.push_back(OverrideText(one));
    ids.insert(one.id);
    EXPECT_THAT(one.id, testing::MatchesRegex("000[1-6]-[0-9a-f]{8}"));
  }
  EXPECT_THAT(texts, ElementsAre("a=1 b=x c=3", "a=1 b=y c=3", "a=1 b=z c=3", "a=2 b=x c=4",
                                 "a=2 b=y c=4", "a=2 b=z c=4"));
  EXPECT_EQ(ids.size(), 6u);
}

TEST(SweepCases, RangesAreWrittenAsOneWouldWriteThem) {
  const TemporaryFolder place;
  const std::string config = "config: " + ShippedConfig("fig3_two_half_steps") + "\nvary:\n";
  const auto values = [&](const std::string& axis) {
    const std::string path = WriteText(place / "s.yaml", config + "  - {" + axis + "}\n");
    return LoadSweep(path, {}, /*check=*/true).vary[0].values;
  };
  EXPECT_THAT(values("key: footsteps.0.x_m, from: 0.1, to: 0.4, step: 0.1"),
              ElementsAre("0.1", "0.2", "0.3", "0.4"));
  EXPECT_THAT(values("key: footsteps.0.x_m, from: -0.1, to: 0.2, count: 3"),
              ElementsAre("-0.1", "0.05", "0.2"));
  EXPECT_THAT(values("key: seed, from: 100000, to: 100001"), ElementsAre("100000", "100001"));
  EXPECT_THAT(values("key: half_step.duration_s, from: 1, to: 2, count: 1"), ElementsAre("1"));
  EXPECT_THAT(values("key: smoothing.limits.foot_speed_m_s, values: [none, 2]"),
              ElementsAre("none", "2"));
  EXPECT_THAT(values("key: smoothing.limits.foot_speed_m_s, values: [none, +2]"),
              ElementsAre("none", "+2"));
}

TEST(SweepCases, OfShippedSweepsCanBeRead) {
  EXPECT_EQ(SweepCases(LoadSweep(Shipped("bar_8cm_speed_clearance"), {}, true)).size(), 200u);
  EXPECT_EQ(SweepCases(LoadSweep(Shipped("bar_8cm_duration_clearance"), {}, true)).size(), 200u);
  EXPECT_EQ(SweepCases(LoadSweep(Shipped("fig3_step_length"), {}, true)).size(), 22u);
}

// Six cases; in the last two steps the foot is on an area where it must not stand.
class SweepCommandTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new TemporaryFolder;
    WriteText(*place_ / "hole.yaml",
              "no_step: [{name: hole, polygon_m: [[0.34, -0.5], [0.6, -0.5], [0.6, 0.5], [0.34, "
              "0.5]]}]\n");
    WriteText(*place_ / "base.yaml",
              "{robot: hrp2, scene: hole.yaml, footsteps: [{foot: right, x_m: 0.2, y_m: -0.105}],\n"
              " smoothing: {dichotomy: {tolerance_s: 0.1}},\n"
              " output: {period_s: 0.05, directory: elsewhere}}\n");
    WriteText(*place_ / "sweep.yaml",
              "config: base.yaml\nvary:\n"
              "  - {key: footsteps.0.x_m, values: [0.1, 0.15, 0.3]}\n"
              "  - {key: half_step.via_height_m, from: 0.2, to: 0.25, count: 2}\n");
    const Outcome outcome =
        Halfstep(place_->path(), {"sweep", "sweep.yaml", "--jobs", "1", "--out", "reference"});
    ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("sweep: 6 cases, 10 rows: 8 converged, 2 on_no_step_area; 8 "
                                       "certified\n"));
  }
  static void TearDownTestSuite() {
    delete place_;
    place_ = nullptr;
  }

  static fs::path Folder(const std::string& name) { return *place_ / name; }
  static Outcome Sweep(const std::string& out, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"sweep", "sweep.yaml", "--out", out, "--quiet"});
    return Halfstep(place_->path(), more);
  }
  // Every file but those of times.
  static std::map<std::string, std::string> Bytes(const std::string& out) {
    std::map<std::string, std::string> bytes;
    for (const std::string& file : FilesBelow(Folder(out))) {
      bytes[file] = file.ends_with("timings.csv") ? "" : ReadText(Folder(out) / file);
    }
    return bytes;
  }
  static void ExpectAsReference(const std::string& out) {
    EXPECT_TRUE(Bytes(out) == Bytes("reference")) << out;
    EXPECT_EQ(FilesBelow(Folder(out)).size(), 6u * 5 + 4 + 7 + (HasReport() ? 1 : 0));
  }
  static size_t Done(const std::string& out) {
    size_t done = 0;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(Folder(out) / "cases", ignored)) {
      if (!entry.path().filename().string().starts_with('.')) ++done;
    }
    return done;
  }

  static TemporaryFolder* place_;
};
TemporaryFolder* SweepCommandTest::place_ = nullptr;

TEST_F(SweepCommandTest, OneRowACaseAndMethodWithItsKeysAndFailures) {
  const ParsedCsv runs(ReadText(Folder("reference") / "runs.csv"));
  EXPECT_THAT(runs.header(),
              ElementsAre("case", "footsteps.0.x_m", "half_step.via_height_m", "method", "status",
                          "certified", "duration_s", "speedup", "cost", "worst_margin",
                          "worst_margin_name", "iterations", "instants", "effort",
                          "collision_queries", "gap_to_reference", "message"));
  ASSERT_EQ(runs.size(), 10u);
  EXPECT_EQ(runs.Text(0, "method"), "raw");
  EXPECT_EQ(runs.Text(3, "method"), "dichotomy");
  EXPECT_EQ(runs.Text(3, "footsteps.0.x_m"), "0.1");
  EXPECT_EQ(runs.Text(3, "half_step.via_height_m"), "0.25");
  EXPECT_GT(runs.Number(3, "speedup"), 1.0);
  for (size_t row : {8u, 9u}) {
    EXPECT_EQ(runs.Text(row, "status"), "on_no_step_area");
    EXPECT_EQ(runs.Text(row, "message"),
              "the plan is not feasible: footstep 1 is on a no-step area");
    EXPECT_EQ(runs.Text(row, "method"), "none");
    EXPECT_EQ(runs.Text(row, "certified"), "false");
    EXPECT_EQ(runs.Text(row, "duration_s"), "");
  }
  const ParsedCsv timings(ReadText(Folder("reference") / "timings.csv"));
  EXPECT_EQ(timings.size(), runs.size());
  EXPECT_GT(timings.Number(3, "wall_s"), 0.0);
  EXPECT_FALSE(fs::exists(Folder("elsewhere"))) << "output.directory is not the sweep's";
}

TEST_F(SweepCommandTest, EveryTableHasItsSchema) {
  const fs::path sweep = Folder("reference");
  for (const std::string name : {"runs", "timings"}) {
    const std::string text = ReadText(sweep / (name + ".schema.json"));
    const nlohmann::json schema = nlohmann::json::parse(text);
    std::vector<std::string> fields;
    for (const auto& field : schema["fields"]) fields.push_back(field["name"]);
    EXPECT_EQ(fields, ParsedCsv(ReadText(sweep / (name + ".csv"))).header());
    for (const std::string& one : NamesIn(sweep / "cases")) {
      EXPECT_EQ(ReadText(sweep / "cases" / one / (name + ".schema.json")), text);
    }
  }
}

TEST_F(SweepCommandTest, TheNumberOfWorkersDoesNotMatter) {
  ASSERT_EQ(Sweep("two", {"--jobs", "2"}).status, kSuccess);
  ExpectAsReference("two");
}

TEST_F(SweepCommandTest, KilledItGoesOnToTheSameBytes) {
  for (const int signal : {SIGKILL, SIGINT}) {
    SCOPED_TRACE(strsignal(signal));
    const std::string out = "signal" + std::to_string(signal);
    Child child({"sweep", "sweep.yaml", "--out", out, "--jobs", "2", "--quiet"},
                {.working_directory = place_->path()});
    while (Done(out) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    child.Signal(signal);
    const Outcome outcome = child.Wait();
    if (signal == SIGKILL) {
      EXPECT_EQ(outcome.signal, SIGKILL);
    } else {
      EXPECT_EQ(outcome.status, kInterrupted);
      EXPECT_THAT(outcome.err, HasSubstr(" of 6 cases are not done (the same command goes on)"));
    }
    EXPECT_LT(Done(out), 6u) << "it came to its end";
    EXPECT_FALSE(fs::exists(Folder(out) / "runs.csv"));
    const Outcome again = Sweep(out);
    EXPECT_EQ(again.status, kSuccess) << again.err;
    ExpectAsReference(out);
  }
}

TEST_F(SweepCommandTest, WhatIsNotWholeIsDoneAgainAndNothingElse) {
  fs::copy(Folder("reference"), Folder("damaged"), fs::copy_options::recursive);
  std::vector<fs::path> cases;
  for (const std::string& name : NamesIn(Folder("damaged") / "cases")) {
    cases.push_back(Folder("damaged") / "cases" / name);
  }
  ASSERT_EQ(cases.size(), 6u);
  const std::string runs = ReadText(cases[0] / "runs.csv");
  WriteText(cases[0] / "runs.csv", runs.substr(0, runs.size() / 2));
  WriteText(cases[1] / "runs.csv", runs);  // of another case
  fs::remove(cases[2] / "config.yaml");
  fs::remove_all(cases[3]);
  fs::create_directory(cases[3]);
  fs::resize_file(cases[4] / "runs.schema.json", 100);
  const std::string untouched = ReadText(cases[5] / "timings.csv");
  fs::remove(Folder("damaged") / "runs.csv");
  const Outcome outcome =
      Halfstep(place_->path(), {"sweep", "sweep.yaml", "--out", "damaged", "--jobs", "2"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("1 of 6 cases are done already\n"));
  ExpectAsReference("damaged");
  EXPECT_EQ(ReadText(cases[5] / "timings.csv"), untouched);
}

TEST_F(SweepCommandTest, CasesAloneThenCollectedAreTheSame) {
  const Outcome listed = Halfstep(place_->path(), {"sweep", "sweep.yaml", "--list-cases"});
  ASSERT_EQ(listed.status, kSuccess);
  std::istringstream lines(listed.out);
  std::vector<std::string> ids;
  for (std::string line; std::getline(lines, line);) ids.push_back(line.substr(0, 13));
  ASSERT_EQ(ids.size(), 6u);
  EXPECT_THAT(listed.out, HasSubstr(" footsteps.0.x_m=0.15 half_step.via_height_m=0.25\n"));
  for (size_t i = 6; i-- > 1;) EXPECT_EQ(Sweep("alone", {"--case", ids[i]}).status, kSuccess);
  const Outcome early = Sweep("alone", {"--collect"});
  EXPECT_EQ(early.status, kFailed);
  EXPECT_EQ(early.err, "halfstep: 1 of 6 cases are not done, the first is " + ids[0] + "\n");
  fs::create_directories(Folder("alone") / "cases" / ids[0]);  // as a scheduler does
  EXPECT_EQ(Sweep("alone", {"--case", ids[0]}).status, kSuccess);
  EXPECT_EQ(Sweep("alone", {"--collect"}).status, kSuccess);
  ExpectAsReference("alone");
  const Outcome unknown = Sweep("alone", {"--case", "0001-00000000"});
  EXPECT_EQ(unknown.status, kBadInput);
  EXPECT_THAT(unknown.err, HasSubstr("'0001-00000000': no such case"));
}

TEST_F(SweepCommandTest, RangesOfCasesThenCollectedAreTheSame) {
  for (const std::string range : {"4-6", "1-1", "1-4"}) {
    const Outcome outcome = Sweep("ranges", {"--cases", range, "--jobs", "1"});
    EXPECT_EQ(outcome.status, kSuccess) << outcome.err;
    EXPECT_FALSE(fs::exists(Folder("ranges") / "runs.csv"));
  }
  EXPECT_EQ(Sweep("ranges", {"--collect"}).status, kSuccess);
  ExpectAsReference("ranges");
  for (const std::string range : {"0-2", "3-2", "1-7", "1", "1-2x", "a-b", "-1-2", "1-"}) {
    const Outcome outcome = Sweep("ranges", {"--cases=" + range});
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_THAT(outcome.err, HasSubstr("--cases '" + range +
                                       "': no numbers of cases (valid: "
                                       "FROM-TO from 1-1 to 1-6)"));
  }
  const Outcome checked = Halfstep(place_->path(), {"sweep", "sweep.yaml", "--check"});
  EXPECT_EQ(checked.out, "sweep: 6 cases\n");
}

TEST_F(SweepCommandTest, IsReportedOnceItIsCollected) {
  if (!HasReport()) GTEST_SKIP() << "this build has no report";
  ASSERT_EQ(Sweep("begun", {"--cases", "1-1"}).status, kSuccess);
  const Outcome early = Halfstep(place_->path(), {"report", "begun"});
  EXPECT_EQ(early.status, kBadInput);
  EXPECT_THAT(early.err, HasSubstr("begun: has no runs.csv, since not all cases are done"));
  const std::string page = ReadText(Folder("reference") / "report.html");
  EXPECT_THAT(page, HasSubstr(R"("counts":{"dichotomy":{"converged":[4,4]},)"
                              R"("none":{"on_no_step_area":[2,0]},"raw":{"converged":[4,4]}})"));
  EXPECT_THAT(page, HasSubstr(R"("solved":[1,1,1,1,0,0])"));
  const Outcome again =
      Halfstep(place_->path(), {"report", "reference", "--out", "reference/again.html"});
  EXPECT_EQ(again.status, kSuccess) << again.err;
  EXPECT_TRUE(ReadText(Folder("reference") / "again.html") == page);
  fs::remove(Folder("reference") / "again.html");
  const Outcome compared = Halfstep(place_->path(), {"compare", "reference"});
  EXPECT_EQ(compared.status, kBadInput);
  EXPECT_THAT(compared.err, HasSubstr("is the folder of a sweep"));
}

// Of a config's own file of footsteps, and of those that cases name.
TEST_F(SweepCommandTest, RunsOfOtherFootstepsAreNotTakenOver) {
  const std::string footsteps = "foot,x_m,y_m,yaw_rad\nright,0.2,-0.105,0\n";
  WriteText(Folder("a.csv"), footsteps);
  WriteText(Folder("b.csv"), footsteps);
  const std::string rest =
      "{robot: hrp2, scene: none, footsteps_file: {path: a.csv},\n"
      " smoothing: {dichotomy: {tolerance_s: 0.1}}, output: {period_s: 0.1}}\n";
  WriteText(Folder("filed.yaml"), rest);
  const auto sweep = [&](const std::string& key, const std::string& values) {
    WriteText(Folder("filed_sweep.yaml"),
              "config: filed.yaml\nvary: [{key: " + key + ", values: [" + values + "]}]\n");
    return Halfstep(place_->path(), {"sweep", "filed_sweep.yaml", "--jobs", "1", "--out",
                                     "filed_" + key, "--quiet"});
  };
  const std::array<std::array<std::string, 2>, 2> cases = {
      {{"half_step.via_height_m", "0.2"}, {"footsteps_file.path", "b.csv"}}};
  for (const auto& [key, values] : cases) {
    ASSERT_EQ(sweep(key, values).status, kSuccess);
    EXPECT_EQ(sweep(key, values).status, kSuccess);
    const fs::path changed = Folder(key == "footsteps_file.path" ? "b.csv" : "a.csv");
    WriteText(changed, footsteps + "left,0.4,0.105,0\n");
    const Outcome outcome = sweep(key, values);
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_THAT(outcome.err, HasSubstr("holds a sweep of another robot, scene or footsteps file"));
    WriteText(changed, footsteps);
  }
}

TEST_F(SweepCommandTest, AnotherDefinitionIsRefused) {
  const auto before = Bytes("reference");
  const auto refused = [&](const std::vector<std::string>& more, const std::string& why) {
    const Outcome outcome = Sweep("reference", more);
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_THAT(outcome.err, HasSubstr("reference: " + why +
                                       " (valid: a new folder, or one that "
                                       "the same sweep by the same program began)\n"));
  };
  refused({"--set", "vary.1.to=0.26"}, "holds a sweep of other cases");
  refused({"--set", "keep=all"}, "holds a sweep of another keep");
  const std::string base = ReadText(Folder("base.yaml"));
  WriteText(Folder("base.yaml"), base + "# changed\n");
  refused({}, "holds a sweep of another config");
  WriteText(Folder("base.yaml"), base);
  const std::string hole = ReadText(Folder("hole.yaml"));
  WriteText(Folder("hole.yaml"), hole + "# changed\n");
  refused({}, "holds a sweep of another robot, scene or footsteps file");
  WriteText(Folder("hole.yaml"), hole);
  EXPECT_TRUE(Bytes("reference") == before);
  fs::create_directories(Folder("mine/letters"));
  const Outcome outcome = Sweep("mine");
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("mine: is the folder of no sweep"));
  EXPECT_THAT(FilesBelow(Folder("mine")), testing::IsEmpty());
}

TEST_F(SweepCommandTest, KeptCasesAreRunsThatCanBeComparedAndVerified) {
  ASSERT_EQ(Sweep("kept", {"--set", "keep=all", "--set", "vary.1.count=1"}).status, kSuccess);
  std::vector<std::string> compare = {"compare"};
  size_t runs = 0;
  for (const std::string& name : NamesIn(Folder("kept") / "cases")) {
    const fs::path one = Folder("kept") / "cases" / name;
    if (!fs::exists(one / "manifest.json")) continue;  // came to nothing
    ++runs;
    compare.push_back(one.string());
    EXPECT_EQ(
        Halfstep(place_->path(), {"verify", one.string(), "--tolerance", "0.02", "--quiet"}).status,
        kSuccess);
  }
  EXPECT_EQ(runs, 2u);
  const Outcome outcome = Halfstep(place_->path(), compare);
  EXPECT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("base-0001-"));
}

TEST_F(SweepCommandTest, ACrashIsARowWithItsReason) {
  const SweepConfig sweep = LoadSweep(Folder("sweep.yaml").string(), {}, /*check=*/false);
  const SweepFolder folder(Folder("crash"), sweep);
  const SweepCase one = SweepCases(sweep).front();
  EXPECT_FALSE(folder.IsDone(one));
  WriteSweepFailure(folder, one, "crashed", "ended by signal 11 (Segmentation fault)", 1.5);
  EXPECT_TRUE(folder.IsDone(one));
  const ParsedCsv runs(ReadText(folder.CasePath(one) / "runs.csv"));
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs.Text(0, "status"), "crashed");
  EXPECT_EQ(runs.Text(0, "message"), "ended by signal 11 (Segmentation fault)");
}

}  // namespace
}  // namespace halfstep
