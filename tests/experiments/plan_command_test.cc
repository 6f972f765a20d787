#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "experiments/config/random_scenes.h"
#include "experiments/run/planning.h"
#include "planner/scene/scene.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

// Two half-steps on coarse cells: baked in a moment.
std::string ConfigText(const std::string& scene, const std::string& more) {
  return "robot: hrp2\nscene: " + scene +
         "\n"
         "step_set: {x_min_m: 0, x_max_m: 0.2, y_min_m: -0.21, y_max_m: -0.21,\n"
         "             spacing_m: 0.2, yaws_rad: [0]}\n"
         "swept_volumes: {cell_m: 0.05, displacement_m: 0.05, cache: cache}\n"
         "planner: {unimproved_nodes: 0, max_nodes: 2000}\n"
         "smoothing: {methods: []}\n" +
         more;
}

constexpr const char* kGoal = "goal: {x_m: 0.6, y_m: 0.1, radius_m: 0.05}\n";

TEST(PlanCommand, PrintsFootstepsThatCanReplaceTheGoal) {
  const TemporaryFolder place;
  const std::string config = WriteText(place / "walk.yaml", ConfigText("none", kGoal));
  const Outcome planned = Halfstep(place.path(), {"plan", config});
  ASSERT_EQ(planned.status, kSuccess) << planned.err;
  EXPECT_THAT(planned.out, HasSubstr("footsteps:\n"));
  const std::string given = WriteText(place / "given.yaml", ConfigText("none", planned.out));
  const Outcome again = Halfstep(place.path(), {"plan", config});
  EXPECT_EQ(again.out.substr(again.out.find("footsteps:")),
            planned.out.substr(planned.out.find("footsteps:")));
  const Outcome run = Halfstep(place.path(), {"run", given, "--quiet"});
  EXPECT_EQ(run.status, kSuccess) << run.err;
}

TEST(PlanCommand, ARobotThatCannotStepIsToldWhatAStepInPlaceMisses) {
  const TemporaryFolder place;
  const std::string config = WriteText(place / "walk.yaml", ConfigText("none", kGoal));
  const Outcome outcome =
      Halfstep(place.path(), {"plan", config, "--set", "smoothing.margins.self_clearance_m=0.1"});
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("step_set: no place of the grid keeps the demanded margins"));
  EXPECT_THAT(outcome.err, HasSubstr("; a step in place is not feasible either, worst first:\n  "
                                     "footstep 1 (left), half-step "));
  EXPECT_THAT(outcome.err, HasSubstr("; 0.1 m demanded"));
  EXPECT_THAT(outcome.err, HasSubstr("what may help with self_clearance: "));
}

TEST(PlanCommand, AStartBlockedByAMeshWithItsFloorIsToldHowToSayIt) {
  const TemporaryFolder place;
  WriteText(place / "room.obj",
            "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nv 2 -2 2\nv 2 2 2\n"
            "f 1 2 3\nf 1 3 4\nf 2 3 6\nf 2 6 5\n");
  const std::string mesh = "obstacles: [{name: room, mesh: {file: room.obj";
  WriteText(place / "scene.yaml", mesh + "}}]\n");
  const std::string config = WriteText(place / "walk.yaml", ConfigText("scene.yaml", kGoal));
  const Outcome blocked = Halfstep(place.path(), {"plan", config});
  EXPECT_EQ(blocked.status, kFailed);
  EXPECT_THAT(blocked.err, HasSubstr("neither foot can leave the floor at the start; a step in "
                                     "place is not feasible either, worst first:\n"));
  EXPECT_THAT(blocked.err, HasSubstr(" inside room; "));
  EXPECT_THAT(blocked.err, HasSubstr("room has 16 m² of floor at z = 0"));
  EXPECT_THAT(blocked.err, HasSubstr("say `floor: in_mesh` in its `mesh`"));
  WriteText(place / "scene.yaml", mesh + ", floor: in_mesh}}]\n");
  const Outcome run = Halfstep(place.path(), {"run", config, "--quiet", "--out", "run"});
  EXPECT_EQ(run.status, kSuccess) << run.err;
  EXPECT_THAT(run.err, HasSubstr("obstacle room: floor: in_mesh: 2 of 4 triangles"));
  const auto manifest = nlohmann::json::parse(ReadText(place / "run/manifest.json"));
  ASSERT_EQ(manifest["scene_warnings"].size(), 1u);
  EXPECT_EQ(Halfstep(place.path(), {"verify", "run"}).status, kSuccess);
}

TEST(PlanCommand, RunPlansAndItsConfigRunsAgain) {
  const TemporaryFolder place;
  const std::string config = WriteText(place / "walk.yaml", ConfigText("none", kGoal));
  const Outcome first = Halfstep(place.path(), {"run", config, "--quiet", "--out", "first"});
  ASSERT_EQ(first.status, kSuccess) << first.err;
  const auto plan = nlohmann::json::parse(ReadText(place / "first/plan.json"));
  EXPECT_EQ(plan.at("status"), "solved");
  EXPECT_EQ(plan.at("half_steps"), 2);
  EXPECT_GE(plan.at("footsteps"), 3);
  EXPECT_EQ(plan.at("elements").size(), plan.at("footsteps"));
  ASSERT_EQ(plan.at("places").size(), plan.at("footsteps"));
  EXPECT_NEAR(plan.at("places").back().at("x_m").get<double>(), 0.6, 0.05);
  EXPECT_FALSE(plan.at("places").back().contains("z_m"));
  const Outcome second = Halfstep(
      place.path(), {"run", (place / "first/config.yaml").string(), "--quiet", "--out", "second"});
  ASSERT_EQ(second.status, kSuccess) << second.err;
  for (const char* file : {"footsteps.csv", "raw/trajectory.csv", "raw/certificate.csv"}) {
    EXPECT_EQ(ReadText(place / "first" / file), ReadText(place / "second" / file)) << file;
  }
  EXPECT_FALSE(fs::exists(place / "second/plan.json"));
  EXPECT_EQ(Halfstep(place.path(), {"certify", "first", "--quiet"}).status, kSuccess);
}

// Under a roof, where the ground alone would have every sole.
TEST(PlanCommand, TellsHeightsOnLevels) {
  const TemporaryFolder place;
  WriteText(
      place / "scene.yaml",
      "surfaces:\n"
      "  - {name: step, polygon_m: [[0.14, -1], [2, -1], [2, 1], [0.14, 1]], height_m: 0.05}\n"
      "  - {name: roof, polygon_m: [[-2, -2], [3, -2], [3, 2], [-2, 2]], height_m: 2.5,\n"
      "     thickness_m: 0.1}\n");
  const std::string begin =
      "robot: hrp2\nscene: scene.yaml\nsmoothing: {methods: []}\n"
      "planner: {name: astar, unimproved_nodes: 0}\nstep_set: {yaws_rad: [0]}\n"
      "start: {left: {x_m: -0.05, y_m: 0.085, level: floor},\n"
      "        right: {x_m: -0.05, y_m: -0.085, level: floor}}\n";
  const std::string config = WriteText(
      place / "walk.yaml", begin + "goal: {x_m: 0.4, y_m: 0, radius_m: 0.13, level: step}\n");
  const Outcome planned = Halfstep(place.path(), {"plan", config});
  ASSERT_EQ(planned.status, kSuccess) << planned.err;
  EXPECT_THAT(planned.out, HasSubstr("    z_m: 0.05\n"));
  const std::string given = WriteText(place / "given.yaml", begin + planned.out);
  const Outcome run = Halfstep(place.path(), {"run", given, "--quiet", "--out", "run"});
  EXPECT_EQ(run.status, kSuccess) << run.err;
  const Outcome told = Halfstep(place.path(), {"plan", config, "--json"});
  EXPECT_EQ(nlohmann::json::parse(told.out).at("places").back().at("z_m"), 0.05);
}

TEST(PlanCommand, SaysWhyThereIsNoPlanAndWritesNothing) {
  const TemporaryFolder place;
  const std::string config = WriteText(
      place / "walk.yaml", ConfigText("none", "goal: {x_m: -3, y_m: 0, radius_m: 0.05}\n"));
  const Outcome run = Halfstep(place.path(), {"run", config, "--out", "run"});
  EXPECT_EQ(run.status, kFailed);
  EXPECT_THAT(run.err, HasSubstr("no walk: all that the half-steps reach"));
  EXPECT_FALSE(fs::exists(place / "run"));
  const Outcome standing = Halfstep(place.path(), {"run", config, "--out", "run", "--set",
                                                   "goal.x_m=0", "--set", "goal.y_m=0.1"});
  EXPECT_EQ(standing.status, kFailed);
  EXPECT_THAT(standing.err, HasSubstr("no walk: the start is in the goal: nothing to plan"));
}

TEST(PlanCommand, BakesOnceAndListsTheHalfSteps) {
  const TemporaryFolder place;
  const std::string config = WriteText(place / "walk.yaml", ConfigText("none", kGoal));
  const Outcome first = Halfstep(place.path(), {"bake", config, "--json"});
  ASSERT_EQ(first.status, kSuccess) << first.err;
  EXPECT_EQ(nlohmann::json::parse(first.out).at("baked"), true);
  const Outcome second = Halfstep(place.path(), {"bake", config, "--json"});
  EXPECT_EQ(nlohmann::json::parse(second.out).at("baked"), false);
  EXPECT_EQ(nlohmann::json::parse(second.out).at("half_steps"), 2);
  const Outcome list = Halfstep(place.path(), {"list", "half-steps", config});
  EXPECT_EQ(list.out, "half_step,x_m,y_m,yaw_rad\n1,0,-0.21,0\n2,0.2,-0.21,0\n");
}

TEST(PlanCommand, ABakeThatKeepsNothingFails) {
  const TemporaryFolder place;
  const std::string config = WriteText(place / "walk.yaml", ConfigText("none", kGoal));
  WriteText(place / "file", "");
  const std::vector<std::string> bake = {"bake", config, "--set", "swept_volumes.cache=file/below"};
  const Outcome outcome = Halfstep(place.path(), bake);
  EXPECT_EQ(outcome.status, kFailed);
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("file/below"), HasSubstr("Not a directory")));
  std::vector<std::string> plan = bake;
  plan[0] = "plan";  // to keep volumes is not its purpose
  EXPECT_EQ(Halfstep(place.path(), plan).status, kSuccess);
}

TEST(PlanCommand, WithoutAHomeNothingIsKeptInTheWorkingDirectory) {
  const TemporaryFolder place;
  std::string text = ConfigText("none", kGoal);
  text.replace(text.find(", cache: cache"), 14, "");
  const std::string config = WriteText(place / "walk.yaml", text);
  for (const std::string home : {"", "relative"}) {
    for (const std::string command : {"bake", "plan"}) {
      const Outcome outcome = Child({command, config, "--quiet"},
                                    {.working_directory = place.path(),
                                     .environment = {{"HOME", home}, {"XDG_CACHE_HOME", "cache"}}})
                                  .Wait();
      EXPECT_EQ(outcome.status, command == "bake" ? kFailed : kSuccess);
      EXPECT_THAT(outcome.err, HasSubstr("neither XDG_CACHE_HOME nor HOME"));
      EXPECT_THAT(NamesIn(place.path()), testing::ElementsAre("walk.yaml"));
    }
  }
}

TEST(PlanCommand, AnEndlessCacheFileIsRefusedByItsSize) {
  const TemporaryFolder place;
  const std::string config = WriteText(place / "walk.yaml", ConfigText("none", kGoal));
  const Outcome first = Halfstep(place.path(), {"bake", config, "--json"});
  ASSERT_EQ(first.status, kSuccess) << first.err;
  const std::string file = nlohmann::json::parse(first.out).at("file");
  fs::resize_file(file, std::uintmax_t{1} << 40);
  const Outcome second = Halfstep(place.path(), {"bake", config, "--json"});
  EXPECT_EQ(second.status, kSuccess);
  EXPECT_THAT(second.err, HasSubstr("refused: too large: 1099511627776 bytes"));
  EXPECT_EQ(nlohmann::json::parse(second.out).at("baked"), true);
}

TEST(PlanCommand, RefusesAPlanWithoutAGoal) {
  const TemporaryFolder place;
  const Outcome outcome = Halfstep(place.path(), {"plan", ShippedConfig("bar_5cm")});
  EXPECT_EQ(outcome.status, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("goal: is missing"));
}

TEST(DrawCommand, DrawsTheSameSceneFromTheSameSeed) {
  const TemporaryFolder place;
  for (const std::string& name : RandomSceneNames()) {
    const Outcome drawn = Halfstep(place.path(), {"draw", name, "--count", "30", "--seed", "5"});
    EXPECT_EQ(drawn.status, kSuccess);
    EXPECT_EQ(drawn.out, DrawScene(name, 30, 5));
    EXPECT_NE(drawn.out, DrawScene(name, 30, 6));
    const Scene scene = LoadScene(WriteText(place / (name + ".yaml"), drawn.out));
    const size_t levels = scene.ground->Solids().size();
    EXPECT_EQ(scene.obstacles.size(), name == "blocks" ? 0u : 30u);
    EXPECT_EQ(levels > 20 && levels < 30, name == "blocks");  // some are of no height
    EXPECT_TRUE(LoadScene(WriteText(place / "none.yaml", DrawScene(name, 0, 5))).obstacles.empty());
  }
}

TEST(DrawCommand, TheShippedScenesAreThoseThatTheirFirstLineSays) {
  const fs::path scenes = InSources("experiments/scenes");
  EXPECT_EQ(ReadText(scenes / "cylinders.yaml"), DrawScene("cylinders", 40, 1));
  EXPECT_EQ(ReadText(scenes / "random_room.yaml"), DrawScene("random_room", 14, 1));
}

}  // namespace
}  // namespace halfstep
