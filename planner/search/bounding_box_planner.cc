#include "planner/search/bounding_box_planner.h"

#include <algorithm>
#include <limits>

#include "planner/search/state_buckets.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

// How far the feet still have to go along a path.
class Corridor {
 public:
  Corridor(std::vector<Pose2> path, double width, double feet_apart, const StepGraph& graph)
      : path_(std::move(path)), width_(width), feet_apart_(feet_apart), graph_(graph) {
    left_.assign(path_.size(), 0.0);
    for (size_t j = path_.size() - 1; j > 0; --j) {
      left_[j - 1] = left_[j] + StateDistance(path_[j - 1], path_[j], true);
    }
  }

  StepsToGo operator()(const StepState& state) const {
    const Pose2 X_WM =
        state.X_WS.Planar() * Pose2{0.0, -0.5 * Sign(state.support) * feet_apart_, 0.0};
    double least = std::numeric_limits<double>::infinity();
    size_t nearest = 0;
    for (size_t j = 0; j < path_.size(); ++j) {
      const double way = (path_[j].position() - X_WM.position()).squaredNorm();
      if (way > width_ * width_) continue;
      const double distance = StateDistance(path_[j], X_WM, true);
      if (distance < least) {
        least = distance;
        nearest = j;
      }
    }
    const double bound = graph_.LeastSteps(state);
    if (least > width_) return {bound, std::numeric_limits<double>::infinity()};
    const double per_step = 0.5 * graph_.reach().Distance(2);
    return {bound, std::max(graph_.SteadySteps(state), (left_[nearest] + least) / per_step)};
  }

 private:
  std::vector<Pose2> path_;
  double width_, feet_apart_;
  const StepGraph& graph_;
  std::vector<double> left_;  // from each pose of the path to its end [m]
};

}  // namespace

PlanResult BoundingBoxPlanner::Plan(const PlanRequest& request, std::mt19937_64&) const {
  for (const Foothold& sole : request.start) {
    HALFSTEP_CHECK(sole.height == world_.level(),
                   "a sole at " << sole.height << " m, the box at " << world_.level() << " m");
  }
  return PlanWith(
      request, AllElements(request.set),
      [&](const std::vector<StepState>& starts, StepGraph* graph,
          PlanMonitor* monitor) -> SearchEnd {
        const BoxPath box = FindBoxPath(
            world_, options_.grid, MidFeet(request.start[0].Planar(), request.start[1].Planar()),
            request.goal, graph->workspace(), monitor);
        if (box.stopped) return {.exhausted = false};
        if (box.start_blocked) return {true, "the box around the robot stands in an obstacle"};
        if (box.path.empty()) return {true, "no way for the box around the robot"};
        const Corridor corridor(box.path, options_.corridor, options_.box.feet_apart, *graph);
        StepSearch search(starts, corridor, options_.steps, graph, monitor);
        return {search.Run(), "no footsteps along the way of the box"};
      });
}

}  // namespace halfstep
