#include "tests/checker/forged_certificates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "experiments/checker/check_walk.h"
#include "tests/oracle/judge_case.h"
#include "tests/oracle/project_side.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace checker {

void ForgeryTally::Add(const ForgeryTally& other) {
  walks += other.walks;
  proved += other.proved;
  refused += other.refused;
  controls += other.controls;
  proved_controls += other.proved_controls;
  const auto add = [](const std::map<std::string, Count>& of, std::map<std::string, Count>* to) {
    for (const auto& [name, count] : of) {
      Count& its = (*to)[name];
      its.wrong += count.wrong;
      its.proved += count.proved;
      its.close += count.close;
    }
  };
  add(other.raised, &raised);
  add(other.nudged, &nudged);
}

namespace {

using oracle::FloorPose;

// What the files of a run would say of the plan.
WalkTables TablesOf(const oracle::WalkPlan& plan) {
  WalkTables tables;
  tables.com_height = Interval(plan.com_height);
  const auto add = [&](int footstep, int foot, const FloorPose& at, double via_height) {
    verify::FootstepRow row;
    row.footstep = footstep;
    row.foot = foot == 0 ? "left" : "right";
    row.X_WF = {at.x, at.y, at.yaw};
    row.z = at.z;
    row.via_height = via_height;
    tables.footsteps.push_back(row);
  };
  add(0, 0, plan.start[0], 0.0);
  add(0, 1, plan.start[1], 0.0);
  Interval start = 0.0;
  for (size_t i = 0; i < plan.durations.size(); ++i) {
    const size_t j = i / 2;
    const oracle::PlannedStep& step = plan.steps[j];
    if (i % 2 == 0) add(static_cast<int>(j) + 1, step.foot, step.landing, step.via_height);
    verify::HalfStepRow row;
    row.kind = i % 2 == 0 ? "up" : "down";
    row.support = step.foot == 0 ? "right" : "left";
    row.duration = plan.durations[i];
    row.height_scale = plan.height_scales.empty() ? 1.0 : plan.height_scales[j];
    row.support_point = plan.support_points.empty() ? 0.0 : plan.support_points[j];
    const FloorPose move = plan.footsteps.empty() ? FloorPose{} : plan.footsteps[j];
    row.form = {.via_lateral = plan.via_lateral_of(i),
                .foot_ramp = plan.foot_ramp_of(i),
                .foot_delay = plan.foot_delay_of(i),
                .lift_share = plan.lift_share_of(i),
                .via_along = plan.via_along_of(i),
                .zmp_shift = plan.shift_of(i),
                .zmp_bump_ramp = plan.bump_ramp_of(i),
                .footstep = {move.x, move.y, move.yaw},
                .rise_begin = plan.rise_begin_of(i),
                .rise_end = plan.rise_end_of(i)};
    row.has_rise = true;
    tables.half_steps.push_back(row);
    tables.starts.push_back(start);
    start = start + Interval(plan.durations[i]);
    if (i < plan.overlaps.size()) start = start - Interval(plan.overlaps[i]);
  }
  return tables;
}

verify::CertificateText CertificateOf(const MarginLimits& limits) {
  verify::CertificateText certificate;
  certificate.demanded.fill(verify::kNotDemanded);
  certificate.foot_speed = limits.foot_speed;
  certificate.foot_yaw_rate = limits.foot_yaw_rate;
  certificate.landing_speed = limits.landing_speed;
  certificate.joint_speed_scale = limits.joint_speed_scale;
  return certificate;
}

verify::Family FamilyOf(const std::string& name) {
  const auto at = std::ranges::find(verify::kFamilyNames, name);
  return static_cast<verify::Family>(at - verify::kFamilyNames.begin());
}

// What the oracle's own rounding may be, some times the largest disagreement at an instant that its
// README has, and the unit by which a family is forged.
struct Grain {
  double unit, rounded;
};
Grain GrainOf(const std::string& name, const oracle::PlainRobot& robot) {
  if (name == "torque") return {robot.mass * robot.size(), 1e-9 * robot.mass * robot.size()};
  if (name == "joint_acceleration") return {150.0, 1.5e-7};
  const std::set<std::string> coarse = {"joint_speed", "self_clearance", "clearance"};
  if (coarse.contains(name)) return {1.0, 1e-9};
  return {1.0, name == "joint" ? 1e-10 : 1e-11};
}

// Families of which every statement is proved.
std::set<std::string> Proved(const TrajectoryCheck& check, const std::set<std::string>& asked) {
  std::set<std::string> proved = asked;
  for (const TrajectoryFinding& finding : check.findings) {
    if (finding.proved) continue;
    for (const std::string& name : asked) {
      if (KindOf(FamilyOf(name)) == finding.kind) proved.erase(name);
    }
  }
  return proved;
}

// One number of the plan, moved.
void Nudge(oracle::WalkPlan* plan, double by, oracle::Draw* draw) {
  const auto one_of = [&](std::vector<double>* values) {
    if (values->empty()) return;
    (*values)[static_cast<size_t>(draw->Below(static_cast<int>(values->size())))] += by;
  };
  FloorPose& landing =
      plan->steps[static_cast<size_t>(draw->Below(static_cast<int>(plan->steps.size())))].landing;
  switch (draw->Below(8)) {
    case 0:
      return one_of(&plan->overlaps);
    case 1:
      return one_of(&plan->durations);
    case 2:
      return one_of(&plan->height_scales);
    case 3:
      return one_of(&plan->support_points);
    case 4:
      landing.x += by;
      return;
    case 5:
      landing.y += by;
      return;
    case 6:
      landing.yaw += by;
      return;
    default:
      plan->com_height += by;
  }
}

}  // namespace
}  // namespace checker

namespace oracle {

checker::ForgeryTally Judge::Forge(SceneKind kind, unsigned seed, int rounds,
                                   const std::string& folder,
                                   std::vector<std::string>* falsehoods) const {
  using checker::ForgeryTally;
  Draw draw(seed), further(seed ^ 0x5bd1e995u);
  Tally answers;
  ForgeryTally tally;
  Case drawn = DrawCase(kind, seed, &draw, &further, falsehoods);
  if (!FindFeasible(folder, &drawn, &answers)) return tally;
  RaiseOverlaps(&drawn, &answers);
  const Scene scene = LoadScene(WriteScene(drawn.plain_scene, folder));
  const auto ask = [&](const WalkPlan& plan, const verify::CertificateText& demands,
                       double from = 0.0, double to = std::numeric_limits<double>::infinity()) {
    return checker::CheckWalk(checker::WalkMotion(checker::TablesOf(plan)), robot_, scene, demands,
                              plan.crouch, {}, nullptr, from, to);
  };
  const ClosedFormWalk walk(drawn.plan);
  WalkTruth truth(plain_, walk, *drawn.placed, drawn.plain_scene.no_step,
                  ToDemands(drawn.limits, drawn.plain_scene.friction));
  ++tally.walks;
  const verify::CertificateText none = checker::CertificateOf(drawn.limits);
  verify::CertificateText honest = none;
  std::map<std::string, TrueMargin> least = truth.Least();
  // Distances that are farther than demanded are not told apart by the oracle.
  constexpr double kFar = 0.02;
  for (const MarginFamily family : AllMarginFamilies()) {
    const std::string name(Name(family));
    const auto of = least.find(name);
    if (of == least.end()) continue;
    const double demanded = drawn.limits.demanded_of(family);
    const bool distance = name == "ground" || name.ends_with("clearance");
    honest.demanded[static_cast<size_t>(checker::FamilyOf(name))] = demanded;
    if (!std::isfinite(of->second.value) || (distance && of->second.value > demanded + kFar)) {
      least.erase(of);
    }
  }
  try {
    tally.proved += ask(drawn.plan, honest).proved();
  } catch (const InputError&) {
    ++tally.refused;
    return tally;
  }
  const auto amount = [&] { return std::pow(10.0, draw.Uniform(-12.0, -3.0)); };
  // Families of which every statement is proved around the instant at which it is false: a proof of
  // the whole walk needs one there. Of one forgery in fifty all of the walk is looked at.
  const auto prove = [&](const WalkPlan& plan, const verify::CertificateText& demands) {
    std::set<std::string> proved;
    const bool whole = draw.Chance(0.02);
    for (const auto& [name, margin] : least) {
      const double around = whole ? std::numeric_limits<double>::infinity()
                                  : std::pow(10.0, draw.Uniform(-5.0, -1.0));
      const auto family = static_cast<size_t>(checker::FamilyOf(name));
      verify::CertificateText alone = none;
      alone.demanded[family] = demands.demanded[family];
      proved.merge(checker::Proved(ask(plan, alone, margin.t - around, margin.t + around), {name}));
    }
    return proved;
  };
  const auto count = [&](const std::map<std::string, double>& by_how_much,
                         const std::set<std::string>& proved, const char* what,
                         std::map<std::string, ForgeryTally::Count>* counts) {
    for (const auto& [name, wrong_by] : by_how_much) {
      ForgeryTally::Count& its = (*counts)[name];
      if (!(wrong_by > checker::GrainOf(name, plain_).rounded)) {
        ++its.close;
        continue;
      }
      ++its.wrong;
      if (!proved.contains(name)) continue;
      ++its.proved;
      drawn.Tell(std::string(what) + ": proved, though " + name + " of " + least[name].subject +
                 " falls short by " + std::to_string(1e9 * wrong_by) + "e-9");
    }
  };
  verify::CertificateText kept = none;
  for (const auto& [name, margin] : least) {
    const double less = 1e-6 * checker::GrainOf(name, plain_).unit;
    kept.demanded[static_cast<size_t>(checker::FamilyOf(name))] = margin.value - less;
  }
  tally.controls += std::ssize(least);
  tally.proved_controls += std::ssize(prove(drawn.plan, kept));
  for (int round = 0; round < rounds; ++round) {
    verify::CertificateText demands = none;
    std::map<std::string, double> wrong_by;
    for (const auto& [name, margin] : least) {
      const double more = amount() * checker::GrainOf(name, plain_).unit;
      demands.demanded[static_cast<size_t>(checker::FamilyOf(name))] = margin.value + more;
      wrong_by[name] = more;
    }
    count(wrong_by, prove(drawn.plan, demands), "raised", &tally.raised);

    // The same walk but for one number, while what it kept is demanded.
    WalkPlan nudged = drawn.plan;
    checker::Nudge(&nudged, (draw.Chance(0.5) ? 1.0 : -1.0) * amount(), &draw);
    const ClosedFormWalk other(nudged);
    WalkTruth moved(plain_, other, *drawn.placed, drawn.plain_scene.no_step,
                    ToDemands(drawn.limits, drawn.plain_scene.friction));
    demands = none;
    wrong_by.clear();
    for (const auto& [name, margin] : least) {
      demands.demanded[static_cast<size_t>(checker::FamilyOf(name))] = margin.value;
      if (margin.t > other.duration()) continue;
      wrong_by[name] = margin.value - moved.At(name, margin.t, "").value;
    }
    try {
      count(wrong_by, prove(nudged, demands), "nudged", &tally.nudged);
    } catch (const InputError&) {
      ++tally.refused;
    }
  }
  return tally;
}

}  // namespace oracle
}  // namespace halfstep
