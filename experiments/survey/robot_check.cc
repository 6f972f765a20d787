#include "experiments/survey/robot_check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "experiments/config/scaled_defaults.h"
#include "experiments/run/infeasible_plan.h"
#include "experiments/run/isolated_step.h"
#include "experiments/survey/rest_torques.h"
#include "experiments/survey/self_gaps.h"
#include "planner/search/step_set.h"
#include "smoothing/margins/not_covered_by.h"
#include "smoothing/proof/sampled_feasibility.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/reference_leg.h"

namespace halfstep {
namespace {

constexpr int kSamples = 20;            // of a half-step
constexpr double kBarUnit = 0.005;      // of a bar's height for HRP-2's size [m]
constexpr double kBarThickness = 0.01;  // for HRP-2's size [m]
constexpr double kLateFoot = 0.19;      // HalfStepShape::foot_delay of a foot that rises first
constexpr double kBarLength = 4.0;      // far beyond both feet [m]

std::string InQuotes(const std::string& text) {
  std::string quoted;
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return "'" + quoted + "'";
}

class RobotChecker {
 public:
  RobotChecker(const std::string& name, const RobotModel& robot, const RunHooks& hooks,
               double effort)
      : name_(name),
        robot_(robot),
        hooks_(hooks),
        effort_(effort),
        model_(MotionModelOf(robot, {})) {
    ScaleDefaults(MeasuresOf(robot), &config_);
  }

  RobotCheck Check() {
    check_.measures = MeasuresOf(robot_);
    check_.half_step = PrototypeOf(config_);
    check_.not_covered = NotCoveredBy(robot_, Scene{}, config_.smoothing.limits);
    const StepSet set = SampledSet();
    check_.half_steps = set.size();
    Reach(set);
    Told(0.6);
    // That of the six steps that it takes by default, where the set has none.
    std::vector<double> strides = {Nth(SixSteps(robot_, check_.half_step).half_steps, 2).X_WS.x};
    if (const double longest = check_.reach.stride; longest > 0.0) {
      strides = {0.7 * longest, longest};
    }
    for (const double stride : strides) Walk(stride);
    Told(0.8);
    if (check_.reach.stride > 0.0) StepOver();
    Told(0.9);
    check_.stairs = HighestStairs(UsualRun(robot_), robot_, config_,
                                  [&] { return !hooks_.stop.stop_requested(); });
    Told(1.0);
    return check_;
  }

 private:
  void Told(double done) const {
    if (hooks_.progress) hooks_.progress("check", done);
  }

  StepSet SampledSet() {
    const MarginEvaluator evaluator(robot_, Scene{}, config_.smoothing.limits);
    const SampledFeasibility sampled(evaluator, check_.half_step.duration / kSamples);
    int asked = 0;
    const StepSet set = MakeStepSet(
        config_.step_set, check_.half_step,
        [&](const HalfStep& half_step) {
          if (half_step.kind == HalfStepKind::kDown) ++asked;
          MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
          return AcceptsHalfStep(sampled, half_step, {}, model_, &scratch);
        },
        [&](double done) {
          Told(0.5 * done);
          return !hooks_.stop.stop_requested();
        });
    check_.places = asked;
    return set;
  }

  // The certified element with the largest value; none when no element has one.
  std::optional<Foothold> Farthest(
      const StepSet& set, const std::function<std::optional<double>(const Foothold&)>& value) {
    std::vector<int> order;
    for (int i = 0; i < set.size(); ++i) {
      if (value(Nth(set.placements, i))) order.push_back(i);
    }
    std::ranges::stable_sort(order, std::greater<>(),
                             [&](int i) { return *value(Nth(set.placements, i)); });
    for (const int i : order) {
      if (hooks_.stop.stop_requested()) break;
      if (IsCertified(set, i)) return Nth(set.placements, i);
    }
    return std::nullopt;
  }

  bool IsCertified(const StepSet& set, int i) {
    const auto [known, is_new] = certified_.emplace(i, false);
    if (is_new) {
      if (!certifier_) certifier_.emplace(robot_, Scene{}, config_);
      known->second = certifier_->Certifies(set.Down(i, Side::kLeft), {}) &&
                      certifier_->Certifies(set.Up(i, Side::kLeft), {});
    }
    return known->second;
  }

  // Seen from a left support, so that the swing sole is at negative y.
  void Reach(const StepSet& set) {
    using Value = std::optional<double>;
    const auto farthest = [&](const auto& value) {
      const auto found = Farthest(set, [&](const Foothold& f) { return Value(value(f)); });
      return found ? value(*found) : 0.0;
    };
    SetReach& reach = check_.reach;
    reach.forward = farthest([](const Foothold& f) { return f.x; });
    reach.backward = farthest([](const Foothold& f) { return -f.x; });
    reach.farthest = farthest([](const Foothold& f) { return -f.y; });
    reach.nearest = -farthest([](const Foothold& f) { return f.y; });
    reach.outwards = farthest([](const Foothold& f) { return -f.yaw; });
    reach.inwards = farthest([](const Foothold& f) { return f.yaw; });
    const double near = 0.5 * config_.step_set.spacing + 1e-9;
    const auto straight = Farthest(set, [&](const Foothold& f) -> Value {
      if (f.yaw != 0.0 || std::abs(f.y + check_.measures.standing_width) > near || f.x <= 0.0) {
        return std::nullopt;
      }
      return f.x;
    });
    if (straight) reach.stride = Refined(straight->x, set.prototype);
  }

  // The longest certified step straight ahead from one that the grid has to the grid's next one.
  double Refined(double stride, const HalfStep& half_step) const {
    double beyond = stride + config_.step_set.spacing;
    for (int halvings = 0; halvings < 4; ++halvings) {
      const double middle = 0.5 * (stride + beyond);
      StepSet one{.prototype = half_step, .placements = {}};
      one.placements.push_back(Foothold::Level({middle, -check_.measures.standing_width, 0.0}));
      const bool certified = certifier_->Certifies(one.Down(0, Side::kLeft), {}) &&
                             certifier_->Certifies(one.Up(0, Side::kLeft), {});
      (certified ? stride : beyond) = middle;
    }
    return stride;
  }

  std::string WalkText(double stride) const {
    std::string text = "robot: " + InQuotes(name_) + "\nscene: none\nfootsteps:\n";
    for (int i = 0; i < 6; ++i) {
      const Side side = i % 2 == 0 ? Side::kRight : Side::kLeft;
      text += Formatted("  - {foot: %s, x_m: %.6f, y_m: %.6f}\n", std::string(Name(side)).c_str(),
                        stride * std::min(i + 1, 5), Sign(side) * 0.5 * robot_.standing_width);
    }
    return text + Formatted(
                      "smoothing:\n  methods: [dichotomy, halfstep/sqp]\n"
                      "  optimizer: {effort: %g}\n",
                      effort_);
  }

  // Six steps; the fastest certified walk is kept.
  void Walk(double stride) {
    if (hooks_.stop.stop_requested()) return;
    const RunHooks quiet{.progress = {}, .stop = hooks_.stop};
    ExperimentRun run(ParseConfig("check", WalkText(stride), {}), quiet);
    run.Smooth(quiet);
    run.Certify(hooks_.stop);
    for (const MethodRun& method : run.runs()) {
      if (method.certified.answer.verdict != Verdict::kFeasible) continue;
      const StraightWalk walk{stride, method.duration, method.method};
      if (!check_.walk || walk.speed() > check_.walk->speed()) check_.walk = walk;
    }
    if (check_.walk) {
      check_.why_no_walk.clear();
    } else if (check_.why_no_walk.empty()) {
      run.Explain(hooks_.stop);
      for (const InfeasibleWalk& walk : run.infeasible()) {
        check_.why_no_walk = InfeasibleText(run.problem(), walk);
      }
      if (const auto rest = WeakestAtRest(robot_)) {
        const auto text = RestText(*rest, robot_.standing_width, name_);
        check_.why_no_walk.insert(check_.why_no_walk.begin(), text.begin(), text.end());
      }
    }
  }

  bool StepsOver(const SteppedBar& bar) const {
    Scene scene;
    Obstacle obstacle{.name = "bar", .shape = Box{{bar.thickness, kBarLength, bar.height}}};
    obstacle.X_WO.translation() = Eigen::Vector3d(0.5 * bar.stride, 0.0, 0.5 * bar.height);
    scene.obstacles.push_back(obstacle);
    const double y = 0.5 * robot_.standing_width;
    std::vector<Footstep> footsteps;
    for (const Side side : {Side::kRight, Side::kLeft}) {
      footsteps.push_back({.side = side,
                           .X_WF = Foothold::Level({bar.stride, Sign(side) * y, 0.0}),
                           .via_height = check_.half_step.via_height,
                           .duration = check_.half_step.duration});
    }
    const CertifiedFeasibility test(MarginEvaluator(robot_, scene, config_.smoothing.limits),
                                    config_.smoothing.certification);
    // A foot that moves on later is higher by then.
    for (const double delay : {check_.half_step.shape.foot_delay, kLateFoot}) {
      HalfStepShape shape = check_.half_step.shape;
      shape.foot_delay = std::max(shape.foot_delay, delay);
      const HalfStepSequence sequence =
          MakeSequence({Foothold::Level({0, y, 0}), Foothold::Level({0, -y, 0})}, footsteps,
                       check_.half_step.via_lateral, shape, model_);
      if (CertifyPlan(test, sequence).accepted) return true;
    }
    return false;
  }

  // By halves: what is told is certified, whether or not all lower bars are.
  void StepOver() {
    const double size = check_.measures.leg_length / kLegOfHrp2;
    const double unit = kBarUnit * size;
    SteppedBar bar{.thickness = kBarThickness * size, .stride = check_.reach.stride};
    int over = 0, beyond = static_cast<int>(check_.half_step.via_height / unit) + 1;
    while (beyond - over > 1 && !hooks_.stop.stop_requested()) {
      const int middle = (over + beyond) / 2;
      bar.height = middle * unit;
      (StepsOver(bar) ? over : beyond) = middle;
    }
    bar.height = over * unit;
    if (over > 0) check_.bar = bar;
  }

  const std::string& name_;
  const RobotModel& robot_;
  const RunHooks& hooks_;
  double effort_;
  std::shared_ptr<const MotionModel> model_;
  ExperimentConfig config_;
  std::optional<HalfStepCertifier> certifier_;
  std::map<int, bool> certified_;
  RobotCheck check_;
};

}  // namespace

RobotCheck CheckRobot(const std::string& name, const RobotModel& robot, const RunHooks& hooks,
                      double effort) {
  return RobotChecker(name, robot, hooks, effort).Check();
}

}  // namespace halfstep
