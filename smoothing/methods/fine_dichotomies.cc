#include "smoothing/methods/fine_dichotomies.h"

#include <array>
#include <utility>
#include <vector>

#include "smoothing/methods/dichotomy.h"
#include "wpg/nth.h"

namespace halfstep {

FineDichotomies RunFineDichotomies(const WalkProblem& problem, double tolerance, bool from_start,
                                   SmoothingMonitor& monitor) {
  std::vector<HomotopyParameters> starts = {monitor.incumbent()};
  if (from_start) starts.push_back(problem.Start());
  // Each has one thread, since workers serve one call at a time; two walks are more to share out
  // than the intervals of a proof. The caller hears of progress from its own thread only.
  const bool shared = monitor.workers() != nullptr && starts.size() > 1;
  std::array<SmoothingResult, 2> results;
  RunWith(monitor.workers(), static_cast<int>(starts.size()), [&](int index, int) {
    MonitorOptions part = monitor.Part(0.9, 1.0);
    if (shared) {
      part.workers = nullptr;
      part.progress = {};
    }
    SmoothingMonitor within(std::move(part));
    Nth(results, index) =
        Dichotomy(problem, {.tolerance = tolerance, .start = Nth(starts, index)}, within);
    return true;
  });
  FineDichotomies found{.from_incumbent = std::move(results[0]), .from_start = std::nullopt};
  if (from_start) found.from_start = std::move(results[1]);
  return found;
}

void TakeSearch(const SmoothingResult& found, bool from_incumbent, SmoothingMonitor& monitor) {
  monitor.Count(found);
  if (!found.accepted || (!from_incumbent && !(found.cost < monitor.cost()))) return;
  const double before = monitor.cost();
  for (SmoothingIterate iterate : found.iterates) {
    if (iterate.incumbent_duration > before) continue;
    iterate.wall += monitor.Seconds() - found.wall;
    iterate.instants += monitor.instants() - found.instants;
    monitor.result().iterates.push_back(iterate);
  }
  monitor.Adopt(*found.accepted, found.cost, found.cost);
  monitor.result().junctions = found.junctions;
}

}  // namespace halfstep
