#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/commands/commands.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/made_once.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// A folder with a run of two half-steps, "run".
class ExportCommandTest : public testing::Test {
 protected:
  void SetUp() override {
    CopyMadeOnce(place_.path(), {"run", ShippedConfig("fig3_two_half_steps"), "--out", "run",
                                 "--quiet", "--set", "smoothing.methods=[dichotomy]"});
  }
  Outcome Export(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"export", "run", "--quiet"});
    return Halfstep(place_.path(), arguments);
  }
  std::string Refusal(const std::vector<std::string>& arguments) {
    const Outcome outcome = Export(arguments);
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_THAT(NamesIn(place_.path()), testing::ElementsAre("run"));
    return outcome.err;
  }
  std::vector<std::string> Lines(const std::string& file) {
    std::istringstream in(ReadText(place_ / file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  std::vector<std::vector<double>> Numbers(const std::string& file) {
    std::vector<std::vector<double>> rows;
    for (const std::string& line : Lines(file)) {
      std::istringstream in(line);
      rows.emplace_back();
      for (double x; in >> x;) rows.back().push_back(x);
    }
    return rows;
  }

  TemporaryFolder place_;
};

TEST_F(ExportCommandTest, HrpsysFilesReadBackToTheWalk) {
  const Outcome outcome = Export({"--format", "hrpsys"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  const ParsedCsv table(ReadText(place_ / "run/dichotomy/trajectory.csv"));
  const auto pos = Numbers("run-hrpsys/dichotomy.pos"), zmp = Numbers("run-hrpsys/dichotomy.zmp"),
             waist = Numbers("run-hrpsys/dichotomy.waist");
  const std::vector<std::string> joints = Lines("run-hrpsys/dichotomy.joints");
  ASSERT_EQ(joints.size(), 30u);
  ASSERT_EQ(pos.size(), table.size());
  ASSERT_EQ(zmp.size(), table.size());
  ASSERT_EQ(waist.size(), table.size());
  int of_legs = 0;
  for (size_t i = 0; i < table.size(); ++i) {
    ASSERT_EQ(pos[i].size(), 31u);
    EXPECT_NEAR(pos[i][0], 0.005 * static_cast<double>(i), 1e-12);
    for (size_t j = 0; j < joints.size(); ++j) {
      const double q = pos[i][j + 1];
      if (joints[j].find("LEG") != std::string::npos) {
        ASSERT_EQ(q, table.Number(i, "q_" + joints[j] + "_rad")) << joints[j];
        ++of_legs;
      } else {
        ASSERT_EQ(q, pos[0][j + 1]) << joints[j];
      }
      if (joints[j] == "RARM_JOINT3") {
        ASSERT_NEAR(q, -M_PI / 6, 1e-15);
      }
    }
    ASSERT_EQ(waist[i].size(), 7u);
    const double yaw = waist[i][6];
    EXPECT_EQ(waist[i][4], 0.0);
    const double x = waist[i][1] + std::cos(yaw) * zmp[i][1] - std::sin(yaw) * zmp[i][2];
    const double y = waist[i][2] + std::sin(yaw) * zmp[i][1] + std::cos(yaw) * zmp[i][2];
    ASSERT_NEAR(x, table.Number(i, "zmp_x_m"), 1e-12);
    ASSERT_NEAR(y, table.Number(i, "zmp_y_m"), 1e-12);
    ASSERT_NEAR(waist[i][3] + zmp[i][3], 0.0, 1e-12);
  }
  EXPECT_EQ(of_legs, 12 * static_cast<int>(table.size()));
  EXPECT_TRUE(fs::exists(place_ / "run-hrpsys/raw.pos"));
}

TEST_F(ExportCommandTest, HrpsysTakesJointsInTheGivenOrderAndAPeriod) {
  const Outcome outcome =
      Export({"--format", "hrpsys", "--method", "dichotomy", "--period", "0.02", "--joints",
              "RLEG*", "LLEG*", "CHEST*", "HEAD*", "RARM*", "LARM*"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  const std::vector<std::string> joints = Lines("run-hrpsys/dichotomy.joints");
  EXPECT_EQ(joints[0], "RLEG_JOINT0");
  EXPECT_EQ(joints[11], "LLEG_JOINT5");
  EXPECT_EQ(joints[29], "LARM_JOINT6");
  const auto pos = Numbers("run-hrpsys/dichotomy.pos");
  const ParsedCsv table(ReadText(place_ / "run/dichotomy/trajectory.csv"));
  EXPECT_EQ(pos[7][4], table.Number(28, "q_RLEG_JOINT3_rad"));
  EXPECT_EQ(pos.back()[4], table.Number(table.size() - 1, "q_RLEG_JOINT3_rad"));
  EXPECT_FALSE(fs::exists(place_ / "run-hrpsys/raw.pos"));
}

TEST_F(ExportCommandTest, CsvHoldsTheColumnsAndRowsAskedFor) {
  ASSERT_EQ(Export({"--format", "csv", "--columns", "zmp_?_m", "q_R*", "--period", "0.05"}).status,
            kSuccess);
  const ParsedCsv whole(ReadText(place_ / "run/raw/trajectory.csv"));
  const ParsedCsv part(ReadText(place_ / "run-csv/raw.csv"));
  ASSERT_EQ(part.header().size(), 9u);
  EXPECT_EQ(part.header()[1], "zmp_x_m");
  EXPECT_EQ(part.size(), 81u);  // 4 s
  for (size_t i = 0; i < part.size(); ++i) {
    for (const std::string& column : part.header()) {
      EXPECT_EQ(part.Text(i, column), whole.Text(10 * i, column));
    }
  }
  const auto schema = nlohmann::json::parse(ReadText(place_ / "run-csv/raw.schema.json"));
  EXPECT_EQ(schema["fields"].size(), 9u);
  EXPECT_EQ(schema["fields"][1]["frame"], "W");
}

TEST_F(ExportCommandTest, SaysWhatIsWrong) {
  EXPECT_THAT(Refusal({"--format", "csv", "--columns", "zmq*"}),
              HasSubstr("--columns: zmq*: no such column (valid: t_s, half_step"));
  EXPECT_THAT(Refusal({"--format", "csv", "--period", "0.007"}),
              HasSubstr("--period 0.007: is no multiple of the run's output.period_s"));
  EXPECT_THAT(Refusal({"--format", "hrpsys", "--method", "ipopt"}),
              HasSubstr("--method ipopt: is not in run (valid: raw, dichotomy)"));
  EXPECT_THAT(Refusal({"--format", "hrpsys", "--joints", "RLEG*", "*LEG*"}),
              testing::AllOf(HasSubstr("--joints: *LEG*: RLEG_JOINT0 is there already"),
                             HasSubstr("HEAD_JOINT0: is missing (valid: every joint once)")));
  EXPECT_THAT(Refusal({"--format", "ompl", "--period", "0.01"}), HasSubstr("not of --format ompl"));
  const std::string trajectory = (place_ / "run/raw/trajectory.csv").string();
  std::string text = ReadText(trajectory);
  WriteText(trajectory, text.replace(text.find("both"), 4, "bath"));
  EXPECT_THAT(Refusal({"--format", "hrpsys"}),
              HasSubstr("raw/trajectory.csv:2: support: 'bath' (valid: left, right, both)"));
}

// The log by its grammar: every count is followed by as many lines.
TEST_F(ExportCommandTest, OmplLogKeepsItsCounts) {
  ASSERT_EQ(Halfstep(place_.path(),
                     {"export", "run", "run", "--format", "ompl", "--out", "logs", "--quiet"})
                .status,
            kSuccess);
  const std::vector<std::string> lines = Lines("logs/fig3_two_half_steps.log");
  EXPECT_THAT(lines[0], testing::MatchesRegex("halfstep version [0-9.]+"));
  EXPECT_EQ(lines[1], "Experiment fig3_two_half_steps");
  size_t at = 0;
  while (at < lines.size() && !lines[at].ends_with(" planners")) ++at;
  ASSERT_EQ(lines[at++], "2 planners");
  const auto count = [&](const std::string& what) {
    EXPECT_THAT(lines.at(at), testing::EndsWith(what));
    return static_cast<size_t>(std::stoul(lines.at(at++)));
  };
  for (const std::string planner : {"raw", "dichotomy"}) {
    ASSERT_EQ(lines.at(at++), planner);
    at += count("common properties");
    const size_t properties = count("properties for each run");
    at += properties;
    const size_t runs = count("runs");
    EXPECT_EQ(runs, 2u);
    for (size_t run = 0; run < runs; ++run, ++at) {
      const std::string& line = lines.at(at);
      EXPECT_EQ(static_cast<size_t>(std::count(line.begin(), line.end(), ';')), properties);
      EXPECT_TRUE(line.ends_with("; "));
    }
    if (planner == "dichotomy") {
      at += count("progress properties for each run");
      at += count("runs");
      EXPECT_TRUE(lines.at(at - 1).starts_with("0,4,0,0,;"));
    }
    EXPECT_EQ(lines.at(at++), ".");
  }
  EXPECT_EQ(at, lines.size());
}

TEST_F(ExportCommandTest, OmplReadsTheLog) {
  const std::string reader = "/usr/bin/ompl_benchmark_statistics";
  if (!fs::exists(reader)) GTEST_SKIP() << "ompl-demos is not installed";
  ASSERT_EQ(Export({"--format", "ompl", "--out", (place_ / "logs").string()}).status, kSuccess);
  const std::string read = reader + " -d " + (place_ / "runs.db").string() + " " +
                           (place_ / "logs/fig3_two_half_steps.log").string() + " >" +
                           (place_ / "said").string() + " 2>&1";
  EXPECT_EQ(std::system(read.c_str()), 0) << ReadText(place_ / "said");
  EXPECT_THAT(ReadText(place_ / "said"), HasSubstr("Parsing data for dichotomy"));
}

}  // namespace
}  // namespace halfstep
