#include "smoothing/overlap_optimizer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "opt/solver.h"
#include "opt/stationarity.h"
#include "smoothing/dichotomy.h"
#include "smoothing/feasible_path.h"

namespace halfstep {
namespace {

// Bisections towards a candidate, while the solver is under way and where it ended.
constexpr int kQuick = 2, kThorough = 6;
// A candidate whose rows are violated by more than this is not worth a proof.
constexpr double kHopeless = 0.5;
// After a refusal a candidate is worth a proof when it costs less by this (relative), or after so
// many others.
constexpr double kProgress = 0.01;
constexpr int kPatience = 5;
// Where the program looks after a refusal: instants this far apart [s], slacks below this.
constexpr double kLookPeriod = 0.005, kLookSlack = 0.1;
// Rows grow sharper by this factor from round to round.
constexpr double kSharpen = 3.0;
// Two rounds that gain less than this end the rounds (relative).
constexpr double kGain = 1e-3;

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
        begin_(std::chrono::steady_clock::now()) {}

  SmoothingResult Run() {
    DichotomyOptions dichotomy{.tolerance = options_.tolerance};
    if (options_.start) {
      dichotomy.start = options_.start;
      dichotomy.passes = 0;
    }
    result_ = Dichotomy(sequence_, test_, dichotomy, Part(0.0, 0.2), stop_);
    dichotomy.passes = 1;
    result_.cost = DurationOf(result_.parameters);
    if (result_.status != SmoothingStatus::kFinished) return std::move(result_);

    const double limit =
        options_.duration_limit > 0.0 ? options_.duration_limit : DurationOf(result_.parameters);
    OverlapProgram program(sequence_, test_.evaluator(), options_.program, limit);
    FeasiblePath path(sequence_, RulesOf(program), result_.parameters,
                      Safest() ? SafestStartCost(program) : program.Cost(result_.parameters),
                      test_.evaluator().MakeScratch());
    Search(program, &path);
    return Finish(program, path, dichotomy);
  }

 private:
  std::function<void(double)> Part(double from, double to) const {
    return [this, from, to](double done) {
      if (progress_) progress_(from + (to - from) * done);
    };
  }

  double Elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

  bool Safest() const { return options_.program.kind == ProgramKind::kSafest; }

  // The dichotomy's walk is proved with what is demanded: slack 0. Beyond the limit it is kept
  // until a shorter one is proved.
  double SafestStartCost(const OverlapProgram& program) {
    within_limit_ = DurationOf(result_.parameters) <= program.duration_limit() + 1e-9;
    return within_limit_ ? 0.0 : std::numeric_limits<double>::infinity();
  }

  FeasiblePath::Rules RulesOf(const OverlapProgram& program) {
    if (!Safest()) {
      return {
          .cost = [&program](const HomotopyParameters& p) { return program.Cost(p); },
          .prove =
              [this](const SuperposedWalk& walk, double, const HomotopyParameters& incumbent,
                     MarginEvaluator::Scratch* scratch) { return Prove(walk, incumbent, scratch); },
          .accepted = options_.on_accept};
    }
    // What lies between the table's instants may be a little worse than what they show.
    constexpr double kBetween = 0.01;
    return {.cost =
                [this, &program](const HomotopyParameters& p) {
                  const double cost = program.Cost(p);
                  // Never is less proved than what is demanded, and of the first walk within the
                  // limit no more.
                  if (cost > 0.0) return std::numeric_limits<double>::infinity();
                  return within_limit_ ? std::min(0.0, cost + kBetween) : 0.0;
                },
            .prove =
                [this](const SuperposedWalk& walk, double cost, const HomotopyParameters&,
                       MarginEvaluator::Scratch* scratch) {
                  MarginLimits limits = test_.evaluator().limits();
                  for (MarginFamily family : AllMarginFamilies()) {
                    if (!Raised()[static_cast<size_t>(family)]) continue;
                    limits.demanded_of(family) -= cost * Scale(family);
                  }
                  const MarginEvaluator evaluator = test_.evaluator().WithLimits(limits);
                  return test_.Over(evaluator)->Check(walk, {0.0, walk.duration()}, scratch);
                },
            .accepted =
                [this](const HomotopyParameters& p) {
                  within_limit_ = true;
                  if (options_.on_accept) options_.on_accept(p);
                },
            .improvement = 1e-3};
  }

  Feasibility Prove(const SuperposedWalk& walk, const HomotopyParameters& incumbent,
                    MarginEvaluator::Scratch* scratch) const {
    constexpr size_t kMostSuspects = 32;
    for (const auto& [half_step, fraction] : suspects_) {
      const LocalTime at{half_step, fraction * walk.profiles(half_step).duration()};
      if (const auto violated = test_.evaluator().FirstViolation(walk, at, scratch)) {
        return {Verdict::kViolated, test_.evidence(), *violated};
      }
    }
    const Feasibility answer = CheckChanges(test_, walk, incumbent, scratch);
    if (answer.verdict != Verdict::kFeasible) {
      const LocalTime& at = answer.witness.at;
      if (suspects_.size() == kMostSuspects) suspects_.erase(suspects_.begin());
      suspects_.emplace_back(at.half_step, at.tau / walk.profiles(at.half_step).duration());
    }
    return answer;
  }

  // The dichotomy's result, the planned motion, random points of the variables' box.
  std::vector<HomotopyParameters> Starts(const OverlapProgram& program) const {
    std::vector<HomotopyParameters> starts = {result_.parameters};
    if (options_.planned_start) starts.push_back(PlannedMotion(sequence_));
    std::mt19937_64 random(options_.seed);
    const opt::Problem problem = program.MakeProblem();
    for (int i = 0; i < options_.random_starts; ++i) {
      Eigen::VectorXd x(problem.num_variables());
      for (Eigen::Index v = 0; v < x.size(); ++v) {
        x[v] =
            std::uniform_real_distribution<double>(problem.lower()[v], problem.upper()[v])(random);
      }
      starts.push_back(program.ToParameters(x));
    }
    return starts;
  }

  void Search(OverlapProgram& program, FeasiblePath* path) {
    const std::vector<HomotopyParameters> starts = Starts(program);
    for (size_t s = 0; s < starts.size() && !stop_.stop_requested(); ++s) {
      program.table().SetSharpness(options_.program.table.sharpness);
      Eigen::VectorXd x = program.ToVariables(starts[s]);
      int poor = 0;  // rounds in a row that gained next to nothing
      for (int round = 0; round < options_.rounds; ++round) {
        const double before = path->cost();
        const double remaining = options_.deadline - Elapsed();
        if (remaining <= 0.0 || stop_.stop_requested()) return;
        solution_ = Solve(program, x, round, remaining, path);
        if (solution_.x.size() != x.size()) return;
        x = solution_.x;
        const HomotopyParameters end = program.ToParameters(x);
        const bool whole = path->Toward(end, kThorough) == 1.0;
        result_.raw_end_feasible = whole || !path->refusal();
        bool learned = false;
        if (path->refusal()) {
          const SuperposedWalk walk(sequence_, end);
          learned = program.table().Look(walk, path->refusal()->at);
          learned = program.table().LookAround(walk, kLookPeriod, kLookSlack) > 0 || learned;
        }
        const bool gained = std::isinf(before) ? std::isfinite(path->cost())
                                               : before - path->cost() >= kGain * std::abs(before);
        poor = gained ? 0 : poor + 1;
        if (poor == 2 || (poor > 0 && !learned)) break;
        program.table().SetSharpness(program.table().sharpness() * kSharpen);
        Part(0.2, 0.9)((static_cast<double>(s) + (round + 1.0) / options_.rounds) /
                       static_cast<double>(starts.size()));
      }
    }
  }

  opt::Solution Solve(const OverlapProgram& program, const Eigen::VectorXd& x, int round,
                      double deadline, FeasiblePath* path) {
    const opt::Problem problem = program.MakeProblem();
    opt::SolverOptions solver_options;
    // Later rounds begin near their end.
    solver_options.max_iterations =
        round == 0 ? options_.max_iterations : std::max(1, options_.max_iterations / 3);
    solver_options.deadline = deadline;
    solver_options.stop = stop_;
    solver_options.optimality_tolerance = 1e-4;
    solver_options.on_iterate = [&](const opt::Iterate& iterate) {
      Consider(program, iterate, path);
      return true;
    };
    return opt::MakeSolver(options_.solver)->Solve(problem, x, solver_options);
  }

  void Consider(const OverlapProgram& program, const opt::Iterate& iterate, FeasiblePath* path) {
    const HomotopyParameters candidate = program.ToParameters(iterate.x);
    double lambda = 0.0;
    if (iterate.violation > kHopeless) {
      ++result_.raw_infeasible;
    } else if (iterate.cost < worth_a_proof_ || ++skipped_ >= kPatience) {
      skipped_ = 0;
      lambda = path->Toward(candidate, kQuick);
      const bool refused = lambda < 1.0 && path->refusal();
      if (refused) ++result_.raw_infeasible;
      worth_a_proof_ = refused ? iterate.cost - kProgress * std::abs(iterate.cost)
                               : std::numeric_limits<double>::infinity();
    }
    if (lambda > 0.0 && !result_.time_to_first_improvement) {
      result_.time_to_first_improvement = Elapsed();
    }
    SmoothingIterate record{.wall = Elapsed(),
                            .evaluations = result_.instants + path->scratch().instants,
                            .candidate_duration = DurationOf(candidate),
                            .accepted = lambda > 0.0,
                            .lambda = lambda,
                            .incumbent_duration = DurationOf(path->incumbent()),
                            .incumbent_cost = path->cost()};
    if (iterate.violation > 0.0) record.candidate_slack = -iterate.violation;
    if (record.accepted) {
      std::array<bool, kNumMarginFamilies> all;
      all.fill(true);
      incumbent_slack_ = program.table().LeastSlack(path->incumbent(), all);
    }
    record.incumbent_slack = incumbent_slack_;
    result_.iterates.push_back(record);
  }

  SmoothingResult Finish(const OverlapProgram& program, const FeasiblePath& path,
                         DichotomyOptions dichotomy) {
    result_.instants += path.scratch().instants;
    result_.collision_queries += path.scratch().bodies.queries;
    // Safest walks were proved whole, the others change by change.
    if (Safest() || path.accepted() == 0 || HoldsWhole(path.incumbent())) {
      result_.parameters = path.incumbent();
      result_.cost = path.cost();
    }
    if (options_.program.kind == ProgramKind::kFastest && !stop_.stop_requested()) {
      dichotomy.start = result_.parameters;
      SmoothingResult polished = Dichotomy(sequence_, test_, dichotomy, Part(0.9, 1.0), stop_);
      for (SmoothingIterate& iterate : polished.iterates) {
        iterate.wall += Elapsed() - polished.wall;
        iterate.evaluations += result_.instants;
        result_.iterates.push_back(iterate);
      }
      result_.parameters = polished.parameters;
      result_.junctions = polished.junctions;
      result_.cost = DurationOf(polished.parameters);
      result_.instants += polished.instants;
      result_.collision_queries += polished.collision_queries;
    } else {
      for (size_t i = 0; i < result_.junctions.size(); ++i) {
        JunctionResult& junction = result_.junctions[i];
        junction.overlap = result_.parameters.overlaps[i];
        junction.upper_bound =
            NaturalOverlapBound(sequence_, result_.parameters.durations, static_cast<int>(i));
        junction.limited_by.reset();
      }
    }
    result_.wall = Elapsed();
    AddMultipliers(program);
    result_.message =
        options_.solver + " ended " + opt::ToString(solution_.status) + ": " + solution_.message;
    if (Safest() && !std::isfinite(result_.cost)) {
      result_.message += "; no walk of at most " + std::to_string(program.duration_limit()) +
                         " s was proved, the dichotomy's is kept";
    }
    if (stop_.stop_requested()) {
      result_.status = SmoothingStatus::kInterrupted;
      result_.message = "stopped from outside; the parameters are the best that were proved";
    }
    return std::move(result_);
  }

  bool HoldsWhole(const HomotopyParameters& parameters) const {
    const SuperposedWalk walk(sequence_, parameters);
    MarginEvaluator::Scratch scratch = test_.evaluator().MakeScratch();
    return test_.Check(walk, {0.0, walk.duration()}, &scratch).verdict == Verdict::kFeasible;
  }

  // By our own estimate at the result, whatever the solver: rows nearly active count.
  void AddMultipliers(const OverlapProgram& program) {
    if (Safest()) return;  // its cost is no time
    constexpr double kActive = 0.05;
    const opt::Problem problem = program.MakeProblem();
    const Eigen::VectorXd x = program.ToVariables(result_.parameters);
    const opt::Stationarity at = opt::EstimateMultipliers(
        problem, x, problem.Gradient(x), problem.Constraints(x), problem.Jacobian(x), kActive);
    for (size_t i = 0; i < result_.junctions.size(); ++i) {
      JunctionResult& junction = result_.junctions[i];
      if (!junction.limited_by) continue;
      const MarginFamily family = junction.limited_by->family;
      double sum = 0.0;
      for (int k : {static_cast<int>(i), static_cast<int>(i) + 1}) {
        sum += std::abs(at.multipliers[SlackTable::RowOf(k, family)]);
      }
      junction.multiplier = sum;
    }
  }

  const HalfStepSequence& sequence_;
  const FeasibilityTest& test_;
  const OptimizerOptions& options_;
  const std::function<void(double)>& progress_;
  std::stop_token stop_;
  std::chrono::steady_clock::time_point begin_;
  SmoothingResult result_;
  opt::Solution solution_;                                          // the last one
  double worth_a_proof_ = std::numeric_limits<double>::infinity();  // a cost
  std::optional<double> incumbent_slack_;                           // at the table's instants
  bool within_limit_ = true;  // `safest`: the incumbent lasts no longer than it may
  int skipped_ = 0;           // candidates
  // Where proofs failed: half-step, and τ as a fraction of its T. Looked at first.
  mutable std::vector<std::pair<int, double>> suspects_;
};

}  // namespace

SmoothingResult OptimizeOverlaps(const HalfStepSequence& sequence, const FeasibilityTest& test,
                                 const OptimizerOptions& options,
                                 const std::function<void(double)>& progress,
                                 std::stop_token stop) {
  return Optimization(sequence, test, options, progress, std::move(stop)).Run();
}

}  // namespace halfstep
