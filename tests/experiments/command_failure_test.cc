// The command when it is stopped, killed, or has no room: what stands under a run's name is whole.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <pty.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>

#include <chrono>
#include <cstddef>
#include <random>
#include <thread>

#include "experiments/commands/commands.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/long_walk.h"
#include "tests/experiments/run_check.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

const std::string kTwoHalfSteps = ShippedConfig("fig3_two_half_steps");
const std::string kOneMethod = "smoothing.methods=[dichotomy]";
const std::vector<std::string> kMethods = {"dichotomy", "dichotomy_published"};

// A walk smoothed in so many passes that it would last for a minute.
std::string LongConfig() {
  return LongWalk() +
         "smoothing: {methods: [dichotomy], acceptance: sampled, sampling_s: 0.002,\n"
         "            dichotomy: {passes: 100, tolerance_s: 1e-6}}\n";
}

// Reads a terminal until `text` has come (true) or the process at the other end is gone.
bool WaitFor(const std::string& text, int terminal, std::string* seen) {
  while (seen->find(text) == std::string::npos) {
    char buffer[4096];
    const ssize_t n = read(terminal, buffer, sizeof buffer);
    if (n <= 0) return false;
    seen->append(buffer, static_cast<size_t>(n));
  }
  return true;
}

TEST(StoppedRun, CtrlCKeepsWhatIsAccepted) {
  const TemporaryFolder place;
  const std::string config = WriteText(place / "long.yaml", LongConfig());
  int terminal = -1, other_end = -1;
  ASSERT_EQ(openpty(&terminal, &other_end, nullptr, nullptr, nullptr), 0);
  Child child({"run", config, "--out", "a"},
              {.working_directory = place.path(), .standard_error = other_end});
  close(other_end);
  // The progress bar appears when a method has worked for a second.
  std::string screen;
  ASSERT_TRUE(WaitFor(" %, best so far", terminal, &screen)) << screen << child.Wait().out;
  EXPECT_THAT(screen, HasSubstr("dichotomy ["));
  child.Signal(SIGINT);
  WaitFor("text that never comes", terminal, &screen);
  const Outcome outcome = child.Wait();
  close(terminal);
  EXPECT_EQ(outcome.status, kInterrupted);
  EXPECT_TRUE(screen.ends_with("\r\033[K")) << "the bar is not wiped";
  CheckRunIsWhole(place / "a", {"dichotomy"});
  EXPECT_THAT(NamesIn(place.path()), testing::ElementsAre("a", "long.yaml"));
  const ParsedCsv summary(ReadText(place / "a/summary.csv"));
  EXPECT_EQ(summary.Text(0, "status"), "converged");
  EXPECT_EQ(summary.Text(1, "status"), "interrupted");
  EXPECT_GT(summary.Number(1, "speedup"), 1.0);
  EXPECT_GE(summary.Number(1, "worst_margin"), 0.0);
  EXPECT_EQ(ParsedCsv(ReadText(place / "a/dichotomy/overlaps.csv")).size(), 79u);
}

TEST(KilledRun, LeavesNoPartUnderTheFinalName) {
  const TemporaryFolder place;
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(
      Halfstep(place.path(), {"run", kTwoHalfSteps, "--out", "kept", "--set", kOneMethod}).status,
      kSuccess);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
  std::mt19937 random(20);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  int killed = 0, absent = 0;
  for (int i = 0; i < 20; ++i) {
    // In turn: a new run, and one that replaces an older.
    const std::string name = i % 2 == 0 ? "new" + std::to_string(i) : "kept";
    Child child({"run", kTwoHalfSteps, "--out", name, "--overwrite", "--set", kOneMethod},
                {.working_directory = place.path()});
    std::this_thread::sleep_for(whole * part(random));
    child.Signal(SIGKILL);
    if (child.Wait().signal == SIGKILL) ++killed;
    if (name == "kept" || fs::exists(place / name)) {
      CheckRunIsWhole(place / name, {"dichotomy"});
    } else {
      ++absent;
    }
  }
  EXPECT_GT(killed, 0);
  EXPECT_GT(absent, 0);
  const auto leftovers = [&] {
    const std::set<std::string> names = NamesIn(place.path());
    return std::count_if(names.begin(), names.end(),
                         [](const std::string& name) { return name.starts_with(".kept."); });
  };
  RecordProperty("leftovers", static_cast<int>(leftovers()));
  ASSERT_EQ(Halfstep(place.path(),
                     {"run", kTwoHalfSteps, "--out", "kept", "--overwrite", "--set", kOneMethod})
                .status,
            kSuccess);
  CheckRunIsWhole(place / "kept", {"dichotomy"});
  EXPECT_EQ(leftovers(), 0);
}

TEST(FullDisk, FileThatMayNotGrowIsNamed) {
  const TemporaryFolder place;
  const auto limit = [] {
    const rlimit bytes{50'000, 50'000};  // less than a trajectory
    return ::signal(SIGXFSZ, SIG_IGN) != SIG_ERR && setrlimit(RLIMIT_FSIZE, &bytes) == 0;
  };
  const Outcome outcome = Child({"run", kTwoHalfSteps, "--out", "a"},
                                {.working_directory = place.path(), .before_exec = limit})
                              .Wait();
  if (outcome.status == Child::kNotPossible) GTEST_SKIP() << "cannot set a limit here";
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr((place / "a/raw/trajectory.csv").string()));
  EXPECT_THAT(outcome.err, HasSubstr("File too large"));
  EXPECT_THAT(NamesIn(place.path()), IsEmpty());
}

TEST(FullDisk, FullFileSystemIsNamedAndTheOlderRunStays) {
  const TemporaryFolder place;
  // In a mount namespace of this process alone: nothing outlives it.
  if (unshare(CLONE_NEWNS) != 0 ||
      mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("tmpfs", place.path().c_str(), "tmpfs", 0, "size=3m") != 0) {
    GTEST_SKIP() << "needs the right to mount: " << std::strerror(errno);
  }
  const std::vector<std::string> run = {"run", kTwoHalfSteps, "--out", "a", "--overwrite"};
  EXPECT_EQ(Halfstep(place.path(), run).status, kSuccess);
  const std::string before = ReadText(place / "a/manifest.json");
  std::vector<std::string> larger = run;
  larger.insert(larger.end(), {"--set", "output.period_s=0.001"});
  const Outcome outcome = Halfstep(place.path(), larger);
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr((place / "a").string() + "/"));
  EXPECT_THAT(outcome.err, HasSubstr("No space left on device"));
  EXPECT_THAT(NamesIn(place.path()), testing::ElementsAre("a"));
  EXPECT_EQ(ReadText(place / "a/manifest.json"), before);
  CheckRunIsWhole(place / "a", kMethods);
  umount2(place.path().c_str(), MNT_DETACH);
}

// Lets renameat2 with flags fail as it does on NFS.
bool ForbidRenameFlags() {
  sock_filter program[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_renameat2, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[4])),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 0, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EINVAL),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog filter{.len = sizeof program / sizeof program[0], .filter = program};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

TEST(OldFileSystem, RunsArePublishedWithoutExchange) {
  const TemporaryFolder place;
  for (const std::string period : {"0.01", "0.02"}) {
    const Outcome outcome =
        Child({"run", kTwoHalfSteps, "--out", "a", "--overwrite", "--set",
               "output.period_s=" + period},
              {.working_directory = place.path(), .before_exec = ForbidRenameFlags})
            .Wait();
    if (outcome.status == Child::kNotPossible) GTEST_SKIP() << "cannot filter system calls here";
    ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
    CheckRunIsWhole(place / "a", kMethods);
    EXPECT_THAT(ReadText(place / "a/config.yaml"), HasSubstr("period_s: " + period));
    EXPECT_THAT(NamesIn(place.path()), testing::ElementsAre("a"));
  }
}

}  // namespace
}  // namespace halfstep
