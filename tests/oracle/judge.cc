#include "tests/oracle/judge.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "wpg/files/input_error.h"

namespace halfstep::oracle {
namespace {

// A slab's width falls short of a distance by at most this [m] (planner/collision/separation.h).
constexpr double kSlab = 1e-6;

Pose2 ToPose(const FloorPose& p) { return {p.x, p.y, p.yaw}; }

Demands ToDemands(const MarginLimits& limits) {
  Demands demands;
  for (const MarginFamily family : AllMarginFamilies()) {
    demands.margin[std::string(Name(family))] = limits.demanded_of(family);
  }
  demands.foot_speed = *limits.foot_speed;
  demands.foot_yaw_rate = *limits.foot_yaw_rate;
  demands.joint_speed_scale = limits.joint_speed_scale;
  return demands;
}

MarginFamily FamilyNamed(const std::string& name) {
  for (const MarginFamily family : AllMarginFamilies()) {
    if (Name(family) == name) return family;
  }
  return MarginFamily::kClearance;
}

std::string Line(const char* what, const std::string& of, double value, double demanded, double t) {
  char text[300];
  std::snprintf(text, sizeof text, "%s: %s is %.12g, demanded %.12g, at t = %.9f s", what,
                of.c_str(), value, demanded, t);
  return text;
}

}  // namespace

HalfStepSequence ToSequence(const WalkPlan& plan) {
  std::vector<Footstep> footsteps;
  for (const PlannedStep& step : plan.steps) {
    footsteps.push_back({.side = step.foot == 0 ? Side::kLeft : Side::kRight,
                         .X_WF = ToPose(step.landing),
                         .via_height = step.via_height,
                         .duration = step.duration});
  }
  return MakeSequence({ToPose(plan.start[0]), ToPose(plan.start[1])}, footsteps, plan.via_lateral,
                      {.shift = plan.shift,
                       .horizontal_delay = plan.horizontal_delay,
                       .bump_ramp = plan.bump_ramp,
                       .foot_ramp = plan.foot_ramp,
                       .lift_share = plan.lift_share},
                      {.com_height = plan.com_height});
}

HomotopyParameters ToParameters(const WalkPlan& plan) {
  HomotopyParameters parameters;
  parameters.overlaps = plan.overlaps;
  parameters.height_scales = plan.height_scales;
  parameters.durations = plan.durations;
  parameters.support_points = plan.support_points;
  for (size_t i = 0; i < plan.durations.size(); ++i) {
    if (i % 2 == 0) parameters.via_laterals.push_back(plan.via_lateral_of(i));
    if (i % 2 == 0) parameters.via_alongs.push_back(plan.via_along_of(i));
    parameters.zmp_shifts.push_back(plan.shift_of(i));
    parameters.zmp_bump_ramps.push_back(plan.bump_ramp_of(i));
    parameters.foot_ramps.push_back(plan.foot_ramp_of(i));
    parameters.foot_delays.push_back(plan.foot_delay_of(i));
    parameters.lift_shares.push_back(plan.lift_share_of(i));
    if (i % 2 == 1) continue;
    const FloorPose move = plan.footsteps.empty() ? FloorPose{} : plan.footsteps[i / 2];
    parameters.footstep_xs.push_back(move.x);
    parameters.footstep_ys.push_back(move.y);
    parameters.footstep_yaws.push_back(move.yaw);
  }
  return parameters;
}

void Tally::Add(const Tally& other) {
  walks += other.walks;
  refused += other.refused;
  certified += other.certified;
  violated += other.violated;
  undecided += other.undecided;
  judged += other.judged;
  false_certified += other.false_certified;
  false_violated += other.false_violated;
  least_clearance = std::min(least_clearance, other.least_clearance);
  least_slack = std::min(least_slack, other.least_slack);
  instants += other.instants;
}

struct Judge::Case {
  std::string name;
  PlainScene plain_scene;
  std::unique_ptr<PlacedScene> placed;
  std::unique_ptr<MarginEvaluator> evaluator;
  std::vector<std::string>* falsehoods = nullptr;
};

Judge::Judge(const std::string& robot_yaml, double tolerance)
    : plain_(robot_yaml), robot_(LoadRobot(robot_yaml)), tolerance_(tolerance) {}

Feasibility Judge::Ask(const Case& drawn, const WalkPlan& plan, const MarginLimits& limits,
                       Tally* tally) const {
  const MarginEvaluator evaluator = drawn.evaluator->WithLimits(limits);
  const CertifiedFeasibility test(evaluator, {});
  const SuperposedWalk walk(ToSequence(plan), ToParameters(plan));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const Feasibility answer = test.Check(walk, {0.0, walk.duration()}, &scratch);
  tally->certified += answer.verdict == Verdict::kFeasible;
  tally->violated += answer.verdict == Verdict::kViolated;
  tally->undecided += answer.verdict == Verdict::kUndecided;
  if (answer.verdict == Verdict::kViolated) {
    JudgeViolated(drawn, plan, limits, answer.witness, tally);
  }
  return answer;
}

void Judge::JudgeCertified(const Case& drawn, const WalkPlan& plan, const MarginLimits& limits,
                           Tally* tally) const {
  const ClosedFormWalk walk(plan);
  WalkTruth truth(plain_, walk, *drawn.placed, drawn.plain_scene.no_step, ToDemands(limits));
  ++tally->judged;
  for (const auto& [name, least] : truth.Least()) {
    const MarginFamily family = FamilyNamed(name);
    if (Name(family) != name) continue;  // the project does not claim it
    const double demanded = limits.demanded_of(family), slack = least.value - demanded;
    if (family == MarginFamily::kClearance) {
      tally->least_clearance = std::min(tally->least_clearance, slack);
    }
    tally->least_slack = std::min(tally->least_slack, slack / Scale(family));
    if (!(slack >= -tolerance_)) {
      ++tally->false_certified;
      drawn.falsehoods->push_back(
          drawn.name + ": " +
          Line("certified", name + " of " + least.subject, least.value, demanded, least.t));
    }
  }
  tally->instants += truth.instants();
}

void Judge::JudgeViolated(const Case& drawn, const WalkPlan& plan, const MarginLimits& limits,
                          const Margin& witness, Tally* tally) const {
  if (witness.family == MarginFamily::kZmpRobot) return;  // the oracle knows of no masses
  const ClosedFormWalk walk(plan);
  WalkTruth truth(plain_, walk, *drawn.placed, drawn.plain_scene.no_step, ToDemands(limits));
  const std::string family(Name(witness.family));
  const double t = walk.start_of(witness.at.half_step) + witness.at.tau;
  const TrueMargin margin = truth.At(family, t, "");
  const bool distance = family == "clearance" || family == "self_clearance";
  const double demanded = limits.demanded_of(witness.family);
  if (!(margin.lower < demanded + (distance ? kSlab : tolerance_))) {
    ++tally->false_violated;
    drawn.falsehoods->push_back(drawn.name + ": " +
                                Line("violated", drawn.evaluator->Describe(witness) + "; truth",
                                     margin.lower, demanded, t));
  }
  tally->instants += truth.instants();
}

// Raises what is demanded of one family until the certificate is refused, and judges the last
// certified answer, which has next to nothing to spare.
void Judge::PushDemands(const Case& drawn, const WalkPlan& plan, MarginLimits limits, Draw* draw,
                        Tally* tally) const {
  const auto families = drawn.evaluator->families();
  MarginFamily family = MarginFamily::kClearance;
  if (drawn.plain_scene.obstacles.empty() || draw->Chance(0.4)) {
    family = families[static_cast<size_t>(draw->Below(static_cast<int>(families.size())))];
  }
  double low = limits.demanded_of(family), high = low + 30 * Scale(family);
  for (int k = 0; k < 14; ++k) {
    const double middle = 0.5 * (low + high);
    limits.demanded_of(family) = middle;
    // The refused ones are judged when they are near the limit; the others tell the same again.
    Tally unjudged;
    Tally* const into = k > 9 ? tally : &unjudged;
    (Ask(drawn, plan, limits, into).verdict == Verdict::kFeasible ? low : high) = middle;
  }
  limits.demanded_of(family) = low;
  JudgeCertified(drawn, plan, limits, tally);
}

Tally Judge::JudgeOne(SceneKind kind, unsigned seed, const std::string& folder,
                      std::vector<std::string>* falsehoods) const {
  Draw draw(seed);
  Tally tally;
  tally.walks = 1;
  Case drawn;
  drawn.name = std::string(NameOf(kind)) + ", seed " + std::to_string(seed);
  drawn.falsehoods = falsehoods;
  WalkPlan plan = DrawPlan(plain_, &draw);
  drawn.plain_scene = DrawNastyScene(kind, plan, &draw);
  MarginLimits limits;
  limits.clearance_horizon = 0.05;
  if (draw.Chance(0.5)) {
    limits.demanded_of(MarginFamily::kClearance) = draw.Uniform(0, 0.02);
    limits.demanded_of(MarginFamily::kFloor) = draw.Uniform(0, 0.02);
    limits.joint_speed_scale = draw.Uniform(0.7, 1);
  }
  const ClosedFormWalk farthest(plan);
  const Eigen::Vector4d middle = farthest.At(Real(0.5 * farthest.duration())).value.feet[0];
  const std::vector<double> overlaps = plan.overlaps;
  const auto overlap = [&](double share) {
    for (size_t i = 0; i < overlaps.size(); ++i) plan.overlaps[i] = share * overlaps[i];
  };
  // As long as an obstacle stands in the planned way it is taken out, or not.
  const bool clear_the_way = draw.Chance(0.8);
  for (;;) {
    const std::string path = WriteScene(drawn.plain_scene, folder);
    try {
      drawn.evaluator = std::make_unique<MarginEvaluator>(robot_, LoadScene(path), limits);
    } catch (const InputError&) {
      ++tally.refused;
      return tally;
    }
    drawn.placed =
        std::make_unique<PlacedScene>(drawn.plain_scene, Eigen::Vector3d(middle[0], middle[1], 0));
    overlap(0);
    const Feasibility answer = Ask(drawn, plan, limits, &tally);
    if (answer.verdict == Verdict::kFeasible) break;
    if (answer.witness.family != MarginFamily::kClearance || answer.witness.other < 0 ||
        !clear_the_way) {
      return tally;
    }
    auto& obstacles = drawn.plain_scene.obstacles;
    obstacles.erase(obstacles.begin() + answer.witness.other);
  }
  overlap(1);
  double low = 0, high = 1;
  if (Ask(drawn, plan, limits, &tally).verdict == Verdict::kFeasible) low = 1;
  while (high - low > 2e-3) {
    const double share = 0.5 * (low + high);
    overlap(share);
    (Ask(drawn, plan, limits, &tally).verdict == Verdict::kFeasible ? low : high) = share;
  }
  overlap(low);
  JudgeCertified(drawn, plan, limits, &tally);
  PushDemands(drawn, plan, limits, &draw, &tally);
  return tally;
}

}  // namespace halfstep::oracle
