#include "smoothing/methods/overlap_optimizer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "opt/adapters/solver_registry.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/fine_dichotomies.h"
#include "smoothing/methods/incumbent.h"
#include "smoothing/methods/overlap_prices.h"
#include "smoothing/methods/search_ending.h"
#include "smoothing/methods/search_pace.h"
#include "smoothing/methods/search_rounds.h"
#include "smoothing/methods/shortened_start.h"

namespace halfstep {
namespace {

// Of the dichotomy before a search that is to shorten the walk anyway [s]; the larger one for
// solvers that take long steps.
constexpr double kNearStart = 0.1, kFarStart = 0.5;
// A solver's iterates between two proofs, in rounds that are longer.
constexpr int kPatience = 10;
// Instants a half-step where each has rows of its own.
constexpr int kRowsInstants = 24;
// The same where it is asked how far half-steps may be shortened.
constexpr int kShorteningInstants = 8;
// The end of a round is tried although samples show that it is not feasible, after so many rounds
// of which none was tried: most of a long walk may be feasible.
constexpr int kUntriedRounds = 4;
// Every other one of them keeps so much more in reserve at first, so that it goes another way.
constexpr double kMoreReserve = 5.0;
// A search that does not beat a plain dichotomy by this has found nothing [s].
constexpr double kGainedTime = 1e-9;

// How long a search goes on.
struct Effort {
  int poor_rounds;  // in a row end the rounds from a start
  bool repeats;     // from the incumbent, as long as that gains
  bool compares;    // with fine dichotomies, at last
};
constexpr Effort kWhole = {5, true, true};
// Before a search over more families, which goes on from what it finds.
constexpr Effort kBefore = {2, false, false};
// There is at most one search from the incumbent for so many rounds that each start may have.
constexpr int kRoundsARepeat = 4;

// What to search over first: without footsteps where half-steps have forms, too; else with every
// form and footstep as planned.
ParameterChoice FewerFamilies(const ParameterChoice& choice) {
  ParameterChoice standing = choice;
  standing.footsteps = false;
  const bool has_forms = standing != WithoutForms(standing);
  return choice.footsteps && has_forms ? standing : WithoutForms(choice);
}

class Optimization {
 public:
  Optimization(const WalkProblem& problem, const OptimizerOptions& options,
               const opt::Solver& solver, const Effort& effort, SmoothingMonitor& monitor)
      : problem_(problem),
        sequence_(problem.sequence()),
        test_(problem.test()),
        options_(options),
        solver_(solver),
        effort_(effort),
        monitor_(monitor),
        proofs_(test_, sequence_.size()),
        end_{.solver = options.solver,
             .kept = options.start ? "the walk is what it started from"
                                   : "the walk is a dichotomy's"} {}

  SmoothingResult Run() {
    if (options_.deadline <= monitor_.Remaining()) end_.deadline = options_.deadline;
    monitor_.Begin(problem_, options_.start.value_or(problem_.Start()));
    DichotomyOptions dichotomy{.tolerance = StartTolerance()};
    if (options_.start) {
      dichotomy.start = options_.start;
      dichotomy.passes = 0;
    }
    Take(RunDichotomy(dichotomy, 0.0, 0.2));
    if (!monitor_.result().feasible || monitor_.stopped()) {
      NoteStop();
      return monitor_.Finish(end_.Ending(),
                             monitor_.result().feasible ? end_.Sentence() : start_message_);
    }
    const ParameterChoice fewer = FewerFamilies(options_.program.parameters);
    if (Fastest() && fewer != options_.program.parameters) {
      const SmoothingResult found = SearchFirst(fewer);
      if (monitor_.stopped()) return monitor_.Finish(found.ending, found.message);
    }
    start_ = monitor_.incumbent();

    const double own = DurationOf(start_);
    const double limit = options_.duration_limit > 0.0 ? options_.duration_limit : own;
    OverlapProgram program(sequence_, test_.evaluator(), options_.program, limit, problem_.fixed());
    program.watched().SetWorkers(monitor_.workers());
    const bool within = own <= limit + 1e-9;
    Incumbent::Rules rules =
        Safest() ? SafestRules(program, test_, within) : DemandedRules(program, &proofs_);
    // The dichotomy's walk is proved with what is demanded: slack 0.
    const double cost = !Safest() ? program.Cost(start_)
                        : within  ? 0.0
                                  : std::numeric_limits<double>::infinity();
    monitor_.Adopt(start_, cost, own);
    proofs_.Remember(SuperposedWalk(sequence_, start_));
    Incumbent path(sequence_, rules, start_, cost, monitor_.scratch());
    Search(program, &path);
    return Conclude(program, path);
  }

 private:
  bool Safest() const { return options_.program.kind == ProgramKind::kSafest; }
  bool Fastest() const { return options_.program.kind == ProgramKind::kFastest; }

  // Of the dichotomy before the search. `safest` and `smooth` compare with the fine one's result.
  double StartTolerance() const {
    if (!Fastest()) return options_.tolerance;
    return std::max(options_.tolerance, solver_.traits().long_steps ? kFarStart : kNearStart);
  }

  SmoothingResult RunDichotomy(const DichotomyOptions& options, double from, double to) {
    SmoothingMonitor within(monitor_.Part(from, to));
    SmoothingResult result = Dichotomy(problem_, options, within);
    monitor_.Count(result);
    return result;
  }

  // A dichotomy's walk becomes the incumbent, with its candidates.
  void Take(const SmoothingResult& dichotomy) {
    start_message_ = dichotomy.message;
    SmoothingResult& result = monitor_.result();
    result.iterates = dichotomy.iterates;
    if (dichotomy.feasible) {
      monitor_.Adopt(dichotomy.parameters, DurationOf(dichotomy.parameters),
                     DurationOf(dichotomy.parameters));
    }
    result.junctions = dichotomy.junctions;
    result.time_to_first_improvement = dichotomy.time_to_first_improvement;
  }

  // The same search over fewer families, from the incumbent. With all of them at once the solver
  // can miss walks that it finds when it begins at the best walk of fewer.
  SmoothingResult SearchFirst(const ParameterChoice& families) {
    OptimizerOptions options = options_;
    options.program.parameters = families;
    options.start = monitor_.incumbent();
    options.deadline = 0.5 * (options_.deadline - monitor_.Seconds());
    const double before = monitor_.cost();
    SmoothingMonitor within(monitor_.Part(search_from_, 0.5));
    SmoothingResult found = Optimization(problem_, options, solver_, kBefore, within).Run();
    search_from_ = 0.5;
    TakeSearch(found, /*from_incumbent=*/false, monitor_);
    if (HasOwnResult(found.ending) && monitor_.cost() < before) {
      own_with_fewer_ = true;
      end_.kept = "the walk is the search's over fewer families";
    }
    return found;
  }

  // The slack that the program asks for at x: z ≥ 0 of `safest`.
  double Level(const Eigen::VectorXd& x) const {
    return Safest() ? std::max(0.0, x.tail(1)[0]) : 0;
  }

  void Search(OverlapProgram& program, Incumbent* path) {
    std::vector<HomotopyParameters> starts = {start_};
    if (options_.planned_start) starts.push_back(Fastest() ? Shortened() : problem_.Start());
    AddRandomPoints(program, options_.random_starts, options_.seed, &starts);
    for (size_t s = 0; s < starts.size(); ++s) {
      const double part = static_cast<double>(s) / static_cast<double>(starts.size());
      if (!SearchFrom(program, starts[s], part, 1.0, path)) return;
    }
    // Where rounds lead into what cannot be mended, the incumbent, which has come a part of the
    // way, is a place to set out from again.
    const int repeats = effort_.repeats ? options_.rounds / kRoundsARepeat : 0;
    int poor = 0;
    for (int again = 0; again < repeats && poor < 2 && path->accepted() > 0; ++again) {
      const double before = path->cost(), reserve = again % 2 == 0 ? 1.0 : kMoreReserve;
      if (!SearchFrom(program, path->parameters(), 1.0, reserve, path)) return;
      poor = SearchPace::Gained(before, path->cost()) ? 0 : poor + 1;
    }
  }

  // Rounds from `start` until they gain next to nothing; `part`: of the search that is done;
  // `reserve`: how much more than usual the first round's rows keep. False: there is to be no
  // further one.
  bool SearchFrom(OverlapProgram& program, const HomotopyParameters& start, double part,
                  double reserve, Incumbent* path) {
    ResetRows(options_.program.watch.sharpness, reserve, &program.watched());
    solution_.warm_start = nullptr;
    Eigen::VectorXd x = program.ToVariables(start);
    SearchPace pace(options_.rounds, effort_.poor_rounds);
    for (int round = 0; !pace.over(); ++round) {
      const double before = path->cost();
      const double remaining =
          std::min(options_.deadline - monitor_.Seconds(), monitor_.Remaining());
      end_.deadline_passed = remaining <= 0.0;
      if (end_.deadline_passed || monitor_.stopped()) return false;
      solution_ = Solve(program, x, remaining, path);
      end_.Note(solution_);
      const bool refused = solution_.ending == opt::Ending::kInvalidInput;
      if (refused || solution_.x.size() != x.size()) return false;
      // Cheap and nearly feasible is a better place to go on from than the best feasible one.
      const bool near =
          solution_.final_x.size() == x.size() && solution_.final_violation < kHopeless;
      x = near ? solution_.final_x : solution_.x;
      const bool last = monitor_.Seconds() >= options_.deadline || round + 1 == options_.rounds ||
                        untried_rounds_ + 1 >= kUntriedRounds;
      const bool tried = LookAt(program, x, near, last, path);
      pace.Note(near ? solution_.final_cost : solution_.cost, before, path->cost());
      AdaptRows(tried, tried ? path->refusals() : std::vector<Margin>(), &program.watched());
      monitor_.Progress(search_from_ + (0.9 - search_from_) * part);
    }
    end_.exhausted = end_.exhausted || pace.exhausted();
    return true;
  }

  // The planned motion at the durations that a look at a few instants allows.
  HomotopyParameters Shortened() const {
    ProgramOptions coarse = options_.program;
    coarse.watch.instants = kShorteningInstants;
    coarse.watch.row_per_instant = false;
    OverlapProgram program(sequence_, test_.evaluator(), coarse, 0.0, problem_.fixed());
    program.watched().SetWorkers(monitor_.workers());
    return ShortenedStart(program, problem_.Start());
  }

  // Tries the end of a round where it looks good, or `always`; the program learns where to look.
  // False: it was not tried.
  bool LookAt(OverlapProgram& program, const Eigen::VectorXd& x, bool near, bool always,
              Incumbent* path) {
    const HomotopyParameters end = program.ToParameters(x);
    const SuperposedWalk walk(sequence_, end);
    const bool promising = program.watched().Focus(walk, kLookPeriod, Level(x)) >= kPromising;
    SmoothingResult& result = monitor_.result();
    untried_rounds_ = promising || always ? 0 : untried_rounds_ + 1;
    if (!promising && !always) {
      ++result.raw_infeasible;
      result.raw_end_feasible = false;
      return false;
    }
    const double violation = near ? solution_.final_violation : solution_.max_violation;
    const bool tried = Try(end, violation, always, program, path);
    result.raw_end_feasible = tried && path->refusals().empty();
    if (!tried) return false;
    for (const Margin& refusal : path->refusals()) {
      program.watched().Learn(walk, refusal.at, refusal.stop_after >= 0);
    }
    return true;
  }

  opt::Solution Solve(const OverlapProgram& program, const Eigen::VectorXd& x, double deadline,
                      Incumbent* path) {
    const opt::Problem problem = program.MakeProblem();
    opt::SolverOptions solver_options =
        RoundOptions(solver_.traits(), options_.program.kind, options_.max_iterations);
    solver_options.deadline = deadline;
    solver_options.stop = monitor_.stop();
    solver_options.warm_start = solution_.warm_start;
    solver_options.on_iterate = [&](const opt::Iterate& iterate) {
      const HomotopyParameters candidate = program.ToParameters(iterate.x);
      const bool wait = options_.max_iterations < kPatience || ++since_proof_ < kPatience;
      if (wait) {
        Record(candidate, iterate.violation, 0.0);
      } else {
        Try(candidate, iterate.violation, false, program, path);
      }
      return true;
    };
    return solver_.Solve(problem, x, solver_options);
  }

  // Proves the candidate, or what of it is near the incumbent where it is refused; `always`: also
  // where it is violated so much that all of it is hardly feasible. False: it is not tried.
  bool Try(const HomotopyParameters& candidate, double violation, bool always,
           const OverlapProgram& program, Incumbent* path) {
    since_proof_ = 0;
    const bool tried = always || violation <= kHopeless;
    const double lambda = tried ? path->Toward(candidate, kAttempts) : 0.0;
    if (!tried || !path->refusals().empty()) ++monitor_.result().raw_infeasible;
    if (lambda > 0.0) {
      monitor_.Adopt(path->parameters(), path->cost(), DurationOf(path->parameters()));
      std::array<bool, kNumMarginFamilies> all;
      all.fill(true);
      incumbent_slack_ = program.watched().LeastSlack(path->parameters(), all);
    }
    Record(candidate, violation, lambda);
    return tried;
  }

  void Record(const HomotopyParameters& candidate, double violation, double lambda) {
    SmoothingIterate record{.candidate_duration = DurationOf(candidate),
                            .accepted = lambda > 0.0,
                            .lambda = lambda,
                            .incumbent_slack = incumbent_slack_};
    if (violation > 0.0) record.candidate_slack = -violation;
    monitor_.Record(record);
  }

  SmoothingResult Conclude(const OverlapProgram& program, const Incumbent& path) {
    // Safest walks were proved whole, the others stretch by stretch.
    if (path.accepted() > 0 && (Safest() || HoldsWhole(path.parameters()))) {
      end_.own = true;
    } else if (path.accepted() > 0) {
      monitor_.Adopt(start_, program.Cost(start_), DurationOf(start_));
    }
    end_.own = end_.own || own_with_fewer_;
    for (JunctionResult& junction : monitor_.result().junctions) {
      if (!Fastest() || monitor_.stopped()) junction.limited_by.reset();
    }
    if (effort_.compares && Fastest() && !monitor_.stopped()) {
      const FineDichotomies fine =
          RunFineDichotomies(problem_, options_.tolerance, !options_.start, monitor_);
      TakeSearch(fine.from_incumbent, /*from_incumbent=*/true, monitor_);
      if (fine.from_start) {
        const bool same = monitor_.incumbent() == problem_.Start();
        TakeSearch(*fine.from_start, same, monitor_);
        end_.own = end_.own && monitor_.cost() < fine.from_start->cost - kGainedTime;
      }
    }
    if (!Safest()) AddMultipliers(program, monitor_.incumbent(), &monitor_.result().junctions);
    NoteStop();
    std::string message = end_.Sentence();
    if (Safest() && !std::isfinite(monitor_.cost())) {
      message += "; no walk of at most " + std::to_string(program.duration_limit()) +
                 " s was proved, the dichotomy's is kept";
    }
    return monitor_.Finish(end_.Ending(), message);
  }

  void NoteStop() {
    end_.stopped = monitor_.interrupted();
    end_.deadline_passed = end_.deadline_passed || (monitor_.stopped() && !end_.stopped);
  }

  bool HoldsWhole(const HomotopyParameters& parameters) {
    const SuperposedWalk walk(sequence_, parameters);
    MarginEvaluator::Scratch scratch = test_.evaluator().MakeScratch();
    scratch.stop = monitor_.scratch()->stop;
    scratch.workers = monitor_.workers();
    return test_.Check(walk, {0.0, walk.duration()}, &scratch).verdict == Verdict::kFeasible;
  }

  const WalkProblem& problem_;
  const HalfStepSequence& sequence_;
  const FeasibilityTest& test_;
  const OptimizerOptions& options_;
  const opt::Solver& solver_;
  const Effort& effort_;
  SmoothingMonitor& monitor_;
  StretchProofs proofs_;
  HomotopyParameters start_;  // the dichotomy's result, or that of the search over fewer families
  double search_from_ = 0.2;  // of the progress
  bool own_with_fewer_ = false;  // the search over fewer families beat what it began with
  std::string start_message_;
  opt::Solution solution_;                 // the last one
  std::optional<double> incumbent_slack_;  // at the instants watched
  int since_proof_ = 0;                    // candidates
  int untried_rounds_ = 0;                 // in a row
  SearchEnding end_;
};

}  // namespace

SmoothingResult OptimizeOverlaps(const WalkProblem& problem, const OptimizerOptions& options,
                                 SmoothingMonitor& monitor) {
  const std::unique_ptr<opt::Solver> solver = opt::MakeSolver(options.solver);
  const opt::SolverTraits traits = solver->traits();
  OptimizerOptions own = options;
  own.program.watch = RowsFor(traits, problem.test(), kRowsInstants, own.program.watch);
  if (own.instants > 0) own.program.watch.instants = own.instants;
  if (own.max_iterations == 0) own.max_iterations = traits.iterations;
  return Optimization(problem, own, *solver, kWhole, monitor).Run();
}

}  // namespace halfstep
