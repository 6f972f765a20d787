// Footsteps out of a run and into a config.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/run/experiment_run.h"
#include "tests/experiments/child_process.h"
#include "tests/export/python_reader.h"
#include "tests/temporary_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

ExperimentConfig WithSteps(const TemporaryFolder& place, const std::string& lines) {
  return LoadConfig(WriteText(place / "config.yaml", "robot: hrp2\nscene: none\n" + lines), {});
}

std::string Complaints(const TemporaryFolder& place, const std::string& file,
                       const std::string& text, const std::string& lines = "") {
  WriteText(place / file, text);
  try {
    WithSteps(place, "footsteps_file: {path: " + file + "}\n" + lines);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Footsteps, OfARunComeBackInEitherForm) {
  const TemporaryFolder place;
  ASSERT_EQ(Halfstep(place.path(), {"run", ShippedConfig("fig5_box"), "--out", "run", "--quiet",
                                    "--set", "scene=none"})
                .status,
            kSuccess);
  for (const std::string format : {"footsteps", "humanoid_nav_msgs"}) {
    ASSERT_EQ(Halfstep(place.path(),
                       {"export", "run", "--method", "dichotomy", "--quiet", "--format", format})
                  .status,
              kSuccess);
  }
  EXPECT_EQ(ReadText(place / "run-footsteps/dichotomy.csv"), ReadText(place / "run/footsteps.csv"));
  if (PythonHas("yaml") && PythonHas("numpy")) {
    EXPECT_EQ(
        ReadByPython(place, "footsteps run/footsteps.csv run-humanoid_nav_msgs/dichotomy.yaml"),
        "");
  }
  const ExperimentConfig run = LoadConfig((place / "run/config.yaml").string(), {});
  const HalfStepSequence sequence = Prepare(run).sequence;
  for (const std::string file : {"run/footsteps.csv", "run-footsteps/dichotomy.csv",
                                 "run-humanoid_nav_msgs/dichotomy.yaml"}) {
    ExperimentConfig read = WithSteps(place, "footsteps_file: {path: " + file + "}\n");
    read.half_step = run.half_step;
    const HalfStepSequence again = Prepare(read).sequence;
    ASSERT_EQ(again.size(), sequence.size());
    for (int i = 0; i < sequence.size(); ++i) {
      const PlacedHalfStep &a = sequence.half_steps[static_cast<size_t>(i)],
                           &b = again.half_steps[static_cast<size_t>(i)];
      EXPECT_NEAR(a.X_WS.x, b.X_WS.x, 1e-14) << file;
      EXPECT_NEAR(a.half_step.X_SF.yaw, b.half_step.X_SF.yaw, 1e-14);
      EXPECT_EQ(a.half_step.support, b.half_step.support);
    }
    // What is written is the footsteps themselves.
    EXPECT_THAT(ResolvedConfig(place.path(), read),
                testing::AllOf(HasSubstr("footsteps:\n"), testing::Not(HasSubstr("_file"))));
  }
}

TEST(Footsteps, OfATableSayWhatTheySay) {
  const TemporaryFolder place;
  WriteText(place / "steps.csv",
            "\xEF\xBB\xBF"
            "foot,x_m,y_m,yaw_deg,duration_s\r\n\"left\",0.1,0.1,10,\r\n"
            "right,0.2,-0.1,-5,1.5\r\n");
  const ExperimentConfig config = WithSteps(place, "footsteps_file: {path: steps.csv}\n");
  ASSERT_EQ(config.footsteps.size(), 2u);
  EXPECT_EQ(config.footsteps[0].foot, "left");
  EXPECT_NEAR(config.footsteps[0].X_WF.yaw, M_PI / 18, 1e-15);
  EXPECT_FALSE(config.footsteps[0].duration.has_value());
  EXPECT_EQ(config.footsteps[1].duration, 1.5);
  EXPECT_EQ(config.footsteps[1].X_WF.y, -0.1);
  EXPECT_FALSE(config.has_start);
}

// A relative target is seen from the sole that carries; wrapped angles are taken as the nearest
// turn; what services say besides is passed over.
TEST(Footsteps, OfStepTargetsMayBeRelativeAndWrapped) {
  const TemporaryFolder place;
  WriteText(place / "goal.yaml",
            "footsteps:\n- pose: {x: 0.1, y: 0.2, theta: 3.0}\n  leg: 1\n"
            "- pose: {x: 0.1, y: -0.2, theta: 0.5}\n  leg: 0\nfeedback_frequency: 5.0\n");
  const ExperimentConfig seen =
      WithSteps(place,
                "start: {left: {x_m: 0, y_m: 0.1}, right: {x_m: 0, y_m: -0.1}}\n"
                "footsteps_file: {path: goal.yaml, poses: support}\n");
  EXPECT_NEAR(seen.footsteps[0].X_WF.y, 0.1, 1e-15);  // from the right sole
  const Pose2 left{0.1, 0.1, 3.0};
  const Pose2 right = left * Pose2{0.1, -0.2, 0.5};
  EXPECT_NEAR(seen.footsteps[1].X_WF.x, right.x, 1e-15);
  EXPECT_NEAR(seen.footsteps[1].X_WF.yaw, 3.5, 1e-15);
  WriteText(place / "plan.yaml",
            "result: true\nfootsteps:\n- {pose: {x: 0.1, y: 0.2, theta: 3.1}, leg: 1}\n"
            "- {pose: {x: 0.1, y: -0.2, theta: -3.1}, leg: 0}\ncosts: 3.5\n");
  const ExperimentConfig wrapped = WithSteps(place, "footsteps_file: {path: plan.yaml}\n");
  EXPECT_NEAR(wrapped.footsteps[1].X_WF.yaw, 2 * M_PI - 3.1, 1e-15);
}

TEST(Footsteps, BadRowsAreToldByLineAndColumn) {
  const TemporaryFolder place;
  const auto table = [&](const std::string& text) { return Complaints(place, "steps.csv", text); };
  const std::string header = "foot,x_m,y_m,yaw_rad\n";
  EXPECT_THAT(table(header + "left,0.1,0.1,0\nright,0.x2,-0.1,0\n"),
              HasSubstr("steps.csv:3:7: x_m: '0.x2' is not a number (valid: a finite decimal"));
  EXPECT_THAT(table(header + "lft,0.1,2000,0\n"),
              testing::AllOf(HasSubstr("steps.csv:2:1: foot: 'lft' (valid: left, right)"),
                             HasSubstr("steps.csv:2:9: y_m: 2000 is out of range (valid: -1000")));
  EXPECT_THAT(table(header + "left,0.1,0.1\n"),
              HasSubstr("steps.csv:2:1: footstep: 3 cells for 4 columns"));
  EXPECT_THAT(table("foot,x_m,y_m,yaw\nleft,0,0,0\n"),
              testing::AllOf(HasSubstr("steps.csv:1:14: yaw: no such column"),
                             HasSubstr("steps.csv:1:1: yaw_rad: a column is needed")));
  EXPECT_THAT(table(header + "left,0.1,0.1,3\nright,0.2,-0.1,-3\n"),
              HasSubstr("steps.csv:3:16: yaw_rad: is more than half a turn from"));
  EXPECT_THAT(table(header), HasSubstr("there are no footsteps"));
  EXPECT_THAT(table(""), HasSubstr("the file is empty"));
  EXPECT_THAT(Complaints(place, "t.yaml", "footsteps:\n- {pose: {x: 0, y: 0}, leg: 2}\n"),
              testing::AllOf(HasSubstr("t.yaml:2:10: footsteps[0].pose.theta: a required key"),
                             HasSubstr("t.yaml:2:29: footsteps[0].leg: 2 is out of range")));
  EXPECT_THAT(Complaints(place, "steps.txt", "x"),
              HasSubstr("is no file of footsteps by its name"));
  EXPECT_THAT(Complaints(place, "s.csv", header + "left,0,0.1,0\n",
                         "footsteps: [{foot: left, x_m: 0, y_m: 0.1}]\n"),
              HasSubstr("config.yaml:3:17: footsteps_file: there are `footsteps` or a `goal`"));
  std::filesystem::remove(place / "s.csv");
  try {
    WithSteps(place, "footsteps_file: {path: s.csv}\n");
    ADD_FAILURE() << "a missing file was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("config.yaml:3:24: footsteps_file.path: no such file: "));
  }
}

}  // namespace
}  // namespace halfstep
