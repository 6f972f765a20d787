// Every command that writes, killed or ended at, or let fail by, one of the calls by which it
// changes files: under a final name stands the older state or the new one, errors end with a
// sentence and exit status 1, SIGTERM leaves no partial file, and the same command goes through
// afterwards.
//
// A few calls of each command, drawn from a seed; HALFSTEP_FAULTS=all for every call of each.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <numeric>
#include <random>

#include "experiments/commands/commands.h"
#include "experiments/report/report_page.h"
#include "tests/draws.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/made_once.h"
#include "tests/faults/command_files.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

// A command and what it finds.
struct Scenario {
  std::string name;
  std::function<void(const fs::path&)> prepare;
  std::vector<std::string> command;
  std::string output;           // what it writes, below the working directory
  bool at_once = true;          // all of it appears at once; else file by file
  std::string costs_less = {};  // a path's part where an error does not fail the command
};

void PrintTo(const Scenario& scenario, std::ostream* out) { *out << scenario.name; }

const std::string kWalk = ShippedConfig("fig3_two_half_steps");

std::vector<std::string> RunCommandOf(const std::string& out, const std::string& period) {
  return {"run",        kWalk,
          "--out",      out,
          "--set",      "smoothing.methods=[dichotomy]",
          "--set",      "smoothing.dichotomy.tolerance_s=0.05",
          "--set",      "output.period_s=" + period,
          "--overwrite"};
}

void MakeRun(const fs::path& place) { CopyMadeOnce(place, RunCommandOf("a", "0.1")); }

void WritePlanConfig(const fs::path& place) {
  WriteText(place / "plan.yaml",
            "robot: hrp2\nscene: none\n"
            "goal: {x_m: 0.6, y_m: 0.1, radius_m: 0.05}\n"
            "step_set: {x_min_m: 0, x_max_m: 0.2, y_min_m: -0.21, y_max_m: -0.21,\n"
            "             spacing_m: 0.2, yaws_rad: [0]}\n"
            "swept_volumes: {cell_m: 0.05, displacement_m: 0.05, cache: cache}\n"
            "planner: {unimproved_nodes: 0, max_nodes: 2000}\n");
}

void WriteSweep(const fs::path& place) {
  WriteText(place / "sweep.yaml", "config: " + kWalk +
                                      "\nvary:\n  - {key: output.period_s, values: [0.1, 0.2]}\n"
                                      "  - {key: smoothing.methods, values: ['[dichotomy]']}\n");
}

void WriteRoom(const fs::path& place) {
  WriteText(place / "room.scene", "room\n* crate\n1\nbox\n1 1 1\n2 0 0.5\n0 0 0 1\n0 0 0 0\n.\n");
}

bool EveryCall() {
  const char* wish = std::getenv("HALFSTEP_FAULTS");
  return wish != nullptr && std::string(wish) == "all";
}

std::vector<Scenario> Scenarios() {
  std::vector<Scenario> all = {
      {"RunNew", [](const fs::path&) {}, RunCommandOf("a", "0.1"), "a"},
      {"RunInPlaceOfAnOlder", MakeRun, RunCommandOf("a", "0.05"), "a"},
      {"Smooth", MakeRun, {"smooth", "a", "--out", "b", "--overwrite"}, "b"},
      {"Certify", MakeRun, {"certify", "a", "--set", "smoothing.resolution_s=5e-5"}, "a"},
      {"Compare", MakeRun, {"compare", "a", "--out", "c", "--overwrite"}, "c"},
      {"Export", MakeRun, {"export", "a", "--format", "hrpsys", "--out", "e", "--overwrite"}, "e"},
      {"Bake", WritePlanConfig, {"bake", "plan.yaml"}, "cache", false, ".parts"},
      {"Plan", WritePlanConfig, {"plan", "plan.yaml"}, "cache", false, "/cache"},
      {"Sweep", WriteSweep, {"sweep", "sweep.yaml", "--out", "s", "--jobs", "1"}, "s", false},
      {"Scene", WriteRoom, {"scene", "room.scene", "--out", "r.yaml", "--overwrite"}, "."},
      {"Draw", [](const fs::path&) {}, {"draw", "cylinders", "--count", "3"}, "."},
      {"References",
       [](const fs::path&) {},
       {"draw", "references", "--count", "1", "--robot", "wren", "--format", "lafan1", "--jobs",
        "1", "--out", "r", "--quiet"},
       "r",
       false},
  };
  if (HasReport()) {
    all.push_back({"Report", MakeRun, {"report", "a"}, "a"});
    all.push_back({"ReportOut", MakeRun, {"report", "a", "--out", "r.html", "--overwrite"}, "."});
  }
  if (EveryCall()) {  // a simulation takes seconds
    all.push_back({"Replay", MakeRun, {"replay", "a", "--method", "raw", "--out"}, "a"});
  }
  return all;
}

std::string NameOf(const testing::TestParamInfo<Scenario>& info) { return info.param.name; }

// Runs a scenario's command again and again from the same state.
class FaultyCommand : public testing::TestWithParam<Scenario> {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "sanitizers and preloaded libraries exclude each other";
#endif
    fs::create_directory(place_ / "before");
    scenario_.prepare(place_ / "before");
    older_ = StateOf(place_ / "before" / scenario_.output);
    static std::map<std::string, std::vector<FileCall>> known;  // by scenario: one test finds them
    const auto [at, is_new] = known.try_emplace(scenario_.name);
    if (is_new) {
      const auto [outcome, calls] = Run({}, 0);
      if (scenario_.name == "Replay" && outcome.status != kSuccess) {
        known.erase(at);
        GTEST_SKIP() << outcome.err;
      }
      ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
      at->second = calls;
    }
    calls_ = at->second;
  }

  // What a run without faults writes, and which of it is the same every time.
  void LookAtWhatIsWritten() {
    if (!fs::exists(Output())) Run({}, 0);
    newer_ = StateOf(Output());
    Run({}, 0);
    for (const auto& [file, text] : StateOf(Output()).files) {
      if (newer_.files[file] == text) same_.insert(file);
    }
  }

  fs::path Output() const { return place_ / "work" / scenario_.output; }

  // From the state before: what came of it, and its calls. Without a fault when it is "".
  std::pair<Outcome, std::vector<FileCall>> Run(const std::string& fault, long at) {
    fs::remove_all(place_ / "work");
    fs::copy(place_ / "before", place_ / "work", fs::copy_options::recursive);
    return Again(fault, at);
  }

  std::pair<Outcome, std::vector<FileCall>> Again(const std::string& fault, long at) {
    const std::string log = place_ / "log";
    fs::remove(log);
    std::vector<std::pair<std::string, std::string>> environment = {
        {"LD_PRELOAD", HALFSTEP_FAULT_LIBRARY}, {"HALFSTEP_FAULT_LOG", log}};
    if (!fault.empty()) {
      environment.push_back({"HALFSTEP_FAULT", fault});
      environment.push_back({"HALFSTEP_FAULT_AT", std::to_string(at)});
    }
    Outcome outcome =
        Child(scenario_.command, {.working_directory = place_ / "work", .environment = environment})
            .Wait();
    return {std::move(outcome), fs::exists(log) ? ReadCalls(log) : std::vector<FileCall>()};
  }

  // Whether a file's bytes are those of a state, or as whole as those that differ every time.
  bool FileIsOf(const FolderState& state, const std::string& file, const std::string& text) const {
    const auto known = state.files.find(file);
    if (known == state.files.end()) return false;
    return same_.contains(file) ? known->second == text : IsWhole(file, text);
  }

  bool Is(const FolderState& found, const FolderState& state) const {
    return found.files.size() == state.files.size() &&
           std::all_of(found.files.begin(), found.files.end(),
                       [&](const auto& file) { return FileIsOf(state, file.first, file.second); });
  }

  // What stands under final names after a fault.
  void CheckNothingIsPartial() const {
    const FolderState found = StateOf(Output());
    if (scenario_.at_once) {
      EXPECT_TRUE(Is(found, older_) || Is(found, newer_)) << "neither the older nor the new one";
      return;
    }
    for (const auto& [file, text] : found.files) {
      if (file.find(".parts/") != std::string::npos) continue;  // checked by who reads them
      EXPECT_TRUE(FileIsOf(older_, file, text) || FileIsOf(newer_, file, text)) << file;
    }
  }

  // An error is told and counts, but where only tidying up failed, or a cache.
  void CheckError(const Outcome& outcome, const std::vector<FileCall>& calls, long at,
                  const std::string& reason) const {
    const bool costs_less = std::all_of(calls.begin(), calls.end(), [&](const FileCall& call) {
      return call.number != at || call.operation == "unlink" ||
             (!scenario_.costs_less.empty() &&
              call.path.find(scenario_.costs_less) != std::string::npos);
    });
    EXPECT_EQ(outcome.signal, 0);
    if (costs_less) {
      EXPECT_THAT(outcome.status, testing::AnyOf(kSuccess, kFailed));
      return;
    }
    // A folder that one thread could not make, another one made.
    const bool made_later = outcome.status == kSuccess &&
                            std::any_of(calls.begin(), calls.end(),
                                        [&](const FileCall& call) {
                                          return call.number == at && call.operation == "mkdir";
                                        }) &&
                            Is(StateOf(Output()), newer_);
    if (made_later) return;
    EXPECT_EQ(outcome.status, kFailed);
    EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr(reason),
                                            testing::ContainsRegex("(work/|halfstep: [^ ]+: )"),
                                            testing::Not(HasSubstr(".partial-"))));
    EXPECT_TRUE(StateOf(Output()).hidden.empty()) << "tidied up";
  }

  // One call of those that a run without faults makes.
  void Injure(const std::string& fault, long at) {
    SCOPED_TRACE(fault + " at call " + std::to_string(at));
    const auto [outcome, calls] = Run(fault, at);
    std::string injured;
    for (const FileCall& call : calls) {
      if (call.number == at) injured += call.operation + " " + call.path + "; ";
    }
    SCOPED_TRACE(injured);
    if (injured.empty()) {
      // Threads that race for a folder make a call or two more in one run than in another. Commands
      // whose output appears at once have one thread, and make the same calls every time.
      EXPECT_FALSE(scenario_.at_once);
      EXPECT_EQ(outcome.status, kSuccess) << outcome.err;
      EXPECT_TRUE(Is(StateOf(Output()), newer_)) << "no call was injured";
      ++missed_;
      return;
    }
    if (fault == "term") {
      // Commands that keep what they have found go on to write it.
      EXPECT_TRUE(outcome.signal == SIGTERM || outcome.signal == 0) << outcome.signal;
      for (const fs::path& folder : {place_ / "work", Output()}) {
        for (const std::string& left : StateOf(folder).hidden) {
          EXPECT_THAT(left, testing::Not(HasSubstr(".partial-")));
        }
      }
      ++ended_;
      return;
    }
    if (fault == "kill") {
      // A sweep's worker may be killed in place of the sweep.
      EXPECT_TRUE(outcome.signal == SIGKILL || (scenario_.name == "Sweep" && outcome.status != 0));
      ++killed_;
    } else {
      CheckError(outcome, calls, at,
                 fault == "EIO" ? "Input/output error" : "No space left on device");
      ++(outcome.status == kSuccess ? tolerated_ : failed_);
    }
    CheckNothingIsPartial();
    const auto [second, ignored] = Again("", 0);
    EXPECT_EQ(second.status, kSuccess) << second.err;
    const FolderState after = StateOf(Output());
    EXPECT_TRUE(Is(after, newer_)) << "the same command again";
    EXPECT_TRUE(after.hidden.empty()) << *after.hidden.begin();
  }

  const Scenario scenario_ = GetParam();
  const TemporaryFolder place_;
  FolderState older_, newer_;
  std::set<std::string> same_;  // files that are the same every time
  std::vector<FileCall> calls_;
  int killed_ = 0, ended_ = 0, failed_ = 0, tolerated_ = 0, missed_ = 0;
};

TEST_P(FaultyCommand, LeavesTheOlderOrTheNewAndSaysWhatFailed) {
  long last = 0;
  for (const FileCall& call : calls_) last = std::max(last, call.number);
  if (scenario_.name == "Draw") {
    EXPECT_EQ(last, 0) << "it writes no file";
    return;
  }
  ASSERT_GT(last, 0);
  LookAtWhatIsWritten();
  std::mt19937 random(15);
  for (const std::string fault : {"kill", "term", "EIO", "ENOSPC"}) {
    std::vector<long> numbers(static_cast<size_t>(last));
    std::iota(numbers.begin(), numbers.end(), 1);
    std::shuffle(numbers.begin(), numbers.end(), random);
    // Where threads race some calls are not made, and most must be.
    const size_t few = kFewDraws && scenario_.at_once ? 1 : 2;
    if (!EveryCall()) numbers.resize(std::min(numbers.size(), few));
    for (const long at : numbers) {
      if (!HasFailure()) Injure(fault, at);
    }
  }
  std::cout << scenario_.name << ": " << last << " calls; " << killed_ << " kills, " << ended_
            << " ended by SIGTERM, " << failed_ << " errors with exit status 1, " << tolerated_
            << " tolerated, " << missed_ << " of a call that was not made\n";
  EXPECT_LT(missed_, killed_ + ended_ + failed_ + tolerated_) << "most faults must find their call";
}

// So that a name on the disk never leads to content that is not there yet.
TEST_P(FaultyCommand, SyncsWhatItRenamesBeforeAndItsFolderAfter) {
  const auto is_below = [](const std::string& path, const std::string& folder) {
    return path == folder || path.starts_with(folder + "/");
  };
  const auto parent = [](const std::string& path) { return fs::path(path).parent_path().string(); };
  // Whether a later call up to `end` syncs the path.
  const auto is_synced = [&](const std::string& path, size_t after, size_t end) {
    for (size_t i = after + 1; i < end; ++i) {
      if (calls_[i].operation == "fsync" && calls_[i].path == path) return true;
    }
    return false;
  };
  int renamed = 0;
  for (size_t i = 0; i < calls_.size(); ++i) {
    const FileCall& call = calls_[i];
    if (call.operation == "write" || call.operation == "open") {
      EXPECT_THAT(call.path, HasSubstr("/.")) << "written under its final name";
    }
    if (call.operation != "rename") continue;
    ++renamed;
    EXPECT_TRUE(is_synced(parent(call.other), i, calls_.size())) << parent(call.other);
    for (size_t k = 0; k < i; ++k) {
      const FileCall& made = calls_[k];
      if (!is_below(made.path, call.path)) continue;
      if (made.operation == "write" || made.operation == "open" || made.operation == "mkdir") {
        EXPECT_TRUE(is_synced(made.path, k, i)) << made.operation << " " << made.path;
        if (made.path != call.path && made.operation != "write") {
          EXPECT_TRUE(is_synced(parent(made.path), k, i)) << "the name of " << made.path;
        }
      }
    }
  }
  EXPECT_EQ(renamed > 0, scenario_.name != "Draw");
}

INSTANTIATE_TEST_SUITE_P(Every, FaultyCommand, testing::ValuesIn(Scenarios()), NameOf);

}  // namespace
}  // namespace halfstep
