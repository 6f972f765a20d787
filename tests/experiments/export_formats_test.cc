// Exports as other programs take them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/replay/simulation.h"
#include "experiments/tables/trajectory_file.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/made_once.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/experiments/schema_check.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "wpg/files/yaml_node.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// A folder with a run over a box, "run", a row each 10 ms.
class ExportFormats : public testing::Test {
 protected:
  void SetUp() override {
    CopyMadeOnce(place_.path(),
                 {"run", ShippedConfig("fig5_box"), "--out", "run", "--quiet", "--set",
                  "smoothing.methods=[dichotomy]", "--set", "output.period_s=0.01"});
  }
  Outcome Export(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {"export", "run", "--method", "dichotomy", "--quiet", "--format"});
    return Halfstep(place_.path(), arguments);
  }
  ParsedCsv Trajectory() const {
    return ParsedCsv(ReadText(place_ / "run/dichotomy/trajectory.csv"));
  }
  const Experiment experiment_ = Prepare(LoadConfig(ShippedConfig("fig5_box"), {}));

  TemporaryFolder place_;
};

TEST_F(ExportFormats, NumpyReadsWhatTheCsvSaysToTheBit) {
  const std::string python = "/usr/bin/python3";
  if (std::system((python + " -c 'import numpy' 2>/dev/null").c_str()) != 0) {
    GTEST_SKIP() << "NumPy is not installed";
  }
  ASSERT_EQ(Export({"npz", "--all-joints", "--waist", "quaternion"}).status, kSuccess);
  ASSERT_EQ(Export({"csv", "--all-joints", "--waist", "quaternion"}).status, kSuccess);
  const std::string read = python + " " + InSources("tests/experiments/read_npz.py ") +
                           (place_ / "run-npz/dichotomy.npz").string() + " " +
                           (place_ / "run-csv/dichotomy.csv").string() + " >" +
                           (place_ / "said").string() + " 2>&1";
  EXPECT_EQ(std::system(read.c_str()), 0) << ReadText(place_ / "said");
  const ParsedCsv table(ReadText(place_ / "run-csv/dichotomy.csv"));
  EXPECT_EQ(ReadText(place_ / "said"), std::to_string(table.header().size()) + " arrays of " +
                                           std::to_string(table.size()) + "\n");
}

TEST_F(ExportFormats, NpzTakesColumnsAndAPeriodAndIsTheSameAgain) {
  ASSERT_EQ(Export({"npz", "--columns", "com_*", "--period", "0.1"}).status, kSuccess);
  const std::string first = ReadText(place_ / "run-npz/dichotomy.npz");
  ASSERT_EQ(Export({"npz", "--columns", "com_*", "--period", "0.1", "--overwrite"}).status,
            kSuccess);
  EXPECT_EQ(ReadText(place_ / "run-npz/dichotomy.npz"), first);
  EXPECT_THAT(first, HasSubstr("com_vx_m_s.npy"));
  EXPECT_EQ(first.find("zmp_x_m.npy"), std::string::npos);
}

TEST_F(ExportFormats, CsvHasAllJointsAndTheWaistsQuaternion) {
  ASSERT_EQ(Export({"csv", "--all-joints", "--waist", "quaternion"}).status, kSuccess);
  const ParsedCsv table(ReadText(place_ / "run-csv/dichotomy.csv")), run = Trajectory();
  ASSERT_EQ(table.size(), run.size());
  EXPECT_EQ(table.header().size(), run.header().size() + 18 + 3);  // HRP-2: 30 joints
  double before = 1.0;
  for (size_t i = 0; i < table.size(); ++i) {
    for (const std::string& column : run.header()) {
      if (column == "waist_yaw_rad") continue;
      ASSERT_EQ(table.Text(i, column), run.Text(i, column));
    }
    EXPECT_NEAR(table.Number(i, "q_RARM_JOINT3_rad"), -M_PI / 6, 1e-15);
    const double w = table.Number(i, "waist_qw"), z = table.Number(i, "waist_qz");
    EXPECT_NEAR(w * w + z * z, 1.0, 1e-15);
    EXPECT_NEAR(2.0 * std::atan2(z, w), run.Number(i, "waist_yaw_rad"), 1e-15);
    EXPECT_GT(w * before, 0.0);
    before = w;
  }
  const json schema = json::parse(ReadText(place_ / "run-csv/dichotomy.schema.json"));
  EXPECT_EQ(schema["fields"].size(), table.header().size());
}

// The fields of the message and of the messages in it, and their types.
json MessageSchema() {
  const auto message = [](const json& fields) {
    json required = json::array();
    for (const auto& [name, type] : fields.items()) required.push_back(name);
    return json{{"type", "object"},
                {"properties", fields},
                {"required", required},
                {"additionalProperties", false}};
  };
  const json int32 = {{"type", "integer"}, {"minimum", -2147483648LL}, {"maximum", 2147483647}};
  const json uint32 = {{"type", "integer"}, {"minimum", 0}, {"maximum", 999999999}};
  const json floats = {{"type", "array"}, {"items", {{"type", "number"}}}};
  const json time = message({{"sec", int32}, {"nanosec", uint32}});
  const json point = message({{"positions", floats},
                              {"velocities", floats},
                              {"accelerations", floats},
                              {"effort", floats},
                              {"time_from_start", time}});
  return message({{"header", message({{"stamp", time}, {"frame_id", {{"type", "string"}}}})},
                  {"joint_names", {{"type", "array"}, {"items", {{"type", "string"}}}}},
                  {"points", {{"type", "array"}, {"items", point}}}});
}

json ReadMessage(const fs::path& path) {
  YamlComplaints complaints(path.string());
  const YamlNode node = ParseYaml(ReadText(path), "", &complaints);
  complaints.ThrowIfAny();
  return JsonOfYaml(node);
}

TEST_F(ExportFormats, JointTrajectoryIsTheMessageAndMovesAsTheWalk) {
  const Outcome outcome = Export({"joint_trajectory", "--joints", "RLEG*", "LLEG*", "*"});
  EXPECT_EQ(outcome.status, kBadInput);  // "*" has the legs again
  ASSERT_EQ(Export({"joint_trajectory"}).status, kSuccess);
  const json message = ReadMessage(place_ / "run-joint_trajectory/dichotomy.yaml");
  EXPECT_EQ(SchemaComplaint(MessageSchema(), message), "");
  const json &names = message["joint_names"], &points = message["points"];
  ASSERT_EQ(names.size(), 30u);
  const ParsedCsv run = Trajectory();
  ASSERT_EQ(points.size(), run.size());
  const auto number = [&points](size_t i, const char* what, size_t j) {
    return points[i][what][j].get<double>();
  };
  double fastest = 0.0, off = 0.0;
  long compared = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const json& time = points[i]["time_from_start"];
    const double t = time["sec"].get<double>() + 1e-9 * time["nanosec"].get<double>();
    ASSERT_NEAR(t, run.Number(i, "t_s"), 0.6e-9);
    EXPECT_TRUE(points[i]["effort"].empty());
    for (size_t j = 0; j < names.size(); ++j) {
      const std::string name = names[j];
      const bool of_leg = name.find("LEG") != std::string::npos;
      if (of_leg) {
        ASSERT_EQ(number(i, "positions", j), run.Number(i, "q_" + name + "_rad"));
      } else {
        ASSERT_EQ(number(i, "positions", j), number(0, "positions", j));
        ASSERT_EQ(number(i, "velocities", j), 0.0);
        ASSERT_EQ(number(i, "accelerations", j), 0.0);
      }
      if (i < 1 || i + 2 >= points.size()) continue;
      const auto slope = [&](const char* what) {
        return (number(i + 1, what, j) - number(i - 1, what, j)) / 0.02;
      };
      fastest = std::max(fastest, std::abs(number(i, "velocities", j)));
      ASSERT_NEAR(number(i, "velocities", j), slope("positions"), 0.05) << name << " " << i;
      off += std::abs(number(i, "accelerations", j) - slope("velocities"));
      ++compared;
    }
  }
  // Where the third derivative jumps, differences of velocities are off by more.
  EXPECT_LT(off / static_cast<double>(compared), 0.02);
  EXPECT_GT(fastest, 0.5);  // so the bounds above say something
}

// The raw walk ends 4e-11 s behind a row: ROS refuses two points of one time.
TEST_F(ExportFormats, NoTwoRowsHaveOneTimeInAnyFormat) {
  ASSERT_EQ(Halfstep(place_.path(),
                     {"run", ShippedConfig("fig5_box"), "--out", "run", "--quiet", "--overwrite",
                      "--set", "smoothing.methods=[dichotomy]", "--set", "output.period_s=0.01",
                      "--set", "half_step.duration_s=2.00000000002"})
                .status,
            kSuccess);
  const ParsedCsv run(ReadText(place_ / "run/raw/trajectory.csv"));
  const double end = run.Number(run.size() - 1, "t_s");
  ASSERT_LT(end - run.Number(run.size() - 2, "t_s"), 1e-9);
  for (const std::string format : {"joint_trajectory", "mjcf", "hrpsys", "csv"}) {
    ASSERT_EQ(
        Halfstep(place_.path(), {"export", "run", "--method", "raw", "--quiet", "--format", format})
            .status,
        kSuccess);
  }
  long before = -1;
  const json message = ReadMessage(place_ / "run-joint_trajectory/raw.yaml");
  for (const json& point : message["points"]) {
    const json& time = point["time_from_start"];
    const long nanoseconds = time["sec"].get<long>() * 1000000000 + time["nanosec"].get<long>();
    ASSERT_GT(nanoseconds, before);
    before = nanoseconds;
  }
  EXPECT_EQ(before, std::lround(1e9 * end));
  const auto times = [](const std::string& text, const std::string& mark) {
    std::vector<double> all;
    for (size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
      const std::string rest = text.substr(at + mark.size());
      if (!rest.empty()) all.push_back(std::stod(rest));
    }
    return all;
  };
  for (const std::vector<double>& all :
       {times(ReadText(place_ / "run-mjcf/raw.xml"), " time=\""),
        times("\n" + ReadText(place_ / "run-hrpsys/raw.pos"), "\n"),
        times(ReadText(place_ / "run-csv/raw.csv"), "\n")}) {
    ASSERT_GT(all.size(), 10u);
    EXPECT_TRUE(std::ranges::is_sorted(all, std::less_equal<>()));
  }
}

TEST_F(ExportFormats, MujocoStandsAtTheKeysAsTheWalkDoesAmongItsObstacles) {
  if (!replay::WhyNoSimulation().empty()) GTEST_SKIP() << replay::WhyNoSimulation();
  ASSERT_EQ(Export({"mjcf", "--period", "0.1"}).status, kSuccess);
  const auto obstacles = replay::ObstaclesOf(experiment_.scene).obstacles;
  ASSERT_EQ(obstacles.size(), 1u);
  const WholeRobot whole = LoadWholeRobot(RobotPath(experiment_.config).string());
  const std::string mjcf = ReadText(place_ / "run-mjcf/dichotomy.xml");
  EXPECT_THAT(mjcf, HasSubstr("<text name=\"obstacle_0\" data=\"" + obstacles[0].name + "\"/>"));
  replay::Simulation engine(mjcf, whole.model, "WAIST", obstacles);
  const std::vector<TrajectoryRow> rows =
      ReadTrajectory(place_ / "run/dichotomy/trajectory.csv", whole.model);
  ASSERT_EQ(engine.num_keyframes(), static_cast<int>((rows.size() + 18) / 10));
  for (int key = 0; key < engine.num_keyframes(); ++key) {
    SCOPED_TRACE(key);
    const TrajectoryRow& row = rows[std::min(10 * static_cast<size_t>(key), rows.size() - 1)];
    engine.PlaceAtKeyframe(key);
    EXPECT_TRUE(engine.X_WB().isApprox(row.X_WB(), 1e-9));
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const auto sole = TrajectoryRow::Upright(row.soles[static_cast<size_t>(Index(side))]);
      EXPECT_LT((engine.X_WSole(side).matrix() - sole.matrix()).cwiseAbs().maxCoeff(), 1e-6);
    }
    EXPECT_TRUE(engine.X_WObstacle(0).isApprox(*obstacles[0].pose(row.t), 1e-12));
    EXPECT_TRUE(engine.touches().empty());
  }
}

TEST_F(ExportFormats, SayWhatIsWrong) {
  const auto refusal = [this](const std::vector<std::string>& arguments) {
    const Outcome outcome = Export(arguments);
    EXPECT_EQ(outcome.status, kBadInput);
    EXPECT_EQ(NamesIn(place_.path()), std::set<std::string>{"run"});
    return outcome.err;
  };
  EXPECT_THAT(refusal({"mjcf", "--columns", "com_*"}),
              HasSubstr("--columns: not of --format mjcf (valid: csv, npz)"));
  EXPECT_THAT(refusal({"hrpsys", "--all-joints"}),
              HasSubstr("--all-joints: not of --format hrpsys (valid: csv, npz)"));
  EXPECT_THAT(refusal({"joint_trajectory", "--waist", "quaternion"}),
              HasSubstr("--waist: not of --format joint_trajectory (valid: csv, npz)"));
  EXPECT_THAT(refusal({"npz", "--joints", "RLEG*"}),
              HasSubstr("--joints: not of --format npz (valid: hrpsys, joint_trajectory, lafan1)"));
  EXPECT_THAT(refusal({"npz", "--columns", "zmq*"}), HasSubstr("--columns: zmq*: no such column"));
  EXPECT_THAT(refusal({"mjcf", "--period", "0.013"}),
              HasSubstr("--period 0.013: is no multiple of the run's output.period_s"));
  EXPECT_THAT(refusal({"csv", "--waist", "euler"}), HasSubstr("--waist"));
  const std::string table = (place_ / "run/dichotomy/half_steps.csv").string();
  const std::string text = ReadText(table);
  WriteText(table, std::string(text).replace(text.find(",2.0,"), 5, ",1.9,"));
  EXPECT_THAT(refusal({"joint_trajectory"}),
              HasSubstr("dichotomy/trajectory.csv: is not of the walk that config and tables make: "
                        "the walk ends at "));
}

}  // namespace
}  // namespace halfstep
