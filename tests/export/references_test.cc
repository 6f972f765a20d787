// Sets of reference motions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "experiments/commands/commands.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/export/python_reader.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

std::map<std::string, std::string> ContentsOf(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const std::string& file : FilesBelow(folder)) contents[file] = ReadText(folder / file);
  return contents;
}

Outcome Draw(const TemporaryFolder& place, std::vector<std::string> more) {
  more.insert(more.begin(), {"draw", "references", "--robot", "wren"});
  return Halfstep(place.path(), more);
}

// Least of margin − bound of a family in a certificate; of its first instant alone.
double Proved(const ParsedCsv& certificate, const std::string& family, bool at_start) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t row = 0; row < certificate.size(); ++row) {
    if (certificate.Text(row, "family") != family) continue;
    if (at_start && certificate.Number(row, "begin_s") > 0.0) continue;
    least = std::min(least, certificate.Number(row, "margin") - certificate.Number(row, "bound"));
  }
  return least;
}

TEST(References, AreTheSameForAnyNumberOfJobsAndWhatRunsCertify) {
  const TemporaryFolder place;
  const Outcome one = Draw(place, {"--count", "5", "--seed", "2", "--out", "a", "--jobs", "1"});
  ASSERT_EQ(one.status, kSuccess) << one.err;
  EXPECT_THAT(one.out, testing::AllOf(HasSubstr("wren: 5 references certified"),
                                      HasSubstr("references a second of processor time"),
                                      HasSubstr("written: a\n")));
  ASSERT_EQ(Draw(place, {"--count", "5", "--seed", "2", "--out", "b", "--jobs", "3"}).status,
            kSuccess);
  const auto files = ContentsOf(place / "a");
  EXPECT_EQ(files, ContentsOf(place / "b"));
  EXPECT_EQ(files.size(), 5u * 2 + 3);

  const ParsedCsv index(files.at("index.csv"));
  ASSERT_EQ(index.size(), 5u);
  const bool numpy = PythonHas("numpy");
  std::set<std::string> kinds;
  for (size_t row = 0; row < index.size(); ++row) {
    SCOPED_TRACE(row);
    const std::string name = index.Text(row, "reference");
    kinds.insert(index.Text(row, "kind"));
    EXPECT_EQ(index.Text(row, "file"), "mjlab/" + name + ".npz");
    EXPECT_EQ(index.Text(row, "verdict"), "certified");
    const double duration = index.Number(row, "duration_s");
    EXPECT_EQ(index.Number(row, "frames"), std::ceil(50 * duration - 1e-7) + 1);
    if (row % 4 == 0) {  // by a run of its own
      ASSERT_EQ(
          Halfstep(place.path(), {"run", "a/walks/" + name + ".yaml", "--out", name, "--quiet"})
              .status,
          kSuccess);
      const ParsedCsv certificate(ReadText(place / (name + "/dichotomy/certificate.csv")));
      const bool stands = index.Text(row, "kind") == "standing";
      int families = 0;
      for (const std::string& column : index.header()) {
        if (!column.starts_with("least_")) continue;
        EXPECT_EQ(index.Number(row, column), Proved(certificate, column.substr(6), stands))
            << column;
        ++families;
      }
      EXPECT_GT(families, 8);
      const ParsedCsv walk(ReadText(place / (name + "/dichotomy/trajectory.csv")));
      if (!stands) {
        EXPECT_EQ(duration, walk.Number(walk.size() - 1, "t_s"));
      }
    }
    if (!numpy) continue;
    fs::create_directory(place / "arrays");
    EXPECT_EQ(ReadByPython(place, "arrays a/mjlab/" + name + ".npz arrays"), "");
  }
  EXPECT_EQ(kinds.size(), 5u);
}

TEST(References, StandingIsStillAndWalksGoWhereTheyAreSaidTo) {
  const TemporaryFolder place;
  ASSERT_EQ(Draw(place, {"--count", "8", "--seed", "5", "--out", "a", "--format", "csv", "lafan1",
                         "--fps", "20"})
                .status,
            kSuccess);
  const ParsedCsv index(ReadText(place / "a/index.csv"));
  int standing = 0;
  for (size_t row = 0; row < index.size(); ++row) {
    const ParsedCsv walk(ReadText(place / ("a/" + index.Text(row, "file"))));
    ASSERT_EQ(static_cast<double>(walk.size()), index.Number(row, "frames"));
    const size_t last = walk.size() - 1;
    EXPECT_NEAR(walk.Number(last, "t_s"), 0.05 * static_cast<double>(last), 1e-12);
    const double turn = walk.Number(last, "waist_yaw_rad") - walk.Number(0, "waist_yaw_rad");
    EXPECT_NEAR(turn / index.Number(row, "duration_s"), index.Number(row, "mean_yaw_rate_rad_s"),
                1e-9);
    const double way = std::hypot(walk.Number(last, "com_x_m") - walk.Number(0, "com_x_m"),
                                  walk.Number(last, "com_y_m") - walk.Number(0, "com_y_m"));
    EXPECT_LE(way, index.Number(row, "mean_speed_m_s") * index.Number(row, "duration_s") + 1e-9);
    if (index.Text(row, "kind") != "standing") continue;
    ++standing;
    EXPECT_EQ(index.Number(row, "mean_speed_m_s"), 0.0);
    for (const std::string& column : walk.header()) {
      if (column == "t_s") continue;
      EXPECT_EQ(walk.Text(0, column), walk.Text(last, column)) << column;
    }
    const std::string frames =
        ReadText(place / ("a/lafan1/" + index.Text(row, "reference") + ".csv"));
    EXPECT_EQ(static_cast<size_t>(std::ranges::count(frames, '\n')), walk.size());
  }
  EXPECT_EQ(standing, 1);
}

TEST(References, StoppedSetsGoOn) {
  const TemporaryFolder place;
  const std::vector<std::string> words = {"draw", "references", "--robot", "wren",   "--count",
                                          "4",    "--out",      "a",       "--jobs", "1"};
  Child child(words, {.working_directory = place.path()});
  const fs::path rows = place / "a/unfinished";
  const auto begun = std::chrono::steady_clock::now();
  while ((!fs::exists(rows) || fs::is_empty(rows)) &&
         std::chrono::steady_clock::now() - begun < std::chrono::seconds(60)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  child.Signal(SIGINT);
  const Outcome stopped = child.Wait();
  if (stopped.status == kInterrupted) {
    EXPECT_THAT(stopped.err, HasSubstr("are not done (the same command goes on)"));
    EXPECT_FALSE(fs::exists(place / "a/index.csv"));
    for (const std::string& file : FilesBelow(place / "a")) {
      EXPECT_THAT(file, testing::Not(HasSubstr("partial")));
    }
    const Outcome other = Halfstep(
        place.path(), {"draw", "references", "--robot", "wren", "--count", "5", "--out", "a"});
    EXPECT_EQ(other.status, kBadInput);
    EXPECT_THAT(other.err, HasSubstr("holds another set"));
    const Outcome rest = Halfstep(place.path(), words);
    EXPECT_EQ(rest.status, kSuccess) << rest.err;
    EXPECT_THAT(rest.out, HasSubstr("of 4 references are done already"));
  }
  std::vector<std::string> whole = words;
  whole[7] = "b";
  ASSERT_EQ(Halfstep(place.path(), whole).status, kSuccess);
  EXPECT_EQ(ContentsOf(place / "a"), ContentsOf(place / "b"));
  const Outcome again = Halfstep(place.path(), words);
  EXPECT_EQ(again.status, kBadInput);
  EXPECT_THAT(again.err, HasSubstr("a: is finished already (valid: a new folder"));
}

// Nothing that is not certified is written: no sole is so wide.
TEST(References, WhatIsNotCertifiedIsToldAndNotWritten) {
  const TemporaryFolder place;
  const Outcome outcome =
      Draw(place, {"--count", "2", "--out", "a", "--set", "smoothing.margins.zmp_m=0.09"});
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("of 2 references none of 100 draws was certified"));
  EXPECT_THAT(outcome.out, HasSubstr("0 references certified; 200 draws were not: "));
  const ParsedCsv index(ReadText(place / "a/index.csv"));
  for (size_t row = 0; row < 2; ++row) {
    EXPECT_EQ(index.Text(row, "verdict"), "refused");
    EXPECT_EQ(index.Text(row, "refused"), "100");
    EXPECT_EQ(index.Text(row, "file"), "none");
  }
  EXPECT_EQ(FilesBelow(place / "a"),
            (std::set<std::string>{"index.csv", "index.schema.json", "manifest.json"}));
}

TEST(References, MistakesAreTold) {
  const TemporaryFolder place;
  const auto told = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = Halfstep(place.path(), arguments);
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_TRUE(NamesIn(place.path()).empty());
    return outcome.err;
  };
  EXPECT_THAT(told({"draw", "references"}), HasSubstr("draw: references: --out is missing"));
  EXPECT_THAT(told({"draw", "references", "--count", "0", "--out", "x"}),
              HasSubstr("--count: 0 references (valid: 1 … 100000)"));
  EXPECT_THAT(told({"draw", "references", "--method", "dichotomi", "--out", "x"}),
              HasSubstr("--method 'dichotomi': no such method (did you mean 'dichotomy'?"));
  EXPECT_THAT(told({"draw", "references", "--robot", "hrp3", "--out", "x"}), HasSubstr("hrp3"));
  EXPECT_THAT(told({"draw", "references", "--format", "mjcf", "--out", "x"}),
              HasSubstr("--format"));
  EXPECT_THAT(told({"draw", "walks", "--fps", "3", "--out", "x"}),
              HasSubstr("draw: --fps is for references"));
  fs::create_directory(place / "there");
  const Outcome there =
      Halfstep(place.path(), {"draw", "references", "--count", "1", "--out", "there"});
  EXPECT_EQ(there.status, kBadInput);
  EXPECT_THAT(there.err, HasSubstr("there: is there already (valid: a new folder, or one"));
}

}  // namespace
}  // namespace halfstep
