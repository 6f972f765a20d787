#include "smoothing/methods/search_stages.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "smoothing/methods/accepted_in_parts.h"
#include "smoothing/methods/search_pace.h"
#include "smoothing/methods/typical_start.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// Half-steps beside a window on which what it gains may bear.
constexpr int kBeside = 4;

bool Any(const std::vector<bool>& flags, int first, int last) {
  const int n = static_cast<int>(flags.size());
  const auto begin = flags.begin() + std::clamp(first, 0, n);
  const auto end = flags.begin() + std::clamp(last + 1, 0, n);
  return std::find(begin, end, true) != end;
}

class Stages {
 public:
  Stages(const WalkProblem& problem, SearchStart start, const RangeOptions& options, double effort,
         SmoothingMonitor& monitor, SearchEnding* ending)
      : problem_(problem),
        start_(start),
        options_(options),
        effort_(effort),
        monitor_(monitor),
        end_(*ending),
        at_(monitor.incumbent()) {}

  // False: the search is to end.
  bool Run(const SearchStage& stage) {
    RangeOptions options = options_;
    options.rounds = stage.rounds;
    if (stage.resting) return Rest(options);
    return stage.window == 0 ? Whole(options) : Windows(stage, options);
  }

  // Whether a first walk is proved.
  bool First(RangeOptions options) {
    options.first_proof = true;
    options.from_proved = false;
    const WalkWindow range = WholeRange(problem_, at_);
    RangeSearch search(range, options, monitor_, Adopting(), &end_);
    if (!search.moves()) return false;
    // Each start has its part of the effort, since any of them may lead nowhere.
    const std::vector<HomotopyParameters> starts = Starts(range);
    for (size_t i = 0; i < starts.size(); ++i) {
      const double used = monitor_.work().effort();
      const double part = (effort_ - used) / static_cast<double>(starts.size() - i);
      search.From(starts[i], 1.0, used + part);
      if (search.path().accepted() > 0) return true;
      if (monitor_.cut_off()) return false;
    }
    return false;
  }

 private:
  int size() const { return problem_.sequence().size(); }

  HomotopyParameters Typical(const WalkWindow& range, const TypicalForm* form) const {
    return TypicalStart(range.problem, options_.program.parameters, monitor_.scratch(), form);
  }

  RangeGain Adopting() {
    return [this](const HomotopyParameters& walk, double cost, double) {
      at_ = walk;
      monitor_.Adopt(AcceptedInParts::Walk(walk), cost, DurationOf(walk));
    };
  }

  std::vector<HomotopyParameters> Starts(const WalkWindow& range) const {
    return {Typical(range, nullptr), Typical(range, &TypicalForms().back()), problem_.Start()};
  }

  bool Rest(RangeOptions options) {
    options.first_proof = true;
    options.program = Resting(options.program, problem_);
    const WalkWindow range = WholeRange(problem_, at_);
    RangeSearch search(range, options, monitor_, Adopting(), &end_);
    if (!search.moves()) return true;
    for (const HomotopyParameters& start : Starts(range)) {
      if (!search.From(start, 1.0, effort_)) return false;
      rested_ = search.path().accepted() > 0;
      if (rested_) return true;
    }
    return true;
  }

  bool Whole(const RangeOptions& options) {
    const WalkWindow range = WholeRange(problem_, at_);
    RangeSearch search(range, options, monitor_, Adopting(), &end_);
    monitor_.Adopt(*monitor_.accepted(), search.path().cost(), DurationOf(at_));
    if (!search.moves()) return true;
    const bool from_forms = start_ == SearchStart::kTypical && met_ == 0;
    if (!from_forms || rested_) {
      const double more = rested_ ? options.tuning.sure_reserve : 1.0;
      if (!search.From(at_, more, effort_)) return false;
    }
    if (from_forms) {
      for (const HomotopyParameters& start : Starts(range)) {
        if (!search.From(start, 1.0, effort_)) return false;
      }
    }
    // Where rounds lead into what cannot be mended, the incumbent, which has come a part of the
    // way, is a place to set out from again.
    int poor = 0;
    for (int again = 0; poor < options.tuning.poor_starts && search.path().accepted() > 0;
         ++again) {
      const double before = search.path().cost();
      const double more = again % 2 == 0 ? 1.0 : options.tuning.more_reserve;
      if (!search.From(search.path().parameters(), more, effort_)) return false;
      poor = SearchPace::Gained(before, search.path().cost()) ? 0 : poor + 1;
    }
    return true;
  }

  bool Windows(const SearchStage& stage, const RangeOptions& options) {
    const HomotopyParameters begun = at_;
    const double cost = monitor_.cost();
    const bool goes_on = Passes(stage, options);
    met_ = size();
    if (monitor_.cost() < cost) ProveWhole(begun, cost);
    return goes_on;
  }

  bool Passes(const SearchStage& stage, const RangeOptions& options) {
    std::vector<bool> moved(static_cast<size_t>(size()), true);
    met_ = 0;
    for (int pass = 0; pass < stage.passes; ++pass) {
      std::vector<bool> moves(moved.size(), false);
      // Every other pass has its windows' ends elsewhere.
      const int shift = pass % 2 == 0 ? 0 : stage.window / 4 * 2;
      for (int begin = -shift; begin < size(); begin += stage.step) {
        const int first = std::max(0, begin), last = std::min(begin + stage.window, size()) - 1;
        if (last < first || !Any(moved, first - kBeside, last + kBeside)) continue;
        const double before = monitor_.cost();
        const bool goes_on = SearchAt(first, last, pass == 0, options);
        const double worth = options.tuning.gain * before * stage.window / size();
        if (before - monitor_.cost() > worth) {
          std::fill(moves.begin() + first, moves.begin() + last + 1, true);
        }
        if (!goes_on) return false;
        if (last + 1 == size()) break;
      }
      if (!Any(moves, 0, size() - 1)) return true;
      moved = std::move(moves);
    }
    end_.exhausted = true;
    return true;
  }

  bool SearchAt(int first, int last, bool first_pass, RangeOptions options) {
    if (first_pass) {  // what comes behind will be moved: the rest can wait
      options.first_proof = true;
      options.program = Resting(options.program, problem_);
    }
    const WalkWindow window = WindowOf(problem_, at_, first, last);
    const double before = monitor_.cost();
    RangeSearch search(
        window, options, monitor_,
        [&](const HomotopyParameters& part, double, double gain) {
          window.Paste(part, &at_);
          monitor_.Adopt(AcceptedInParts::Walk(at_), before - gain, DurationOf(at_));
        },
        &end_);
    if (!search.moves()) return true;
    HomotopyParameters start = window.parameters;
    if (met_ <= last && start_ == SearchStart::kTypical) {
      const HomotopyParameters typical = Typical(window, nullptr);
      for (const ParameterFamily family : AllParameterFamilies()) {
        std::vector<double>& values = start.of(family);
        for (size_t i = 0; i < values.size(); ++i) {
          const int to = Traits(family).half_steps(static_cast<int>(i)).second + window.begin;
          if (to >= met_) values[i] = Nth(typical.of(family), i);
        }
      }
    }
    met_ = std::max(met_, last + 1);
    search.From(start, 1.0, effort_);
    return !monitor_.cut_off() && monitor_.work().effort() < effort_;
  }

  // Gains were proved in parts of the walk, which begin at other times, so rounding differs.
  void ProveWhole(const HomotopyParameters& begun, double cost) {
    StretchProofs proofs(problem_.test(), size());
    proofs.Remember(SuperposedWalk(problem_.sequence(), begun));
    Incumbent whole(
        problem_.sequence(),
        {.cost =
             [this](const HomotopyParameters& p) {
               return CostOf(problem_.sequence(), p, options_.program);
             },
         .prove =
             [&proofs](const SuperposedWalk& walk, double, MarginEvaluator::Scratch* scratch) {
               return proofs.Refusals(walk, scratch);
             }},
        begun, cost, monitor_.scratch());
    whole.Toward(at_, options_.tuning.attempts);
    if (whole.parameters() == at_) return;
    at_ = whole.parameters();
    monitor_.Adopt(AcceptedInParts::Walk(at_), whole.cost(), DurationOf(at_));
  }

  const WalkProblem& problem_;
  const SearchStart start_;
  const RangeOptions& options_;
  const double effort_;
  SmoothingMonitor& monitor_;
  SearchEnding& end_;
  HomotopyParameters at_;  // the incumbent
  int met_ = 0;            // half-steps that were in a window
  bool rested_ = false;    // whether it is near walks on whose support points the robot can rest
};

}  // namespace

std::string_view Name(SearchStart start) {
  switch (start) {
    case SearchStart::kTypical:
      return "typical";
    case SearchStart::kDichotomy:
      return "dichotomy";
    case SearchStart::kPlanned:
      return "planned";
  }
  return "";
}

bool RunStages(const WalkProblem& problem, std::span<const SearchStage> stages, SearchStart start,
               const RangeOptions& options, double effort, SmoothingMonitor& monitor,
               SearchEnding* ending) {
  const HomotopyParameters begun = monitor.incumbent();
  Stages search(problem, start, options, effort, monitor, ending);
  for (const SearchStage& stage : stages) {
    if (!search.Run(stage)) break;
  }
  return monitor.incumbent() != begun;
}

bool FindFirst(const WalkProblem& problem, const RangeOptions& options, double effort,
               SmoothingMonitor& monitor, SearchEnding* ending) {
  return Stages(problem, SearchStart::kTypical, options, effort, monitor, ending).First(options);
}

}  // namespace halfstep
