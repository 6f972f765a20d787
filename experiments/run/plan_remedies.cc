#include "experiments/run/plan_remedies.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/scene/no_step_areas.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr size_t kMostFootsteps = 3;
// Tried in this order, the smallest changes first.
constexpr double kHigher[] = {0.01, 0.02,  0.03, 0.04,  0.06, 0.08,  0.1,  -0.01,
                              0.13, -0.02, 0.16, -0.04, 0.2,  -0.06, 0.25, -0.1};  // [m]
constexpr double kLonger[] = {1.1, 1.2, 1.35, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0};
constexpr double kLongerAndHigher[] = {1.1, 1.25, 1.5, 2.0};
constexpr double kFarther[] = {0.01,  -0.01, 0.02,  -0.02, 0.03, -0.03,
                               -0.04, 0.04,  -0.06, 0.06,  0.08, -0.08};  // [m]
constexpr double kLeastHeight = 0.01, kMostHeight = 1.0;                  // [m]
constexpr double kMostDuration = 6.0;                                     // [s]

// Values as they are told, so that exactly what is told was tried.
double Rounded(double value, double grid) { return std::round(value / grid) * grid; }

struct FoundRemedy {
  std::string words;
  FootstepConfig footstep;  // with it; nothing where it is for all footsteps
};

class Trials {
 public:
  Trials(const Experiment& experiment, const WalkProblem& problem, const std::stop_token& stop)
      : experiment_(experiment),
        problem_(problem),
        areas_(experiment.scene, experiment.robot.sole_outline),
        scratch_(problem.evaluator().MakeScratch()) {
    scratch_.stop = stop;
  }

  // Of one footstep, or of all that have no height of their own; the same below.
  std::optional<FoundRemedy> Height(std::optional<int> step) {
    const double planned = step ? HeightOf(*step) : experiment_.config.half_step.via_height;
    for (const double higher : kHigher) {
      const double height = Rounded(planned + higher, 0.001);
      if (height < kLeastHeight || height > kMostHeight) continue;
      ExperimentConfig config = experiment_.config;
      (step ? FootstepOf(*step, &config).via_height.emplace() : config.half_step.via_height) =
          height;
      if (!Feasible(config, step, 1)) continue;
      return Found(config, step,
                   Formatted("a via point %.3g m high in place of %.3g m (`%svia_height_m: %.3g`)",
                             height, planned, Key(step).c_str(), height));
    }
    return std::nullopt;
  }

  std::optional<FoundRemedy> Duration(std::optional<int> step) {
    const double planned = step ? DurationOf(*step) : experiment_.config.half_step.duration;
    for (const double longer : kLonger) {
      const double duration = Rounded(longer * planned, 0.01);
      if (duration > kMostDuration) break;
      ExperimentConfig config = experiment_.config;
      (step ? FootstepOf(*step, &config).duration.emplace() : config.half_step.duration) = duration;
      if (!Feasible(config, step, 1)) continue;
      return Found(config, step,
                   Formatted("half-steps of %.3g s in place of %.3g s (`%sduration_s: %.3g`)",
                             duration, planned, Key(step).c_str(), duration));
    }
    return std::nullopt;
  }

  // A higher via point, which needs more time; for where neither helps alone.
  std::optional<FoundRemedy> HeightAndDuration(int step) {
    for (const double longer : kLongerAndHigher) {
      for (const double higher : {0.01, 0.02, 0.03, 0.04, 0.06, 0.08, 0.1, 0.13}) {
        ExperimentConfig config = experiment_.config;
        const double height = Rounded(HeightOf(step) + higher, 0.001);
        const double duration = Rounded(longer * DurationOf(step), 0.01);
        if (height > kMostHeight || duration > kMostDuration) continue;
        FootstepOf(step, &config).via_height = height;
        FootstepOf(step, &config).duration = duration;
        if (!Feasible(config, step, 1)) continue;
        return Found(
            config, step,
            Formatted("a via point %.3g m high and half-steps of %.3g s (`%svia_height_m: %.3g`, "
                      "`%sduration_s: %.3g`)",
                      height, duration, Key(step).c_str(), height, Key(step).c_str(), duration));
      }
    }
    return std::nullopt;
  }

  // The landing, farther or nearer on its way; the two steps after it begin elsewhere then.
  std::optional<FoundRemedy> Landing(int step) {
    const PlacedHalfStep& up = Nth(problem_.sequence().half_steps, 2 * step);
    const Foothold from = up.X_WS * up.half_step.X_SF;
    const FootstepConfig& planned = Nth(experiment_.config.footsteps, step);
    const Eigen::Vector2d way(planned.X_WF.x - from.x, planned.X_WF.y - from.y);
    if (way.norm() < 0.01) return std::nullopt;  // it steps in place
    for (const double farther : kFarther) {
      const Eigen::Vector2d shift = farther * way.normalized();
      ExperimentConfig config = experiment_.config;
      Pose2& landing = FootstepOf(step, &config).X_WF;
      landing.x = Rounded(landing.x + shift.x(), 0.001);
      landing.y = Rounded(landing.y + shift.y(), 0.001);
      if (!Feasible(config, step, 3)) continue;
      const std::string key = Formatted("footsteps.%d.", step);
      return Found(config, step,
                   Formatted("a landing %.0f cm %s (`%sx_m: %.3g`, `%sy_m: %.3g`)",
                             100.0 * std::abs(farther), farther > 0.0 ? "farther" : "nearer",
                             key.c_str(), landing.x, key.c_str(), landing.y));
    }
    return std::nullopt;
  }

  // Of the whole plan.
  Feasibility Check(const ExperimentConfig& config) {
    return Check(config, 0, static_cast<int>(config.footsteps.size()));
  }

  bool stopped() const { return scratch_.stop.stop_requested(); }

 private:
  double HeightOf(int step) const {
    return Nth(problem_.sequence().half_steps, 2 * step).half_step.via_height;
  }
  double DurationOf(int step) const {
    return Nth(problem_.sequence().half_steps, 2 * step).half_step.duration;
  }

  static FootstepConfig& FootstepOf(int step, ExperimentConfig* config) {
    return Nth(config->footsteps, step);
  }
  static std::string Key(std::optional<int> step) {
    return step ? Formatted("footsteps.%d.", *step) : "half_step.";
  }

  static FoundRemedy Found(const ExperimentConfig& config, std::optional<int> step,
                           std::string words) {
    FoundRemedy remedy{.words = std::move(words), .footstep = {}};
    if (step) remedy.footstep = Nth(config.footsteps, *step);
    return remedy;
  }

  // Whether the footstep and those behind it, `steps` in all, are feasible by themselves; without a
  // footstep all of them.
  bool Feasible(const ExperimentConfig& config, std::optional<int> step, int steps) {
    const Feasibility answer = step ? Check(config, *step, steps) : Check(config);
    return answer.verdict == Verdict::kFeasible;
  }

  Feasibility Check(const ExperimentConfig& config, int step, int steps) {
    if (stopped()) return {};
    const double apart = problem_.limits().demanded_of(MarginFamily::kNoStep);
    const RobotModel& robot = experiment_.robot;
    const Ground& ground = *experiment_.scene.ground;
    if (!std::ranges::all_of(config.footsteps, [&](const FootstepConfig& footstep) {
          return areas_.Clears(footstep.X_WF, apart) &&
                 ground.Standing(robot.sole_outline, footstep.X_WF);
        })) {
      return {};
    }
    const HalfStepSequence sequence = SequenceOf(config, robot, ground);
    const SuperposedWalk walk(sequence, PlannedMotion(sequence));
    const int last = std::min(step + steps, sequence.num_steps()) - 1;
    return problem_.test().Check(walk, {walk.start_of(2 * step), walk.end_of(2 * last + 1)},
                                 &scratch_);
  }

  const Experiment& experiment_;
  const WalkProblem& problem_;
  NoStepAreas areas_;
  MarginEvaluator::Scratch scratch_;
};

// Footsteps by their worst demand, the worst first.
std::vector<int> FootstepsThatMiss(const MissedDemands& missed) {
  std::vector<int> steps;
  for (const MissedDemand& demand : missed.demands) {
    const int step = demand.footstep;
    if (step < 0) continue;  // no footstep mends where a foot stands at the start
    if (std::ranges::find(steps, step) == steps.end()) steps.push_back(step);
  }
  return steps;
}

}  // namespace

std::vector<std::string> PlanRemedies(const Experiment& experiment, const WalkProblem& problem,
                                      const MissedDemands& missed, const std::stop_token& stop) {
  if (!experiment.scene.rests()) return {};
  Trials trials(experiment, problem, stop);
  std::vector<std::string> lines;
  std::vector<int> steps = FootstepsThatMiss(missed);
  if (steps.size() > kMostFootsteps) steps.resize(kMostFootsteps);
  if (steps.size() > 1) {
    for (const auto& found : {trials.Height(std::nullopt), trials.Duration(std::nullopt)}) {
      if (found) lines.push_back("tried, and feasible: every footstep: " + found->words);
    }
  }
  ExperimentConfig together = experiment.config;  // with the first remedy of each footstep
  bool each = true;
  for (size_t k = 0; k < steps.size(); ++k) {
    const int step = steps[k];
    const std::string whose = Formatted("footstep %d: ", step + 1);
    std::vector<FoundRemedy> found;
    const auto keep = [&found](std::optional<FoundRemedy> remedy) {
      if (remedy) found.push_back(std::move(*remedy));
    };
    keep(trials.Height(step));
    keep(trials.Duration(step));
    if (found.empty()) keep(trials.HeightAndDuration(step));
    keep(trials.Landing(step));
    for (const FoundRemedy& remedy : found) {
      lines.push_back("tried, and feasible: " + whose + remedy.words);
    }
    if (found.empty()) {
      each = false;
      lines.push_back("tried in vain: " + whose +
                      "other heights and durations, and landings up to 8 cm off along its way");
      continue;
    }
    Nth(together.footsteps, step) = found.front().footstep;
    if (!each || k + 1 < steps.size()) continue;
    const Feasibility whole = trials.Check(together);
    if (whole.verdict == Verdict::kFeasible) {
      if (steps.size() > 1) lines.push_back("with the first of each footstep the plan is feasible");
      continue;
    }
    // What is missed between the instants of `missed` shows itself now.
    const int next = whole.witness.at.half_step / 2;
    if (steps.size() < kMostFootsteps && std::ranges::find(steps, next) == steps.end()) {
      steps.push_back(next);
    }
  }
  if (trials.stopped()) return {};
  return lines;
}

}  // namespace halfstep
