#include "planner/search/best_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "planner/search/beam_search.h"
#include "planner/search/fewest_steps.h"
#include "planner/search/least_cost.h"
#include "planner/search/plan_search.h"
#include "planner/search/plan_shortcut.h"
#include "planner/search/stand_map.h"
#include "planner/search/state_buckets.h"
#include "planner/search/step_search.h"

namespace halfstep {
namespace {

constexpr double kFirstTurn = 0.05;      // effort until another kind of search looks for a plan
constexpr double kTurnsGrow = 2.0;       // from round to round
constexpr double kFewestFirst = 10.0;    // times such a turn, for A* of the fewest footsteps
constexpr double kFewest = 3.0;          // times a turn that improves a plan, for the same
constexpr double kImprovingTurn = 0.02;  // effort of early turns that improve it
constexpr int kRestarts = 2;             // of a random tree, a round
constexpr int kPlaces = 4000;            // of the map
/// Of A*, one turn after the other: the larger, the sooner it finds a way.
constexpr double kWeights[] = {2.0, 1.4, 1.15};
constexpr double kFirstWeight = 5.0;
constexpr double kOfAState = 7e-4;      // effort of a beam for each state of its width, at most
constexpr double kWidth = 6400.0;       // of a beam in a turn of effort 1
constexpr double kHeaviest = 1.5;       // largest weight of a beam, least 1
constexpr double kRootOfLargest = 2.0;  // of the cells of a beam, times those of A*
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

// One call of Plan.
class BestSearch {
 public:
  BestSearch(const PlanRequest& request, const std::vector<StepState>& starts,
             const RrtOptions& rrt, const PoseCells& cells, StepGraph* graph, PlanMonitor* monitor,
             std::mt19937_64* random)
      : request_(request),
        starts_(starts),
        rrt_(rrt),
        cells_(cells),
        graph_(*graph),
        monitor_(*monitor),
        random_(*random),
        least_(request.set, *graph) {
    if (request.times == nullptr) return;
    const double T = request.set.prototype.duration;
    in_time_.emplace(*request.times, T, graph);
    edges_ = &*in_time_;
    waiting_.emplace(*request.times, T, graph, request.times->settled());
  }

  SearchEnd Run() {
    for (double turn = kFirstTurn; monitor_.plans().empty(); turn *= kTurnsGrow) {
      monitor_.Allow(turn);
      const bool no_tree = Grow(edges_, nullptr);
      if (!monitor_.plans().empty()) break;
      if (monitor_.stopped()) return {};
      if (no_tree && edges_ == nullptr) return {.exhausted = true};
      if (waiting_) {
        Wait(turn);
        if (!monitor_.plans().empty()) break;
        if (monitor_.stopped()) return {};
      }
      if (edges_ == nullptr) {
        monitor_.Allow(kFewestFirst * turn);
        const bool ended = SearchFewest();
        if (!monitor_.plans().empty()) break;
        if (monitor_.stopped()) return {};
        if (ended) return {.exhausted = true};
      }
      monitor_.Allow(no_tree ? kUnlimited : turn);  // in time A* has the last word
      if (SearchWith(kFirstWeight)) return {.exhausted = true};
      if (monitor_.stopped()) return {};
    }
    monitor_.Allow(kUnlimited);
    if (monitor_.Stop()) return {};
    if (!request_.ground) map_.emplace(request_.set, starts_.front(), kPlaces, &graph_);
    led_[Index()].clear();
    if (fewest_[Index()]) {  // it goes on for as long as all took that came before
      monitor_.Allow(monitor_.progress().effort());
      SearchFewest();
      if (monitor_.stopped()) return {};
    }
    coarse_ = true;
    double turn = edges_ == nullptr ? kImprovingTurn / 8.0 : kImprovingTurn;
    while (!IsCheapest()) {
      const bool nothing_better = edges_ == nullptr ? Round(turn) : RoundInTime(turn);
      turn *= edges_ != nullptr ? 1.5 : turn < kImprovingTurn ? 2.0 : 1.2;
      if (nothing_better && !coarse_) break;
      if (monitor_.stopped()) return {};
      coarse_ = !coarse_ && !nothing_better;
    }
    return {.exhausted = true};
  }

 private:
  // A search near a plan of that cost, which takes turns.
  struct NearPlan {
    std::unique_ptr<StepSearch> search = {};
    double of = 0.0;
    bool ended = false;
    void Run() {
      if (!ended) ended = search->Run();
    }
  };

  // Whether no plan is cheaper than the best.
  bool IsCheapest() const {
    return std::ranges::all_of(starts_, [this](const StepState& start) {
      const double least = graph_.StartCost(start) + least_.From(start);
      return monitor_.best_cost() <= least * (1.0 + 1e-12);
    });
  }

  // A turn of each way to improve the best plan; whether nothing is better.
  bool Round(double turn) {
    RunBeam(Along(monitor_.plans().back(), 1.0), turn);
    if (monitor_.stopped()) return false;
    monitor_.Allow(turn);
    Shorten(monitor_.plans().back());
    if (monitor_.stopped()) return false;
    RunBeam(ByLeastCost(), turn);
    for (int restart = 0; restart < kRestarts && !monitor_.stopped(); ++restart) {
      const StepPlan other = GrowOther(turn);
      if (!other.ks.empty() && !monitor_.stopped()) RunBeam(Along(other, 1.0), turn);
    }
    if (monitor_.stopped()) return false;
    monitor_.Allow(kFewest * turn);
    SearchFewest();
    if (monitor_.stopped()) return false;
    monitor_.Allow(turn);
    return SearchWith(std::ranges::min(kWeights));
  }

  // The same in time.
  bool RoundInTime(double turn) {
    for (const double weight : kWeights) {
      monitor_.Allow(turn);
      if (SearchWith(weight)) return true;
      if (monitor_.stopped()) return false;
    }
    Wait(turn);
    if (monitor_.stopped()) return false;
    monitor_.Allow(turn);
    const StepPlan& best = monitor_.plans().back();
    NearPlan& near = near_best_[Index()];
    if (!near.search || near.of != best.cost) near = {SearchNear(best), best.cost};
    near.Run();
    if (monitor_.stopped()) return false;
    monitor_.Allow(turn);
    Shorten(monitor_.plans().back());
    if (monitor_.stopped()) return false;
    for (int restart = 0; restart < kRestarts && !monitor_.stopped(); ++restart) {
      const StepPlan other = GrowOther(turn);
      if (other.ks.empty() || monitor_.stopped()) continue;
      monitor_.Allow(turn);
      SearchNear(other)->Run();
    }
    return false;
  }

  // In time: a turn each of a tree and A* that wait until all is at rest.
  void Wait(double turn) {
    if (waited_) return;
    monitor_.Allow(turn);
    StepPlan found;
    Grow(&*waiting_, &found);
    if (!found.ks.empty() && !monitor_.stopped()) Shorten(std::move(found));
    if (monitor_.stopped()) return;
    monitor_.Allow(turn);
    if (!wait_) {
      wait_ = std::make_unique<StepSearch>(
          starts_, ByLeastCost(), StepSearchOptions{{kFirstWeight, 2.0, 1.4, 1.15}, cells_},
          &graph_, &monitor_, &*waiting_);
    }
    waited_ = wait_->Run();
  }

  // Until the turn ends.
  StepPlan Shorten(StepPlan plan) {
    while (!monitor_.Stop()) {
      auto found = FindShortcut(plan, starts_, rrt_.cells, &graph_, &monitor_, edges_, random_);
      if (!found || !(found->cost < plan.cost)) continue;
      plan = std::move(*found);
      monitor_.Offer(plan);
    }
    return plan;
  }

  // A tree; whether it ended for want of half-steps.
  bool Grow(TimedEdges* edges, StepPlan* plan) {
    StepPlan grown;
    const TreeEnd end = GrowTree(starts_, rrt_, &graph_, &monitor_, edges, random_, &grown);
    if (end == TreeEnd::kPlan) monitor_.Offer(grown);
    if (end == TreeEnd::kPlan && plan != nullptr) *plan = std::move(grown);
    return end == TreeEnd::kExhausted;
  }

  // A turn each: another plan from the start, shortened; without footsteps: none was found.
  StepPlan GrowOther(double turn) {
    StepPlan other;
    monitor_.Allow(turn);
    Grow(edges_, &other);
    if (other.ks.empty() || monitor_.stopped()) return other;
    return Shorten(std::move(other));
  }

  size_t Index() const { return coarse_ ? 1 : 0; }  // of a search with Cells()

  // Of A*: in every second round, from the first on, larger ones, which leave fewer states.
  PoseCells Cells() const {
    constexpr double kLarger = 2.5;
    if (!coarse_) return cells_;
    return {.position = kLarger * cells_.position, .yaw = kLarger * cells_.yaw};
  }

  // Whether it has ended by itself.
  bool SearchFewest() {
    std::unique_ptr<FewestSteps>& search = fewest_[Index()];
    if (!search) {
      search =
          std::make_unique<FewestSteps>(request_, starts_, StepSearchOptions{.cells = Cells()},
                                        map_ && coarse_ ? &*map_ : nullptr, &graph_, &monitor_);
    }
    return search->Run();
  }

  // A beam whose cells and weight are drawn: one finds what another leaves out.
  void RunBeam(const StepSearch::ToGo& to_go, double turn) {
    const double root = Uniform(1.0, kRootOfLargest, random_), larger = root * root;
    const BeamOptions options{
        .width = static_cast<int>(kWidth * turn),
        .cells = {.position = larger * cells_.position, .yaw = larger * cells_.yaw},
        .weight = Uniform(1.0, kHeaviest, random_)};
    monitor_.Allow(kOfAState * kWidth * turn);
    SearchBeam(starts_, to_go, options, &graph_, &monitor_);
  }

  StepSearch::ToGo ByLeastCost() const {
    return [this](const StepState& state) {
      const double each = graph_.reach().least_cost(), bound = least_.From(state);
      double guess = bound;
      if (map_) {
        constexpr double kOffTheMap = 1.0;  // [m] more than the bound says
        const double way = map_->Way(state.X_WS.Planar().position());
        guess = std::isfinite(way) ? std::max(guess, least_.per_metre() * way)
                                   : guess + least_.per_metre() * kOffTheMap;
      }
      return StepsToGo{.bound = bound / each, .guess = guess / each};
    };
  }

  // A*, begun anew after it has ended; whether there is nothing better.
  bool SearchWith(double weight) {
    const double before = monitor_.best_cost();
    std::unique_ptr<StepSearch>& search = led_[Index()][weight];
    if (!search) search = Search(ByLeastCost(), weight);
    if (!search->Run()) return false;
    search.reset();
    return monitor_.best_cost() == before;
  }

  // In time only a weight of 1 leaves nothing out.
  std::unique_ptr<StepSearch> Search(StepSearch::ToGo to_go, double weight) {
    std::vector<double> weights = {weight};
    if (edges_ != nullptr) weights.push_back(1.0);
    return std::make_unique<StepSearch>(
        starts_, std::move(to_go),
        StepSearchOptions{.weights = std::move(weights), .cells = Cells()}, &graph_, &monitor_,
        edges_);
  }

  // Near a plan, which tells how far it is to the goal around what stands in between. `better`:
  // what a good plan costs of it.
  StepSearch::ToGo Along(const StepPlan& plan, double better) const {
    constexpr double kNear = 0.4;  // [m] of its states, by StateDistance
    return [this, path = StatesOf(graph_, plan, edges_), cost = plan.cost,
            better](const StepState& state) {
      double guess = std::numeric_limits<double>::infinity();
      for (size_t j = 0; j < path.states.size(); ++j) {
        const Pose2 X_WS = state.X_WS.Planar(), near = path.states[j].X_WS.Planar();
        if ((X_WS.position() - near.position()).squaredNorm() > kNear * kNear) continue;
        const double away = StateDistance(X_WS, near, true);
        if (away > kNear) continue;
        guess = std::min(guess, better * (cost - path.costs[j]) + least_.per_metre() * away);
      }
      const double each = graph_.reach().least_cost(), bound = least_.From(state);
      return StepsToGo{.bound = bound / each, .guess = std::max(bound, guess) / each};
    };
  }

  // A* near a plan.
  std::unique_ptr<StepSearch> SearchNear(const StepPlan& plan) {
    return Search(Along(plan, 0.9), 1.0);
  }

  const PlanRequest& request_;
  const std::vector<StepState>& starts_;
  const RrtOptions& rrt_;
  const PoseCells& cells_;
  StepGraph& graph_;
  PlanMonitor& monitor_;
  std::mt19937_64& random_;
  LeastCost least_;
  std::optional<TimedEdges> in_time_, waiting_;
  TimedEdges* edges_ = nullptr;  // null: not in time
  bool coarse_ = false;
  std::optional<StandMap> map_;
  // By Index().
  std::array<std::unique_ptr<FewestSteps>, 2> fewest_;
  std::array<std::map<double, std::unique_ptr<StepSearch>>, 2> led_;  // and by weight
  // In time.
  std::array<NearPlan, 2> near_best_;  // by Index()
  std::unique_ptr<StepSearch> wait_;
  bool waited_ = false;  // it has ended
};

}  // namespace

PlanResult BestPlanner::Plan(const PlanRequest& request, std::mt19937_64& random) const {
  return PlanWith(
      request, AllElements(request.set),
      [&](const std::vector<StepState>& starts, StepGraph* graph, PlanMonitor* monitor) {
        return BestSearch(request, starts, rrt_, cells_, graph, monitor, &random).Run();
      });
}

}  // namespace halfstep
