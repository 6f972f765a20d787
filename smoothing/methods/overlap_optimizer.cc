#include "smoothing/methods/overlap_optimizer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "opt/adapters/solver_registry.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/explain.h"
#include "smoothing/methods/path_rules.h"
#include "smoothing/methods/search_ending.h"
#include "smoothing/methods/stopwatch.h"

namespace halfstep {
namespace {

constexpr char kSqp[] = "halfstep/sqp";
// Of the dichotomy before a search that is to shorten the walk anyway [s]. Linear programs move
// fast where there is room, others are better off nearer to the end.
constexpr double kStartTolerance = 0.1, kSqpStartTolerance = 0.5;
// Points tried towards a candidate.
constexpr int kAttempts = 8;
// A candidate whose rows are violated by more than this is not worth a proof, nor a place to go on
// from.
constexpr double kHopeless = 0.5;
// A solver's iterates between two proofs, in rounds that are longer.
constexpr int kPatience = 10;
constexpr double kLookPeriod = 0.005;  // [s]: how far apart the program looks for small slacks
// A point where less slack is seen is not worth a proof.
constexpr double kPromising = -0.02;
// After a round whose end was proved rows grow sharper by a factor, up to a bound; after one whose
// end was refused they grow softer, so that more is left in reserve.
constexpr double kSharpen = 1.5, kSoften = 0.75, kSharpest = 3000.0;
// Of a table with rows by instant, from the first round on.
constexpr double kSqpSharpness = 200.0;
constexpr int kSqpInstants = 24;
// A round that gains less, for the incumbent and for the solver, is poor (relative); so many in a
// row end the search.
constexpr double kGain = 1e-3;
constexpr int kPoorRounds = 5;
// A search that does not beat a plain dichotomy by this has found nothing [s].
constexpr double kGainedTime = 1e-9;

bool Gained(double before, double after) {
  if (!std::isfinite(before)) return std::isfinite(after);
  return before - after >= kGain * std::abs(before);
}

class Optimization {
 public:
  Optimization(const HalfStepSequence& sequence, const FeasibilityTest& test,
               const OptimizerOptions& options, const std::function<void(double)>& progress,
               std::stop_token stop)
      : sequence_(sequence),
        test_(test),
        options_(options),
        progress_(progress),
        stop_(std::move(stop)),
        proofs_(test, sequence.size()),
        end_{.solver = options.solver,
             .kept = options.start ? "the walk is what it started from"
                                   : "the walk is a dichotomy's"} {}

  SmoothingResult Run() {
    DichotomyOptions dichotomy{.tolerance = StartTolerance()};
    if (options_.start) {
      dichotomy.start = options_.start;
      dichotomy.passes = 0;
    }
    result_ = Dichotomy(sequence_, test_, dichotomy, Part(0.0, 0.2), stop_);
    start_ = result_.parameters;
    result_.cost = DurationOf(start_);
    if (!result_.feasible || stop_.stop_requested()) {
      end_.stopped = result_.feasible;
      result_.ending = end_.Ending();
      if (end_.stopped) result_.message = end_.Sentence();
      return std::move(result_);
    }

    const double own = DurationOf(start_);
    const double limit = options_.duration_limit > 0.0 ? options_.duration_limit : own;
    OverlapProgram program(sequence_, test_.evaluator(), options_.program, limit);
    const bool within = own <= limit + 1e-9;
    FeasiblePath::Rules rules =
        Safest() ? SafestRules(program, test_, within) : DemandedRules(program, &proofs_);
    const auto accepted = rules.accepted;
    rules.accepted = [&](const HomotopyParameters& p) {
      if (accepted) accepted(p);
      if (options_.on_accept) options_.on_accept(p);
    };
    // The dichotomy's walk is proved with what is demanded: slack 0.
    const double cost = !Safest() ? program.Cost(start_)
                        : within  ? 0.0
                                  : std::numeric_limits<double>::infinity();
    proofs_.Remember(SuperposedWalk(sequence_, start_));
    FeasiblePath path(sequence_, rules, start_, cost, test_.evaluator().MakeScratch());
    Search(program, &path);
    return Finish(program, path);
  }

 private:
  bool Safest() const { return options_.program.kind == ProgramKind::kSafest; }
  bool Sqp() const { return options_.solver == kSqp; }
  bool Fastest() const { return options_.program.kind == ProgramKind::kFastest; }

  // Of the dichotomy before the search. `safest` and `smooth` compare with the fine one's result.
  double StartTolerance() const {
    if (!Fastest()) return options_.tolerance;
    return std::max(options_.tolerance, Sqp() ? kSqpStartTolerance : kStartTolerance);
  }

  std::function<void(double)> Part(double from, double to) const {
    return [this, from, to](double done) {
      if (progress_) progress_(from + (to - from) * done);
    };
  }

  // The slack that the program asks for at x: z ≥ 0 of `safest`.
  double Level(const Eigen::VectorXd& x) const {
    return Safest() ? std::max(0.0, x.tail(1)[0]) : 0;
  }

  void Search(OverlapProgram& program, FeasiblePath* path) {
    std::vector<HomotopyParameters> starts = {start_};
    if (options_.planned_start) starts.push_back(PlannedMotion(sequence_));
    AddRandomPoints(program, options_.random_starts, options_.seed, &starts);
    for (size_t s = 0; s < starts.size(); ++s) {
      program.table().SetSharpness(options_.program.table.sharpness);
      solution_.warm_start = nullptr;
      Eigen::VectorXd x = program.ToVariables(starts[s]);
      double solved = std::numeric_limits<double>::infinity();  // cost of the last end
      int poor = 0;
      for (int round = 0; round < options_.rounds && poor < kPoorRounds; ++round) {
        const double before = path->cost();
        const double remaining = options_.deadline - stopwatch_.Seconds();
        end_.deadline_passed = remaining <= 0.0;
        if (end_.deadline_passed || stop_.stop_requested()) return;
        solution_ = Solve(program, x, remaining, path);
        end_.Note(solution_);
        const bool refused = solution_.ending == opt::Ending::kInvalidInput;
        if (refused || solution_.x.size() != x.size()) return;
        // Cheap and nearly feasible is a better place to go on from than the best feasible one.
        const bool near =
            solution_.final_x.size() == x.size() && solution_.final_violation < kHopeless;
        x = near ? solution_.final_x : solution_.x;
        const HomotopyParameters end = program.ToParameters(x);
        const SuperposedWalk walk(sequence_, end);
        const double seen = program.table().Focus(walk, kLookPeriod, Level(x));
        const bool last = stopwatch_.Seconds() >= options_.deadline || round + 1 == options_.rounds;
        if (seen >= kPromising || last) {
          Try(end, near ? solution_.final_violation : solution_.max_violation, program, path);
          result_.raw_end_feasible = path->refusals().empty();
          for (const Margin& refusal : path->refusals()) {
            program.table().Learn(walk, refusal.at);
          }
        } else {  // violated where it was sampled
          ++result_.raw_infeasible;
          result_.raw_end_feasible = false;
        }
        const double cost = near ? solution_.final_cost : solution_.cost;
        poor = Gained(before, path->cost()) || Gained(solved, cost) ? 0 : poor + 1;
        solved = std::min(solved, cost);
        const double sharpen = seen >= kPromising && path->refusals().empty() ? kSharpen : kSoften;
        program.table().SetSharpness(std::min(kSharpest, sharpen * program.table().sharpness()));
        Part(0.2, 0.9)((static_cast<double>(s) + (round + 1.0) / options_.rounds) /
                       static_cast<double>(starts.size()));
      }
      end_.exhausted = end_.exhausted || poor < kPoorRounds;
    }
  }

  opt::Solution Solve(const OverlapProgram& program, const Eigen::VectorXd& x, double deadline,
                      FeasiblePath* path) {
    const opt::Problem problem = program.MakeProblem();
    opt::SolverOptions solver_options;
    solver_options.max_iterations = options_.max_iterations;
    solver_options.deadline = deadline;
    solver_options.stop = stop_;
    solver_options.optimality_tolerance = 1e-4;
    solver_options.warm_start = solution_.warm_start;
    // Nearly linear: what curvature a few steps show of it does more harm than good. Nor does a
    // small penalty jam at curved rows; where it is not exact, proofs refuse what it leaves
    // violated.
    if (Sqp() && options_.program.kind != ProgramKind::kSmooth) {
      solver_options.solver_options["memory"] = "0";
      solver_options.solver_options["penalty"] = "2";
      solver_options.solver_options["most_penalty"] = "2";
    }
    solver_options.on_iterate = [&](const opt::Iterate& iterate) {
      const HomotopyParameters candidate = program.ToParameters(iterate.x);
      const bool wait = options_.max_iterations < kPatience || ++since_proof_ < kPatience;
      if (wait) {
        Record(candidate, iterate.violation, 0.0, *path);
      } else {
        Try(candidate, iterate.violation, program, path);
      }
      return true;
    };
    return opt::MakeSolver(options_.solver)->Solve(problem, x, solver_options);
  }

  void Try(const HomotopyParameters& candidate, double violation, const OverlapProgram& program,
           FeasiblePath* path) {
    since_proof_ = 0;
    double lambda = 0.0;
    if (violation <= kHopeless) lambda = path->Toward(candidate, kAttempts);
    if (violation > kHopeless || !path->refusals().empty()) ++result_.raw_infeasible;
    if (lambda > 0.0) {
      if (!result_.time_to_first_improvement)
        result_.time_to_first_improvement = stopwatch_.Seconds();
      std::array<bool, kNumMarginFamilies> all;
      all.fill(true);
      incumbent_slack_ = program.table().LeastSlack(path->incumbent(), all);
    }
    Record(candidate, violation, lambda, *path);
  }

  void Record(const HomotopyParameters& candidate, double violation, double lambda,
              const FeasiblePath& path) {
    SmoothingIterate record{.wall = stopwatch_.Seconds(),
                            .evaluations = result_.instants + path.scratch().instants,
                            .candidate_duration = DurationOf(candidate),
                            .accepted = lambda > 0.0,
                            .lambda = lambda,
                            .incumbent_duration = DurationOf(path.incumbent()),
                            .incumbent_slack = incumbent_slack_,
                            .incumbent_cost = path.cost()};
    if (violation > 0.0) record.candidate_slack = -violation;
    result_.iterates.push_back(record);
  }

  SmoothingResult Finish(const OverlapProgram& program, const FeasiblePath& path) {
    result_.instants += path.scratch().instants;
    result_.collision_queries += path.scratch().bodies.queries;
    // Safest walks were proved whole, the others stretch by stretch.
    if (path.accepted() > 0 && (Safest() || HoldsWhole(path.incumbent()))) {
      result_.parameters = path.incumbent();
      end_.own = true;
    }
    result_.cost = path.cost();
    if (!end_.own && path.accepted() > 0) result_.cost = program.Cost(result_.parameters);
    if (Fastest() && !stop_.stop_requested()) {
      AddDichotomy(result_.parameters);
      if (!options_.start) {
        const double plain = AddDichotomy(PlannedMotion(sequence_));
        end_.own = end_.own && result_.cost < plain - kGainedTime;
      }
    } else {
      for (size_t i = 0; i < result_.junctions.size(); ++i) {
        JunctionResult& junction = result_.junctions[i];
        junction.overlap = result_.parameters.overlaps[i];
        junction.upper_bound =
            NaturalOverlapBound(sequence_, result_.parameters.durations, static_cast<int>(i));
        junction.limited_by.reset();
      }
    }
    result_.wall = stopwatch_.Seconds();
    if (!Safest()) AddMultipliers(program, result_.parameters, &result_.junctions);
    end_.stopped = stop_.stop_requested();
    result_.ending = end_.Ending();
    result_.message = end_.Sentence();
    if (Safest() && !std::isfinite(result_.cost)) {
      result_.message += "; no walk of at most " + std::to_string(program.duration_limit()) +
                         " s was proved, the dichotomy's is kept";
    }
    return std::move(result_);
  }

  // A dichotomy's pass over all junctions, which counts if it ends with a shorter walk. Its
  // duration [s].
  double AddDichotomy(const HomotopyParameters& start) {
    SmoothingResult added = Dichotomy(
        sequence_, test_, {.tolerance = options_.tolerance, .start = start}, Part(0.9, 1.0), stop_);
    result_.instants += added.instants;
    result_.collision_queries += added.collision_queries;
    const bool first = result_.parameters == start;
    if (!first && !(added.cost < result_.cost)) return added.cost;
    for (SmoothingIterate& iterate : added.iterates) {
      if (iterate.incumbent_duration > result_.cost) continue;
      iterate.wall += stopwatch_.Seconds() - added.wall;
      iterate.evaluations += result_.instants - added.instants;
      result_.iterates.push_back(iterate);
    }
    result_.parameters = added.parameters;
    result_.junctions = added.junctions;
    result_.cost = added.cost;
    return added.cost;
  }

  bool HoldsWhole(const HomotopyParameters& parameters) const {
    const SuperposedWalk walk(sequence_, parameters);
    MarginEvaluator::Scratch scratch = test_.evaluator().MakeScratch();
    return test_.Check(walk, {0.0, walk.duration()}, &scratch).verdict == Verdict::kFeasible;
  }

  const HalfStepSequence& sequence_;
  const FeasibilityTest& test_;
  const OptimizerOptions& options_;
  const std::function<void(double)>& progress_;
  std::stop_token stop_;
  Stopwatch stopwatch_;
  StretchProofs proofs_;
  SmoothingResult result_;
  HomotopyParameters start_;               // the dichotomy's result
  opt::Solution solution_;                 // the last one
  std::optional<double> incumbent_slack_;  // at the table's instants
  int since_proof_ = 0;                    // candidates
  SearchEnding end_;
};

}  // namespace

SmoothingResult OptimizeOverlaps(const HalfStepSequence& sequence, const FeasibilityTest& test,
                                 const OptimizerOptions& options,
                                 const std::function<void(double)>& progress,
                                 std::stop_token stop) {
  OptimizerOptions own = options;
  const bool sqp = options.solver == kSqp;
  SlackTableOptions& table = own.program.table;
  table.row_per_instant = sqp;
  if (sqp) table.sharpness = std::max(table.sharpness, kSqpSharpness);
  if (sqp) table.instants = kSqpInstants;
  if (own.instants > 0) table.instants = own.instants;
  if (own.max_iterations == 0) own.max_iterations = sqp ? 3 : 30;
  return Optimization(sequence, test, own, progress, std::move(stop)).Run();
}

}  // namespace halfstep
