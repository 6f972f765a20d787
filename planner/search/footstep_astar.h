#pragma once

#include <vector>

#include "planner/search/footstep_planner.h"
#include "planner/search/step_search.h"

namespace halfstep {

/// Weighted A* over all elements of the set or over a few of them; anytime, by searching again with
/// smaller and smaller weights. Cost to go: the least number of footsteps that any sequence of
/// elements needs for the distance and the turn that are left, times the least cost of an element;
/// so it never exceeds the true one, for every kind of cost. Does not use `random`.
class FootstepAStar : public FootstepPlanner {
 public:
  /// Which elements are used: all, or a small set as of earlier planners (ClassicElements).
  enum class Elements { kAll, kClassic };
  /// Weights and cells hold for both kinds.
  FootstepAStar(Elements elements, const StepSearchOptions& options)
      : elements_(elements), options_(options) {}

  PlanResult Plan(const PlanRequest& request, std::mt19937_64& random) const override;
  bool knows_time() const override { return true; }

 private:
  Elements elements_;
  StepSearchOptions options_;
};

/// The elements of a set that are nearest to 14 classic steps: ahead far, half and none; back; to
/// the side near, middle and far; each way round by half and in full; and the diagonals between.
/// Fewer when two of them share an element. Sorted.
std::vector<int> ClassicSubset(const StepSet& set);

}  // namespace halfstep
