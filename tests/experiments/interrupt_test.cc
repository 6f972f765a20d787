// SIGINT at any moment of a run leaves a certified walk no worse than the start.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <random>
#include <thread>

#include "experiments/commands/commands.h"
#include "smoothing/methods/methods.h"
#include "tests/draws.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/long_walk.h"
#include "tests/experiments/run_check.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using std::chrono::duration;
using std::chrono::steady_clock;

// The optimizing methods of this build among those that the test wants.
std::vector<std::string> OptimizingMethods() {
  std::vector<std::string> methods;
  const std::vector<std::string> known = Methods::Standard().Names();
  for (const std::string wanted : {"ipopt", "halfstep/barrier"}) {
    if (std::find(known.begin(), known.end(), wanted) != known.end()) methods.push_back(wanted);
  }
  return methods;
}

std::vector<std::string> OptimizingRun(const std::string& name, const std::string& method) {
  return {"run",
          ShippedConfig("bar_8cm"),
          "--quiet",
          "--out",
          name,
          "--set",
          "smoothing.optimizer.heights=true",
          "--set",
          "smoothing.optimizer.durations=true",
          "--set",
          "smoothing.optimizer.effort=600",
          "--set",
          "output.period_s=0.02",
          "--set",
          "smoothing.methods=[" + method + "]"};
}

std::vector<std::string> FoldersOf(std::vector<std::string> methods) {
  for (std::string& method : methods) std::replace(method.begin(), method.end(), '/', '_');
  return methods;
}

TEST(InterruptedRun, LeavesACertifiedWalkAtLeastAsGoodAsTheStart) {
  const std::vector<std::string> methods = OptimizingMethods();
  if (methods.empty()) GTEST_SKIP() << "no optimizing method in this build";
  const TemporaryFolder place;
  const auto begin = steady_clock::now();
  ASSERT_EQ(Halfstep(place.path(), OptimizingRun("none", "")).status, kSuccess);
  const duration<double> shortest = steady_clock::now() - begin;

  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> moment(0.0, 6.0);
  int whole = 0, interrupted = 0, improved = 0;
  for (int i = 0; i < 20; ++i) {
    if (kFewDraws && i >= 6 && improved > 0) break;
    const std::string name = "run" + std::to_string(i);
    SCOPED_TRACE(name);
    const std::vector<std::string> one = {methods[static_cast<size_t>(i) % methods.size()]};
    Child child(OptimizingRun(name, one.front()), {.working_directory = place.path()});
    std::this_thread::sleep_for(moment(random) * shortest);
    child.Signal(SIGINT);
    const Outcome outcome = child.Wait();
    if (outcome.signal != 0) {  // before the program began to listen
      EXPECT_EQ(outcome.signal, SIGINT);
      EXPECT_FALSE(fs::exists(place / name));
      continue;
    }
    EXPECT_EQ(outcome.status, kInterrupted) << outcome.err;
    if (outcome.err == "halfstep: interrupted\n") {  // on a busy machine: nothing to keep yet
      EXPECT_FALSE(fs::exists(place / name));
      continue;
    }
    CheckRunIsWhole(place / name, FoldersOf(one));
    if (testing::Test::HasFatalFailure()) return;
    ++whole;
    const ParsedCsv summary(ReadText(place / name / "summary.csv"));
    for (size_t row = 0; row < summary.size(); ++row) {
      SCOPED_TRACE(summary.Text(row, "method"));
      EXPECT_EQ(summary.Text(row, "certified"), "true");
      EXPECT_LE(summary.Number(row, "duration_s"), summary.Number(0, "duration_s"));
      if (row == 0) continue;
      EXPECT_THAT(summary.Text(row, "status"),
                  testing::AnyOf("interrupted", "no_improvement", "not_run"));
      if (summary.Text(row, "status") == "interrupted") ++interrupted;
      if (summary.Number(row, "speedup") > 1.0) ++improved;
    }
  }
  EXPECT_GT(whole, 0);
  EXPECT_GT(interrupted, 0);
  EXPECT_GT(improved, 0) << "no moment after the first improvement was drawn";
  EXPECT_THAT(NamesIn(place.path()), testing::Each(testing::Not(testing::StartsWith("."))));
}

TEST(InterruptedRun, SecondSignalEndsAtOnce) {
  const TemporaryFolder place;
  // Rows so dense that writing what there is would take long.
  std::vector<std::string> run = OptimizingRun("a", "dichotomy");
  run.insert(run.end(),
             {"--set", "output.period_s=0.0001", "--set", "smoothing.dichotomy.tolerance_s=1e-6",
              "--set", "smoothing.dichotomy.passes=100"});
  int ended = 0;
  for (int i = 0; i < 10 && ended == 0; ++i) {
    Child child(run, {.working_directory = place.path()});
    std::this_thread::sleep_for(std::chrono::milliseconds(100 << (i / 2)));
    child.Signal(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    child.Signal(SIGINT);
    const Outcome outcome = child.Wait();
    EXPECT_FALSE(fs::exists(place / "a")) << "it went on to the end";
    if (outcome.signal == SIGINT) continue;  // the first was too early
    EXPECT_EQ(outcome.status, kInterrupted);
    ++ended;
  }
  EXPECT_EQ(ended, 1);
}

// A run of which certification takes most of the time, and how long it lasts.
duration<double> MakeLongRun(const TemporaryFolder& place) {
  WriteText(place / "c.yaml", LongWalk() + "smoothing: {methods: []}\n");
  const auto begin = steady_clock::now();
  EXPECT_EQ(Halfstep(place.path(), {"run", "c.yaml", "--out", "whole", "--quiet"}).status,
            kSuccess);
  return steady_clock::now() - begin;
}

// Looks by halves for a moment that is between too early and too late. On a machine whose load
// changes the moment moves, so after some tries it is looked for anew, in twice the time.
class Moment {
 public:
  explicit Moment(duration<double> whole) : whole_(whole), late_(whole) {}

  duration<double> next() const { return 0.5 * (early_ + late_); }
  void TooEarly() { Narrow(next(), late_); }
  void TooLate() { Narrow(early_, next()); }

 private:
  void Narrow(duration<double> early, duration<double> late) {
    constexpr int kTries = 8;
    const bool anew = ++tries_ % kTries == 0;
    early_ = anew ? duration<double>(0.0) : early;
    late_ = anew ? 2.0 * whole_ : late;
  }

  duration<double> whole_, early_{0.0}, late_;
  int tries_ = 0;
};
constexpr int kMostMoments = 40;

TEST(InterruptedCertification, IsUndecidedAndTheRunIsWhole) {
  const TemporaryFolder place;
  const duration<double> whole = MakeLongRun(place);
  bool undecided = false;
  Moment moment(whole);
  for (int i = 0; i < kMostMoments && !undecided; ++i) {
    const std::string name = "run" + std::to_string(i);
    Child child({"run", "c.yaml", "--out", name, "--quiet"}, {.working_directory = place.path()});
    std::this_thread::sleep_for(moment.next());
    child.Signal(SIGINT);
    const Outcome outcome = child.Wait();
    if (outcome.signal != 0) {
      moment.TooEarly();
      continue;
    }
    moment.TooLate();  // where it is not undecided below
    if (outcome.status == kSuccess) continue;
    EXPECT_EQ(outcome.status, kInterrupted) << outcome.err;
    CheckRunIsWhole(place / name, {});
    const auto certificate = [&] {
      return nlohmann::json::parse(ReadText(place / name / "raw/certificate.json"));
    };
    undecided = certificate()["verdict"] == "undecided";
    const ParsedCsv summary(ReadText(place / name / "summary.csv"));
    EXPECT_EQ(summary.Text(0, "certified"), undecided ? "false" : "true");
    if (!undecided) continue;
    EXPECT_EQ(certificate()["message"], "interrupted before all of it was proved");
    EXPECT_EQ(Halfstep(place.path(), {"verify", name, "--quiet"}).status, kNotVerified);
    EXPECT_EQ(Halfstep(place.path(), {"certify", name, "--quiet"}).status, kSuccess);
    EXPECT_EQ(certificate()["verdict"], "certified");
  }
  EXPECT_TRUE(undecided) << "certification was never interrupted";
}

TEST(InterruptedCertification, OfARunLeavesItAsItWas) {
  const TemporaryFolder place;
  const duration<double> whole = MakeLongRun(place);
  const std::string older = "begin_s\n";
  int interrupted = 0;
  Moment moment(whole);
  for (int i = 0; i < kMostMoments && interrupted == 0; ++i) {
    WriteText(place / "whole/raw/certificate.csv", older);
    Child child({"certify", "whole"}, {.working_directory = place.path()});
    std::this_thread::sleep_for(moment.next());
    child.Signal(SIGINT);
    const Outcome outcome = child.Wait();
    outcome.signal != 0 ? moment.TooEarly() : moment.TooLate();
    if (outcome.status != kInterrupted) continue;
    ++interrupted;
    EXPECT_EQ(outcome.err, "halfstep: interrupted; the run is as it was\n");
    EXPECT_EQ(ReadText(place / "whole/raw/certificate.csv"), older);
    EXPECT_THAT(NamesIn(place.path()), testing::ElementsAre("c.yaml", "whole"));
  }
  EXPECT_EQ(interrupted, 1);
}

}  // namespace
}  // namespace halfstep
