// How the replanner follows a course that was commanded in place of a goal.

#include <algorithm>
#include <cmath>

#include "experiments/live/isolated_half_steps.h"
#include "experiments/live/near_rest.h"
#include "experiments/live/overlap_search.h"
#include "experiments/live/prepared_world.h"
#include "experiments/live/replanner.h"
#include "experiments/live/thread_seconds.h"
#include "experiments/run/planning.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr int kAtOnce = 4;         // half-steps behind a junction that are proved at once
constexpr int kMostFootsteps = 8;  // that are planned in one go
constexpr double kLikelyPace =
    0.7;  // part of a step's time that overlaps leave, as long as none is

// Half of the largest gap between the values [rad].
double HalfGap(std::vector<double> yaws) {
  constexpr double kAlone = 0.1;  // [rad]
  std::ranges::sort(yaws);
  double gap = 0.0;
  for (size_t i = 1; i < yaws.size(); ++i) gap = std::max(gap, yaws[i] - yaws[i - 1]);
  return gap > 0.0 ? 0.5 * gap : kAlone;
}

// How long the latest steps of a walk take whose overlaps are found, at most four [s].
double PaceOf(const WalkPlan& plan, const std::vector<bool>& smoothed, double likely) {
  constexpr int kSteps = 4;
  if (plan.sequence.half_steps.empty()) return likely;
  const SuperposedWalk walk = plan.Walk();
  const std::vector<double>& overlaps = plan.parameters.overlaps;
  double time = 0.0;
  int steps = 0;
  for (int up = walk.num_half_steps() - 2; up >= 2 && steps < kSteps; up -= 2) {
    bool counts = true;
    for (const int junction : {up - 2, up - 1}) {
      counts = counts && Nth(smoothed, junction) && Nth(overlaps, junction) >= 0.0;
    }
    if (!counts) continue;
    time += walk.start_of(up) - walk.start_of(up - 2);
    ++steps;
  }
  return steps > 0 ? time / steps : likely;
}

// The footstep of a list that begins behind a junction which half-step `half_step` belongs to.
int ListedAt(int half_step, int junction) { return half_step / 2 - (junction + 1) / 2; }

Standing StandingAfter(const WalkPlan& plan, int junction) {
  const HalfStep& half_step = Nth(plan.sequence.half_steps, junction).half_step;
  Standing standing{.feet = StanceAfter(plan.sequence, junction), .landed = half_step.swing()};
  if (half_step.kind == HalfStepKind::kUp) standing.in_air = half_step.swing();
  return standing;
}

PlanResult Refused(const std::string& why) {
  PlanResult refused;
  refused.status = PlanStatus::kRefused;
  refused.sentence = why;
  return refused;
}

}  // namespace

Gait Replanner::GaitOf(const WalkPlan& plan, const std::vector<bool>& smoothed) const {
  const StepGrid& grid = config_.experiment.step_set;
  constexpr double kRounding = 1e-9;
  const double half = 0.5 * grid.spacing + kRounding;
  const double step = 2.0 * config_.experiment.half_step.duration;
  return {.set = half_steps_.set(),
          .cell = {half, half, HalfGap(grid.yaws) + kRounding},
          .width = width_,
          .pace = PaceOf(plan, smoothed, kLikelyPace * step),
          .ground = [this](const Pose2& X_WF, double from) {
            return half_steps_.HeightAt(X_WF, from);
          }};
}

CourseSteps Replanner::StepsAhead(const Course& course, const Gait& gait, const Standing& standing,
                                  double kept) const {
  const double missing = std::max(0.0, Ahead(config_) - kept);
  const int count = std::min(1 + static_cast<int>(std::ceil(missing / gait.pace)), kMostFootsteps);
  return FootstepsAlong(course, gait, standing, count);
}

std::vector<Footstep> Replanner::Listed(const Course& course, std::array<Foothold, 2> feet) const {
  const HalfStep like = PrototypeOf(config_.experiment);
  std::vector<Footstep> footsteps;
  for (const CommandedFootstep& one : course.footsteps) {
    const double from = Nth(feet, Index(Opposite(one.side))).height;
    const double height = half_steps_.HeightAt(one.X_WF, from);
    if (std::isnan(height)) break;
    footsteps.push_back({.side = one.side,
                         .X_WF = Foothold(one.X_WF, height),
                         .via_height = like.via_height,
                         .duration = like.duration});
    Nth(feet, Index(one.side)) = footsteps.back().X_WF;
  }
  return footsteps;
}

bool Replanner::RunsShort(const Situation& s, const Proposal& proposal,
                          const Course& course) const {
  if (course.Rests() || course.kind == CourseKind::kFootsteps) return false;
  const SuperposedWalk walk = proposal.plan.Walk();
  const int next = s.begun + 1, last = walk.num_half_steps() - 1;
  if (next <= last && walk.duration() - walk.start_of(next) >= Ahead(config_)) return false;
  const CourseSteps more = FootstepsAlong(course, GaitOf(proposal.plan, proposal.smoothed),
                                          StandingAfter(proposal.plan, last), 1);
  return !(more.complete && more.footsteps.empty());
}

bool Replanner::Follow(const Situation& s, const WalkPlan& plan, int junction, const Course& course,
                       const PreparedWorld& among, const NearRest* near, std::mt19937_64& random,
                       Proposal* proposal) const {
  if (course.kind == CourseKind::kFootsteps) {
    return FollowList(s, plan, junction, course, among, near, proposal);
  }
  const double begin = ThreadSeconds();
  const Standing standing = StandingAfter(plan, junction);
  const SuperposedWalk walk = plan.Walk();
  const double kept = walk.end_of(junction) - walk.start_of(std::min(s.begun + 1, junction));
  const CourseSteps steps = StepsAhead(course, GaitOf(plan, s.smoothed), standing, kept);
  std::vector<Footstep> footsteps = steps.footsteps;
  proposal->planned = {};
  proposal->planned.status = PlanStatus::kSolved;
  proposal->planned.footsteps = footsteps;
  proposal->seconds.plan += ThreadSeconds() - begin;
  const auto take = [&](const std::vector<Footstep>& some) {
    auto refused = Splice(s, plan, junction, some, kAtOnce, among, near, proposal);
    if (!refused) proposal->course = among.world.course;
    return refused;
  };
  if (footsteps.empty() && (standing.in_air || !steps.complete)) {
    proposal->planned = Refused("the ground bears no footstep along the course");
    return false;
  }
  if (footsteps.empty() && junction + 1 == plan.sequence.size()) {
    proposal->course = among.world.course;
    return true;  // the walk ends as it shall
  }
  const std::optional<Margin> refused = take(footsteps);
  if (!refused) {
    proposal->reason += ShortfallText(steps);
    return true;
  }
  const std::string why = "the way is blocked: " + Describe(s, among, *refused);
  if (course.Rests()) {
    proposal->planned = Refused(why);
    // Where the feet cannot be closed the robot rests as it stands.
    return !standing.in_air && !take({});
  }
  // Around what is in the way, or as far as is proved.
  const PlanResult around =
      PlanAfter(s, plan, junction, among, RegionAlong(course, standing.feet, Ahead(config_)), near,
                random, proposal);
  const bool found = around.status == PlanStatus::kSolved && !around.footsteps.empty();
  if (found && !take(around.footsteps)) return true;
  const int proved = ListedAt(refused->at.half_step, junction);
  footsteps.resize(std::min(footsteps.size(), static_cast<size_t>(std::max(0, proved))));
  const bool ends = junction + 1 == plan.sequence.size();
  // A walk that is safe and only ends too soon stays as it is up to its end.
  const bool stays = SameCourse(s.course, among.world.course) &&
                     proposal->grant.version == among.world.version &&
                     proposal->grant.through + 1 == plan.sequence.size();
  // One that has to change may end between two steps.
  const bool cuts = !standing.in_air && !ends;
  if ((ends || !stays) && (cuts || !footsteps.empty()) && !take(footsteps)) {
    proposal->reason += "; as far as is proved: " + why;
    return true;
  }
  const std::string searched = found ? "a plan around it was refused" : around.sentence;
  proposal->planned = Refused(why + "; " + searched);
  return false;
}

bool Replanner::FollowList(const Situation& s, const WalkPlan& plan, int junction,
                           const Course& course, const PreparedWorld& among, const NearRest* near,
                           Proposal* proposal) const {
  const Standing standing = StandingAfter(plan, junction);
  if (standing.in_air && *standing.in_air != course.footsteps.front().side) {
    proposal->planned = Refused("the other foot is in the air");
    return false;
  }
  const std::vector<Footstep> footsteps = Listed(course, standing.feet);
  if (footsteps.size() < course.footsteps.size()) {
    const auto borne = static_cast<int>(footsteps.size());
    proposal->planned = Refused(course.NameOf(borne) + "the ground does not bear it");
    return false;
  }
  const int all = 2 * static_cast<int>(footsteps.size()) + 1;
  const auto refused = Splice(s, plan, junction, footsteps, all, among, near, proposal);
  if (!refused) {
    proposal->planned.status = PlanStatus::kSolved;
    proposal->course = among.world.course;
    return true;
  }
  const auto last = static_cast<int>(footsteps.size()) - 1;
  const int listed = std::clamp(ListedAt(refused->at.half_step, junction), 0, last);
  proposal->planned = Refused(course.NameOf(listed) + Describe(s, among, *refused));
  return false;
}

}  // namespace halfstep
