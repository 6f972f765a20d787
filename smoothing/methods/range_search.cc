#include "smoothing/methods/range_search.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "smoothing/methods/search_pace.h"
#include "wpg/files/number_text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Iterations of the solver in a repair.
constexpr int kRepairIterations = 2;
constexpr int kViolatedRounds = 4;
constexpr double kNearlyAll = 0.9;
constexpr double kDearer = 10.0, kHardlyLess = 1.5;
// A solver that moves no variable by more stands still.
constexpr double kStill = 1e-6;

ProgramOptions OfRange(const WalkWindow& range, const RangeOptions& options) {
  ProgramOptions own = options.program;
  const opt::SolverTraits traits = options.solver->traits();
  own.watch.range = {range.proved_first, range.proved_last};
  own.watch.stop_branches = range.problem.test().stop_branches();
  own.watch.row_per_instant = traits.many_rows;
  if (!traits.many_rows) return own;
  own.watch.sharpness = std::max(own.watch.sharpness, options.tuning.sharpness);
  own.watch.instants = options.tuning.instants;
  return own;
}

// Rows as sharp as at first, with `more` times the reserve.
void ResetRows(const SearchTuning& tuning, double sharpness, double more,
               WatchedInstants* watched) {
  const bool by_instant = watched->row_per_instant();
  watched->SetSharpness(by_instant ? sharpness : sharpness / more);
  if (by_instant) watched->SetReserves(tuning.reserve * more);
}

// After an end that was proved but for `refusals`, or was not `tried`. Rows by instant stay as
// sharp as they are, and keep more or less in reserve where that is needed. Rows by half-step grow
// sharper by a factor, up to a bound, where all is proved, and else softer, so that more is left in
// reserve.
void AdaptRows(bool tried, const std::vector<Margin>& refusals, WatchedInstants* watched) {
  constexpr double kSharpen = 1.5, kSoften = 0.75, kSharpest = 3000.0;
  if (watched->row_per_instant()) {
    watched->LearnReserves(tried, refusals);
    return;
  }
  const bool proved = tried && refusals.empty();
  watched->SetSharpness(std::min(kSharpest, (proved ? kSharpen : kSoften) * watched->sharpness()));
}

}  // namespace

ProgramOptions Resting(ProgramOptions program, const WalkProblem& problem) {
  const MarginLimits& limits = problem.limits();
  const double inside =
      limits.demanded_of(MarginFamily::kZmp) + limits.demanded_of(MarginFamily::kZmpRobot);
  double& most = program.parameters.bound("most_support_point_m");
  most = std::min(most, 0.5 * problem.robot().sole_size.y() - inside);
  return program;
}

WalkWindow WholeRange(const WalkProblem& problem, const HomotopyParameters& at) {
  return {.begin = 0,
          .proved_first = 0,
          .proved_last = problem.sequence().size() - 1,
          .parameters = at,
          .problem = problem};
}

RangeSearch::RangeSearch(const WalkWindow& range, RangeOptions options, SmoothingMonitor& monitor,
                         RangeGain gained, SearchEnding* ending)
    : range_(range),
      options_(std::move(options)),
      monitor_(monitor),
      gained_(std::move(gained)),
      end_(*ending),
      program_(range.problem.sequence(), range.problem.evaluator(), OfRange(range, options_),
               options_.duration_limit, range.problem.fixed()),
      proofs_(range.problem.test(), range.problem.sequence().size(),
              {range.proved_first, range.proved_last}),
      begun_(!options_.from_proved ? std::numeric_limits<double>::infinity()
             : !Safest()           ? program_.Cost(range.parameters)
             : DurationOf(range.parameters) <= options_.duration_limit + 1e-9
                 ? 0.0
                 : std::numeric_limits<double>::infinity()),
      path_(range.problem.sequence(),
            Safest() ? SafestRules(program_, range.problem.test(), begun_ == 0.0)
                     : DemandedRules(program_, &proofs_),
            range.parameters, begun_, monitor.scratch()) {
  program_.watched().SetWorkers(monitor.workers());
  program_.watched().SetWork(&monitor.scratch()->work);
  if (options_.from_proved) {
    proofs_.Remember(SuperposedWalk(range.problem.sequence(), range.parameters));
  }
}

bool RangeSearch::From(const HomotopyParameters& start, double more, double effort) {
  until_ = std::min(effort, monitor_.effort());
  const SearchTuning& tuning = options_.tuning;
  WatchedInstants& watched = program_.watched();
  ResetRows(tuning, sharpness_, more, &watched);
  solution_ = {};
  violated_ = 0;
  dearer_ = 1.0;
  const OverlapVariables& variables = program_.variables();
  Eigen::VectorXd x = program_.ToVariables(start);
  x.head(variables.size()) =
      x.head(variables.size()).cwiseMax(variables.lower()).cwiseMin(variables.upper());
  SearchPace pace(options_.rounds, tuning.poor_rounds);
  int repairs = 0;
  while (!pace.over()) {
    if (monitor_.cut_off() || monitor_.work().effort() >= until_) {
      end_.NoteCut(monitor_);
      return false;
    }
    const double before = path_.cost();
    const Eigen::VectorXd from = x;
    if (!Solve(&x, repairs > 0)) return false;
    const bool tried = Try(x);
    AdaptRows(tried, path_.refusals(), &watched);
    const bool repair = tried && options_.solver->traits().many_rows && Few(path_.refusals()) &&
                        repairs < tuning.repairs;
    repairs = repair ? repairs + 1 : 0;
    if (!repair) pace.Note(end_cost_, before, path_.cost());
    // Where ends stay violated, violations cost too little.
    violated_ = end_violation_ > -tuning.promising ? violated_ + 1 : 0;
    if (violated_ >= kViolatedRounds) {
      violated_ = 0;
      dearer_ *= kDearer;
      solution_.warm_start = nullptr;
    }
    // Where the solver stands still at rows that are violated, steps begin again at the incumbent.
    if (!Safest() && (x - from).lpNorm<Eigen::Infinity>() < kStill) {
      x = program_.ToVariables(path_.Beside(program_.ToParameters(x), held_));
      solution_.warm_start = nullptr;
    }
    monitor_.ShowEffort();
    if (options_.first_proof && moved_ >= kNearlyAll) break;
  }
  end_.exhausted = end_.exhausted || pace.exhausted();
  return true;
}

bool RangeSearch::Few(const std::vector<Margin>& refusals) const {
  const double all = range_.proved_last - range_.proved_first + 1;
  return !refusals.empty() &&
         static_cast<double>(refusals.size()) <= std::max(1.0, options_.tuning.few_refusals * all);
}

bool RangeSearch::Solve(Eigen::VectorXd* x, bool repair) {
  const opt::SolverTraits traits = options_.solver->traits();
  opt::SolverOptions options;
  options.max_iterations = repair ? kRepairIterations : options_.iterations;
  options.optimality_tolerance = 1e-4;
  // Rows are nearly linear, and so is every cost but the roughness.
  if (options_.program.kind != ProgramKind::kSmooth) options.solver_options = traits.nearly_linear;
  if (dearer_ > 1.0 && traits.many_rows) {
    options.solver_options["penalty"] = ShortestText(2.0 * dearer_);
    if (!repair) options.solver_options["radius"] = "0.05";
  }
  if (repair) {
    options.solver_options["radius"] = ShortestText(options_.tuning.repair_region);
  } else {
    options.warm_start = solution_.warm_start;
  }
  options.deadline = monitor_.deadline() - monitor_.Seconds();
  options.stop = monitor_.stop();
  options.may_go_on = [this](long linear_algebra) {
    Work work = monitor_.work();
    work.linear_algebra += linear_algebra;
    return work.effort() < until_;
  };
  options.on_iterate = [this](const opt::Iterate& iterate) {
    Record(program_.ToParameters(iterate.x), iterate.violation, 0.0);
    return true;
  };
  opt::Solution solution = options_.solver->Solve(program_.MakeProblem(), *x, options);
  monitor_.Count({.linear_algebra = solution.linear_algebra}, 0);
  end_.Note(solution);
  if (solution.ending == opt::Ending::kInvalidInput || solution.x.size() != x->size()) return false;
  // Cheap and nearly feasible is a better place to go on from than the best feasible one, and where
  // there is none, than one that is violated hardly less.
  const double far = std::max(options_.tuning.hopeless, kHardlyLess * solution.max_violation);
  const bool near = solution.final_x.size() == x->size() && solution.final_violation < far;
  *x = near ? solution.final_x : solution.x;
  end_cost_ = near ? solution.final_cost : solution.cost;
  end_violation_ = near ? solution.final_violation : solution.max_violation;
  if (repair) solution.warm_start = solution_.warm_start;
  solution_ = std::move(solution);
  return true;
}

bool RangeSearch::Try(const Eigen::VectorXd& x) {
  const HomotopyParameters end = program_.ToParameters(x);
  const SuperposedWalk walk(range_.problem.sequence(), end);
  const double level = Safest() ? std::max(0.0, x.tail(1)[0]) : 0.0;
  const std::vector<double> least =
      program_.watched().Focus(walk, options_.tuning.look_period, level);
  held_.clear();
  // What is refused of a safest walk holds all of it back.
  for (const double slack : least) {
    held_.push_back(!Safest() && slack < options_.tuning.promising);
  }
  const auto first = held_.begin() + range_.proved_first,
             last = held_.begin() + range_.proved_last + 1;
  const bool some = std::find(first, last, false) != last;
  const bool tried = some && end_violation_ <= options_.tuning.hopeless;
  const double lambda = tried ? path_.Toward(end, options_.tuning.attempts, held_) : 0.0;
  moved_ = lambda;
  SmoothingResult& result = monitor_.result();
  result.raw_end_feasible = tried && lambda == 1.0;
  if (!tried || !path_.refusals().empty()) ++result.raw_infeasible;
  if (tried) {
    for (const Margin& refusal : path_.refusals()) {
      program_.watched().Learn(walk, refusal.at, refusal.stop_after >= 0);
    }
  }
  if (lambda > 0.0) gained_(path_.parameters(), path_.cost(), begun_ - path_.cost());
  Record(end, end_violation_, lambda);
  return tried;
}

void RangeSearch::Record(const HomotopyParameters& candidate, double violation, double lambda) {
  SmoothingIterate record{.candidate_duration = monitor_.duration() + DurationOf(candidate) -
                                                DurationOf(path_.parameters()),
                          .accepted = lambda > 0.0,
                          .lambda = lambda};
  if (violation > 0.0) record.candidate_worst_margin = -violation;
  monitor_.Record(record);
}

}  // namespace halfstep
