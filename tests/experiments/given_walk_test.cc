#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/tables/given_walk_file.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/made_once.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

// The text with `old` replaced where it stands first.
std::string Replaced(std::string text, const std::string& old, const std::string& by) {
  return text.replace(text.find(old), old.size(), by);
}

/// Tables of a walk of two half-steps, T = 2 s each, in a folder of their own.
class GivenWalkFile : public testing::Test {
 protected:
  std::string Table(const std::string& name, const std::string& text) {
    return WriteText(place_ / name, text);
  }
  // What is wrong with two tables; "": nothing. "" stands for no table.
  std::string Complaint(const std::string& overlaps, const std::string& half_steps,
                        const std::vector<FixedParameter>& fixed = {}) {
    const GivenWalkFiles files{.overlaps = overlaps.empty() ? "" : Table("o.csv", overlaps),
                               .half_steps = half_steps.empty() ? "" : Table("h.csv", half_steps)};
    try {
      (void)ReadGivenWalk(files, sequence_, fixed);
    } catch (const InputError& error) {
      std::string text;
      for (std::string line : error.complaints()) {
        text += line.substr(place_.path().string().size() + 1) + "\n";
      }
      return text;
    }
    return "";
  }

  TemporaryFolder place_;
  const HalfStepSequence sequence_ =
      Prepare(LoadConfig(ShippedConfig("fig3_two_half_steps"), {})).sequence;
};

TEST_F(GivenWalkFile, TakesWhatItSaysAndTheRestAsPlanned) {
  const HomotopyParameters planned = PlannedMotion(sequence_);
  HomotopyParameters walk = planned;
  walk.overlaps = {0.25};
  EXPECT_EQ(ReadGivenWalk({Table("o.csv", "overlap_s\n0.25\n"), ""}, sequence_, {}), walk);
  // As a spreadsheet writes it, with other columns of a run, in another order.
  const std::string half_steps =
      "\xEF\xBB\xBFheight_scale,kind,half_step,duration_s\r\n0.5,up,1,1.5\r\n0.5,down,2,+1.75\r\n";
  walk.durations = {1.5, 1.75};
  walk.height_scales = {0.5};
  EXPECT_EQ(
      ReadGivenWalk({Table("o.csv", "kind,overlap_s\nup_down,.25\n"), Table("h.csv", half_steps)},
                    sequence_, {}),
      walk);
  const FixedParameter fixed{{ParameterFamily::kHeightScale, 0}, 0.5};
  walk.durations = planned.durations;
  EXPECT_EQ(ReadGivenWalk({Table("o.csv", "overlap_s\n0.25\n"), ""}, sequence_, {fixed}), walk);
}

TEST_F(GivenWalkFile, TellsEveryMistakeAtItsPlace) {
  EXPECT_EQ(Complaint("overlap_s\n0.25\n0.25\n", ""),
            "o.csv:1:1: overlap_s: 2 rows for 1 junctions (valid: a row for each of them)\n");
  EXPECT_EQ(Complaint("junction,overlap_s\n1,nan\n", ""),
            "o.csv:2:3: overlap_s: 'nan' is not finite (valid: a finite decimal number)\n");
  EXPECT_EQ(Complaint("junction,overlap_s\n1,\n", ""),
            "o.csv:2:3: overlap_s: '' is not a number (valid: a finite decimal number)\n");
  EXPECT_THAT(Complaint("overlap_s,overlaps_s\n0.25,1\n", ""),
              StartsWith("o.csv:1:11: overlaps_s: no such column (did you mean 'overlap_s'? valid: "
                         "junction, kind, overlap_s,"));
  EXPECT_EQ(Complaint("overlap_s,overlap_s\n0.25,0.5\n", ""),
            "o.csv:1:11: overlap_s: is there twice (valid: once)\n");
  EXPECT_EQ(Complaint("kind,overlap_s\ndown_up,0.25\n", ""),
            "o.csv:2:1: kind: 'down_up' is not what the footsteps make of it (valid: up_down)\n");
  EXPECT_EQ(Complaint("limited_by,overlap_s\n\"a, \"\"b\"\"\nc\",-4000\n", ""),
            "o.csv:3:4: overlap_s: -4000 is too small (valid: from -3600)\n");
  EXPECT_THAT(Complaint("overlap_s\n0.96\n", ""),
              AllOf(StartsWith("o.csv:2:1: overlap_s: overlap 1 is 0.96 s, above its natural bound "
                               "(valid: up to 0.95"),
                    HasSubstr(" s with these durations)")));
  EXPECT_EQ(Complaint("", "half_step,duration_s\n1,0\n3,61\n"),
            "h.csv:3:1: half_step: '3' is not what the footsteps make of it (valid: 2)\n"
            "h.csv:2:3: duration_s: 0 is too small (valid: above 0 up to 60)\n"
            "h.csv:3:3: duration_s: 61 is too large (valid: above 0 up to 60)\n");
  EXPECT_EQ(Complaint("", "height_scale\n0.5\n0.6\n"),
            "h.csv:3:1: height_scale: 0.6 differs from the row before, of the same step (valid: "
            "0.5)\n");
  EXPECT_THAT(Complaint("", "height_scale,duration_s\n0.5\n0.6,1\n"),
              HasSubstr("h.csv:2: 1 cells"));
  const FixedParameter fixed{{ParameterFamily::kOverlap, 0}, 0.5};
  EXPECT_EQ(Complaint("overlap_s\n0.25\n", "", {fixed}),
            "o.csv:2:1: overlap_s: 0.25 is not where smoothing.fixed has it (valid: 0.5)\n");
  // A table of overlaps from a walk whose durations are not given.
  EXPECT_EQ(Complaint("overlap_s,duration_after_s\n0.25,1.5\n", ""),
            "o.csv:2:6: duration_after_s: 1.5 is not that of the walk, 2 (valid: the walk's, or "
            "half_steps.csv with duration_s besides)\n");
  EXPECT_EQ(Complaint("overlap_s,duration_after_s\n0.25,1.5\n", "duration_s\n2\n1.5\n"), "");
}

TEST_F(GivenWalkFile, FilesAreToldByTheirColumns) {
  const std::string o = Table("a.csv", "overlap_s\n0.25\n"), h = Table("b.csv", "duration_s\n2\n"),
                    x = Table("c.csv", "t_s\n0\n");
  const GivenWalkFiles files = SortGivenFiles({h, o});
  EXPECT_EQ(files.overlaps, o);
  EXPECT_EQ(files.half_steps, h);
  EXPECT_THROW((void)SortGivenFiles({o, x}), InputError);
  EXPECT_THROW((void)SortGivenFiles({o, o}), InputError);
}

/// A run of two half-steps by a method that moves overlaps, heights and durations, "run".
class GivenWalkCommand : public testing::Test {
 protected:
  void SetUp() override {
    CopyMadeOnce(
        place_.path(),
        {"run", ShippedConfig("fig3_two_half_steps"), "--out", "run", "--quiet", "--set",
         "smoothing.methods=[dichotomy, halfstep/sqp]", "--set", "smoothing.optimizer.heights=true",
         "--set", "smoothing.optimizer.durations=true", "--set", "output.period_s=0.02"});
  }
  Outcome Do(const std::vector<std::string>& arguments) {
    return Halfstep(place_.path(), arguments);
  }
  Outcome SmoothGiven(const std::string& overlaps, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"smooth",  "run",       "--given", overlaps,
                                      "--given", half_steps_, "--out",   "mine"};
    words.insert(words.end(), more.begin(), more.end());
    return Do(words);
  }

  TemporaryFolder place_;
  const std::string overlaps_ = "run/halfstep_sqp/overlaps.csv",
                    half_steps_ = "run/halfstep_sqp/half_steps.csv";
};

TEST_F(GivenWalkCommand, AWalkThatWasWrittenComesBackToTheByte) {
  const Outcome outcome = SmoothGiven(overlaps_, {"--method", "dichotomy"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  const std::string theirs = "run/halfstep_sqp/", ours = "mine/given/";
  for (const std::string file : {"trajectory.csv", "half_steps.csv", "certificate.csv"}) {
    EXPECT_EQ(ReadText(place_ / (ours + file)), ReadText(place_ / (theirs + file))) << file;
  }
  const ParsedCsv summary(ReadText(place_ / "mine/summary.csv"));
  ASSERT_EQ(summary.size(), 3u);
  EXPECT_EQ(summary.Text(1, "method"), "given");
  EXPECT_EQ(summary.Text(1, "status"), "converged");
  EXPECT_EQ(summary.Text(1, "certified"), "true");
  EXPECT_EQ(summary.Text(2, "method"), "dichotomy");
  const Outcome verified = Do({"verify", "mine", "--quiet"});
  EXPECT_EQ(verified.status, kSuccess) << verified.out << verified.err;
  EXPECT_EQ(Do({"certify", "mine", "--quiet"}).status, kSuccess);

  // The run holds what was given, and its config runs again wherever it is.
  fs::rename(place_ / "mine", place_ / "elsewhere");
  fs::remove_all(place_ / "run");
  ASSERT_EQ(Do({"run", "elsewhere/config.yaml", "--out", "again", "--quiet"}).status, kSuccess);
  EXPECT_EQ(ReadText(place_ / "again/given/trajectory.csv"),
            ReadText(place_ / "elsewhere/given/trajectory.csv"));
}

// Columns of forms are written where half-steps have their own, read again, and verified.
TEST_F(GivenWalkCommand, AWalkInFormsOfItsOwnComesBackToTheByte) {
  const std::string config = ShippedConfig("fig3_two_half_steps");
  const auto smooth = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"smooth", config, "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return Halfstep(place_.path(), words);
  };
  ASSERT_EQ(
      smooth({"--method", "halfstep/sqp", "--out", "sqp", "--set",
              "smoothing.optimizer.foot_delays=true", "--set",
              "smoothing.optimizer.lift_shares=true", "--set",
              "smoothing.optimizer.zmp_shifts=true", "--set",
              "smoothing.optimizer.zmp_bump_ramps=true", "--set",
              "smoothing.optimizer.via_alongs=true", "--set", "smoothing.optimizer.durations=true"})
          .status,
      0);
  const std::string half_steps = ReadText(place_ / "sqp/halfstep_sqp/half_steps.csv");
  EXPECT_THAT(half_steps, HasSubstr(",via_lateral_m,foot_ramp,foot_delay,lift_share,via_along_m,"
                                    "zmp_shift,zmp_bump_ramp\n"));
  const Outcome again =
      smooth({"--given", (place_ / "sqp/halfstep_sqp/half_steps.csv").string(), "--given",
              (place_ / "sqp/halfstep_sqp/overlaps.csv").string(), "--out", "again"});
  ASSERT_EQ(again.status, 0) << again.err;
  for (const std::string file : {"trajectory.csv", "half_steps.csv"}) {
    EXPECT_EQ(ReadText(place_ / "again/given" / file),
              ReadText(place_ / "sqp/halfstep_sqp" / file));
  }
  EXPECT_EQ(Halfstep(place_.path(), {"verify", "again"}).status, 0);
}

// So are footsteps that a solver moved.
TEST_F(GivenWalkCommand, AWalkOnMovedFootstepsComesBackToTheByte) {
  const std::string config = ShippedConfig("bar_8cm");
  ASSERT_EQ(Halfstep(place_.path(), {"smooth", config, "--quiet", "--method", "halfstep/sqp",
                                     "--out", "sqp", "--set", "smoothing.optimizer.footsteps=true",
                                     "--set", "smoothing.optimizer.all_families=false", "--set",
                                     "smoothing.optimizer.rounds=3"})
                .status,
            0);
  const std::string half_steps = ReadText(place_ / "sqp/halfstep_sqp/half_steps.csv");
  EXPECT_THAT(half_steps, HasSubstr(",footstep_x_m,footstep_y_m,footstep_yaw_rad\n"));
  const Outcome again = Halfstep(
      place_.path(), {"smooth", config, "--quiet", "--given",
                      (place_ / "sqp/halfstep_sqp/half_steps.csv").string(), "--given",
                      (place_ / "sqp/halfstep_sqp/overlaps.csv").string(), "--out", "again"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(ReadText(place_ / "again/given/trajectory.csv"),
            ReadText(place_ / "sqp/halfstep_sqp/trajectory.csv"));
  EXPECT_EQ(Halfstep(place_.path(), {"verify", "again"}).status, 0);
  // A footstep that the file moves a little: the trajectory is not of these tables any more.
  std::string forged = ReadText(place_ / "again/given/half_steps.csv");
  const ParsedCsv rows(forged);
  const std::string x = rows.Text(2, "footstep_x_m");
  for (size_t at = forged.find(x); at != std::string::npos; at = forged.find(x, at + 7)) {
    forged.replace(at, x.size(), "0.0111");
  }
  WriteText(place_ / "again/given/half_steps.csv", forged);
  EXPECT_EQ(Halfstep(place_.path(), {"verify", "again"}).status, kNotVerified);
}

TEST_F(GivenWalkCommand, WhatIsNotFeasibleIsToldWithTheMarginItMisses) {
  const std::string durations = "half_step,duration_s\n1,0.2\n2,0.2\n";
  WriteText(place_ / "fast.csv", durations);
  const Outcome outcome = Do({"smooth", "run", "--given", "fast.csv", "--out", "mine", "--quiet"});
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(
      outcome.err,
      AllOf(StartsWith(
                "halfstep: the given walk is not feasible; worst first:\n  footstep 1 (right)"),
            HasSubstr("half-step "), HasSubstr("what may help with ")));
  const ParsedCsv summary(ReadText(place_ / "mine/summary.csv"));
  EXPECT_EQ(summary.Text(1, "status"), "failed");
  EXPECT_EQ(summary.Text(1, "certified"), "false");
  EXPECT_NEAR(summary.Number(1, "duration_s"), 0.4, 1e-12);
  const auto certificate = nlohmann::json::parse(ReadText(place_ / "mine/given/certificate.json"));
  EXPECT_EQ(certificate["verdict"], "violated");
}

TEST_F(GivenWalkCommand, MistakesAreToldAndNothingIsWritten) {
  const std::set<std::string> before = NamesIn(place_.path());
  const auto refused = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = Do(arguments);
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(NamesIn(place_.path()), before);
    return outcome.err;
  };
  EXPECT_THAT(refused({"smooth", "run", "--given", "none.csv", "--out", "mine"}),
              HasSubstr("none.csv: "));
  EXPECT_THAT(refused({"smooth", "run", "--given", "run/summary.csv", "--out", "mine"}),
              HasSubstr("run/summary.csv:1:1: --given: has neither overlaps nor half-steps"));
  EXPECT_THAT(refused({"smooth", "run", "--given", overlaps_, "--out", "mine"}),
              HasSubstr("overlaps.csv:2:"));  // of other durations than planned
  EXPECT_THAT(refused({"smooth", "run", "--method", "given", "--out", "mine"}),
              HasSubstr("'given' without a walk (valid: with `smoothing.given`)"));
  EXPECT_THAT(refused({"run", "run/config.yaml", "--set", "smoothing.given={}", "--out", "mine"}),
              HasSubstr("no table is named (valid: `overlaps`, `half_steps` or both)"));
}

// An edited table is of another walk than the trajectory beside it: told, and nothing is touched.
TEST_F(GivenWalkCommand, CertifyRefusesTablesThatWereEdited) {
  const auto state = [this] {
    std::map<std::string, std::string> texts;
    for (const std::string& file : FilesBelow(place_ / "run")) {
      texts[file] = ReadText(place_ / ("run/" + file));
    }
    return texts;
  };
  const std::string table = "run/dichotomy/overlaps.csv";
  const std::string overlaps = ReadText(place_ / table);
  const std::string value = ParsedCsv(overlaps).Text(0, "overlap_s");
  WriteText(place_ / table, Replaced(overlaps, "," + value + ",", ",0.1,"));
  const auto edited = state();
  const Outcome outcome = Do({"certify", "run"});
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("overlaps.csv: certify: is not as the run wrote it"),
                                 HasSubstr("`halfstep smooth run --given OVERLAPS.csv")));
  EXPECT_EQ(state(), edited);

  // The way that it names: the edited walk in a run of its own, which verify accepts.
  ASSERT_EQ(Do({"smooth", "run", "--given", table, "--out", "mine", "--quiet"}).status, kSuccess);
  EXPECT_EQ(Do({"verify", "mine", "--quiet"}).status, kSuccess);
  EXPECT_EQ(ParsedCsv(ReadText(place_ / "mine/given/overlaps.csv")).Number(0, "overlap_s"), 0.1);

  WriteText(place_ / table, overlaps);
  EXPECT_EQ(Do({"certify", "run", "--quiet"}).status, kSuccess);
  EXPECT_EQ(Do({"verify", "run", "--quiet"}).status, kSuccess);
}

// --set may change what is demanded, but not the walk.
TEST_F(GivenWalkCommand, CertifyRefusesAConfigThatMakesAnotherWalk) {
  const std::string raw = ReadText(place_ / "run/raw/certificate.json");
  const Outcome outcome = Do({"certify", "run", "--set", "half_step.via_height_m=0.2"});
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("raw/trajectory.csv: is of another walk than config and "
                                     "tables make with --set: q_RLEG_"));
  EXPECT_EQ(ReadText(place_ / "run/raw/certificate.json"), raw);
}

}  // namespace
}  // namespace halfstep
