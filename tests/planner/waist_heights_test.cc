// Plans in which the waist changes its height between half-steps.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "planner/scene/scene.h"
#include "planner/search/footstep_astar.h"
#include "planner/search/planners.h"
#include "planner/search/pose_cells.h"
#include "planner/search/step_graph.h"
#include "tests/planner/flat_world.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr StepSet::Form kUpright{0.0, 0.25}, kLow{0.1, 0.16};

// Each place at both heights, and some between them.
StepSet TwoHeights() {
  const StepSet plain = PlausibleSet();
  StepSet set = plain;
  set.prototype.via_height = kUpright.via_height;
  set.forms = {kUpright, kLow};
  set.changes.assign(plain.placements.size(), {0, 0});
  const auto add = [&](int i, const StepSet::Change& change) {
    set.placements.push_back(Nth(plain.placements, i));
    set.changes.push_back(change);
  };
  for (int i = 0; i < plain.size(); ++i) add(i, {1, 1});
  for (const int i : ClassicSubset(plain)) add(i, {0, 1});
  for (const int i : ClassicSubset(plain)) add(i, {1, 0});
  return set;
}

// Under 0.5 < x < 1.1 only who is low has room; over 1.5 < x < 2.1 only who is upright.
bool HasRoom(const StepSet::Form& form, double x) {
  if (x > 0.5 && x < 1.1) return form == kLow;
  if (x > 1.5 && x < 2.1) return form == kUpright;
  return true;
}

class Bands : public HalfStepQuery {
 public:
  explicit Bands(const StepSet& set) : set_(set) {}

  bool DownIsFree(int i, Side support, const Foothold& X_WS) const override {
    const StepSet::Form& form = Nth(set_.forms, set_.ChangeOf(i).from);
    return HasRoom(form, X_WS.x) && HasRoom(form, (X_WS * set_.Placement(i, support)).x);
  }
  bool UpIsFree(int i, Side support, const Foothold& X_WS) const override {
    const double x = (X_WS * set_.Placement(i, support)).x;
    const auto [from, to] = set_.ChangeOf(i);
    return HasRoom(Nth(set_.forms, from), x) && HasRoom(Nth(set_.forms, to), x);
  }

 private:
  const StepSet& set_;
};

PlanResult PlanOver(const std::string& planner, const StepSet& set, const HalfStepQuery& query) {
  PlanRequest request{.start = {Foothold::Level({0, 0.1, 0}), Foothold::Level({0, -0.1, 0})},
                      .goal = {.X_WG = {2.6, 0, 0}, .radius = 0.15, .box = {}},
                      .set = set,
                      .query = query};
  request.workspace = {Eigen::Vector2d(-0.5, -0.6), Eigen::Vector2d(3.0, 0.6)};
  request.stop = AnyOf({WhenPlannedAfter(0.05), AfterEffort(3.0)});
  std::mt19937_64 random(1);
  return Planners::Standard().Make(planner, Scene{}, {})->Plan(request, random);
}

TEST(WaistHeights, EveryPlannerChangesThemWhereItHasTo) {
  const StepSet set = TwoHeights();
  const Bands query(set);
  for (const char* planner : {"best", "rrt", "astar", "astar/classic"}) {
    SCOPED_TRACE(planner);
    const PlanResult plan = PlanOver(planner, set, query);
    ASSERT_EQ(plan.status, PlanStatus::kSolved) << plan.sentence;
    int low = 0, changes = 0, form = set.ChangeOf(plan.elements.front()).from;
    for (size_t j = 0; j < plan.footsteps.size(); ++j) {
      const Footstep& footstep = plan.footsteps[j];
      const auto [from, to] = set.ChangeOf(plan.elements[j]);
      EXPECT_EQ(from, form) << "element " << j << " begins at another height";
      form = to;
      ASSERT_TRUE(footstep.crouch.has_value());
      EXPECT_EQ(*footstep.crouch, Nth(set.forms, from).crouch) << j;
      EXPECT_EQ(footstep.via_height, Nth(set.forms, from).via_height) << j;
      EXPECT_TRUE(HasRoom({*footstep.crouch, footstep.via_height}, footstep.X_WF.x)) << j;
      low += *footstep.crouch > 0.0 ? 1 : 0;
      changes += j > 0 && footstep.crouch != plan.footsteps[j - 1].crouch ? 1 : 0;
    }
    EXPECT_GT(low, 0);
    EXPECT_LT(low, std::ssize(plan.footsteps));
    EXPECT_GE(changes, 1);
    // What costs more is not done for nothing.
    if (std::string(planner) == "best") {
      EXPECT_LE(changes, 2);
    }
  }
}

// The waist comes down before the low band, not where the walk begins; under it, it begins low.
TEST(WaistHeights, AreThoseOfStandingAtFirst) {
  const StepSet set = TwoHeights();
  const Bands query(set);
  PlanRequest request{.start = {Foothold::Level({0, 0.1, 0}), Foothold::Level({0, -0.1, 0})},
                      .goal = {.X_WG = {0.9, 0, 0}, .radius = 0.15, .box = {}},
                      .set = set,
                      .query = query};
  request.stop = AfterEffort(3.0);
  const StepGraph graph(request, AllElements(set));
  const std::vector<StepState> starts = graph.FreeStarts();
  ASSERT_EQ(starts.size(), 4u);
  EXPECT_EQ(graph.StartCost(starts[0]), 0.0);
  EXPECT_EQ(graph.StartCost(starts[2]), 0.5);
  for (const bool low_at_first : {false, true}) {
    request.start_is_free = [&](const HalfStep& up, const Foothold&) {
      return !low_at_first || up.shape.crouch > 0.0;
    };
    for (const char* planner : {"best", "astar"}) {
      SCOPED_TRACE(planner);
      std::mt19937_64 random(1);
      const PlanResult plan =
          Planners::Standard().Make(planner, Scene{}, {})->Plan(request, random);
      ASSERT_EQ(plan.status, PlanStatus::kSolved) << plan.sentence;
      EXPECT_EQ(set.ChangeOf(plan.elements.front()).from, low_at_first ? 1 : 0);
      double cost = low_at_first ? 0.5 : 0.0;
      for (const int i : plan.elements)
        cost += request.cost.OfElements(set)[static_cast<size_t>(i)];
      EXPECT_EQ(plan.cost, cost);
    }
  }
}

TEST(WaistHeights, OneHeightAloneFindsNoWay) {
  const StepSet set = TwoHeights();
  const Bands query(set);
  StepSet no_change = set;
  no_change.placements.resize(static_cast<size_t>(2 * PlausibleSet().size()));
  no_change.changes.resize(no_change.placements.size());
  EXPECT_NE(PlanOver("astar", no_change, query).status, PlanStatus::kSolved);
}

TEST(WaistHeights, ElementsOfAnotherHeightAreNotFree) {
  const StepSet set = TwoHeights();
  const Bands query(set);
  const PlanRequest request{.start = {Foothold::Level({0, 0.1, 0}), Foothold::Level({0, -0.1, 0})},
                            .goal = {.X_WG = {2.6, 0, 0}, .radius = 0.15, .box = {}},
                            .set = set,
                            .query = query};
  StepGraph graph(request, AllElements(set));
  for (const int form : {0, 1}) {
    const StepState from{Foothold::Level({0, 0.1, 0}), Side::kLeft, form};
    for (int k = 0; k < graph.size(); ++k) {
      const bool fits = set.ChangeOf(k).from == form;
      EXPECT_EQ(graph.DownIsFree(from, k), fits) << k;
      EXPECT_EQ(graph.UpIsFree(from, k), fits) << k;
      EXPECT_EQ(graph.After(from, k).form, set.ChangeOf(k).to) << k;
    }
  }
  // A start at each height with each foot; the first comes down to it.
  const std::vector<StepState> starts = graph.FreeStarts();
  ASSERT_EQ(starts.size(), 4u);
  const PoseCells cells;
  EXPECT_NE(cells.KeyOf(starts[0]), cells.KeyOf(starts[2]));
}

}  // namespace
}  // namespace halfstep
