#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/commands/commands.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

std::string Columns(const fs::path& csv) {
  const std::string text = ReadText(csv);
  return text.substr(0, text.find('\n'));
}

// Columns of a table that say how long something took.
const std::vector<std::string> kWall = {"wall_s", "time_to_first_improvement_s"};

// A report without the numbers of these columns.
std::string WithoutWallTimes(std::string report) {
  for (const std::string& column : kWall) {
    const std::string key = "\"" + column + "\":";
    for (size_t at = report.find(key); at != std::string::npos; at = report.find(key, at)) {
      at += key.size();
      report.erase(at, report.find_first_of(",}", at) - at);
    }
  }
  return report;
}

// What a URDF has that no leg needs is told, and does not stop the run.
TEST(RunCommand, TellsWhatWasRepairedInTheUrdf) {
  const TemporaryFolder place;
  fs::copy(InSources("wpg/robots"), place / "robots", fs::copy_options::recursive);
  std::string urdf = ReadText(place / "robots/hrp2.urdf");
  urdf.insert(urdf.rfind("</robot>"),
              "<link name='finger'/><joint name='grip' type='revolute'><parent link='WAIST'/>"
              "<child link='finger'/><limit lower='0' upper='1' velocity='0' effort='1'/></joint>");
  WriteText(place / "robots/hrp2.urdf", urdf);
  const std::string robot = "robot=" + (place / "robots/hrp2.yaml").string();
  for (const std::string command : {"run", "live"}) {
    const std::string config = command == "run" ? ShippedConfig("fig3_two_half_steps")
                                                : InSources("experiments/episodes/live_bar.yaml");
    std::vector<std::string> arguments = {command, config, "--set", robot, "--out", command};
    // An episode ends before anything is baked.
    if (command == "live") arguments.insert(arguments.end(), {"--serve", "no/such/folder"});
    const Outcome outcome = Halfstep(place.path(), arguments);
    EXPECT_EQ(outcome.status, command == "run" ? kSuccess : kBadInput) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("halfstep: warning: "));
    EXPECT_THAT(outcome.err,
                HasSubstr("limit velocity: 0 is out of range (valid: > 0); it is held still"));
  }
}

TEST(RunCommand, WritesEveryFileAndColumn) {
  const TemporaryFolder place;
  const Outcome outcome = Halfstep(place.path(), {"run", ShippedConfig("bar_8cm")});
  EXPECT_EQ(outcome.status, kSuccess) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("written: "));
  EXPECT_THAT(NamesIn(place.path()), testing::ElementsAre("runs"));
  EXPECT_THAT(NamesIn(place / "runs"), testing::ElementsAre("bar_8cm"));
  const fs::path run = place / "runs/bar_8cm";
  CheckRunIsWhole(run, {"dichotomy", "dichotomy_published"});

  EXPECT_EQ(Columns(run / "dichotomy/trajectory.csv"),
            "t_s,half_step,support,com_x_m,com_y_m,com_z_m,com_vx_m_s,com_vy_m_s,com_ax_m_s2,"
            "com_ay_m_s2,zmp_x_m,zmp_y_m,waist_x_m,waist_y_m,waist_z_m,waist_yaw_rad,"
            "left_foot_x_m,left_foot_y_m,left_foot_z_m,left_foot_yaw_rad,"
            "right_foot_x_m,right_foot_y_m,right_foot_z_m,right_foot_yaw_rad,"
            "q_LLEG_JOINT0_rad,q_LLEG_JOINT1_rad,q_LLEG_JOINT2_rad,q_LLEG_JOINT3_rad,"
            "q_LLEG_JOINT4_rad,q_LLEG_JOINT5_rad,q_RLEG_JOINT0_rad,q_RLEG_JOINT1_rad,"
            "q_RLEG_JOINT2_rad,q_RLEG_JOINT3_rad,q_RLEG_JOINT4_rad,q_RLEG_JOINT5_rad,"
            "zmp_margin_m,joint_margin_rad,joint_speed_margin_rad_s,foot_speed_margin_m_s,"
            "clearance_m,self_clearance_m,zmp_robot_margin_m,torque_margin_n_m,friction_margin");
  EXPECT_EQ(
      Columns(run / "dichotomy/overlaps.csv"),
      "junction,kind,overlap_s,upper_bound_s,limited_by,limited_by_family,limited_by_scale,price_s,"
      "multiplier_s,duration_before_s,duration_after_s,height_scale_before,"
      "height_scale_after");
  EXPECT_EQ(Columns(run / "dichotomy/iterates.csv"),
            "iteration,wall_s,instants,effort,candidate_duration_s,candidate_worst_margin,"
            "accepted,lambda,incumbent_duration_s,incumbent_worst_margin");
  EXPECT_EQ(Columns(run / "summary.csv"),
            "method,status,certified,duration_s,speedup,cost,worst_margin,worst_margin_name,"
            "iterations,instants,effort,collision_queries,wall_s,time_to_first_improvement_s,"
            "gap_to_reference");
  EXPECT_EQ(Columns(run / "footsteps.csv"),
            "footstep,foot,x_m,y_m,yaw_rad,via_height_m,duration_s");

  const auto manifest = nlohmann::json::parse(ReadText(run / "manifest.json"));
  EXPECT_EQ(manifest["config_sha256"].get<std::string>().size(), 64u);
  EXPECT_EQ(manifest["half_steps"], 8);
  ASSERT_EQ(manifest["methods"].size(), 3u);
  EXPECT_EQ(manifest["methods"][2]["name"], "dichotomy/published");
  for (const auto& [library, version] : manifest["libraries"].items()) {
    EXPECT_NE(version, "") << library;
  }
  EXPECT_TRUE(manifest["libraries"].contains("sleef"));
  // `instants` of tables are all kinds at which margins were evaluated.
  const ParsedCsv summary(ReadText(run / "summary.csv"));
  for (size_t row = 0; row < 3; ++row) {
    const nlohmann::json& method = manifest["methods"][row];
    const nlohmann::json& work = method["work"];
    EXPECT_EQ(work["instants"].get<long>() + work["derivatives"].get<long>() +
                  work["intervals"].get<long>(),
              std::lround(summary.Number(row, "instants")));
    EXPECT_EQ(work["effort"].get<double>(), summary.Number(row, "effort"));
    EXPECT_GT(work["effort"].get<double>(), 0.0);
    EXPECT_EQ(method["processor_s"].get<double>() > 0.0, row > 0) << "raw searches nothing";
  }
  const ParsedCsv iterates(ReadText(run / "dichotomy/iterates.csv"));
  for (size_t row = 1; row < iterates.size(); ++row) {
    EXPECT_GE(iterates.Number(row, "effort"), iterates.Number(row - 1, "effort"));
  }
  EXPECT_LE(iterates.Number(iterates.size() - 1, "effort"), summary.Number(1, "effort"));
}

TEST(RunCommand, RowsComeAtAFixedRateAndEndWithTheWalk) {
  const TemporaryFolder place;
  const double period = 0.004;
  const Outcome outcome =
      Halfstep(place.path(), {"run", ShippedConfig("fig3_two_half_steps"), "--set",
                              "output.period_s=0.004", "--out", "here"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  const ParsedCsv summary(ReadText(place / "here/summary.csv"));
  const std::string folders[] = {"raw", "dichotomy", "dichotomy_published"};
  for (size_t method = 0; method < 3; ++method) {
    SCOPED_TRACE(folders[method]);
    const ParsedCsv table(ReadText(place / "here" / folders[method] / "trajectory.csv"));
    const size_t last = table.size() - 1;
    for (size_t i = 0; i < last; ++i) {
      EXPECT_NEAR(table.Number(i, "t_s"), static_cast<double>(i) * period, 1e-12);
      EXPECT_LE(table.Number(i, "half_step"), table.Number(i + 1, "half_step"));
      const std::string& support = table.Text(i, "support");
      EXPECT_TRUE(support == "left" || support == "both") << support;  // the right foot steps
    }
    EXPECT_EQ(table.Text(last, "t_s"), summary.Text(method, "duration_s"));
    const double rest = table.Number(last, "t_s") - table.Number(last - 1, "t_s");
    EXPECT_GT(rest, 1e-9);
    EXPECT_LE(rest, period + 1e-12);
    EXPECT_EQ(table.Text(0, "half_step"), "1");
    EXPECT_EQ(table.Text(last, "half_step"), "2");
    EXPECT_NEAR(table.Number(last, "right_foot_x_m"), 0.2, 1e-12);
    EXPECT_NEAR(table.Number(last, "right_foot_z_m"), 0.0, 1e-12);
  }
}

TEST(RunCommand, TwoRunsDifferInWallTimesOnly) {
  const TemporaryFolder place;
  for (const std::string name : {"a", "b"}) {
    const Outcome outcome =
        Halfstep(place.path(), {"run", ShippedConfig("fig5_box"), "--out", name, "--quiet"});
    ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  }
  const std::set<std::string> files = FilesBelow(place / "a");
  EXPECT_EQ(files, FilesBelow(place / "b"));
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const std::string a = ReadText(place / "a" / file), b = ReadText(place / "b" / file);
    if (file == "manifest.json") continue;
    if (file == "summary.csv" || file.ends_with("iterates.csv")) {
      EXPECT_EQ(ParsedCsv(a).Without(kWall), ParsedCsv(b).Without(kWall));
    } else if (file == "report.html") {
      EXPECT_TRUE(WithoutWallTimes(a) == WithoutWallTimes(b));
    } else {
      EXPECT_TRUE(a == b);
    }
  }
}

TEST(RunCommand, ResolvedConfigRunsAgainToTheSameResult) {
  const TemporaryFolder place;
  ASSERT_EQ(Halfstep(place.path(), {"run", ShippedConfig("fig5_box"), "--out", "first", "--set",
                                    "smoothing.margins.clearance_m=0.006"})
                .status,
            kSuccess);
  ASSERT_EQ(Halfstep(place.path(), {"run", "first/config.yaml", "--out", "second"}).status,
            kSuccess);
  for (const std::string file : {"config.yaml", "dichotomy/trajectory.csv"}) {
    EXPECT_TRUE(ReadText(place / "first" / file) == ReadText(place / "second" / file)) << file;
  }
}

TEST(RunCommand, JsonIsOneValidObject) {
  const TemporaryFolder place;
  const Outcome outcome =
      Halfstep(place.path(), {"run", ShippedConfig("fig3_two_half_steps"), "--json"});
  EXPECT_EQ(outcome.status, kSuccess);
  EXPECT_EQ(outcome.err, "");
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(fs::exists(fs::path(json["folder"].get<std::string>()) / "manifest.json"));
  ASSERT_EQ(json["methods"].size(), 3u);
  EXPECT_EQ(json["methods"][0]["method"], "raw");
  EXPECT_EQ(json["methods"][1]["status"], "converged");
  EXPECT_GT(json["methods"][1]["speedup"].get<double>(), 1.0);
}

TEST(RunCommand, JsonIsValidWhenMarginsAreInfinite) {
  const TemporaryFolder place;
  const Outcome outcome = Halfstep(place.path(), {"run", ShippedConfig("fig3_two_half_steps"),
                                                  "--json", "--set", "footsteps.0.x_m=5"});
  EXPECT_EQ(outcome.status, kFailed);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["methods"][0]["status"], "failed");
  EXPECT_EQ(json["methods"][1]["status"], "not_run");
}

TEST(RunCommand, QuietPrintsNothing) {
  const TemporaryFolder place;
  const Outcome outcome =
      Halfstep(place.path(), {"run", ShippedConfig("fig3_two_half_steps"), "--quiet"});
  EXPECT_EQ(outcome.status, kSuccess);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST(RunCommand, RefusesAnExistingFolder) {
  const TemporaryFolder place;
  const std::vector<std::string> run = {"run", ShippedConfig("fig3_two_half_steps"), "--out", "a"};
  ASSERT_EQ(Halfstep(place.path(), run).status, kSuccess);
  const std::string before = ReadText(place / "a/manifest.json");
  const Outcome outcome = Halfstep(place.path(), run);
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("a: is there already (--overwrite replaces it)"));
  EXPECT_EQ(ReadText(place / "a/manifest.json"), before);
  EXPECT_THAT(NamesIn(place.path()), testing::ElementsAre("a"));
  std::vector<std::string> again = run;
  again.push_back("--overwrite");
  EXPECT_EQ(Halfstep(place.path(), again).status, kSuccess);
  CheckRunIsWhole(place / "a", {"dichotomy", "dichotomy_published"});
}

// A row of the program that nothing moves gets no price, and what a proof could not decide is no
// violation: the walk of the tutorial's chapter 4.
TEST(RunCommand, NoPriceIsMoreThanTheWalkAndUndecidedReadsSo) {
  const TemporaryFolder place;
  WriteText(place / "cable.yaml",
            "obstacles:\n  - name: cable\n    cylinder: {radius_m: 0.01, length_m: 2.0}\n"
            "    pose: {xyz: [0.137, 0, 0.07], rpy_deg: [90, 0, 0]}\n");
  WriteText(place / "over.yaml",
            "robot: hrp2\nscene: cable.yaml\n"
            "start: {left: {x_m: 0, y_m: 0.085}, right: {x_m: 0, y_m: -0.085}}\n"
            "footsteps:\n  - {foot: right, x_m: 0.274, y_m: -0.085}\n"
            "  - {foot: left, x_m: 0.274, y_m: 0.085}\nhalf_step: {foot_delay: 0.19}\n"
            "smoothing: {methods: [halfstep/sqp],\n"
            "            optimizer: {heights: true, durations: true, rounds: 4}}\n");
  const Outcome outcome = Halfstep(place.path(), {"run", "over.yaml", "--out", "run"});
  ASSERT_EQ(outcome.status, kSuccess) << outcome.err;
  const ParsedCsv overlaps(ReadText(place / "run/halfstep_sqp/overlaps.csv"));
  const ParsedCsv summary(ReadText(place / "run/summary.csv"));
  int determined = 0, undecided = 0;
  for (size_t row = 0; row < overlaps.size(); ++row) {
    const bool open =
        overlaps.Text(row, "limited_by").find("could not be decided") < std::string::npos;
    undecided += open;
    if (overlaps.Text(row, "multiplier_s").empty()) continue;
    ++determined;
    EXPECT_LE(overlaps.Number(row, "multiplier_s"), summary.Number(1, "duration_s")) << outcome.out;
  }
  EXPECT_GE(determined, 1) << outcome.out;
  EXPECT_THAT(outcome.out, Not(testing::ContainsRegex("e\\+[0-9]+ s")));
  if (undecided > 0) {
    EXPECT_THAT(outcome.out, HasSubstr(", undecided"));
  }
}

TEST(RunCommand, FootstepOnANoStepAreaWritesNothing) {
  const TemporaryFolder place;
  const std::string scene = WriteText(
      place / "scene.yaml",
      "no_step: [{name: hole, polygon_m: [[0.25, -0.2], [0.5, -0.2], [0.5, 0], [0.25, 0]]}]");
  fs::create_directory(place / "here");
  const auto run = [&](const std::string& key) {
    return Halfstep(place / "here", {"run", ShippedConfig("fig3_two_half_steps"), "--set",
                                     "scene=" + scene, "--set", key});
  };
  const Outcome outcome = run("seed=1");
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "halfstep: the plan is not feasible: footstep 1 is on a no-step area\n");
  EXPECT_THAT(NamesIn(place / "here"), IsEmpty());
  // What touches reaches 12.1 cm ahead of the centre, 1.24 cm more than the rectangle that carries.
  EXPECT_EQ(run("footsteps.0.x_m=0.135").status, kFailed);
  EXPECT_EQ(run("footsteps.0.x_m=0.128").status, kSuccess);
}

TEST(RunCommand, SaysWhenTheScreenIsFull) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  if (full < 0) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder place;
  const Outcome outcome = Child({"run", ShippedConfig("fig3_two_half_steps"), "--json"},
                                {.working_directory = place.path(), .standard_output = full})
                              .Wait();
  close(full);
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_EQ(outcome.err, "halfstep: standard output cannot be written\n");
}

TEST(ListCommand, NamesWhatThereIs) {
  const TemporaryFolder place;
  for (const auto& [what, name] :
       std::vector<std::pair<std::string, std::string>>{{"robots", "hrp2"},
                                                        {"scenes", "bar_8cm"},
                                                        {"configs", "bar_8cm"},
                                                        {"methods", "dichotomy/published"}}) {
    EXPECT_THAT(Halfstep(place.path(), {"list", what}).out, HasSubstr(name + "  "));
    const auto json = nlohmann::json::parse(Halfstep(place.path(), {"list", what, "--json"}).out);
    EXPECT_TRUE(std::any_of(json.begin(), json.end(),
                            [&](const auto& entry) { return entry["name"] == name; }));
  }
  EXPECT_EQ(Halfstep(place.path(), {"list", "solvers", "--json"}).status, kSuccess);
  EXPECT_EQ(Halfstep(place.path(), {"--version"}).status, kSuccess);
  EXPECT_THAT(Halfstep(place.path(), {"run", "--help"}).out, HasSubstr("example: halfstep run"));
}

}  // namespace
}  // namespace halfstep
