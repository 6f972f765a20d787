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

}  // namespace

void SearchWindow(const WalkWindow& window, const WindowSearchOptions& options,
                  const opt::Solver& solver, double deadline, SmoothingMonitor& monitor,
                  const WindowGain& gained, SearchEnding* ending) {
  const WalkProblem& part = window.problem;
  const HalfStepSequence& sequence = part.sequence();
  const opt::SolverTraits traits = solver.traits();
  OverlapProgram program(sequence, part.evaluator(), OfWindow(window, options.program, traits), 0.0,
                         part.fixed());
  if (program.variables().size() == 0) return;
  program.watched().SetWorkers(monitor.workers());
  ResetRows(program.watched().sharpness(), 1.0, &program.watched());
  StretchProofs proofs(part.test(), sequence.size(), {window.proved_first, window.proved_last});
  proofs.Remember(SuperposedWalk(sequence, window.parameters));
  const double begun = program.Cost(window.parameters);
  Incumbent path(sequence, DemandedRules(program, &proofs), window.parameters, begun,
                 monitor.scratch());
  Eigen::VectorXd x = program.ToVariables(options.start.value_or(window.parameters));
  if (options.start) {
    const OverlapVariables& variables = program.variables();
    x = x.cwiseMax(variables.lower()).cwiseMin(variables.upper());
    if (path.Toward(program.ToParameters(x), kAttempts) > 0.0) {
      gained(path.parameters(), begun - path.cost());
    }
  }
  opt::Solution solution;
  SearchPace pace(options.rounds, kPoorRounds);
  double end_cost = begun;
  bool falling = false;
  for (int round = 0; !pace.over() || (falling && round < options.most_rounds); ++round) {
    const double remaining = std::min(deadline - monitor.Seconds(), monitor.Remaining());
    if (remaining <= 0.0 || monitor.stopped()) return;
    const opt::Problem problem = program.MakeProblem();
    opt::SolverOptions solver_options =
        RoundOptions(traits, options.program.kind, traits.iterations);
    solver_options.deadline = remaining;
    solver_options.stop = monitor.stop();
    solver_options.warm_start = solution.warm_start;
    solution = solver.Solve(problem, x, solver_options);
    ending->Note(solution);
    if (solution.x.size() != x.size()) return;
    const bool near = solution.final_x.size() == x.size() && solution.final_violation < kHopeless;
    x = near ? solution.final_x : solution.x;
    const double end_before = std::exchange(end_cost, near ? solution.final_cost : solution.cost);
    falling = end_cost < (1.0 - kFalling) * end_before;
    const double violation = near ? solution.final_violation : solution.max_violation;
    const double before = path.cost();
    const HomotopyParameters end = program.ToParameters(x);
    const SuperposedWalk walk(sequence, end);
    const bool promising = program.watched().Focus(walk, kLookPeriod, 0.0) >= kPromising;
    const bool goes_on = round + 1 < options.rounds || (falling && round + 1 < options.most_rounds);
    const bool last = !goes_on || round + 1 == options.rounds || pace.poor() + 1 == kPoorRounds;
    const bool tried = violation <= kHopeless && (promising || last);
    const double lambda = tried ? path.Toward(end, kAttempts) : 0.0;
    const bool refused = !promising || !tried || !path.refusals().empty();
    if (refused) ++monitor.result().raw_infeasible;
    if (tried) {
      for (const Margin& refusal : path.refusals()) {
        program.watched().Learn(walk, refusal.at, refusal.stop_after >= 0);
      }
    }
    if (lambda > 0.0) gained(path.parameters(), begun - path.cost());
    SmoothingIterate record{
        .candidate_duration = monitor.duration() + DurationOf(end) - DurationOf(path.parameters()),
        .accepted = lambda > 0.0,
        .lambda = lambda};
    if (violation > 0.0) record.candidate_worst_margin = -violation;
    monitor.Record(record);
    pace.Note(end_cost, before, path.cost());
    AdaptRows(tried, tried ? path.refusals() : std::vector<Margin>(), &program.watched());
  }
}

}  // namespace halfstep
