#include "smoothing/methods/improve_ahead.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "opt/adapters/solver_registry.h"
#include "smoothing/methods/accepted_in_parts.h"
#include "smoothing/methods/window_search.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

// Half-steps behind a window that may be under way with the last of it, and one more so that the
// stretch of the last of these ends where it does. Even.
constexpr int kBehind = 4;

// The first `count` half-steps of a walk; count is even.
WalkPlan Beginning(const WalkPlan& walk, int count) {
  WalkPlan beginning = walk;
  beginning.sequence.half_steps.resize(static_cast<size_t>(count));
  for (const ParameterFamily family : AllParameterFamilies()) {
    beginning.parameters.of(family).resize(
        static_cast<size_t>(Traits(family).count(beginning.sequence)));
  }
  return beginning;
}

}  // namespace

std::optional<HomotopyParameters> ImproveAhead(const WalkPlan& walk,
                                               std::shared_ptr<const FeasibilityTest> test,
                                               int first, const AheadOptions& options,
                                               SmoothingMonitor& monitor) {
  const int n = walk.sequence.size();
  HALFSTEP_CHECK(first >= 0 && first < n, "half-step " << first << " of " << n);
  HALFSTEP_CHECK(options.window >= 2 && options.window % 2 == 0, "window = " << options.window);
  const int begin = (first + 1) / 2 * 2;  // whole steps
  if (begin >= n) return std::nullopt;
  const int last = std::min(begin + options.window, n) - 1;
  const bool local = test->evaluator().scene().OnlyGrowsFrom(walk.Walk().start_of(begin));
  const int count = local ? std::min(n, last + 1 + kBehind) : n;
  const WalkPlan part = Beginning(walk, count);
  const WalkProblem problem(part.sequence, std::move(test));
  // The part begins when the walk does, so that obstacles are met at their times.
  WalkWindow window = WindowOf(problem, part.parameters, begin, last, /*keeps_begin=*/true);
  if (window.begin + window.proved_last + 1 == count && count < n) --window.proved_last;
  monitor.BeginAccepted(window.problem, AcceptedInParts::Walk(window.parameters));
  HomotopyParameters found = walk.parameters;
  double gained = 0.0;
  SearchEnding ending;
  WindowSearchOptions search{.program = {}, .rounds = options.rounds};
  search.program.parameters = options.choice;
  SearchWindow(
      window, search, *opt::MakeSolver(options.solver), std::numeric_limits<double>::infinity(),
      monitor,
      [&](const HomotopyParameters& of_window, double gain) {
        window.Paste(of_window, &found);
        gained = gain;
      },
      &ending);
  if (gained < options.least_gain) return std::nullopt;
  return found;
}

}  // namespace halfstep
