#include "planner/search/footstep_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <random>
#include <set>

#include "planner/search/beam_search.h"
#include "planner/search/footstep_astar.h"
#include "planner/search/footstep_rrt.h"
#include "planner/search/plan_search.h"
#include "planner/search/plan_shortcut.h"
#include "planner/search/state_buckets.h"
#include "planner/search/step_graph.h"
#include "tests/planner/flat_world.h"

namespace halfstep {
namespace {

// The least number of footsteps by trying all sequences, level by level, without cells.
int LeastByTrying(const PlanRequest& request, int most) {
  StepGraph graph(request, ClassicSubset(request.set));
  std::vector<StepState> level = graph.FreeStarts();
  for (int n = 1; n <= most; ++n) {
    std::vector<StepState> next;
    for (const StepState& state : level) {
      for (int k = 0; k < graph.size(); ++k) {
        const StepState after = graph.After(state, k);
        if (!graph.DownIsFree(state, k)) continue;
        if (graph.IsGoal(state, after.X_WS)) return n;
        if (n < most && graph.UpIsFree(state, k)) next.push_back(after);
      }
    }
    level = next;
  }
  return -1;
}

TEST(FootstepAStar, EndsWithTheLeastNumberOfFootsteps) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, {.poles = {{{0.35, 0.0}, 0.1}}, .no_step = {}});
  const FootstepAStar planner(FootstepAStar::Elements::kClassic, {});
  int tried = 0;
  for (const Pose2& goal : {Pose2{0.4, 0.35, 0.0}, Pose2{-0.4, 0.3, 0.0}, Pose2{0.2, -0.45, 0.0}}) {
    PlanRequest request = RequestTo(goal, set, query);
    request.stop = AfterNodes(200000);
    const int least = LeastByTrying(request, 4);
    if (least < 0) continue;
    std::mt19937_64 random(1);
    const PlanResult result = planner.Plan(request, random);
    ASSERT_EQ(result.status, PlanStatus::kSolved) << result.sentence;
    EXPECT_TRUE(result.exhausted);
    EXPECT_EQ(static_cast<int>(result.footsteps.size()), least);
    ++tried;
  }
  EXPECT_GE(tried, 2);
}

TEST(FootstepAStar, LaterPlansAreCheaper) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, WallWithGap(0.6, 0.6));
  const FootstepAStar planner(FootstepAStar::Elements::kClassic, {});
  PlanRequest request = RequestTo({1.6, 0.0, 0.0}, set, query);
  std::mt19937_64 random(1);
  const PlanResult first = planner.Plan(request, random);
  request.stop = AfterNodes(2 * first.nodes + 3000);
  const PlanResult later = planner.Plan(request, random);
  ASSERT_EQ(first.status, PlanStatus::kSolved);
  ASSERT_EQ(later.status, PlanStatus::kSolved);
  EXPECT_LE(later.cost, first.cost);
}

TEST(FootstepRrt, ShortensItsPlanWhenThereIsTime) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, WallWithGap(0.8, 0.6));
  const FootstepRrt planner({});
  int shorter = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    PlanRequest request = RequestTo({2.0, 0.0, 0.0}, set, query);
    std::mt19937_64 random(seed);
    const PlanResult first = planner.Plan(request, random);
    request.stop = AnyOf({WhenNotImprovedFor(500), AfterNodes(20000)});
    random.seed(seed);
    const PlanResult later = planner.Plan(request, random);
    ASSERT_EQ(first.status, PlanStatus::kSolved);
    ASSERT_EQ(later.status, PlanStatus::kSolved);
    ASSERT_LE(later.cost, first.cost);
    if (later.cost < first.cost) ++shorter;
  }
  EXPECT_GE(shorter, 8);
}

TEST(FootstepRrt, LeavesAnIslandWithEverySeed) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, Island(0.35, 0.06));
  const FootstepRrt planner({});
  const PlanRequest request = RequestTo({1.2, 0.3, 0.0}, set, query);
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    std::mt19937_64 random(seed);
    EXPECT_EQ(planner.Plan(request, random).status, PlanStatus::kSolved) << "seed " << seed;
  }
}

TEST(FootstepRrt, DoesNotLeaveARingThatIsTooWide) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, Island(0.35, 0.5));
  const FootstepRrt planner({});
  PlanRequest request = RequestTo({1.5, 0.0, 0.0}, set, query);
  request.stop = AfterNodes(1500);
  std::mt19937_64 random(1);
  EXPECT_NE(planner.Plan(request, random).status, PlanStatus::kSolved);
}

TEST(FootstepRrt, DifferentSeedsFindDifferentWays) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, {});
  const FootstepRrt planner({});
  const PlanRequest request = RequestTo({1.5, 0.5, 0.0}, set, query);
  std::set<std::vector<int>> plans;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    std::mt19937_64 random(seed);
    plans.insert(planner.Plan(request, random).elements);
  }
  EXPECT_GT(plans.size(), 3u);
}

// Calls two thirds of all half-steps free, by their places to the last digit: what was free from
// one state says nothing about another one near it.
class CapriciousQuery : public HalfStepQuery {
 public:
  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override {
    return IsFree(2 * i, support, X_WS);
  }
  bool UpIsFree(int i, Side support, const Foothold& X_WS) const override {
    return IsFree(2 * i + 1, support, X_WS);
  }

 private:
  static bool IsFree(int what, Side support, const Foothold& X_WS) {
    std::uint64_t mixed = static_cast<std::uint64_t>(2 * what + Index(support)) + 1;
    for (const double value : {X_WS.x, X_WS.y, X_WS.yaw}) {
      mixed = (mixed ^ std::bit_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15;
      mixed ^= mixed >> 29;
    }
    return mixed % 3 != 0;
  }
};

// Short-cuts go on along the old landings from a state that is only near the old one: there every
// half-step must be asked about again.
TEST(Shortcut, EveryHalfStepOfAShortenedPlanIsFree) {
  const StepSet set = PlausibleSet();
  const CapriciousQuery query;
  std::mt19937_64 random(11);
  int shortened = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const PlanRequest request = RequestTo({2.5, 0.0, 0.4}, set, query);
    const PlanResult first = FootstepRrt({}).Plan(request, random);
    ASSERT_EQ(first.status, PlanStatus::kSolved);
    StepGraph graph(request, AllElements(set));
    const Side support = Opposite(first.footsteps[0].side);
    PlanRequest more = RequestTo({2.5, 0.0, 0.4}, set, query);
    more.stop = AfterNodes(2000);
    PlanMonitor monitor(more, graph);
    monitor.Offer({.start = {request.start[static_cast<size_t>(Index(support))], support},
                   .ks = first.elements,
                   .cost = first.cost});
    while (!monitor.Stop()) {
      TryShortcut(monitor.plans().back(), graph.FreeStarts(), {}, &graph, &monitor, nullptr,
                  random);
    }
    for (const StepPlan& plan : monitor.plans()) {
      StepState state = plan.start;
      for (size_t i = 0; i < plan.ks.size(); ++i) {
        const bool last = i + 1 == plan.ks.size();
        EXPECT_TRUE(graph.DownIsFree(state, plan.ks[i])) << "footstep " << i;
        EXPECT_TRUE(last || graph.UpIsFree(state, plan.ks[i])) << "footstep " << i;
        EXPECT_EQ(graph.IsGoal(state, graph.Landing(state, plan.ks[i])), last);
        state = graph.After(state, plan.ks[i]);
      }
    }
    shortened += static_cast<int>(monitor.plans().size()) - 1;
  }
  EXPECT_GT(shortened, 10);
}

// Asks about every half-step of a plan from a state on.
void ExpectFree(const PlanRequest& request, StepState state, const std::vector<int>& elements) {
  StepGraph graph(request, AllElements(request.set));
  for (size_t i = 0; i < elements.size(); ++i) {
    const bool last = i + 1 == elements.size();
    EXPECT_TRUE(graph.DownIsFree(state, elements[i])) << "footstep " << i;
    EXPECT_TRUE(last || graph.UpIsFree(state, elements[i])) << "footstep " << i;
    state = graph.After(state, elements[i]);
  }
}

TEST(FootstepAStar, EveryHalfStepOfAPlanIsFree) {
  const StepSet set = PlausibleSet();
  const CapriciousQuery query;
  const FootstepAStar planner(FootstepAStar::Elements::kClassic, {});
  std::mt19937_64 random(12);
  for (int trial = 0; trial < 10; ++trial) {
    const PlanRequest request = RequestTo({1.5, 0.1 * trial, 0.0}, set, query);
    const PlanResult result = planner.Plan(request, random);
    ASSERT_EQ(result.status, PlanStatus::kSolved);
    const Side support = Opposite(result.footsteps[0].side);
    ExpectFree(request, {request.start[static_cast<size_t>(Index(support))], support},
               result.elements);
  }
}

TEST(SearchBeam, EveryHalfStepOfAPlanIsFree) {
  const StepSet set = PlausibleSet();
  const CapriciousQuery query;
  int plans = 0;
  for (int trial = 0; trial < 10; ++trial) {
    PlanRequest request = RequestTo({1.0, 0.1 * trial, 0.0}, set, query);
    request.stop = AfterEffort(10.0);
    StepGraph graph(request, AllElements(set));
    PlanMonitor monitor(request, graph);
    const auto to_go = [&graph](const StepState& state) {
      return StepsToGo{static_cast<double>(graph.LeastSteps(state)), graph.SteadySteps(state)};
    };
    SearchBeam(graph.FreeStarts(), to_go, {.width = 30}, &graph, &monitor);
    for (const StepPlan& plan : monitor.plans()) ExpectFree(request, plan.start, plan.ks);
    plans += static_cast<int>(monitor.plans().size());
  }
  EXPECT_GE(plans, 10);
}

}  // namespace
}  // namespace halfstep
