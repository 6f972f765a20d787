#include "tests/oracle/judge.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/oracle/judge_case.h"
#include "tests/oracle/project_side.h"
#include "wpg/files/input_error.h"
#include "wpg/robot/acceleration_limits.h"

namespace halfstep::oracle {
namespace {

// A slab's width falls short of a distance by at most this [m] (planner/collision/separation.h).
constexpr double kSlab = 1e-6;
// Distances beyond this are not compared: neither side tells them apart [m].
constexpr double kNear = 0.02;

bool IsDistance(MarginFamily f) {
  return f == MarginFamily::kClearance || f == MarginFamily::kSelfClearance;
}

MarginFamily FamilyNamed(const std::string& name) {
  for (const MarginFamily family : AllMarginFamilies()) {
    if (Name(family) == name) return family;
  }
  throw std::logic_error("oracle: the project has no family " + name);
}

std::string Line(const char* what, const std::string& of, double value, double demanded, double t) {
  char text[300];
  std::snprintf(text, sizeof text, "%s: %s is %.12g, demanded %.12g, at t = %.9f s", what,
                of.c_str(), value, demanded, t);
  return text;
}

}  // namespace

Judge::Judge(const std::string& robot_yaml, const std::string& plain_yaml, double tolerance)
    : plain_(plain_yaml), robot_(LoadRobot(robot_yaml)), tolerance_(tolerance) {
  // Where a robot's file states none.
  constexpr double kAssumed = 140;  // [rad/s²]
  AssumeAccelerationLimits(kAssumed, &robot_);
  for (const PlainRobot::Leg& leg : plain_.legs) {
    for (const int j : leg.joints) {
      double& limit = plain_.joints[static_cast<size_t>(j)].acceleration;
      if (limit == PlainRobot::kUnknown) limit = kAssumed;
    }
  }
}

double Judge::ToleranceOf(MarginFamily family) const {
  if (family == MarginFamily::kJointAcceleration) return 150 * tolerance_;
  if (family == MarginFamily::kTorque) return plain_.mass * plain_.size() * tolerance_;
  return tolerance_;
}

Feasibility Judge::Ask(const Case& drawn, const MarginLimits& limits,
                       std::optional<MarginFamily> only) const {
  const MarginEvaluator evaluator = drawn.evaluator->WithLimits(limits);
  CertificationScope scope;
  if (only) scope.families = {*only};
  const CertifiedFeasibility test(evaluator, {}, scope);
  const SuperposedWalk walk(ToSequence(drawn.plan), ToParameters(drawn.plan));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  return test.Check(walk, {0.0, walk.duration()}, &scratch);
}

void Judge::Count(const Feasibility& answer, Tally* tally) const {
  tally->certified += answer.verdict == Verdict::kFeasible;
  tally->violated += answer.verdict == Verdict::kViolated;
  tally->undecided += answer.verdict == Verdict::kUndecided;
}

void Judge::JudgeCertified(const Case& drawn, const MarginLimits& limits,
                           const std::map<std::string, TrueMargin>& least, const WalkTruth& truth,
                           Tally* tally) const {
  ++tally->judged;
  for (const auto& [name, margin] : least) {
    const MarginFamily family = FamilyNamed(name);
    const double demanded = limits.demanded_of(family), spare = margin.value - demanded;
    FamilyTally& its = tally->families[name];
    its.statements += truth.CountOf(name);
    its.least_spare = std::min(its.least_spare, spare);
    if (!(spare >= -ToleranceOf(family))) {
      ++tally->false_certified;
      drawn.Tell(
          Line("certified", name + " of " + margin.subject, margin.value, demanded, margin.t));
    }
  }
}

void Judge::JudgeViolated(const Case& drawn, const MarginLimits& limits, const Margin& witness,
                          WalkTruth* truth, Tally* tally) const {
  const std::string family(Name(witness.family));
  const double t = truth->walk().start_of(witness.at.half_step) + witness.at.tau;
  truth->Demand(ToDemands(limits, drawn.plain_scene.friction));
  const TrueMargin margin = truth->At(family, t, "");
  const double demanded = limits.demanded_of(witness.family);
  const double may_differ = IsDistance(witness.family) ? kSlab : ToleranceOf(witness.family);
  if (margin.lower < demanded + may_differ) return;
  ++tally->false_violated;
  drawn.Tell(
      Line("violated", drawn.evaluator->Describe(witness) + "; truth", margin.lower, demanded, t));
}

// What both sides say at the middle of each stretch.
void Judge::Compare(const Case& drawn, std::span<const MarginFamily> families, WalkTruth* truth,
                    Tally* tally) const {
  const SuperposedWalk walk(ToSequence(drawn.plan), ToParameters(drawn.plan));
  MarginEvaluator::Scratch scratch = drawn.evaluator->MakeScratch();
  for (const Stretch& stretch : truth->walk().stretches()) {
    const double t = 0.5 * (stretch.begin + stretch.end);
    const MarginSet margins = drawn.evaluator->At(walk, walk.Locate(t), &scratch);
    for (const MarginFamily family : families) {
      const std::string name(Name(family));
      const TrueMargin margin = truth->At(name, t, "");
      const double theirs = margins[static_cast<size_t>(family)].value;
      const bool to_solids = family == MarginFamily::kFloor || family == MarginFamily::kFoothold;
      const bool in_metres = IsDistance(family) || family == MarginFamily::kGround ||
                             family == MarginFamily::kNoStep ||
                             (to_solids && drawn.plain_scene.has_levels());
      if (!std::isfinite(theirs) && theirs == margin.value) continue;
      // Overlaps are told by their sign alone, and what is far away is not told apart.
      if (in_metres && !(theirs > 0 && theirs < kNear)) continue;
      FamilyTally& its = tally->families[name];
      if (const double apart = std::abs(theirs - margin.lower); apart > its.disagreement) {
        its.disagreement = apart;
        its.where = drawn.name + ": " +
                    Line("theirs", std::to_string(theirs) + "; " + margin.subject, margin.lower,
                         drawn.limits.demanded_of(family), t);
      }
    }
  }
}

// Raises what is demanded of one family to what the oracle finds least, nearly: the last certified
// answer has next to nothing to spare, and a little more must be refused.
void Judge::Push(const Case& drawn, MarginFamily family, WalkTruth* truth, Tally* tally) const {
  const std::string name(Name(family));
  MarginLimits limits = drawn.limits;
  const auto least_at = [&](double demanded) {
    limits.demanded_of(family) = demanded;
    truth->Demand(ToDemands(limits, drawn.plain_scene.friction));
    return truth->Least(name);
  };
  double value = least_at(limits.demanded_of(family))[name].value;
  if (!std::isfinite(value) || (IsDistance(family) && value > kNear)) return;
  // Looked at closely there; what was far away is told apart only then.
  for (double before = -kNever; value - before > 0.1 * Scale(family);) {
    before = value;
    value = least_at(value)[name].value;
  }
  for (const double spare : {-1e-6, 1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
    const double demanded = value - spare * Scale(family);
    if (demanded < drawn.limits.demanded_of(family)) return;
    const auto least = least_at(demanded);
    const Feasibility answer = Ask(drawn, limits, family);
    Count(answer, tally);
    if (answer.verdict == Verdict::kViolated) {
      JudgeViolated(drawn, limits, answer.witness, truth, tally);
    }
    if (answer.verdict != Verdict::kFeasible) continue;
    JudgeCertified(drawn, limits, least, *truth, tally);
    FamilyTally& its = tally->families[name];
    ++its.pushed;
    // The same claim, falsified by a hundredth of the scale.
    const double false_demand = value + 0.01 * Scale(family);
    ++its.falsified;
    const TrueMargin again = least_at(false_demand)[name];
    const bool found = again.value < false_demand - ToleranceOf(family);
    its.found += found;
    if (!found) {
      tally->missed.push_back(drawn.name + ": " +
                              Line("before", name + " of " + least.at(name).subject, value,
                                   false_demand, least.at(name).t));
    }
    return;
  }
}

// Takes obstacles out of the planned way, and makes the plan calmer and levels lower, until it is
// certified.
bool Judge::FindFeasible(const std::string& folder, Case* drawn, Tally* tally) const {
  const ClosedFormWalk walk(drawn->plan);
  const Eigen::Vector4d middle = walk.At(Real(0.5 * walk.duration())).value.feet[0];
  std::vector<double> overlaps = drawn->plan.overlaps;
  int calmed = 0;
  for (;;) {
    const std::string path = WriteScene(drawn->plain_scene, folder);
    try {
      drawn->evaluator = std::make_unique<MarginEvaluator>(robot_, LoadScene(path), drawn->limits);
    } catch (const InputError&) {
      ++tally->refused;
      return false;
    }
    drawn->placed = std::make_unique<PlacedScene>(Seen(drawn->plain_scene),
                                                  Eigen::Vector3d(middle[0], middle[1], 0));
    drawn->Overlap(overlaps, 0);
    const Feasibility answer = Ask(*drawn, drawn->limits, {});
    Count(answer, tally);
    if (answer.verdict == Verdict::kFeasible) break;
    const Margin& witness = answer.witness;
    const bool by_another = answer.verdict == Verdict::kViolated && witness.other >= 0;
    auto& obstacles = drawn->plain_scene.obstacles;
    // Solids of the ground come after the obstacles.
    if (by_another && witness.family == MarginFamily::kClearance &&
        witness.other < static_cast<int>(obstacles.size())) {
      obstacles.erase(obstacles.begin() + witness.other);
    } else if (by_another && witness.family == MarginFamily::kNoStep) {
      auto& areas = drawn->plain_scene.no_step;
      areas.erase(areas.begin() + witness.other);
    } else if (++calmed <= 5) {
      if (drawn->plain_scene.has_levels()) {
        CalmOverLevels(plain_, &drawn->plan, &drawn->plain_scene);
      } else {
        Calm(&drawn->plan);
      }
    } else {
      return false;
    }
  }
  for (size_t i = 0; i < overlaps.size(); ++i) {
    overlaps[i] = std::min(overlaps[i], NaturalBound(drawn->plan, i));
  }
  drawn->plan.overlaps = overlaps;
  return true;
}

// As large a share of the drawn overlaps as is certified, to a hundredth.
void Judge::RaiseOverlaps(Case* drawn, Tally* tally) const {
  const std::vector<double> overlaps = drawn->plan.overlaps;
  double low = 0, high = 1;
  for (double share = 1; high - low > 0.01; share = 0.5 * (low + high)) {
    drawn->Overlap(overlaps, share);
    const Feasibility answer = Ask(*drawn, drawn->limits, {});
    Count(answer, tally);
    (answer.verdict == Verdict::kFeasible ? low : high) = share;
    if (low == 1) break;
    if (answer.verdict == Verdict::kViolated && high - low < 0.05) {
      const ClosedFormWalk walk(Seen(drawn->plan));
      WalkTruth truth(plain_, walk, *drawn->placed, drawn->plain_scene.no_step, Seen(*drawn));
      JudgeViolated(*drawn, drawn->limits, answer.witness, &truth, tally);
    }
  }
  drawn->Overlap(overlaps, low);
}

// Draws a walk, its scene and what is demanded of it.
Judge::Case Judge::DrawCase(SceneKind kind, unsigned seed, Draw* draw_from, Draw* further_from,
                            std::vector<std::string>* falsehoods) const {
  Draw &draw = *draw_from, &further = *further_from;
  Case drawn;
  drawn.name = robot_.name + ", " + NameOf(kind) + ", seed " + std::to_string(seed);
  drawn.falsehoods = falsehoods;
  if (IsOverLevels(kind)) {
    DrawLevels(kind, plain_, &draw, &drawn.plan, &drawn.plain_scene);
  } else {
    drawn.plan = DrawPlan(plain_, &draw);
    drawn.plain_scene = DrawNastyScene(kind, drawn.plan, plain_.size(), &draw);
  }
  drawn.limits.clearance_cap = 0.05;
  if (draw.Chance(0.5)) {
    drawn.limits.demanded_of(MarginFamily::kClearance) = draw.Uniform(0, 0.02);
    drawn.limits.demanded_of(MarginFamily::kFloor) = 0.01 * plain_.size() * draw.Uniform(0, 1);
    drawn.limits.joint_speed_scale = draw.Uniform(0.7, 1);
  }
  if (plain_.size() < 0.5) drawn.limits.demanded_of(MarginFamily::kFloor) *= plain_.size();
  drawn.limits.demanded_of(MarginFamily::kZmp) = 0.01 * draw.Uniform(0, plain_.size());
  drawn.limits.demanded_of(MarginFamily::kZmpRobot) = 0.01 * draw.Uniform(0, plain_.size());
  drawn.limits.demanded_of(MarginFamily::kSelfClearance) = 0.005 * plain_.size();
  // So that these are there.
  drawn.limits.demanded_of(MarginFamily::kDoubleSupport) = 0.0;
  drawn.limits.landing_speed = drawn.limits.foot_speed;
  // One in three is demanded what the profile walkable demands, or less of it.
  if (further.Chance(0.33)) {
    drawn.limits.demanded_of(MarginFamily::kZmpRobot) =
        plain_.sole_size.y() * further.Uniform(0, 0.2);
    drawn.limits.demanded_of(MarginFamily::kFriction) = further.Uniform(0, 0.3);
    drawn.limits.demanded_of(MarginFamily::kDoubleSupport) =
        0.08 * std::sqrt(plain_.size()) * further.Uniform(0, 1);
    drawn.limits.landing_speed = further.Uniform(0.2, 1);
  }
  if (IsOverLevels(kind)) LimitOverLevels(&further, &drawn);
  return drawn;
}

Tally Judge::JudgeOne(SceneKind kind, unsigned seed, const std::string& folder,
                      std::vector<std::string>* falsehoods) const {
  Draw draw(seed), further(seed ^ 0x5bd1e995u);
  Tally tally;
  tally.walks = 1;
  Case drawn = DrawCase(kind, seed, &draw, &further, falsehoods);
  if (!FindFeasible(folder, &drawn, &tally)) return tally;
  RaiseOverlaps(&drawn, &tally);
  const ClosedFormWalk walk(Seen(drawn.plan));
  WalkTruth truth(plain_, walk, *drawn.placed, drawn.plain_scene.no_step, Seen(drawn));
  JudgeCertified(drawn, drawn.limits, truth.Least(), truth, &tally);
  Compare(drawn, drawn.evaluator->families(), &truth, &tally);
  // The families that came last, one more, and often clearance.
  std::vector<MarginFamily> pushed = {
      MarginFamily::kZmpRobot,          MarginFamily::kTorque,        MarginFamily::kFriction,
      MarginFamily::kJointAcceleration, MarginFamily::kDoubleSupport, MarginFamily::kLandingSpeed};
  pushed.push_back(static_cast<MarginFamily>(draw.Below(static_cast<int>(MarginFamily::kOwn))));
  if (draw.Chance(0.6)) pushed.push_back(MarginFamily::kClearance);
  const bool levels = drawn.plain_scene.has_levels();
  if (levels) pushed.insert(pushed.end(), {MarginFamily::kFloor, MarginFamily::kFoothold});
  for (const MarginFamily family : pushed) Push(drawn, family, &truth, &tally);
  if (!levels) PushTubes(drawn, &truth, &further, &tally);  // over levels they are refused
  tally.instants += truth.instants();
  return tally;
}

}  // namespace halfstep::oracle
