#include "planner/search/best_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "planner/search/beam_search.h"
#include "planner/search/footstep_astar.h"
#include "planner/search/least_cost.h"
#include "planner/search/plan_search.h"
#include "planner/search/state_buckets.h"
#include "planner/search/step_search.h"
#include "tests/draws.h"
#include "tests/planner/flat_world.h"

namespace halfstep {
namespace {

PlanResult PlanBest(PlanRequest request, double effort, std::uint64_t seed = 1) {
  request.cost.kind = CostKind::kSmoothedDuration;
  request.stop = AnyOf({WhenPlannedAfter(effort), AfterEffort(10.0)});
  std::mt19937_64 random(seed);
  return BestPlanner({}, {}).Plan(request, random);
}

// Also from far away and of states beyond the area; the first of equals.
TEST(StateBuckets, FindTheNearestFromAfarAndOfEquals) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const double reach = trial % 2 == 0 ? 1.0 : 1.5;  // of states
    StateBuckets buckets({Eigen::Vector2d(-1.0, -0.6), Eigen::Vector2d(1.0, 0.6)});
    std::vector<Pose2> states;
    for (int i = 0; i < 60; ++i) {
      const Pose2 X_WS{Uniform(&random, -reach, reach), Uniform(&random, -reach, reach),
                       Uniform(&random, -3.0, 3.0)};
      states.push_back(i % 10 == 9 ? states.back() : X_WS);
      buckets.Insert(i, {Foothold(states.back(), 0.0), Side::kLeft});
    }
    for (int k = 0; k < 200; ++k) {
      const double far = k % 4 == 0 ? 1000.0 : k % 4 == 1 ? 3.0 : 1.0;
      const Pose2 X_W{Uniform(&random, -far, far), Uniform(&random, -far, far),
                      Uniform(&random, -3.0, 3.0)};
      const auto distance = [&](const Pose2& X_WS) { return StateDistance(X_WS, X_W, k % 2 == 0); };
      const auto nearest = std::ranges::min_element(states, {}, distance);
      EXPECT_EQ(buckets.FindNearest(X_W, Side::kLeft, k % 2 == 0), nearest - states.begin());
    }
  }
}

// Along plans of every cost, what is left of a plan never costs less than the bound.
TEST(LeastCost, NeverExceedsWhatAPlanCosts) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, {});
  int states = 0, above_half = 0;
  for (const CostKind kind : {CostKind::kSteps, CostKind::kSmoothedDuration}) {
    for (const GoalPart part : {GoalPart::kEitherFoot, GoalPart::kLeftFoot, GoalPart::kMidFeet}) {
      for (int trial = 0; trial < 3; ++trial) {
        const double angle = 2.1 * trial;
        PlanRequest request =
            RequestTo({1.2 * std::cos(angle), 1.2 * std::sin(angle), angle}, set, query);
        request.goal.part = part;
        if (trial % 2 == 1) request.goal.yaw_tolerance = 0.3;
        request.cost.kind = kind;
        request.stop = AnyOf({WhenPlannedAfter(0.02), AfterEffort(1.0)});
        std::mt19937_64 random(1);
        const PlanResult plan = BestPlanner({}, {}).Plan(request, random);
        ASSERT_EQ(plan.status, PlanStatus::kSolved) << plan.sentence;
        const StepGraph graph(request, AllElements(set));
        const LeastCost least(set, graph);
        const Side support = Opposite(plan.footsteps[0].side);
        StepState state{request.start[static_cast<size_t>(Index(support))], support};
        double left = plan.cost;
        for (const int k : plan.elements) {
          EXPECT_LE(least.From(state), left + 1e-9) << "kind " << static_cast<int>(kind);
          ++states;
          above_half += static_cast<int>(least.From(state) > 0.5 * left);
          left -= graph.cost(k);
          state = graph.After(state, k);
        }
      }
    }
  }
  EXPECT_GT(above_half, states / 2);  // and it is no empty claim
}

TEST(BestPlanner, FindsTheWayThroughAGapOnTheFarSide) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, WallWithGap(0.9, 0.8));
  PlanRequest request = RequestTo({2.0, 0.0, 0.0}, set, query);
  request.workspace = {Eigen::Vector2d(-0.6, -1.45), Eigen::Vector2d(2.6, 1.45)};
  request.start_is_free = [&query](const HalfStep& up, const Foothold& X_WS) {
    return query.StartIsFree(up, X_WS);
  };
  const PlanResult best = PlanBest(request, 0.25);
  ASSERT_EQ(best.status, PlanStatus::kSolved) << best.sentence;
  for (const std::uint64_t seed : {2}) {
    const PlanResult soon = PlanBest(request, 0.1, seed);
    ASSERT_EQ(soon.status, PlanStatus::kSolved) << soon.sentence;
    EXPECT_LE(soon.cost, 1.05 * best.cost);
    EXPECT_GE(soon.effort(), 0.1);
    EXPECT_LT(soon.effort(), 0.12);
  }
}

TEST(BestPlanner, TheSameSeedGivesTheSamePlanNodeForNode) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, WallWithGap(0.3, 0.8));
  const PlanRequest request = RequestTo({2.0, 0.0, 0.0}, set, query);
  const PlanResult once = PlanBest(request, 0.05), again = PlanBest(request, 0.05);
  EXPECT_EQ(once.elements, again.elements);
  EXPECT_EQ(once.nodes, again.nodes);
  EXPECT_EQ(once.queries, again.queries);
}

TEST(BestPlanner, EndsAtTheFirstPlanWhereThatIsEnough) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, {});
  const PlanRequest request = RequestTo({2.0, 0.0, 0.0}, set, query);
  std::mt19937_64 random(1);
  const PlanResult first = BestPlanner({}, {}).Plan(request, random);
  random.seed(1);
  const PlanResult tree = FootstepRrt({}).Plan(request, random);
  EXPECT_EQ(first.elements, tree.elements);
}

TEST(StepSearch, GoesOnWhereItsTurnEnded) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, WallWithGap(0.3, 0.8));
  PlanRequest request = RequestTo({2.0, 0.0, 0.0}, set, query);
  request.stop = AfterEffort(10.0);
  struct Searched {
    int turns = 1;
    std::int64_t nodes = 0, queries = 0;
    std::vector<std::vector<int>> plans;
  };
  const auto search_in_turns = [&](double turn) {
    StepGraph graph(request, AllElements(set));
    PlanMonitor monitor(request, graph);
    StepSearch search(
        graph.FreeStarts(),
        [&graph](const StepState& state) {
          return StepsToGo{static_cast<double>(graph.LeastSteps(state)), graph.SteadySteps(state)};
        },
        {.weights = {5.0, 2.0}, .cells = {.position = 0.06, .yaw = 0.2}}, &graph, &monitor);
    Searched searched;
    for (monitor.Allow(turn); !search.Run() && searched.turns < 1000; ++searched.turns) {
      EXPECT_FALSE(monitor.stopped());
      monitor.Allow(turn);
    }
    searched.nodes = monitor.progress().nodes;
    searched.queries = graph.queries();
    for (const StepPlan& plan : monitor.plans()) searched.plans.push_back(plan.ks);
    EXPECT_TRUE(search.Run());  // it has ended
    return searched;
  };
  const Searched whole = search_in_turns(10.0), parts = search_in_turns(0.002);
  EXPECT_EQ(whole.turns, 1);
  EXPECT_GT(parts.turns, 5);
  EXPECT_GE(whole.plans.size(), 1u);
  EXPECT_EQ(parts.plans, whole.plans);
  EXPECT_EQ(parts.nodes, whole.nodes);
  EXPECT_EQ(parts.queries, whole.queries);
}

// Where nothing is left out and no two states share a cell, the plan is the cheapest, whatever the
// guess. A narrow beam finds none that is cheaper.
TEST(SearchBeam, LeavesOutOnlyWhatIsBeyondItsWidth) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, {});
  PlanRequest request = RequestTo({0.5, 0.0, 0.0}, set, query);
  request.cost.kind = CostKind::kSmoothedDuration;
  request.stop = AfterEffort(60.0);
  const std::vector<int> elements = ClassicSubset(set);
  const PoseCells apart{.position = 1e-6, .yaw = 1e-6};
  const auto cheapest = [&](auto search) {
    StepGraph graph(request, elements);
    PlanMonitor monitor(request, graph);
    const auto to_go = [&graph](const StepState& state) {
      const auto bound = static_cast<double>(graph.LeastSteps(state));
      return StepsToGo{.bound = bound, .guess = bound};
    };
    search(graph.FreeStarts(), to_go, &graph, &monitor);
    EXPECT_FALSE(monitor.stopped());
    return monitor.best_cost();
  };
  const double least = cheapest([&](const auto& starts, const auto& to_go, auto* graph, auto* end) {
    StepSearch(starts, to_go, {.weights = {1.0}, .cells = apart}, graph, end).Run();
  });
  ASSERT_TRUE(std::isfinite(least));
  const auto beam = [&](int width, double weight) {
    return cheapest([&](const auto& starts, const auto& to_go, auto* graph, auto* end) {
      SearchBeam(starts, to_go, {.width = width, .cells = apart, .weight = weight}, graph, end);
    });
  };
  for (const double weight : {0.0, 1.0, 3.0}) EXPECT_DOUBLE_EQ(beam(1000000, weight), least);
  EXPECT_TRUE(std::isfinite(beam(30, 1.0)));
  for (const int width : {1, 3, 30}) EXPECT_GE(beam(width, 1.0), least);
}

TEST(SearchBeam, EndsWithItsTurn) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, {});
  PlanRequest request = RequestTo({2.0, 0.0, 0.0}, set, query);
  request.stop = AfterEffort(60.0);
  StepGraph graph(request, AllElements(set));
  PlanMonitor monitor(request, graph);
  monitor.Allow(0.01);
  const auto nowhere = [](const StepState&) { return StepsToGo{}; };
  SearchBeam(graph.FreeStarts(), nowhere, {.width = 1000000}, &graph, &monitor);
  EXPECT_FALSE(monitor.stopped());
  EXPECT_GE(monitor.progress().effort(), 0.01);
  EXPECT_LT(monitor.progress().effort(), 0.011);
}

TEST(PlanMonitor, ATurnEndsWithoutEndingThePlanning) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, {});
  PlanRequest request = RequestTo({2.0, 0.0, 0.0}, set, query);
  double proofs = 0.0;
  request.proofs = [&proofs] { return proofs; };
  request.stop = AfterEffort(1.0);
  const StepGraph graph(request, AllElements(set));
  PlanMonitor monitor(request, graph);
  EXPECT_FALSE(monitor.Stop());
  monitor.Allow(0.3);
  EXPECT_FALSE(monitor.Stop());
  proofs = 0.4;
  EXPECT_TRUE(monitor.Stop());
  EXPECT_FALSE(monitor.stopped());
  monitor.Allow(0.3);
  EXPECT_FALSE(monitor.Stop());
  proofs = 1.0;
  EXPECT_TRUE(monitor.Stop());
  EXPECT_TRUE(monitor.stopped());
}

}  // namespace
}  // namespace halfstep
