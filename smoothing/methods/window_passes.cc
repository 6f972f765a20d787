#include "smoothing/methods/window_passes.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "smoothing/methods/accepted_in_parts.h"
#include "smoothing/methods/incumbent.h"
#include "smoothing/methods/repeated_steps.h"
#include "smoothing/methods/search_rounds.h"
#include "smoothing/methods/walk_window.h"
#include "smoothing/methods/window_search.h"

namespace halfstep {
namespace {

// A window that gains less is not taken again [of the walk's mean cost a window].
constexpr double kWorthAnotherPass = 1e-3;
// Half-steps beside a window on which what it gains may bear.
constexpr int kBeside = 4;
// Rounds in a window: fewer in the first pass, whose windows end at rests that the next will move.
constexpr int kFirstRounds = 4, kLaterRounds = 8;
// Where passes take long, of more than so many windows, the first one has up to so many rounds in a
// window while they gain: half-steps that are planned slow would else take many passes to shrink.
constexpr int kManyWindows = 4, kFallingRounds = 16;

bool Any(const std::vector<bool>& flags, int first, int last) {
  const int n = static_cast<int>(flags.size());
  const auto begin = flags.begin() + std::clamp(first, 0, n);
  const auto end = flags.begin() + std::clamp(last + 1, 0, n);
  return std::find(begin, end, true) != end;
}

class WindowPasses {
 public:
  WindowPasses(const WalkProblem& problem, const WindowPassesOptions& options,
               const opt::Solver& solver, double from, double to, SmoothingMonitor& monitor,
               SearchEnding* ending)
      : problem_(problem),
        options_(options),
        solver_(solver),
        from_(from),
        to_(to),
        monitor_(monitor),
        end_(*ending),
        at_(monitor.incumbent()) {}

  bool Run() {
    const HomotopyParameters begun = at_;
    const double cost = monitor_.cost();
    Passes();
    if (!(monitor_.cost() < cost)) return false;
    // Gains were proved in parts of the walk, which begin at other times, so rounding differs.
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
    whole.Toward(at_, kAttempts);
    if (whole.parameters() != at_) {
      monitor_.Adopt(AcceptedInParts::Walk(whole.parameters()), whole.cost(),
                     DurationOf(whole.parameters()));
    }
    return whole.accepted() > 0;
  }

 private:
  int size() const { return problem_.sequence().size(); }

  bool Stopped() {
    end_.deadline_passed = monitor_.Seconds() >= options_.deadline || monitor_.Remaining() <= 0.0;
    return end_.deadline_passed || monitor_.stopped();
  }

  void Passes() {
    std::vector<bool> moved(static_cast<size_t>(size()), true);
    for (int pass = 0; pass < options_.passes; ++pass) {
      std::vector<bool> moves(moved.size(), false);
      // Every other pass has its windows' ends elsewhere.
      const int shift = pass % 2 == 0 ? 0 : options_.window / 4 * 2;
      for (int begin = -shift; begin < size(); begin += options_.step) {
        const int first = std::max(0, begin), last = std::min(begin + options_.window, size()) - 1;
        if (last < first || !Any(moved, first - kBeside, last + kBeside)) continue;
        if (Stopped()) return;
        if (SearchAt(first, last, pass == 0) > Worth()) {
          std::fill(moves.begin() + first, moves.begin() + last + 1, true);
        }
        monitor_.Progress(from_ + (to_ - from_) * (pass + (last + 1.0) / size()) / options_.passes);
        if (last + 1 == size()) break;
      }
      if (!Any(moves, 0, size() - 1)) return;
      moved = std::move(moves);
    }
    end_.exhausted = true;
  }

  double Worth() const { return kWorthAnotherPass * monitor_.cost() * options_.window / size(); }

  // What the window gains [s].
  double SearchAt(int first, int last, bool in_first_pass) {
    const WalkWindow window = WindowOf(problem_, at_, first, last);
    WindowSearchOptions options{.program = options_.program, .rounds = kLaterRounds};
    if (in_first_pass) {
      options.rounds = kFirstRounds;
      if (size() > kManyWindows * options_.window) options.most_rounds = kFallingRounds;
    }
    if (met_ > 0 && met_ <= last) {
      options.start = window.Cut(RepeatSteps(problem_.sequence(), at_, met_, last));
    }
    met_ = std::max(met_, last + 1);
    const double before = monitor_.cost();
    SearchWindow(
        window, options, solver_, options_.deadline, monitor_,
        [&](const HomotopyParameters& part, double gain) {
          window.Paste(part, &at_);
          monitor_.Adopt(AcceptedInParts::Walk(at_), before - gain, DurationOf(at_));
        },
        &end_);
    return before - monitor_.cost();
  }

  const WalkProblem& problem_;
  const WindowPassesOptions& options_;
  const opt::Solver& solver_;
  const double from_, to_;  // of the progress
  SmoothingMonitor& monitor_;
  SearchEnding& end_;
  HomotopyParameters at_;  // the incumbent
  int met_ = 0;            // half-steps that were in a window
};

}  // namespace

bool SearchWindows(const WalkProblem& problem, const WindowPassesOptions& options,
                   const opt::Solver& solver, double from, double to, SmoothingMonitor& monitor,
                   SearchEnding* ending) {
  return WindowPasses(problem, options, solver, from, to, monitor, ending).Run();
}

}  // namespace halfstep
