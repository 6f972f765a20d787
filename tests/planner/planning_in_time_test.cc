#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "planner/search/planners.h"
#include "planner/search/timed_edges.h"
#include "tests/planner/flat_world.h"

namespace halfstep {
namespace {

constexpr double kTick = 0.25;  // [s]

// Bands of x, as far as `y_min`, that are shut for some times, which are multiples of kTick. Soles
// at rest or at their via points must not be in them then.
struct ShutBand {
  double x_min, x_max;
  TimeInterval shut;
  double y_min = -10.0;
};

class BandTimes : public HalfStepTimes {
 public:
  BandTimes(const StepSet& set, std::vector<ShutBand> bands, double settled = 100.0)
      : set_(set), bands_(std::move(bands)), settled_(settled) {}

  TimeIntervals DownStarts(int i, Side support, const Foothold& X_WS, const Foothold& X_WF,
                           const TimeInterval&) const override {
    const Pose2 via = X_WS.Planar() * set_.Down(i, support).via();
    return Open({X_WS.Planar(), via, X_WF.Planar()}, set_.prototype.duration);
  }
  TimeIntervals UpStarts(int i, Side support, const Foothold& X_WS, const Foothold& X_WF,
                         const TimeInterval&) const override {
    const Pose2 via = X_WF.Planar() * set_.Up(i, support).via();
    return Open({X_WS.Planar(), via, X_WF.Planar()}, set_.prototype.duration);
  }
  TimeIntervals OnBothFeet(int, Side, const Foothold& X_WS, const Foothold& X_WF,
                           const TimeInterval&) const override {
    return Open({X_WS.Planar(), X_WF.Planar()}, 0.0);
  }
  TimeIntervals OnOneFoot(Side, const Foothold& X_WS, const TimeInterval&) const override {
    return Open({X_WS.Planar()}, 0.0);
  }
  double settled() const override { return settled_; }

 private:
  // When something that takes `lasts` may begin.
  TimeIntervals Open(const std::vector<Pose2>& soles, double lasts) const {
    TimeIntervals open = {{}};
    for (const ShutBand& band : bands_) {
      if (std::ranges::none_of(soles, [&](const Pose2& sole) {
            return sole.x > band.x_min && sole.x < band.x_max && sole.y > band.y_min;
          })) {
        continue;
      }
      TimeIntervals rest;
      for (const TimeInterval& one : open) {
        const double before = std::min(one.end, band.shut.begin - lasts);
        const double after = std::max(one.begin, band.shut.end);
        if (one.begin <= before) rest.push_back({one.begin, before});
        if (after <= one.end) rest.push_back({after, one.end});
      }
      open = rest;
    }
    return open;
  }

  const StepSet& set_;
  std::vector<ShutBand> bands_;
  double settled_;
};

StepSet FewSteps() {
  StepSet set;
  set.prototype.duration = 1.0;
  for (const double x : {-0.2, 0.0, 0.2}) set.placements.push_back(Foothold::Level({x, -0.2, 0.0}));
  return set;
}

PlanRequest RequestAlong(const StepSet& set, const HalfStepQuery& query,
                         const HalfStepTimes& times) {
  PlanRequest request{
      .start = {Foothold::Level({0.0, 0.1, 0.0}), Foothold::Level({0.0, -0.1, 0.0})},
      .goal = {},
      .set = set,
      .query = query,
      .times = &times,
      .workspace = {{Eigen::Vector2d(-0.5, -1.0), Eigen::Vector2d(1.3, 1.0)}}};
  request.goal.X_WG = {1.0, 0.0, 0.0};
  request.goal.part = GoalPart::kEitherFoot;
  request.goal.radius = 0.25;
  request.stop = AfterNodes(200000);
  return request;
}

// The earliest end of a walk, by going through all states at all ticks; none up to 60 s.
double EarliestByTicks(const PlanRequest& request) {
  const StepSet& set = request.set;
  const auto ticks = [](double t) { return static_cast<int>(std::lround(t / kTick)); };
  const int T = ticks(set.prototype.duration), last = ticks(60.0);
  struct Standing {
    StepState from;
    int k = -1;  // −1: on one foot, `from`; else on both, landed by k
  };
  using Key = std::array<int, 5>;
  const auto key = [](const Standing& s) {
    const Foothold& at = s.from.X_WS;
    return Key{static_cast<int>(std::lround(100 * at.x)), static_cast<int>(std::lround(100 * at.y)),
               static_cast<int>(std::lround(100 * at.yaw)), Index(s.from.support), s.k};
  };
  std::vector<std::map<Key, Standing>> at(static_cast<size_t>(last + T + 1));
  const auto add = [&](int tick, const Standing& s) {
    at[static_cast<size_t>(tick)].try_emplace(key(s), s);
  };
  const auto holds = [](const TimeIntervals& all, int tick) {
    return IntervalAt(all, tick * kTick) != nullptr;
  };
  StepGraph graph(request, AllElements(set));
  for (const StepState& start : graph.FreeStarts()) {
    if (holds(request.times->OnOneFoot(start.support, start.X_WS, {}), T)) add(T, {start});
  }
  for (int tick = 0; tick < last; ++tick) {
    for (const auto& [ignored, s] : at[static_cast<size_t>(tick)]) {
      const Foothold& X_WS = s.from.X_WS;
      const Side side = s.from.support;
      if (s.k < 0) {
        if (holds(request.times->OnOneFoot(side, X_WS, {}), tick + 1)) add(tick + 1, s);
        for (int k = 0; k < set.size(); ++k) {
          const Foothold X_WF = X_WS * set.Placement(k, side);
          if (!request.query.DownIsFree(k, side, X_WS)) continue;
          if (!holds(request.times->DownStarts(k, side, X_WS, X_WF, {}), tick)) continue;
          const TimeIntervals stands = request.times->OnBothFeet(k, side, X_WS, X_WF, {});
          if (!holds(stands, tick + T)) continue;
          if (request.goal.ContainsLanding(Opposite(side), X_WF, X_WS)) {
            if (std::isinf(IntervalAt(stands, (tick + T) * kTick)->end)) return (tick + T) * kTick;
            continue;
          }
          if (request.workspace->contains(X_WF.Planar().position())) add(tick + T, {s.from, k});
        }
        continue;
      }
      const Foothold X_WF = X_WS * set.Placement(s.k, side);
      if (holds(request.times->OnBothFeet(s.k, side, X_WS, X_WF, {}), tick + 1)) add(tick + 1, s);
      const StepState after{X_WF, Opposite(side)};
      if (request.query.UpIsFree(s.k, side, X_WS) &&
          holds(request.times->UpStarts(s.k, side, X_WS, X_WF, {}), tick) &&
          holds(request.times->OnOneFoot(after.support, X_WF, {}), tick + T)) {
        add(tick + T, {after});
      }
    }
  }
  return INFINITY;
}

// Start and end of each half-step of a walk of raw half-steps.
std::vector<TimeInterval> TimesOf(const std::vector<Footstep>& footsteps) {
  std::vector<TimeInterval> times;
  double t = 0.0;
  for (const Footstep& footstep : footsteps) {
    for (const double rest : {footstep.rest, footstep.rest_on_one_foot}) {
      if (!times.empty()) t += rest;
      times.push_back({t, t + footstep.duration});
      t += footstep.duration;
    }
  }
  return times;
}

PlanResult PlanBy(const char* planner, const PlanRequest& request, std::uint64_t seed = 1,
                  const PlannerOptions& options = {}) {
  std::mt19937_64 random(seed);
  return Planners::Standard().Make(planner, {}, options)->Plan(request, random);
}

TEST(PlanningInTime, ArrivesAsEarlyAsABruteSearchInTimeAndNeverWhereItIsShut) {
  const StepSet set = FewSteps();
  const FlatQuery query(set, {});
  std::mt19937_64 random(3);
  const auto tick = [&](int least, int most) {
    return kTick * std::uniform_int_distribution<int>(least, most)(random);
  };
  int rested = 0, none = 0, trees = 0;
  for (int draw = 0; draw < 30; ++draw) {
    std::vector<ShutBand> bands;
    for (int i = 0; i < 3; ++i) {
      const double x = 0.05 + 0.1 * std::uniform_int_distribution<int>(1, 9)(random);
      const double begin = tick(0, 40), end = begin + tick(4, 40);
      bands.push_back({x, x + 0.2, {begin, draw % 10 == 9 ? INFINITY : end}});
    }
    const BandTimes times(set, bands);
    const PlanRequest request = RequestAlong(set, query, times);
    const double earliest = EarliestByTicks(request);
    const PlanResult plan = PlanBy("astar", request);
    ASSERT_EQ(plan.status == PlanStatus::kSolved, std::isfinite(earliest)) << draw;
    if (!std::isfinite(earliest)) {
      EXPECT_EQ(PlanBy("best", request).status, PlanStatus::kNoPlan) << draw;
      ++none;
      continue;
    }
    const std::vector<TimeInterval> at = TimesOf(plan.footsteps);
    EXPECT_NEAR(at.back().end, earliest, 1e-9) << draw;
    EXPECT_NEAR(plan.cost, earliest / 2.0, 1e-9);  // steps of two half-steps of 1 s
    for (size_t j = 0; j < plan.footsteps.size(); ++j) {
      rested += plan.footsteps[j].rest > 0.0 || plan.footsteps[j].rest_on_one_foot > 0.0;
    }
    // Each half-step within what it may.
    StepState state{request.start[static_cast<size_t>(Index(Opposite(plan.footsteps[0].side)))],
                    Opposite(plan.footsteps[0].side)};
    for (size_t j = 0; j < plan.footsteps.size(); ++j) {
      const int k = plan.elements[j];
      const Foothold& X_WF = plan.footsteps[j].X_WF;
      EXPECT_TRUE(IntervalAt(times.DownStarts(k, state.support, state.X_WS, X_WF, {}),
                             at[2 * j + 1].begin));
      if (j + 1 < plan.footsteps.size()) {
        EXPECT_TRUE(IntervalAt(times.UpStarts(k, state.support, state.X_WS, X_WF, {}),
                               at[2 * j + 2].begin));
      }
      state = {X_WF, Opposite(state.support)};
    }
    // As early where random trees and A* take turns.
    PlanRequest with_turns = request;
    with_turns.stop = AnyOf({WhenPlannedAfter(0.2), AfterEffort(10.0)});
    const PlanResult best = PlanBy("best", with_turns);
    ASSERT_EQ(best.status, PlanStatus::kSolved) << best.sentence;
    EXPECT_NEAR(TimesOf(best.footsteps).back().end, earliest, 1e-9) << draw;
    // A tree finds a way as well, no earlier.
    PlanRequest quick = request;
    quick.stop = AnyOf({AtFirstPlan(), AfterNodes(2000)});
    const PlanResult tree = PlanBy("rrt", quick);
    if (tree.status != PlanStatus::kSolved) continue;
    ++trees;
    EXPECT_GE(TimesOf(tree.footsteps).back().end, earliest - 1e-9);
  }
  EXPECT_GT(trees, 15);
  EXPECT_GT(rested, 10);
  EXPECT_GT(none, 0);
}

// Around a door that opens soon one comes earlier, and in time for a door that shuts for good.
TEST(PlanningInTime, WhoCameFirstInTheSearchDoesNotHideWhoComesEarlier) {
  StepSet set = FewSteps();
  set.placements.push_back(Foothold::Level({0.0, -0.4, 0.0}));
  const FlatQuery query(set, {});
  int solved = 0;
  for (double opens = 20.0; opens <= 26.0; opens += 2.0) {
    const BandTimes times(set, {{0.25, 0.45, {0.0, opens}, -0.5}, {0.55, 0.75, {opens, INFINITY}}});
    PlanRequest request = RequestAlong(set, query, times);
    request.workspace = {Eigen::Vector2d(-0.5, -1.4), Eigen::Vector2d(1.3, 0.6)};
    const double earliest = EarliestByTicks(request);
    for (const char* planner : {"astar", "best"}) {
      const PlanResult plan = PlanBy(planner, request);
      EXPECT_EQ(plan.status == PlanStatus::kSolved, std::isfinite(earliest)) << planner << opens;
    }
    // Whose user wants no weight of 1.
    PlannerOptions greedy;
    greedy.astar.weights = {5.0};
    EXPECT_EQ(PlanBy("astar", request, 1, greedy).status == PlanStatus::kSolved,
              std::isfinite(earliest))
        << opens;
    solved += std::isfinite(earliest);
  }
  EXPECT_GT(solved, 0);
}

// Doors that open and shut all the time, until all is open: in time there is much to search.
TEST(PlanningInTime, BestNeverEndsLaterThanWaitingUntilAllIsAtRest) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, {});
  std::mt19937_64 random(2);
  for (int draw = 0; draw < 4; ++draw) {
    std::vector<ShutBand> bands;
    double settled = 0.0;
    for (double t = 0.0; t < 40.0; t += std::uniform_real_distribution<double>(4.0, 7.0)(random)) {
      settled = t + std::uniform_real_distribution<double>(2.0, 4.0)(random);
      const double x = std::uniform_real_distribution<double>(0.5, 1.2)(random);
      bands.push_back({x, x + 0.4, {t, settled}});
    }
    const BandTimes times(set, bands, settled);
    PlanRequest request = RequestTo({2.0, 0.0, 0.0}, set, query);
    request.cost.kind = CostKind::kRawDuration;
    request.stop = AnyOf({WhenPlannedAfter(0.3), AfterEffort(10.0)});
    const PlanResult after = PlanBy("best", request);
    ASSERT_EQ(after.status, PlanStatus::kSolved) << after.sentence;
    request.times = &times;
    const PlanResult best = PlanBy("best", request);
    ASSERT_EQ(best.status, PlanStatus::kSolved) << best.sentence;
    const double T = set.prototype.duration;
    EXPECT_LE(TimesOf(best.footsteps).back().end,
              settled - T + 2.0 * T * static_cast<double>(after.footsteps.size()) + 1e-9);
  }
}

TEST(PlanningInTime, WhoWaitsForAllToRestBeginsOnOneFoot) {
  const StepSet set = FewSteps();
  const FlatQuery query(set, {});
  const BandTimes times(set, {{0.25, 0.75, {0.0, 20.0}}}, 30.0);
  const PlanRequest request = RequestAlong(set, query, times);
  StepGraph graph(request, AllElements(set));
  TimedEdges waiting(times, 1.0, &graph, times.settled());
  const StepState start = graph.FreeStarts().front();
  const auto at = waiting.Start(start);
  ASSERT_TRUE(at);
  EXPECT_EQ(at->since, 30.0);
  const std::vector<TimedEdge> edges = waiting.Take(*at, 2);
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_EQ(edges[0].to.since, 32.0);
  EXPECT_EQ(edges[0].rest_on_one_foot, 29.0);  // from T on
  const std::vector<TimedEdge> next = waiting.Take(edges[0].to, 2);
  ASSERT_EQ(next.size(), 1u);
  EXPECT_EQ(next[0].rest_on_one_foot, 0.0);
  // Not where it may not rest for so long.
  const BandTimes shut(set, {{-0.1, 0.1, {10.0, 20.0}}}, 30.0);
  EXPECT_TRUE(TimedEdges(shut, 1.0, &graph).Start(start));
  EXPECT_FALSE(TimedEdges(shut, 1.0, &graph, 30.0).Start(start));
}

TEST(PlanningInTime, TheSameRequestGivesTheSamePlanAndShutNowhereTheUntimedOne) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, WallWithGap(0.3, 0.8));
  for (const char* planner : {"astar", "rrt", "best"}) {
    const BandTimes open(set, {}), shut(set, {{0.6, 0.8, {2.0, 17.0}}});
    PlanRequest request = RequestTo({2.0, 0.0, 0.0}, set, query);
    request.times = &open;
    const PlanResult timed = PlanBy(planner, request);
    request.times = nullptr;
    const PlanResult untimed = PlanBy(planner, request);
    ASSERT_EQ(timed.status, PlanStatus::kSolved) << timed.sentence;
    if (std::string(planner) == "astar") {
      EXPECT_EQ(timed.elements, untimed.elements);
    }
    EXPECT_EQ(timed.cost, static_cast<double>(timed.footsteps.size()));
    request.times = &shut;
    const PlanResult first = PlanBy(planner, request), again = PlanBy(planner, request);
    ASSERT_EQ(first.status, PlanStatus::kSolved) << first.sentence;
    EXPECT_EQ(first.elements, again.elements);
    EXPECT_EQ(first.cost, again.cost);
    EXPECT_NE(first.sentence.find(", at rest for "), std::string::npos) << first.sentence;
  }
}

TEST(PlanningInTime, RestsAreOnBothFeetWhereTheyMayBe) {
  std::vector<TimedEdge> edges(2);
  edges[0].to.since = 4.0;
  edges[0].latest_up = 4.5;  // 1.5 s later
  edges[0].rest_on_both_feet = 0.5;
  edges[1].rest_on_one_foot = 2.0;
  const auto rests = RestsOf(edges, 1.0);
  ASSERT_EQ(rests.size(), 2u);
  EXPECT_DOUBLE_EQ(rests[0][0] + rests[0][1], 0.0);
  EXPECT_DOUBLE_EQ(rests[1][0], 2.0);
  EXPECT_DOUBLE_EQ(rests[1][1], 0.5);
  // The walk ends when it did.
  EXPECT_DOUBLE_EQ(rests[1][0] + rests[1][1],
                   edges[0].rest_on_both_feet + edges[1].rest_on_one_foot);
}

TEST(PlanningInTime, OnlySomePlannersKnowTime) {
  const Scene scene;
  const Planners all = Planners::Standard();
  for (const std::string& name : all.Names()) {
    EXPECT_EQ(all.Make(name, scene)->knows_time(), name != "bounding_box") << name;
  }
}

}  // namespace
}  // namespace halfstep
