#include "smoothing/methods/window_search.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "smoothing/methods/incumbent.h"
#include "smoothing/methods/search_pace.h"
#include "smoothing/methods/search_rounds.h"

namespace halfstep {
namespace {

// Fewer than in a search over the whole walk, which has to last longer.
constexpr int kInstantsOfRows = 16;
constexpr int kPoorRounds = 2;
// Rounds go on up to most_rounds as long as their ends fall by more than this [of their cost].
constexpr double kFalling = 0.01;

ProgramOptions OfWindow(const WalkWindow& window, const ProgramOptions& options,
                        const opt::SolverTraits& traits) {
  ProgramOptions own = options;
  own.watch.range = {window.proved_first, window.proved_last};
  own.watch = RowsFor(traits, window.problem.test(), kInstantsOfRows, own.watch);
  return own;
}

// What a round ends with: the solver's last point, or its best where the last one is hopeless. `x`
// belongs to the solution.
struct RoundEnd {
  const Eigen::VectorXd& x;
  double cost, violation;
};

RoundEnd EndOf(const opt::Solution& solution) {
  const bool near =
      solution.final_x.size() == solution.x.size() && solution.final_violation < kHopeless;
  return near ? RoundEnd{solution.final_x, solution.final_cost, solution.final_violation}
              : RoundEnd{solution.x, solution.cost, solution.max_violation};
}

// The rounds of SearchWindow; all is borrowed.
class WindowRounds {
 public:
  WindowRounds(const WalkWindow& window, const WindowSearchOptions& options,
               const opt::Solver& solver, SmoothingMonitor& monitor, const WindowGain& gained,
               OverlapProgram* program)
      : options_(options),
        solver_(solver),
        monitor_(monitor),
        gained_(gained),
        program_(*program),
        sequence_(window.problem.sequence()),
        proofs_(window.problem.test(), sequence_.size(), {window.proved_first, window.proved_last}),
        begun_(program_.Cost(window.parameters)),
        path_(sequence_, DemandedRules(program_, &proofs_), window.parameters, begun_,
              monitor.scratch()),
        x_(program_.ToVariables(options.start.value_or(window.parameters))) {
    proofs_.Remember(SuperposedWalk(sequence_, window.parameters));
  }

  void Run(double deadline, SearchEnding* ending) {
    if (options_.start) TryStart();
    for (int round = 0; !pace_.over() || (falling_ && round < options_.most_rounds); ++round) {
      const double remaining = std::min(deadline - monitor_.Seconds(), monitor_.Remaining());
      if (remaining <= 0.0 || monitor_.stopped() || !Solve(remaining, ending)) return;
      const RoundEnd end = EndOf(solution_);
      x_ = end.x;
      const double end_before = std::exchange(end_cost_, end.cost);
      falling_ = end_cost_ < (1.0 - kFalling) * end_before;
      TryEnd(end.violation, MayBeLast(round));
    }
  }

 private:
  void TryStart() {
    const OverlapVariables& variables = program_.variables();
    x_ = x_.cwiseMax(variables.lower()).cwiseMin(variables.upper());
    if (path_.Toward(program_.ToParameters(x_), kAttempts) > 0.0) {
      gained_(path_.parameters(), begun_ - path_.cost());
    }
  }

  // False when the solver has no point.
  bool Solve(double seconds, SearchEnding* ending) {
    const opt::SolverTraits traits = solver_.traits();
    const opt::Problem problem = program_.MakeProblem();
    opt::SolverOptions round = RoundOptions(traits, options_.program.kind, traits.iterations);
    round.deadline = seconds;
    round.stop = monitor_.stop();
    round.warm_start = solution_.warm_start;
    solution_ = solver_.Solve(problem, x_, round);
    ending->Note(solution_);
    return solution_.x.size() == x_.size();
  }

  bool MayBeLast(int round) const {
    const bool goes_on =
        round + 1 < options_.rounds || (falling_ && round + 1 < options_.most_rounds);
    return !goes_on || round + 1 == options_.rounds || pace_.poor() + 1 == kPoorRounds;
  }

  // Moves the incumbent towards x if that is worth a proof; the program learns what refused it.
  void TryEnd(double violation, bool last) {
    const double before = path_.cost();
    const HomotopyParameters end = program_.ToParameters(x_);
    const SuperposedWalk walk(sequence_, end);
    const bool promising = program_.watched().Focus(walk, kLookPeriod, 0.0) >= kPromising;
    const bool tried = violation <= kHopeless && (promising || last);
    const double lambda = tried ? path_.Toward(end, kAttempts) : 0.0;
    const bool refused = !promising || !tried || !path_.refusals().empty();
    if (refused) ++monitor_.result().raw_infeasible;
    if (tried) {
      for (const Margin& refusal : path_.refusals()) {
        program_.watched().Learn(walk, refusal.at, refusal.stop_after >= 0);
      }
    }
    if (lambda > 0.0) gained_(path_.parameters(), begun_ - path_.cost());
    SmoothingIterate record{.candidate_duration = monitor_.duration() + DurationOf(end) -
                                                  DurationOf(path_.parameters()),
                            .accepted = lambda > 0.0,
                            .lambda = lambda};
    if (violation > 0.0) record.candidate_worst_margin = -violation;
    monitor_.Record(record);
    pace_.Note(end_cost_, before, path_.cost());
    AdaptRows(tried, tried ? path_.refusals() : std::vector<Margin>(), &program_.watched());
  }

  const WindowSearchOptions& options_;
  const opt::Solver& solver_;
  SmoothingMonitor& monitor_;
  const WindowGain& gained_;
  OverlapProgram& program_;
  const HalfStepSequence& sequence_;
  StretchProofs proofs_;
  double begun_;  // what the window's own parameters cost
  Incumbent path_;
  Eigen::VectorXd x_;  // where the next round begins
  opt::Solution solution_;
  SearchPace pace_{options_.rounds, kPoorRounds};
  double end_cost_ = begun_;
  bool falling_ = false;  // the ends of rounds
};

}  // namespace

void SearchWindow(const WalkWindow& window, const WindowSearchOptions& options,
                  const opt::Solver& solver, double deadline, SmoothingMonitor& monitor,
                  const WindowGain& gained, SearchEnding* ending) {
  const WalkProblem& part = window.problem;
  OverlapProgram program(part.sequence(), part.evaluator(),
                         OfWindow(window, options.program, solver.traits()), 0.0, part.fixed());
  if (program.variables().size() == 0) return;
  program.watched().SetWorkers(monitor.workers());
  ResetRows(program.watched().sharpness(), 1.0, &program.watched());
  WindowRounds(window, options, solver, monitor, gained, &program).Run(deadline, ending);
}

}  // namespace halfstep
