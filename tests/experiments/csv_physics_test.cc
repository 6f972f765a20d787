// What the trajectory files say must be physics by itself: here nothing but CSV and the robot's
// forward kinematics.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "experiments/commands/commands.h"
#include "experiments/config/data_folder.h"
#include "experiments/config/experiment.h"
#include "tests/experiments/parsed_csv.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/generated_robots.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

void PrintTo(const GeneratedRobot& robot, std::ostream* out) { *out << robot.name; }

namespace {

namespace fs = std::filesystem;

constexpr double kGravity = 9.81;

Eigen::Isometry3d PoseAt(const ParsedCsv& table, size_t row, const std::string& what) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(table.Number(row, what + "_yaw_rad"), Eigen::Vector3d::UnitZ())
                   .toRotationMatrix();
  X.translation() =
      Eigen::Vector3d(table.Number(row, what + "_x_m"), table.Number(row, what + "_y_m"),
                      table.Number(row, what + "_z_m"));
  return X;
}

// Largest |z_c/g·c̈ − c + p| [m].
double LipmResidual(const ParsedCsv& table) {
  double largest = 0.0;
  for (size_t i = 0; i < table.size(); ++i) {
    const double z = table.Number(i, "com_z_m");
    for (const std::string axis : {"x", "y"}) {
      const double residual = z / kGravity * table.Number(i, "com_a" + axis + "_m_s2") -
                              table.Number(i, "com_" + axis + "_m") +
                              table.Number(i, "zmp_" + axis + "_m");
      largest = std::max(largest, std::abs(residual));
    }
  }
  return largest;
}

// Largest difference of a column from the slope of another, by central differences.
double SlopeError(const ParsedCsv& table, const std::string& of, const std::string& slope) {
  double largest = 0.0;
  for (size_t i = 1; i + 2 < table.size(); ++i) {  // the last period is shorter
    const double dt = table.Number(i + 1, "t_s") - table.Number(i - 1, "t_s");
    const double difference = (table.Number(i + 1, of) - table.Number(i - 1, of)) / dt;
    largest = std::max(largest, std::abs(difference - table.Number(i, slope)));
  }
  return largest;
}

// Compares the foot columns with what the joint columns make of the waist columns.
void CheckSoles(const ParsedCsv& table, const RobotModel& robot) {
  double farthest = 0.0, most_turned = 0.0;
  for (size_t i = 0; i < table.size(); ++i) {
    const Eigen::Isometry3d X_WB = PoseAt(table, i, "waist");
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Leg& leg = robot.legs[static_cast<size_t>(Index(side))];
      Vector6d q;
      for (size_t j = 0; j < 6; ++j) {
        q[static_cast<Eigen::Index>(j)] = table.Number(i, "q_" + leg.joints[j].name + "_rad");
      }
      const Eigen::Isometry3d X_WSole = X_WB * LegForwardKinematics(leg, q)[6];
      const Eigen::Isometry3d error =
          PoseAt(table, i, std::string(Name(side)) + "_foot").inverse() * X_WSole;
      farthest = std::max(farthest, error.translation().norm());
      // For small angles, |R − 1|_F = √2·angle, without the cosine's loss of digits.
      const double turn = (error.linear() - Eigen::Matrix3d::Identity()).norm() / std::sqrt(2.0);
      most_turned = std::max(most_turned, turn);
    }
  }
  EXPECT_LT(farthest, 1e-9);
  EXPECT_LT(most_turned, 1e-9);
}

// Runs a config and checks the trajectories of all its methods.
void CheckPhysics(const std::string& config, const std::vector<YamlOverride>& overrides,
                  const RobotModel& robot) {
  const TemporaryFolder place;
  const fs::path run = place / "run";
  ASSERT_EQ(Run({.config = config,
                 .methods = {},
                 .overrides = overrides,
                 .out = run.string(),
                 .quiet = true}),
            kSuccess);
  for (const std::string method : {"raw", "dichotomy", "dichotomy_published"}) {
    SCOPED_TRACE(method);
    const ParsedCsv table(ReadText(run / method / "trajectory.csv"));
    ASSERT_GT(table.size(), 100u);
    EXPECT_LT(LipmResidual(table), 1e-9);
    for (const std::string axis : {"x", "y"}) {
      EXPECT_LT(SlopeError(table, "com_" + axis + "_m", "com_v" + axis + "_m_s"), 2e-3);
      EXPECT_LT(SlopeError(table, "com_v" + axis + "_m_s", "com_a" + axis + "_m_s2"), 0.3);
    }
    CheckSoles(table, robot);
  }
}

TEST(CsvPhysics, Hrp2) {
  const std::string config = InSources("experiments/configs/fig4_raw_sequence.yaml");
  CheckPhysics(config, {{"output.period_s", "0.01"}},
               LoadRobot((RobotsFolder() / "hrp2.yaml").string()));
}

TEST(CsvPhysics, OtherShippedRobots) {
  for (const std::string name : {"wren", "bison"}) {
    SCOPED_TRACE(name);
    CheckPhysics(InSources("experiments/configs/") + name + "_six_steps.yaml",
                 {{"smoothing.methods", "[dichotomy, dichotomy/published]"}},
                 LoadRobot((RobotsFolder() / (name + ".yaml")).string()));
  }
}

class GeneratedRobotPhysics : public testing::TestWithParam<GeneratedRobot> {};
INSTANTIATE_TEST_SUITE_P(Csv, GeneratedRobotPhysics, testing::ValuesIn(GeneratedRobots()),
                         [](const auto& info) { return info.param.name; });

// Four steps on a curve, scaled to the robot's size.
TEST_P(GeneratedRobotPhysics, HoldsInEveryRow) {
  const TemporaryRobot files(GetParam());
  const RobotModel robot = files.Load();
  const double length = robot.waist_height, half_width = 0.5 * robot.standing_width;
  std::ostringstream yaml;
  yaml.precision(17);
  yaml << "robot: " << files.yaml_path() << "\nscene: none\nfootsteps:\n";
  for (int i = 1; i <= 4; ++i) {
    const double yaw = 0.05 * i, x = 0.06 * length * i;
    const double y = (i % 2 == 0 ? 1 : -1) * half_width + 0.01 * length * i;
    yaml << "  - {foot: " << (i % 2 == 0 ? "left" : "right") << ", x_m: " << x << ", y_m: " << y
         << ", yaw_deg: " << yaw * 180 / 3.14159265358979323846 << "}\n";
  }
  yaml << "half_step: {via_height_m: " << 0.12 * length << ", via_lateral_m: " << 2.2 * half_width
       << "}\nsmoothing: {methods: [dichotomy, dichotomy/published]}\n";
  const TemporaryFolder place;
  CheckPhysics(WriteText(place / "walk.yaml", yaml.str()), {}, robot);
}

}  // namespace
}  // namespace halfstep
