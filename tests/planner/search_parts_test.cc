// What searches for footsteps are made of: goals, endings, steps and what is near.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "planner/search/footstep_planner.h"
#include "planner/search/plan_search.h"
#include "planner/search/plan_shortcut.h"
#include "planner/search/state_buckets.h"
#include "planner/search/step_graph.h"
#include "tests/planner/flat_world.h"

namespace halfstep {
namespace {

TEST(GoalRegion, ContainsItsBorderAndTurnsWithItsFrame) {
  GoalRegion goal;
  goal.X_WG = {1.0, 2.0, 0.5};
  goal.radius = 0.25;
  EXPECT_TRUE(goal.Contains({1.25, 2.0, 3.0}));
  EXPECT_FALSE(goal.Contains({1.2501, 2.0, 3.0}));
  EXPECT_NEAR(goal.Distance({1.0, 3.0}), 0.75, 1e-15);
  goal.box = Eigen::Vector2d(1.0, 0.1);
  const Eigen::Vector2d corner = goal.X_WG * Eigen::Vector2d(0.4999, 0.0499);
  const Eigen::Vector2d outside = goal.X_WG * Eigen::Vector2d(0.0499, 0.4999);
  EXPECT_TRUE(goal.Contains({corner.x(), corner.y(), 0.0}));
  EXPECT_FALSE(goal.Contains({outside.x(), outside.y(), 0.0}));
  EXPECT_NEAR(goal.Distance(outside), 0.4499, 1e-12);
}

TEST(GoalRegion, ComparesYawsModuloATurn) {
  GoalRegion goal;
  goal.X_WG = {0.0, 0.0, 3.1};
  goal.yaw_tolerance = 0.2;
  EXPECT_TRUE(goal.Contains({0.0, 0.0, -3.1}));
  EXPECT_TRUE(goal.Contains({0.0, 0.0, 3.1 + 4.0 * std::numbers::pi}));
  EXPECT_FALSE(goal.Contains({0.0, 0.0, 2.8}));
  EXPECT_NEAR(goal.Turn(2.8), 0.1, 1e-12);
}

TEST(GoalRegion, AsksTheFootThatCounts) {
  GoalRegion goal;
  goal.X_WG = {0.0, 0.1, 0.0};
  goal.radius = 0.01;
  const std::array<Foothold, 2> feet = {Foothold::Level({0.0, 0.1, 0.0}),
                                        Foothold::Level({0.0, -0.1, 0.0})};
  const auto contains = [&](GoalPart part) {
    goal.part = part;
    return goal.ContainsStance(feet);
  };
  EXPECT_TRUE(contains(GoalPart::kLeftFoot));
  EXPECT_TRUE(contains(GoalPart::kEitherFoot));
  EXPECT_FALSE(contains(GoalPart::kRightFoot));
  EXPECT_FALSE(contains(GoalPart::kMidFeet));
  goal.X_WG.y = 0.0;
  EXPECT_TRUE(contains(GoalPart::kMidFeet));
}

TEST(Termination, TheFirstReasonCounts) {
  std::stop_source source;
  const Termination stop =
      AnyOf({AtFirstPlan(), AfterNodes(10), WhenNotImprovedFor(3), OnRequest(source.get_token())});
  EXPECT_EQ(stop({.nodes = 9}), StopReason::kGoOn);
  EXPECT_EQ(stop({.nodes = 10}), StopReason::kBudget);
  EXPECT_EQ(stop({.nodes = 10, .cost = 5.0}), StopReason::kEnough);
  const Termination improving = WhenNotImprovedFor(3);
  EXPECT_EQ(improving({.nodes = 9, .nodes_since_improvement = 9}), StopReason::kGoOn);
  EXPECT_EQ(improving({.nodes = 9, .cost = 5.0, .nodes_since_improvement = 3}),
            StopReason::kEnough);
  source.request_stop();
  EXPECT_EQ(stop({}), StopReason::kInterrupted);
}

// Nodes that never come, because every half-step is blocked, cost queries.
TEST(Termination, EffortCountsNodesQueriesAndSamples) {
  const Termination stop = AfterEffort(1.0);
  EXPECT_EQ(stop({.nodes = 60000, .queries = 90000}), StopReason::kGoOn);
  EXPECT_EQ(stop({.nodes = 60000, .queries = 100000}), StopReason::kBudget);
  EXPECT_EQ(stop({.queries = 1000000}), StopReason::kBudget);
  EXPECT_EQ(stop({.samples = 66667}), StopReason::kBudget);
}

// Where the first plan was hard to find, better ones are.
TEST(Termination, ImprovingTakesThreeTimesTheFirstPlan) {
  const Termination stop = WhenPlannedAfter(1.0);
  EXPECT_EQ(stop({.queries = 900000}), StopReason::kGoOn);
  EXPECT_EQ(stop({.queries = 900000, .cost = 5.0}), StopReason::kGoOn);
  EXPECT_EQ(stop({.queries = 2699999, .cost = 5.0}), StopReason::kGoOn);
  EXPECT_EQ(stop({.queries = 2700000, .cost = 5.0}), StopReason::kEnough);
  const Termination early = WhenPlannedAfter(1.0);
  EXPECT_EQ(early({.queries = 100000, .cost = 5.0}), StopReason::kGoOn);
  EXPECT_EQ(early({.queries = 1000000, .cost = 5.0}), StopReason::kEnough);
}

TEST(StepReach, NoSequenceOfElementsLeadsFarther) {
  const StepSet set = PlausibleSet();
  const std::vector<int> all = AllElements(set);
  const StepReach reach(set, all, StepCost{}.OfElements(set));
  std::mt19937_64 random(3);
  double nearest_to_bound = 0.0;
  for (int trial = 0; trial < 20000; ++trial) {
    Foothold X_WS;
    Side support = Side::kLeft;
    for (int n = 1; n <= 6; ++n) {
      X_WS = X_WS * set.Placement(Pick(set.size(), random), support);
      support = Opposite(support);
      const double distance = X_WS.Planar().position().norm();
      ASSERT_LE(distance, reach.Distance(n) + 1e-12);
      ASSERT_LE(reach.Steps(distance, std::fabs(X_WS.yaw)), n + 1e-9);
      nearest_to_bound = std::max(nearest_to_bound, distance / reach.Distance(n));
    }
  }
  EXPECT_GT(nearest_to_bound, 0.95);  // the bound says something
}

TEST(StateBuckets, FindTheNearestOfAll) {
  std::mt19937_64 random(5);
  const Eigen::AlignedBox2d area(Eigen::Vector2d(-1, -2), Eigen::Vector2d(3, 1));
  StateBuckets buckets(area);
  EXPECT_EQ(buckets.FindNearest({}, Side::kLeft, true), -1);
  std::vector<StepState> states;
  std::vector<bool> there;
  const auto pose = [&] {
    const double x = Uniform(-1, 3, random), y = Uniform(-2, 1, random);
    return Pose2{x, y, Uniform(-7, 7, random)};
  };
  for (int i = 0; i < 300; ++i) {
    states.push_back({Foothold::Level(pose()), Pick(2, random) == 0 ? Side::kLeft : Side::kRight});
    there.push_back(true);
    buckets.Insert(i, states.back());
  }
  for (int i = 0; i < 300; ++i) {
    const Pose2 wanted = pose();
    for (bool with_yaw : {false, true}) {
      int nearest = -1;
      for (int j = 0; j < 300; ++j) {
        const auto at = static_cast<size_t>(j);
        if (!there[at] || states[at].support != Side::kRight) continue;
        if (nearest < 0 || StateDistance(states[at].X_WS.Planar(), wanted, with_yaw) <
                               StateDistance(states[static_cast<size_t>(nearest)].X_WS.Planar(),
                                             wanted, with_yaw)) {
          nearest = j;
        }
      }
      ASSERT_EQ(buckets.FindNearest(wanted, Side::kRight, with_yaw), nearest);
    }
    if (i % 2 == 0) {
      there[static_cast<size_t>(i)] = false;
      buckets.Remove(i, states[static_cast<size_t>(i)]);
    }
  }
}

TEST(StepGraph, LandsAllElementsWhereItLandsEach) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, {});
  const PlanRequest request = RequestTo({2.0, 0.0, 0.0}, set, query);
  const StepGraph graph(request, AllElements(set));
  std::vector<Foothold> landings;
  for (Side support : {Side::kLeft, Side::kRight}) {
    const StepState from{{{0.3, -0.7, 1.234}, 0.15}, support};
    graph.Landings(from, &landings);
    ASSERT_EQ(landings.size(), set.placements.size());
    for (int k = 0; k < graph.size(); ++k) {
      EXPECT_EQ(landings[static_cast<size_t>(k)], graph.Landing(from, k));
    }
  }
}

// The first up half-step lifts the other foot from where it stands.
TEST(StepGraph, StartsFromBothFeetOfTheStance) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, {});
  PlanRequest request = RequestTo({2.0, 0.0, 0.0}, set, query);
  request.start = {Foothold::Level({0.03, 0.12, 0.1}), Foothold::Level({-0.04, -0.11, -0.2})};
  int asked = 0;
  request.start_is_free = [&](const HalfStep& up, const Foothold& X_WS) {
    ++asked;
    const Foothold &support = request.start[static_cast<size_t>(Index(up.support))],
                   &other = request.start[static_cast<size_t>(Index(up.swing()))];
    EXPECT_EQ(X_WS, support);
    const Foothold lifted = X_WS * up.X_SF;
    EXPECT_LT((lifted.Planar().position() - other.Planar().position()).norm(), 1e-12);
    EXPECT_NEAR(lifted.yaw, other.yaw, 1e-12);
    return up.support == Side::kRight;
  };
  const std::vector<StepState> starts = StepGraph(request, AllElements(set)).FreeStarts();
  EXPECT_EQ(asked, 2);
  ASSERT_EQ(starts.size(), 1u);
  EXPECT_EQ(starts.front().support, Side::kRight);
}

TEST(ClassicSubset, HasTwelveToSixteenElementsOfTheSet) {
  const StepSet set = PlausibleSet();
  const std::vector<int> classic = ClassicSubset(set);
  EXPECT_GE(classic.size(), 12u);
  EXPECT_LE(classic.size(), 16u);
  EXPECT_TRUE(std::is_sorted(classic.begin(), classic.end()));
  EXPECT_GE(classic.front(), 0);
  EXPECT_LT(classic.back(), set.size());
}

// An element is kept when both of its half-steps are.
TEST(StepSet, KeepsWhatIsKeptDownAndUp) {
  const StepGrid grid{.x_min = -0.1, .x_max = 0.1, .y_min = -0.3, .y_max = -0.2};
  const int all = MakeStepSet(grid, {}, [](const HalfStep&) { return true; }).size();
  ASSERT_GT(all, 0);
  for (const HalfStepKind refused : {HalfStepKind::kDown, HalfStepKind::kUp}) {
    const auto keeps = [&](const HalfStep& half_step) { return half_step.kind != refused; };
    EXPECT_EQ(MakeStepSet(grid, {}, keeps).size(), 0);
  }
}

}  // namespace
}  // namespace halfstep
