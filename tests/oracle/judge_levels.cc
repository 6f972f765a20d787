// Walks over levels, and what a mistaken oracle takes for true of them.
#include <array>
#include <numbers>

#include "tests/oracle/judge.h"
#include "tests/oracle/judge_case.h"
#include "tests/oracle/project_side.h"

namespace halfstep::oracle {
namespace {

// A rectangle with all sides moved outwards.
Polygon Larger(const Polygon& rectangle, double by) {
  Polygon larger;
  const size_t n = rectangle.size();
  for (size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& p = rectangle[i];
    const Eigen::Vector2d from_last = (p - rectangle[(i + n - 1) % n]).normalized();
    const Eigen::Vector2d from_next = (p - rectangle[(i + 1) % n]).normalized();
    larger.push_back(p + by * (from_last + from_next));
  }
  return larger;
}

// Of a plan its first step.
void CutAfterFirstStep(WalkPlan* plan) {
  const auto cut = [](size_t most, auto* values) {
    if (values->size() > most) values->resize(most);
  };
  plan->steps.resize(1);
  for (auto* of_steps : {&plan->height_scales, &plan->support_points, &plan->via_laterals,
                         &plan->via_alongs, &plan->overlaps}) {
    cut(1, of_steps);
  }
  for (auto* of_half_steps :
       {&plan->durations, &plan->foot_ramps, &plan->foot_delays, &plan->lift_shares,
        &plan->zmp_shifts, &plan->zmp_bump_ramps, &plan->rise_begins, &plan->rise_ends}) {
    cut(2, of_half_steps);
  }
  cut(1, &plan->footsteps);
}

}  // namespace

void Judge::LimitOverLevels(Draw* draw, Case* drawn) const {
  const double size = plain_.size();
  MarginLimits& limits = drawn->limits;
  limits.demanded_of(MarginFamily::kFoothold) = 0.005 * size * draw->Uniform(0.2, 1);
  limits.demanded_of(MarginFamily::kFloor) = 0.005 * size * draw->Uniform(0.1, 1);
  limits.demanded_of(MarginFamily::kClearance) = 0.005 * size * draw->Uniform(0.1, 1);
}

Tally Judge::JudgeFamily(MarginFamily family, SceneKind kind, unsigned seed,
                         const std::string& folder, std::vector<std::string>* falsehoods) const {
  Draw draw(seed), further(seed ^ 0x5bd1e995u);
  Tally tally;
  tally.walks = 1;
  Case drawn = DrawCase(kind, seed, &draw, &further, falsehoods);
  CutAfterFirstStep(&drawn.plan);
  if (!FindFeasible(folder, &drawn, &tally)) return tally;
  drawn.Overlap(std::vector<double>(drawn.plan.overlaps), 0);
  const ClosedFormWalk walk(Seen(drawn.plan));
  WalkTruth truth(plain_, walk, *drawn.placed, drawn.plain_scene.no_step, Seen(drawn));
  Compare(drawn, std::array{family}, &truth, &tally);
  JudgeCertified(drawn, drawn.limits, truth.Least(std::string(Name(family))), truth, &tally);
  Push(drawn, family, &truth, &tally);
  tally.instants += truth.instants();
  return tally;
}

WalkPlan Judge::Seen(const WalkPlan& plan) const {
  WalkPlan seen = plan;
  if (mistake_ != OracleMistake::kWaistLater) return seen;
  seen.rise_begins.clear();
  for (size_t i = 0; i < plan.durations.size(); ++i) {
    seen.rise_begins.push_back(plan.rise_begin_of(i) + 0.05);
  }
  return seen;
}

PlainScene Judge::Seen(const PlainScene& scene) const {
  PlainScene seen = scene;
  double larger = 0, higher = 0;
  if (mistake_ == OracleMistake::kRisersNearer) larger = 0.005 * plain_.size();
  if (mistake_ == OracleMistake::kEdgesNearer) larger = -0.001 * plain_.size();
  if (mistake_ == OracleMistake::kTreadsHigher) higher = 0.001;
  if (mistake_ == OracleMistake::kTreadsLower) higher = -0.001;
  for (PlainSurface& surface : seen.surfaces) {
    surface.polygon = Larger(surface.polygon, larger);
    surface.height += higher;
    surface.at.z() += higher;
    const Eigen::Rotation2Dd turn(surface.yaw_deg * std::numbers::pi / 180);
    surface.at.head<2>() -= turn * Eigen::Vector2d(larger, 0);
  }
  return seen;
}

Demands Judge::Seen(const Case& drawn) const {
  Demands seen = ToDemands(drawn.limits, drawn.plain_scene.friction);
  if (mistake_ == OracleMistake::kFlatShadows) seen.forgets = ForgetsHeights::kInShadows;
  if (mistake_ == OracleMistake::kFlatFriction) seen.forgets = ForgetsHeights::kInFriction;
  if (mistake_ == OracleMistake::kFlatLoads) seen.forgets = ForgetsHeights::kInLoads;
  return seen;
}

}  // namespace halfstep::oracle
