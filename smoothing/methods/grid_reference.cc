#include "smoothing/methods/grid_reference.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <utility>

#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/feasible_path.h"
#include "smoothing/methods/stopwatch.h"
#include "smoothing/methods/stretch_grid.h"
#include "smoothing/program/overlap_program.h"
#include "smoothing/proof/stretch_proofs.h"
#include "wpg/check.h"

namespace halfstep {
namespace {

using opt::Ending;

constexpr int kAttempts = 6;    // towards a grid's optimum that the test refuses
constexpr double kGain = 1e-4;  // a round that gains less counts as none [s]

class Reference {
 public:
  Reference(const HalfStepSequence& sequence, const FeasibilityTest& test,
            const GridReferenceOptions& options, const std::function<void(double)>& progress,
            std::stop_token stop)
      : sequence_(sequence),
        test_(test),
        options_(options),
        progress_(progress),
        stop_(std::move(stop)),
        planned_(PlannedMotion(sequence)),
        grid_(sequence, test.evaluator(), options.period),
        proofs_(test, sequence.size()),
        random_(options.seed) {}

  SmoothingResult Run() {
    std::vector<HomotopyParameters> starts = Starts();
    if (starts.empty()) return std::move(result_);
    for (size_t s = 0; s < starts.size() && !stop_.stop_requested(); ++s) {
      FeasiblePath path(sequence_, Rules(), starts[s], DurationOf(starts[s]),
                        test_.evaluator().MakeScratch());
      if (s == 0 && !options_.heights && !options_.durations && options_.global_values > 1) {
        Round(GlobalChoices(), &path);
      }
      Corridor(&path, [&](double done) {
        if (progress_)
          progress_((static_cast<double>(s) + done) / static_cast<double>(starts.size()));
      });
      result_.instants += path.scratch().instants;
      result_.collision_queries += path.scratch().bodies.queries;
    }
    return Finish();
  }

 private:
  // The dichotomy's result and the feasible ones of those given.
  std::vector<HomotopyParameters> Starts() {
    std::vector<HomotopyParameters> starts;
    result_ = Dichotomy(sequence_, test_, {}, {}, stop_);
    result_.iterates.clear();
    if (result_.feasible) starts.push_back(result_.parameters);
    MarginEvaluator::Scratch scratch = test_.evaluator().MakeScratch();
    for (const HomotopyParameters& start : options_.starts) {
      const SuperposedWalk walk(sequence_, start);
      const Feasibility answer = test_.Check(walk, {0.0, walk.duration()}, &scratch);
      if (answer.verdict == Verdict::kFeasible) starts.push_back(start);
    }
    result_.instants += scratch.instants;
    result_.collision_queries += scratch.bodies.queries;
    result_.feasible = !starts.empty();
    if (starts.empty()) return starts;
    best_ = starts[0];
    for (const HomotopyParameters& start : starts) Keep(start);
    begun_ = DurationOf(best_);
    return starts;
  }

  void Keep(const HomotopyParameters& point) {
    if (DurationOf(point) < DurationOf(best_)) best_ = point;
  }

  FeasiblePath::Rules Rules() {
    return {.cost = [](const HomotopyParameters& p) { return DurationOf(p); },
            .prove =
                [this](const SuperposedWalk& walk, double, MarginEvaluator::Scratch* scratch) {
                  return proofs_.Refusals(walk, scratch);
                }};
  }

  StretchChoice At(const HomotopyParameters& point, size_t k) const {
    return {k > 0 ? point.overlaps[k - 1] : 0.0, point.durations[k], point.height_scales[k / 2]};
  }

  StretchGrid::Choices GlobalChoices() const {
    StretchGrid::Choices choices;
    for (size_t k = 0; k < planned_.durations.size(); ++k) {
      StretchChoice choice = At(planned_, k);
      choices.push_back({});
      const int values = k == 0 ? 1 : options_.global_values;
      for (int i = 0; i < values; ++i) {
        if (k > 0) {
          choice.overlap =
              NaturalOverlapBound(sequence_, planned_.durations, static_cast<int>(k) - 1) * i /
              (values - 1);
        }
        choices.back().push_back(choice);
      }
    }
    return choices;
  }

  StretchGrid::Choices Neighbours(const HomotopyParameters& point, double step) {
    StretchGrid::Choices choices;
    std::uniform_int_distribution<int> sign(-1, 1);
    for (size_t k = 0; k < point.durations.size(); ++k) {
      const StretchChoice incumbent = At(point, k);
      choices.push_back({incumbent});
      if (!options_.heights && !options_.durations) {
        for (int i : {-2, -1, 1, 2}) {
          if (k > 0)
            choices.back().push_back({std::max(0.0, incumbent.overlap + i * step),
                                      incumbent.duration, incumbent.height});
        }
        continue;
      }
      for (int c = 1; c < options_.choices; ++c) {
        StretchChoice choice = incumbent;
        if (options_.durations) {
          const double T = planned_.durations[k];
          const double factor = 1.0 + step * sign(random_);
          choice.duration = std::clamp(incumbent.duration * factor, options_.least_duration * T,
                                       options_.most_duration * T);
          choice.overlap *= choice.duration / incumbent.duration;
        }
        if (options_.heights && k % 2 == 0) {
          choice.height = std::clamp(incumbent.height * (1.0 + 2.0 * step * sign(random_)),
                                     options_.least_height_scale, 1.0);
        }
        choice.overlap = std::max(0.0, choice.overlap + step * sign(random_));
        choices.back().push_back(choice);
      }
    }
    return choices;
  }

  // What one solution of the grid gains [s].
  double Round(const StretchGrid::Choices& choices, FeasiblePath* path) {
    const double before = path->cost();
    const std::vector<int> indices =
        grid_.Solve(choices, before, [this] { return stop_.stop_requested(); });
    SmoothingIterate iterate{.wall = 0.0, .candidate_duration = before};
    if (!indices.empty()) {
      const HomotopyParameters candidate = grid_.ParametersOf(choices, indices);
      iterate.candidate_duration = DurationOf(candidate);
      iterate.lambda = path->Toward(candidate, kAttempts);
      iterate.accepted = iterate.lambda > 0.0;
      if (!path->refusals().empty()) ++result_.raw_infeasible;
    }
    Keep(path->incumbent());
    iterate.wall = stopwatch_.Seconds();
    iterate.evaluations = result_.instants + grid_.scratch().instants + path->scratch().instants;
    iterate.incumbent_duration = iterate.incumbent_cost = DurationOf(best_);
    result_.iterates.push_back(iterate);
    return before - path->cost();
  }

  void Corridor(FeasiblePath* path, const std::function<void(double)>& progress) {
    const bool random = options_.heights || options_.durations;
    const int patience = random ? options_.patience : 1;
    int idle = 0, rounds = 0;
    double step = options_.widest;
    for (; step >= options_.narrowest && rounds < options_.max_rounds; ++rounds) {
      if (stop_.stop_requested()) return;
      const double gain = Round(Neighbours(path->incumbent(), step), path);
      idle = gain > kGain ? 0 : idle + 1;
      if (idle == patience) {
        idle = 0;
        step *= 0.5;
        progress(std::log(options_.widest / step) / std::log(options_.widest / options_.narrowest));
      }
    }
    finest_ = std::max(2.0 * step, options_.narrowest);
    exhausted_ = exhausted_ || rounds == options_.max_rounds;
  }

  Ending EndingNow() const {
    if (result_.iterates.empty()) return Ending::kNotRun;
    if (!(result_.cost < begun_)) return Ending::kNoImprovement;
    if (stop_.stop_requested()) return Ending::kInterrupted;
    return exhausted_ ? Ending::kLimit : Ending::kConverged;
  }

  SmoothingResult Finish() {
    result_.parameters = best_;
    result_.cost = DurationOf(best_);
    for (int i = 0; i < sequence_.num_junctions(); ++i) {
      JunctionResult& junction = result_.junctions[static_cast<size_t>(i)];
      junction.overlap = best_.overlaps[static_cast<size_t>(i)];
      junction.upper_bound = NaturalOverlapBound(sequence_, best_.durations, i);
      junction.limited_by.reset();
    }
    std::ostringstream message;
    message << "dynamic programming, last step " << 1e3 * finest_ << " ms, looked at every "
            << 1e3 * options_.period << " ms; " << result_.iterates.size() << " rounds, "
            << grid_.passes() << " stretches";
    if (exhausted_) message << "; the last corridor was not finished";
    result_.message = message.str();
    if (stop_.stop_requested()) {
      result_.message =
          "stopped from outside; the parameters are the best that were found feasible";
    }
    result_.ending = EndingNow();
    if (result_.ending == Ending::kNoImprovement) {
      result_.message += "; no shorter than the shortest walk that it began with";
    }
    result_.instants += grid_.scratch().instants;
    result_.collision_queries += grid_.scratch().bodies.queries;
    result_.wall = stopwatch_.Seconds();
    return std::move(result_);
  }

  const HalfStepSequence& sequence_;
  const FeasibilityTest& test_;
  const GridReferenceOptions& options_;
  const std::function<void(double)>& progress_;
  std::stop_token stop_;
  HomotopyParameters planned_;
  HomotopyParameters best_;  // found feasible
  double begun_ = 0.0;       // the shortest start's duration [s]
  StretchGrid grid_;
  StretchProofs proofs_;
  std::mt19937_64 random_;
  Stopwatch stopwatch_;
  double finest_ = 0.0;
  bool exhausted_ = false;
  SmoothingResult result_;
};

}  // namespace

SmoothingResult GridReference(const HalfStepSequence& sequence, const FeasibilityTest& test,
                              const GridReferenceOptions& options,
                              const std::function<void(double)>& progress, std::stop_token stop) {
  HALFSTEP_CHECK(options.period > 0.0 && options.narrowest > 0.0 && options.choices >= 2 &&
                     options.patience >= 1,
                 "period " << options.period << ", narrowest " << options.narrowest << ", choices "
                           << options.choices << ", patience " << options.patience);
  return Reference(sequence, test, options, progress, std::move(stop)).Run();
}

}  // namespace halfstep
