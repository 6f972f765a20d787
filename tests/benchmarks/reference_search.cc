#include "tests/benchmarks/reference_search.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "smoothing/methods/accepted_in_parts.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/incumbent.h"
#include "smoothing/proof/stretch_proofs.h"
#include "tests/benchmarks/dynamic_program.h"
#include "wpg/check.h"
#include "wpg/files/plain_locale.h"

namespace halfstep {
namespace {

using opt::Ending;

constexpr int kGridAttempts = 6;     // towards a grid's optimum that the test refuses
constexpr double kRoundGain = 1e-4;  // a round that gains less counts as none [s]

class Reference {
 public:
  Reference(const WalkProblem& problem, const ReferenceOptions& options, SmoothingMonitor& monitor)
      : sequence_(problem.sequence()),
        problem_(problem),
        options_(options),
        monitor_(monitor),
        table_(problem.Parameters(options.parameters)),
        planned_(problem.Start()),
        grid_(sequence_, problem.evaluator(), planned_, options.period),
        proofs_(problem.test(), sequence_.size()),
        random_(options.seed) {}

  SmoothingResult Run() {
    if (!problem_.scene().rests()) {
      monitor_.Begin(problem_, planned_);
      return monitor_.Finish(Ending::kNotRun,
                             "stretches are looked at apart from each other, which obstacles that "
                             "move do not allow");
    }
    const std::vector<HomotopyParameters> starts = Starts();
    if (starts.empty()) return monitor_.Finish(Ending::kNotRun, refusal_);
    for (size_t s = 0; s < starts.size() && !monitor_.stopped(); ++s) {
      Incumbent path(sequence_, Rules(), starts[s], DurationOf(starts[s]), monitor_.scratch());
      if (s == 0 && OverlapsOnly() && options_.global_values > 1) Round(GlobalChoices(), &path);
      Corridor(&path, [&](double done) {
        monitor_.Progress((static_cast<double>(s) + done) / static_cast<double>(starts.size()));
      });
    }
    return Finish();
  }

 private:
  using Family = ParameterFamily;

  bool OverlapsOnly() const {
    return !options_.parameters.heights && !options_.parameters.durations;
  }

  // The dichotomy's result and the feasible ones of those given; the monitor begins at the
  // shortest.
  std::vector<HomotopyParameters> Starts() {
    std::vector<HomotopyParameters> starts;
    SmoothingMonitor within(monitor_.Part(0.0, 0.0));
    const SmoothingResult dichotomy = Dichotomy(problem_, {}, within);
    if (dichotomy.feasible) starts.push_back(dichotomy.parameters);
    refusal_ = dichotomy.message;
    MarginEvaluator::Scratch scratch = problem_.evaluator().MakeScratch();
    scratch.stop = monitor_.stop();
    for (const HomotopyParameters& start : options_.starts) {
      const SuperposedWalk walk(sequence_, start);
      const Feasibility answer = problem_.test().Check(walk, {0.0, walk.duration()}, &scratch);
      if (answer.verdict == Verdict::kFeasible) starts.push_back(start);
    }
    const auto shortest = std::min_element(
        starts.begin(), starts.end(), [](const HomotopyParameters& a, const HomotopyParameters& b) {
          return DurationOf(a) < DurationOf(b);
        });
    if (starts.empty()) {
      monitor_.Begin(problem_, planned_);
    } else {
      monitor_.BeginAccepted(problem_, AcceptedInParts::Walk(*shortest));
    }
    monitor_.Count(dichotomy);
    monitor_.Count(scratch.work, scratch.bodies.queries);
    return starts;
  }

  void Keep(const HomotopyParameters& point) {
    const double duration = DurationOf(point);
    if (duration < monitor_.duration()) {
      monitor_.Adopt(AcceptedInParts::Walk(point), duration, duration);
    }
  }

  Incumbent::Rules Rules() {
    return {.cost = [](const HomotopyParameters& p) { return DurationOf(p); },
            .prove =
                [this](const SuperposedWalk& walk, double, MarginEvaluator::Scratch* scratch) {
                  return proofs_.Refusals(walk, scratch);
                }};
  }

  StretchChoice At(const HomotopyParameters& point, size_t k) const {
    return {k > 0 ? point.overlaps[k - 1] : 0.0, point.durations[k], point.height_scales[k / 2]};
  }

  DynamicProgram::Choices GlobalChoices() const {
    DynamicProgram::Choices choices;
    for (size_t k = 0; k < planned_.durations.size(); ++k) {
      StretchChoice choice = At(planned_, k);
      choices.push_back({});
      const bool one = k == 0 || !table_.free({Family::kOverlap, static_cast<int>(k) - 1});
      const int values = one ? 1 : options_.global_values;
      for (int i = 0; i < values; ++i) {
        if (!one) {
          choice.overlap =
              NaturalOverlapBound(planned_, static_cast<int>(k) - 1) * i / (values - 1);
        }
        choices.back().push_back(choice);
      }
    }
    return choices;
  }

  DynamicProgram::Choices Neighbours(const HomotopyParameters& point, double step) {
    DynamicProgram::Choices choices;
    std::uniform_int_distribution<int> sign(-1, 1);
    for (size_t k = 0; k < point.durations.size(); ++k) {
      const int i = static_cast<int>(k);
      const StretchChoice incumbent = At(point, k);
      const bool overlaps = k > 0 && table_.free({Family::kOverlap, i - 1});
      choices.push_back({incumbent});
      if (OverlapsOnly()) {
        for (int by : {-2, -1, 1, 2}) {
          if (!overlaps) continue;
          choices.back().push_back(incumbent);
          choices.back().back().overlap = std::max(0.0, incumbent.overlap + by * step);
        }
        continue;
      }
      const ParameterRow& T = table_.row({Family::kDuration, i});
      const ParameterRow& eta = table_.row({Family::kHeightScale, i / 2});
      for (int c = 1; c < options_.choices; ++c) {
        StretchChoice choice = incumbent;
        if (!T.fixed) {
          const double factor = 1.0 + step * sign(random_);
          choice.duration = std::clamp(incumbent.duration * factor, T.lower, T.upper);
          if (overlaps) choice.overlap *= choice.duration / incumbent.duration;
        }
        if (!eta.fixed && k % 2 == 0) {
          choice.height = std::clamp(incumbent.height * (1.0 + 2.0 * step * sign(random_)),
                                     eta.lower, eta.upper);
        }
        const double moved = std::max(0.0, choice.overlap + step * sign(random_));
        if (overlaps) choice.overlap = moved;
        choices.back().push_back(choice);
      }
    }
    return choices;
  }

  // What one solution of the grid gains [s].
  double Round(const DynamicProgram::Choices& choices, Incumbent* path) {
    const double before = path->cost();
    const std::vector<int> indices =
        grid_.Solve(choices, before, [this] { return monitor_.stopped(); });
    const MarginEvaluator::Scratch& spent = grid_.scratch();
    monitor_.Count(spent.work - counted_, spent.bodies.queries - counted_queries_);
    counted_ = spent.work;
    counted_queries_ = spent.bodies.queries;
    SmoothingIterate iterate{.candidate_duration = before};
    if (!indices.empty()) {
      const HomotopyParameters candidate = grid_.ParametersOf(choices, indices);
      iterate.candidate_duration = DurationOf(candidate);
      iterate.lambda = path->Toward(candidate, kGridAttempts);
      iterate.accepted = iterate.lambda > 0.0;
      if (!path->refusals().empty()) ++monitor_.result().raw_infeasible;
    }
    Keep(path->parameters());
    monitor_.Record(iterate);
    return before - path->cost();
  }

  void Corridor(Incumbent* path, const std::function<void(double)>& progress) {
    const bool random = !OverlapsOnly();
    const int patience = random ? options_.patience : 1;
    int idle = 0, rounds = 0;
    double step = options_.widest;
    for (; step >= options_.narrowest && rounds < options_.max_rounds; ++rounds) {
      if (monitor_.stopped()) return;
      const double gain = Round(Neighbours(path->parameters(), step), path);
      idle = gain > kRoundGain ? 0 : idle + 1;
      if (idle == patience) {
        idle = 0;
        step *= 0.5;
        progress(std::log(options_.widest / step) / std::log(options_.widest / options_.narrowest));
      }
    }
    finest_ = std::max(2.0 * step, options_.narrowest);
    exhausted_ = exhausted_ || rounds == options_.max_rounds;
  }

  SmoothingResult Finish() {
    PlainStream message;
    message << "dynamic programming, last step " << 1e3 * finest_ << " ms, looked at every "
            << 1e3 * options_.period << " ms; " << monitor_.result().iterates.size() << " rounds, "
            << grid_.passes() << " stretches";
    if (exhausted_) message << "; the last corridor was not finished";
    const bool stopped = monitor_.stopped();
    const Ending ending = monitor_.result().iterates.empty() ? Ending::kNotRun
                          : stopped                          ? monitor_.StopEnding()
                          : exhausted_                       ? Ending::kLimit
                                                             : Ending::kConverged;
    return monitor_.FinishAgainstStart(
        ending,
        stopped ? monitor_.StopReason() + "; the parameters are the best that were found feasible"
                : message.str(),
        "; no shorter than the shortest walk that it began with");
  }

  const HalfStepSequence& sequence_;
  const WalkProblem& problem_;
  const ReferenceOptions& options_;
  SmoothingMonitor& monitor_;
  ParameterTable table_;
  HomotopyParameters planned_;
  DynamicProgram grid_;
  StretchProofs proofs_;
  std::mt19937_64 random_;
  Work counted_;  // of the grid
  long counted_queries_ = 0;
  double finest_ = 0.0;
  bool exhausted_ = false;
  std::string refusal_;
};

}  // namespace

SmoothingResult ReferenceSearch(const WalkProblem& problem, const ReferenceOptions& options,
                                SmoothingMonitor& monitor) {
  HALFSTEP_CHECK(options.period > 0.0 && options.narrowest > 0.0 && options.choices >= 2 &&
                     options.patience >= 1,
                 "period " << options.period << ", narrowest " << options.narrowest << ", choices "
                           << options.choices << ", patience " << options.patience);
  return Reference(problem, options, monitor).Run();
}

}  // namespace halfstep
