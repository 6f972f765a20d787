#include "smoothing/methods/dichotomy.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "smoothing/methods/accepted_in_parts.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/check.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using opt::Ending;

class Bisection {
 public:
  Bisection(const WalkProblem& problem, const DichotomyOptions& options, SmoothingMonitor& monitor)
      : problem_(problem),
        options_(options),
        monitor_(monitor),
        table_(problem.Parameters()),
        rests_(problem.scene().rests()),
        walk_(problem.sequence(), options.accepted_start
                                      ? options.accepted_start->parameters()
                                      : options.start.value_or(problem.Start())) {}

  SmoothingResult Run() {
    if (options_.accepted_start) {
      monitor_.BeginAccepted(problem_, *options_.accepted_start);
    } else if (!monitor_.BeginFeasibly(problem_, walk_.parameters())) {
      return Finish(monitor_.Refusal());
    }
    const int n = problem_.sequence().num_junctions();
    for (int pass = 0; pass < options_.passes; ++pass) {
      for (int k = 0; k < n; ++k) {
        const bool forward = options_.order == DichotomyOptions::Order::kLeftToRight;
        if (!BisectJunction(forward ? k : n - 1 - k)) {
          const bool tried = !monitor_.result().iterates.empty();
          return Finish(tried ? monitor_.StopEnding() : Ending::kNotRun,
                        monitor_.StopReason() + "; the overlaps found so far are feasible");
        }
        monitor_.Progress(static_cast<double>(pass * n + k + 1) / (options_.passes * n));
      }
    }
    return Finish(Ending::kConverged,
                  Formatted("every junction bisected to %f s", options_.tolerance));
  }

 private:
  double CapOf(int junction) const {
    return KindOfJunction(junction) == JunctionKind::kUpDown ? options_.up_down_cap
                                                             : options_.down_up_cap;
  }

  // False when the search is to end.
  bool BisectJunction(int junction) {
    const HomotopyParameters& at = walk_.parameters();
    const double feasible = Nth(at.overlaps, junction);
    double highest = CapOf(junction) * NaturalOverlapBound(at, junction);
    if (feasible >= highest || !table_.free({ParameterFamily::kOverlap, junction})) {
      return !monitor_.stopped();
    }
    Nth(monitor_.result().junctions, junction).limited_by.reset();
    if (options_.cheaper) highest = Bisect(junction, feasible, highest, *options_.cheaper);
    if (highest > feasible) Bisect(junction, feasible, highest, problem_.test());
    return !monitor_.stopped();
  }

  // Leaves the walk at the largest overlap of [feasible, highest] that is found, and returns it.
  double Bisect(int junction, double feasible, double highest, const FeasibilityTest& test) {
    // The bound itself first; after that only what lies between counts.
    std::optional<Margin> refused = Try(junction, highest, test);
    if (!refused) return highest;
    double infeasible = highest;
    while (infeasible - feasible > options_.tolerance && !monitor_.stopped()) {
      const double middle = 0.5 * (feasible + infeasible);
      const std::optional<Margin> refusal = Try(junction, middle, test);
      if (refusal) {
        infeasible = middle;
        refused = refusal;
      } else {
        feasible = middle;
      }
    }
    walk_.SetOverlap(junction, feasible);
    Nth(monitor_.result().junctions, junction).limited_by = refused;
    return feasible;
  }

  // Leaves the walk at the candidate and returns what refuses it, if anything does. What only the
  // cheaper test accepts is no result yet.
  std::optional<Margin> Try(int junction, double candidate, const FeasibilityTest& test) {
    walk_.SetOverlap(junction, candidate);
    // Just before t_{i+1}: an interval that ends there is cut anew, also where e_i = t_{i+2} and
    // the span would be a whole stretch.
    // All that comes later meets the obstacles earlier, which matters where they move.
    const double begin = std::nextafter(walk_.start_of(junction + 1), -1.0);
    const bool local = rests_ || problem_.scene().OnlyGrowsFrom(begin);
    const TimeSpan span{begin, local ? walk_.end_of(junction) : walk_.duration()};
    const Feasibility answer = test.Check(walk_, span, monitor_.scratch());
    const bool accepted = answer.verdict == Verdict::kFeasible;
    if (&test != &problem_.test()) return accepted ? std::nullopt : std::optional(answer.witness);
    if (accepted) {
      monitor_.Adopt(AcceptedInParts::Walk(walk_.parameters()), walk_.duration(), walk_.duration());
    }
    SmoothingIterate iterate{.candidate_duration = walk_.duration(),
                             .accepted = accepted,
                             .lambda = accepted ? 1.0 : 0.0};
    if (answer.verdict == Verdict::kViolated) {
      iterate.candidate_worst_margin = problem_.limits().Slack(answer.witness);
    }
    monitor_.Record(std::move(iterate));
    if (accepted) return std::nullopt;
    return answer.witness;
  }

  SmoothingResult Finish(Ending ending, const std::string& message) {
    return Finish(monitor_.FinishAgainstStart(ending, message, "; none could be made longer"));
  }
  SmoothingResult Finish(SmoothingResult result) const {
    for (size_t i = 0; i < result.junctions.size(); ++i) {
      result.junctions[i].upper_bound *= CapOf(static_cast<int>(i));
    }
    return result;
  }

  const WalkProblem& problem_;
  const DichotomyOptions& options_;
  SmoothingMonitor& monitor_;
  ParameterTable table_;
  bool rests_;  // the scene; asking costs as much as there are obstacles
  SuperposedWalk walk_;
};

}  // namespace

SmoothingResult Dichotomy(const WalkProblem& problem, const DichotomyOptions& options,
                          SmoothingMonitor& monitor) {
  HALFSTEP_CHECK(options.tolerance > 0.0 && options.passes >= 0,
                 "tolerance = " << options.tolerance << ", passes = " << options.passes);
  HALFSTEP_CHECK(options.up_down_cap >= 0.0 && options.up_down_cap <= 1.0 &&
                     options.down_up_cap >= 0.0 && options.down_up_cap <= 1.0,
                 "caps " << options.up_down_cap << ", " << options.down_up_cap);
  return Bisection(problem, options, monitor).Run();
}

}  // namespace halfstep
