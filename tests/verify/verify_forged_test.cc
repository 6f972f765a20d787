// One wrong thing and one expected reason for what verify checks of a run's other files: manifest,
// summary, footsteps, the places of robot and scene. Hashes follow, except where they are what is
// wrong.

#include <gmock/gmock.h>

#include <algorithm>

#include "experiments/verify/verify_run.h"
#include "tests/verify/verify_mutation.h"

namespace halfstep {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;
using Forge = std::function<void(TamperedRun&)>;

struct Forgery {
  std::string name;
  Forge before;  ///< the hashes follow
  Forge after;   ///< they do not
  std::string reason;
};
void PrintTo(const Forgery& forgery, std::ostream* out) { *out << forgery.name; }

const std::string kNoHash(64, '0');

Forge InManifest(std::function<void(Json&)> edit) {
  return [edit](TamperedRun& run) { run.EditManifest(edit); };
}
Forge InCertificate(std::function<void(Json&)> edit) {
  return [edit](TamperedRun& run) { run.EditJson(edit); };
}
// Another value in a column of a table, in its last row.
Forge InTable(const std::string& file, const std::string& column, const std::string& value) {
  return [=](TamperedRun& run) {
    TamperedRun::EditCsv(run.run() / file, [&](TamperedRun::Table& table) {
      const auto& header = table.front();
      const auto at = std::find(header.begin(), header.end(), column) - header.begin();
      table.back().at(static_cast<size_t>(at)) = value;
    });
  };
}
std::vector<Forgery> OfTheManifest() {
  std::vector<Forgery> all = {
      {"LengthOfARobotFile",
       {},
       InManifest([](Json& j) { j["inputs"]["robot"][0]["bytes"] = 1; }),
       "robot: not the one that manifest.json is about: 'hrp2.yaml' has changed"},
      {"NameOfARobotFile",
       {},
       InManifest([](Json& j) { j["inputs"]["robot"][0]["name"] = "other.yaml"; }),
       "'hrp2.yaml' was 'other.yaml'"},
      {"HashOfTheRobot",
       {},
       InManifest([](Json& j) { j["robot_sha256"] = kNoHash; }),
       "robot: not the one that manifest.json is about"},
      {"HashOfTheCertificatesScene",
       {},
       InCertificate([](Json& j) { j["sha256"]["scene"] = kNoHash; }),
       "scene: not the one that the certificate is about"},
      {"HashOfTheCertificatesTrajectory",
       {},
       InCertificate([](Json& j) { j["sha256"]["trajectory.csv"] = kNoHash; }),
       "trajectory.csv: not the one that the certificate is about"},
      {"AnotherSceneInTheConfig",
       [](TamperedRun& run) {
         std::filesystem::copy(run.scene(), run.scene().parent_path() / "other.yaml");
         TamperedRun::Replace(run.run() / "config.yaml", "scene/box.yaml", "scene/other.yaml");
       },
       {},
       "scene: not the one that the certificate is about"},
      {"NoSuchRobotInTheConfig",
       [](TamperedRun& run) {
         TamperedRun::Replace(run.run() / "config.yaml", "robot/hrp2.yaml", "robot/hrp.yaml");
       },
       {},
       "config.yaml names the robot 'inputs/robot/hrp.yaml', which is not the one"},
      {"NoSceneInTheCertificate",
       InCertificate([](Json& j) { j["scene"] = "none"; }),
       {},
       "the certificate is about the scene 'none'"},
      {"MethodMore",
       InManifest([](Json& j) { j["methods"].push_back(j["methods"].back()); }),
       {},
       "the methods of manifest.json are not raw and those of config.yaml"},
      {"DurationOfTheMethod",
       InManifest([](Json& j) { j["methods"][1]["duration_s"] = 1.5; }),
       {},
       "duration: manifest.json has 1.5 s"},
      {"HashOfAFile",
       {},
       InManifest([](Json& j) { j["files"]["footsteps.csv"]["sha256"] = kNoHash; }),
       "footsteps.csv: not the one that manifest.json lists"},
      {"FileNotListed",
       InManifest([](Json& j) { j["files"].erase("footsteps.csv"); }),
       {},
       "manifest.json does not list footsteps.csv"},
      {"OverlapsNotListed",
       InManifest([](Json& j) { j["files"].erase("dichotomy/overlaps.csv"); }),
       {},
       "manifest.json does not list dichotomy/overlaps.csv"},
      {"FileThatIsNotThere",
       InManifest([](Json& j) { j["files"]["dichotomy/more.csv"] = j["files"]["footsteps.csv"]; }),
       {},
       "manifest.json lists 'dichotomy/more.csv', which is not there"},
  };
  for (const auto& [member, value] :
       std::vector<std::pair<std::string, Json>>{{"config_sha256", kNoHash},
                                                 {"name", "other"},
                                                 {"seed", 77},
                                                 {"objective", "other"},
                                                 {"half_steps", 4},
                                                 {"robot", "other"},
                                                 {"scene", "other"}}) {
    all.push_back({"Member_" + member,
                   {},
                   InManifest([member = member, value = value](Json& j) { j[member] = value; }),
                   member + ": manifest.json disagrees with config.yaml"});
  }
  return all;
}

std::vector<Forgery> OfTables() {
  const auto summary = [](const std::string& column, const std::string& value) {
    return InTable("summary.csv", column, value);
  };
  const std::string of = "summary.csv: dichotomy: ";
  return {
      {"SummaryOfAnotherMethod",
       summary("method", "iterative"),
       {},
       "summary.csv: its methods are not those of manifest.json"},
      {"SummaryStatus", summary("status", "stopped"), {}, of + "status is not"},
      {"SummaryCertified", summary("certified", "false"), {}, of + "certified is not"},
      {"SummaryDuration", summary("duration_s", "1.5"), {}, of + "duration_s is 1.5"},
      {"SummarySpeedup", summary("speedup", "3.5"), {}, of + "speedup is not"},
      {"SummaryCost", summary("cost", "1.5"), {}, of + "cost is not the duration"},
      {"SummaryIterations", summary("iterations", "77"), {}, of + "iterations is 77"},
      {"SummaryGapWithoutReference",
       summary("gap_to_reference", "0.5"),
       {},
       of + "gap_to_reference is not"},
      {"FootstepElsewhere",
       InTable("footsteps.csv", "x_m", "0.28"),
       {},
       "footsteps.csv:4: not the footstep of config.yaml"},
      {"FootstepOfTheOtherFoot",
       InTable("footsteps.csv", "foot", "left"),
       {},
       "footsteps.csv:4: not the footstep of config.yaml"},
      {"FootstepHeight",
       InTable("footsteps.csv", "via_height_m", "0.2"),
       {},
       "footsteps.csv:4: not the footstep of config.yaml"},
      {"FootstepDuration",
       InTable("footsteps.csv", "duration_s", "1.5"),
       {},
       "footsteps.csv:4: not the footstep of config.yaml"},
      {"JointLimitsTightened",
       [](TamperedRun& run) {
         for (const std::string side : {"L", "R"}) {
           TamperedRun::Replace(run.urdf().parent_path() / "hrp2.yaml",
                                side + "LEG_JOINT3: [2, 150]", side + "LEG_JOINT3: [2, 60]");
         }
       },
       {},
       "joint limits: "},
      {"MarginColumn",
       InTable("dichotomy/trajectory.csv", "clearance_m", "0.2"),
       {},
       "clearance_m is 0.2"},
      {"HalfStepStart",
       InTable("dichotomy/half_steps.csv", "start_s", "1.5"),
       {},
       "half_steps.csv:3: start 1.5"},
  };
}

std::vector<Forgery> Forgeries() {
  std::vector<Forgery> all = OfTheManifest();
  const std::vector<Forgery> tables = OfTables();
  all.insert(all.end(), tables.begin(), tables.end());
  return all;
}

class Forged : public testing::TestWithParam<Forgery> {};

TEST_P(Forged, IsRefusedForThisReason) {
  TamperedRun run;
  if (GetParam().before) GetParam().before(run);
  run.Rehash();
  if (GetParam().after) GetParam().after(run);
  const auto results = VerifyProved({.run = run.run().string(), .method = "dichotomy"});
  EXPECT_FALSE(results.front().verified);
  EXPECT_THAT(results.front().reasons, Contains(HasSubstr(GetParam().reason)))
      << verify::Describe(results.front());
}

INSTANTIATE_TEST_SUITE_P(Verify, Forged, testing::ValuesIn(Forgeries()),
                         [](const auto& info) { return info.param.name; });

// A joint program keeps the branches that are demanded, and loses one when none are; a config that
// was changed to demand them is refused for that branch.
TEST(StopBranches, AreCheckedWhenTheConfigDemandsThem) {
  for (const char* demanded : {"all", "none"}) {
    SCOPED_TRACE(demanded);
    TamperedRun run(
        {.overrides = {"smoothing.methods=[halfstep/sqp]", "smoothing.profile=limit",
                       "smoothing.optimizer.heights=true", "smoothing.optimizer.durations=true",
                       "smoothing.optimizer.effort=1",
                       std::string("smoothing.stop_branches=") + demanded}});
    const auto verify = [&] { return VerifiedHere({.run = run.run().string()}); };
    Outcome outcome = verify();
    EXPECT_EQ(outcome.status, 0);
    if (demanded == std::string("all")) {
      EXPECT_THAT(outcome.out, HasSubstr("stop branches keep every margin to their end: 1"));
      TamperedRun::Replace(run.run() / "config.yaml", "stop_branches: all",
                           "stop_branches: \"none\"");
      run.Rehash();
      outcome = verify();
      EXPECT_EQ(outcome.status, 3);
      EXPECT_THAT(outcome.out, HasSubstr("smoothing.stop_branches: config.yaml has none, but by "
                                         "manifest.json's acceptance it was all"));
      continue;
    }
    EXPECT_THAT(outcome.out, testing::Not(HasSubstr("stop branches")));
    TamperedRun::Replace(run.run() / "config.yaml", "stop_branches: \"none\"",
                         "stop_branches: all");
    run.Rehash();
    outcome = verify();
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.out, HasSubstr(", stopped after half-step 1 at t = "));
    EXPECT_THAT(outcome.out, HasSubstr("smoothing.stop_branches: config.yaml has all, but by "
                                       "manifest.json's acceptance it was none"));
  }
}

}  // namespace
}  // namespace halfstep
