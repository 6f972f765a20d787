#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/commands/commands.h"
#include "tests/experiments/child_process.h"
#include "tests/experiments/run_check.h"
#include "tests/temporary_folder.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::Not;

// A cart across the way that stays until `leaves` [s], and is gone a second later.
std::string WaitingCart(double leaves) {
  const std::string time = std::to_string(leaves), gone = std::to_string(leaves + 1.0);
  return "obstacles:\n"
         "  - name: cart\n"
         "    box: {size_m: [0.3, 2.0, 0.8]}\n"
         "    pose: {xyz: [0.6, 0, 0.4]}\n"
         "    motion: {error_m: 0.01, waypoints: [{t_s: " +
         time + ", xyz: [0.6, 0, 0.4]}, {t_s: " + gone + ", xyz: [0.6, 4, 0.4]}]}\n";
}

// Two half-steps on coarse cells: baked in a moment.
std::string ConfigText(const std::string& more = "") {
  return "robot: hrp2\nscene: scene.yaml\n"
         "goal: {x_m: 1.2, y_m: 0.1, radius_m: 0.05}\n"
         "step_set: {x_min_m: 0, x_max_m: 0.2, y_min_m: -0.21, y_max_m: -0.21,\n"
         "             spacing_m: 0.2, yaws_rad: [0]}\n"
         "swept_volumes: {cell_m: 0.05, displacement_m: 0.05, cache: cache}\n"
         "planner: {name: astar, unimproved_nodes: 0, max_nodes: 2000" +
         more + "}\nsmoothing: {methods: [dichotomy]}\n";
}

TEST(PlanInTime, BehindACartThatIsGoneCertifiedVerifiedAndNotWhenItStaysLonger) {
  const TemporaryFolder place;
  WriteText(place / "scene.yaml", WaitingCart(12.0));
  WriteText(place / "later.yaml", WaitingCart(16.0));
  const std::string config = WriteText(place / "walk.yaml", ConfigText());
  const Outcome everywhere =
      Halfstep(place.path(), {"plan", config, "--set", "planner.moving=everywhere"});
  EXPECT_EQ(everywhere.status, kFailed) << everywhere.out;
  const Outcome run = Halfstep(place.path(), {"run", config, "--quiet", "--out", "run"});
  ASSERT_EQ(run.status, kSuccess) << run.err;
  const auto plan = nlohmann::json::parse(ReadText(place / "run/plan.json"));
  double rests = 0.0;
  for (const auto& footstep : plan.at("places")) {
    rests += footstep.at("rest_s").get<double>() + footstep.at("rest_on_one_foot_s").get<double>();
  }
  EXPECT_GT(rests, 0.0);
  EXPECT_THAT(plan.at("message").get<std::string>(), HasSubstr(", at rest for "));
  EXPECT_THAT(ReadText(place / "run/footsteps.csv"), HasSubstr(",rest_s,rest_on_one_foot_s\n"));
  const Outcome verified = Halfstep(place.path(), {"verify", "run"});
  EXPECT_EQ(verified.status, kSuccess) << verified.out << verified.err;
  // The config of the run has the rests, and so has its table of footsteps.
  const std::string again = (place / "run/config.yaml").string();
  ASSERT_EQ(Halfstep(place.path(), {"run", again, "--quiet", "--out", "again"}).status, kSuccess);
  for (const char* file : {"footsteps.csv", "raw/trajectory.csv", "dichotomy/trajectory.csv"}) {
    EXPECT_EQ(ReadText(place / "run" / file), ReadText(place / "again" / file)) << file;
  }
  // Control: what was planned behind the cart meets one that stays four seconds longer.
  const Outcome late = Halfstep(
      place.path(), {"run", again, "--quiet", "--out", "late", "--set", "scene=../later.yaml"});
  EXPECT_EQ(late.status, kFailed);
  EXPECT_THAT(late.err + late.out, HasSubstr("cart"));
}

TEST(PlanInTime, TheDefaultPlannerKnowsTimeUnlessItsCostIsAnEstimate) {
  const TemporaryFolder place;
  WriteText(place / "scene.yaml", WaitingCart(12.0));
  const std::string config = WriteText(place / "walk.yaml", ConfigText());
  const auto plan = [&](const std::string& set) {
    const Outcome outcome =
        Halfstep(place.path(), {"plan", config, "--json", "--set", "planner.name=best", "--set",
                                "planner.unimproved_nodes=none", "--set",
                                "planner.improving_effort=0.1", "--set", set});
    return nlohmann::json::parse(outcome.out);
  };
  const auto best = plan("seed=1");
  EXPECT_EQ(best.at("status"), "solved");
  EXPECT_EQ(best.at("cost_kind"), "raw_duration");
  EXPECT_THAT(best.at("message").get<std::string>(), HasSubstr(", at rest for "));
  const auto earliest = nlohmann::json::parse(
      Halfstep(place.path(), {"plan", config, "--json", "--set", "planner.unimproved_nodes=500",
                              "--set", "planner.cost=raw_duration"})
          .out);
  EXPECT_EQ(best.at("cost"), earliest.at("cost"));  // of `astar`
  const auto everywhere = plan("planner.cost=smoothed_duration");
  EXPECT_EQ(everywhere.at("status"), "no_plan");
}

TEST(PlanInTime, WithoutAnythingThatMovesTablesAndPlansHaveNoRests) {
  const TemporaryFolder place;
  WriteText(place / "scene.yaml", "obstacles: []\n");
  const std::string config = WriteText(place / "walk.yaml", ConfigText());
  ASSERT_EQ(Halfstep(place.path(), {"run", config, "--quiet", "--out", "run"}).status, kSuccess);
  for (const char* file : {"plan.json", "config.yaml", "footsteps.csv"}) {
    EXPECT_THAT(ReadText(place / "run" / file), Not(HasSubstr("rest_"))) << file;
  }
}

TEST(PlanInTime, SaysWhatCannotPlanInTime) {
  const TemporaryFolder place;
  WriteText(place / "scene.yaml", WaitingCart(12.0));
  const std::string config = WriteText(place / "walk.yaml", ConfigText(", moving: in_time"));
  const auto refusal = [&](const std::string& set) {
    const Outcome outcome = Halfstep(place.path(), {"plan", config, "--set", set});
    EXPECT_EQ(outcome.status, kBadInput) << set;
    return outcome.err;
  };
  EXPECT_THAT(refusal("planner.name=bounding_box"),
              HasSubstr("planner.moving: 'bounding_box' does not know when obstacles are where "
                        "(valid: everywhere, or `planner.name: best`)"));
  EXPECT_THAT(refusal("planner.cost=smoothed_duration"), HasSubstr("planner.cost: "));
  WriteText(place / "first.yaml",
            "robot: hrp2\nscene: none\nfootsteps: [{foot: left, x_m: 0.2, y_m: 0.1, rest_s: 1}]\n");
  const Outcome first = Halfstep(place.path(), {"run", "first.yaml"});
  EXPECT_EQ(first.status, kBadInput);
  EXPECT_THAT(first.err, HasSubstr("rest_s: of the first footstep, with which the walk begins"));
}

}  // namespace
}  // namespace halfstep
