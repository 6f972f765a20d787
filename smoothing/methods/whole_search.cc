#include "smoothing/methods/whole_search.h"

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "smoothing/methods/accepted_in_parts.h"
#include "smoothing/methods/incumbent.h"
#include "smoothing/methods/search_pace.h"
#include "smoothing/methods/search_rounds.h"
#include "smoothing/methods/shortened_start.h"
#include "smoothing/methods/whole_proof.h"

namespace halfstep {
namespace {

// A solver's iterates between two proofs, in rounds that are longer.
constexpr int kPatience = 10;
// Instants a half-step where it is asked how far half-steps may be shortened.
constexpr int kShorteningInstants = 8;
// The end of a round is tried although samples show that it is not feasible, after so many rounds
// of which none was tried: most of a long walk may be feasible.
constexpr int kUntriedRounds = 4;
// Every other one of the searches from the incumbent keeps so much more in reserve at first, so
// that it goes another way.
constexpr double kMoreReserve = 5.0;
// There is at most one of them for so many rounds that each start may have.
constexpr int kRoundsARepeat = 4;

class WholeSearch {
 public:
  WholeSearch(const WalkProblem& problem, const OptimizerOptions& options,
              const opt::Solver& solver, const RestartPolicy& restarts, double from,
              OverlapProgram* program, SmoothingMonitor& monitor, SearchEnding* ending)
      : problem_(problem),
        sequence_(problem.sequence()),
        test_(problem.test()),
        options_(options),
        solver_(solver),
        restarts_(restarts),
        from_(from),
        program_(*program),
        monitor_(monitor),
        end_(*ending),
        proofs_(test_, sequence_.size()),
        begun_(*monitor.accepted()),
        start_(begun_.parameters()) {}

  bool Run() {
    const double own = DurationOf(start_), limit = program_.duration_limit();
    const bool within = own <= limit + 1e-9;
    Incumbent::Rules rules =
        Safest() ? SafestRules(program_, test_, within) : DemandedRules(program_, &proofs_);
    // What it begins with is proved with what is demanded: slack 0.
    const double cost = !Safest() ? program_.Cost(start_)
                        : within  ? 0.0
                                  : std::numeric_limits<double>::infinity();
    monitor_.Adopt(begun_, cost, own);
    proofs_.Remember(SuperposedWalk(sequence_, start_));
    Incumbent path(sequence_, rules, start_, cost, monitor_.scratch());
    Search(&path);
    if (path.accepted() == 0) return false;
    // Safest walks were proved whole, the others stretch by stretch.
    if (Safest() || HoldsWhole(problem_, path.parameters(), monitor_)) return true;
    monitor_.Adopt(begun_, program_.Cost(start_), own);
    return false;
  }

 private:
  bool Safest() const { return options_.program.kind == ProgramKind::kSafest; }
  bool Fastest() const { return options_.program.kind == ProgramKind::kFastest; }

  // The slack that the program asks for at x: z ≥ 0 of `safest`.
  double Level(const Eigen::VectorXd& x) const {
    return Safest() ? std::max(0.0, x.tail(1)[0]) : 0;
  }

  void Search(Incumbent* path) {
    std::vector<HomotopyParameters> starts = {start_};
    if (options_.planned_start && restarts_.planned_start)
      starts.push_back(Fastest() ? Shortened() : problem_.Start());
    AddRandomPoints(program_, options_.random_starts, options_.seed, &starts);
    for (size_t s = 0; s < starts.size(); ++s) {
      const double part = static_cast<double>(s) / static_cast<double>(starts.size());
      if (!SearchFrom(starts[s], part, 1.0, path)) return;
    }
    // Where rounds lead into what cannot be mended, the incumbent, which has come a part of the
    // way, is a place to set out from again.
    const int repeats = restarts_.repeats ? options_.rounds / kRoundsARepeat : 0;
    int poor = 0;
    for (int again = 0; again < repeats && poor < 2 && path->accepted() > 0; ++again) {
      const double before = path->cost(), reserve = again % 2 == 0 ? 1.0 : kMoreReserve;
      if (!SearchFrom(path->parameters(), 1.0, reserve, path)) return;
      poor = SearchPace::Gained(before, path->cost()) ? 0 : poor + 1;
    }
  }

  // Rounds from `start` until they gain next to nothing; `part`: of the search that is done;
  // `reserve`: how much more than usual the first round's rows keep. False: there is to be no
  // further one.
  bool SearchFrom(const HomotopyParameters& start, double part, double reserve, Incumbent* path) {
    ResetRows(options_.program.watch.sharpness, reserve, &program_.watched());
    solution_.warm_start = nullptr;
    Eigen::VectorXd x = program_.ToVariables(start);
    SearchPace pace(options_.rounds, restarts_.poor_rounds);
    for (int round = 0; !pace.over(); ++round) {
      const double before = path->cost();
      const double remaining =
          std::min(options_.deadline - monitor_.Seconds(), monitor_.Remaining());
      end_.deadline_passed = remaining <= 0.0;
      if (end_.deadline_passed || monitor_.stopped()) return false;
      solution_ = Solve(x, remaining, path);
      end_.Note(solution_);
      const bool refused = solution_.ending == opt::Ending::kInvalidInput;
      if (refused || solution_.x.size() != x.size()) return false;
      // Cheap and nearly feasible is a better place to go on from than the best feasible one.
      const bool near =
          solution_.final_x.size() == x.size() && solution_.final_violation < kHopeless;
      x = near ? solution_.final_x : solution_.x;
      const bool last = monitor_.Seconds() >= options_.deadline || round + 1 == options_.rounds ||
                        untried_rounds_ + 1 >= kUntriedRounds;
      const bool tried = LookAt(x, near, last, path);
      pace.Note(near ? solution_.final_cost : solution_.cost, before, path->cost());
      AdaptRows(tried, tried ? path->refusals() : std::vector<Margin>(), &program_.watched());
      monitor_.Progress(from_ + (0.9 - from_) * part);
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
  bool LookAt(const Eigen::VectorXd& x, bool near, bool always, Incumbent* path) {
    const HomotopyParameters end = program_.ToParameters(x);
    const SuperposedWalk walk(sequence_, end);
    const bool promising = program_.watched().Focus(walk, kLookPeriod, Level(x)) >= kPromising;
    SmoothingResult& result = monitor_.result();
    untried_rounds_ = promising || always ? 0 : untried_rounds_ + 1;
    if (!promising && !always) {
      ++result.raw_infeasible;
      result.raw_end_feasible = false;
      return false;
    }
    const double violation = near ? solution_.final_violation : solution_.max_violation;
    const bool tried = Try(end, violation, always, path);
    result.raw_end_feasible = tried && path->refusals().empty();
    if (!tried) return false;
    for (const Margin& refusal : path->refusals()) {
      program_.watched().Learn(walk, refusal.at, refusal.stop_after >= 0);
    }
    return true;
  }

  opt::Solution Solve(const Eigen::VectorXd& x, double deadline, Incumbent* path) {
    const opt::Problem problem = program_.MakeProblem();
    opt::SolverOptions solver_options =
        RoundOptions(solver_.traits(), options_.program.kind, options_.max_iterations);
    solver_options.deadline = deadline;
    solver_options.stop = monitor_.stop();
    solver_options.warm_start = solution_.warm_start;
    solver_options.on_iterate = [&](const opt::Iterate& iterate) {
      const HomotopyParameters candidate = program_.ToParameters(iterate.x);
      const bool wait = options_.max_iterations < kPatience || ++since_proof_ < kPatience;
      if (wait) {
        Record(candidate, iterate.violation, 0.0);
      } else {
        Try(candidate, iterate.violation, false, path);
      }
      return true;
    };
    return solver_.Solve(problem, x, solver_options);
  }

  // Proves the candidate, or what of it is near the incumbent where it is refused; `always`: also
  // where it is violated so much that all of it is hardly feasible. False: it is not tried.
  bool Try(const HomotopyParameters& candidate, double violation, bool always, Incumbent* path) {
    since_proof_ = 0;
    const bool tried = always || violation <= kHopeless;
    const double lambda = tried ? path->Toward(candidate, kAttempts) : 0.0;
    if (!tried || !path->refusals().empty()) ++monitor_.result().raw_infeasible;
    if (lambda > 0.0) {
      monitor_.Adopt(AcceptedInParts::Walk(path->parameters()), path->cost(),
                     DurationOf(path->parameters()));
      std::array<bool, kNumMarginFamilies> all;
      all.fill(true);
      incumbent_slack_ = program_.watched().LeastSlack(path->parameters(), all);
    }
    Record(candidate, violation, lambda);
    return tried;
  }

  void Record(const HomotopyParameters& candidate, double violation, double lambda) {
    SmoothingIterate record{.candidate_duration = DurationOf(candidate),
                            .accepted = lambda > 0.0,
                            .lambda = lambda,
                            .incumbent_slack = incumbent_slack_};
    if (violation > 0.0) record.candidate_worst_margin = -violation;
    monitor_.Record(record);
  }

  const WalkProblem& problem_;
  const HalfStepSequence& sequence_;
  const FeasibilityTest& test_;
  const OptimizerOptions& options_;
  const opt::Solver& solver_;
  const RestartPolicy& restarts_;
  const double from_;  // of the progress
  OverlapProgram& program_;
  SmoothingMonitor& monitor_;
  SearchEnding& end_;
  StretchProofs proofs_;
  const AcceptedWalk begun_;
  const HomotopyParameters& start_;        // its parameters
  opt::Solution solution_;                 // the last one
  std::optional<double> incumbent_slack_;  // at the instants watched
  int since_proof_ = 0;                    // candidates
  int untried_rounds_ = 0;                 // in a row
};

}  // namespace

bool SearchWhole(const WalkProblem& problem, const OptimizerOptions& options,
                 const opt::Solver& solver, const RestartPolicy& restarts, double from,
                 OverlapProgram* program, SmoothingMonitor& monitor, SearchEnding* ending) {
  return WholeSearch(problem, options, solver, restarts, from, program, monitor, ending).Run();
}

}  // namespace halfstep
