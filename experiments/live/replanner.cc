#include "experiments/live/replanner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/live/isolated_half_steps.h"
#include "experiments/live/near_rest.h"
#include "experiments/live/overlap_search.h"
#include "experiments/live/prepared_world.h"
#include "experiments/live/thread_seconds.h"
#include "experiments/run/planning.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

constexpr int kMostNear = 4;  // half-steps one after the other that keep less than demanded

// Whether the robot waits before half-steps that are planned.
bool GoesOn(const Situation& s) { return s.stopped && s.begun + 1 < s.plan.sequence.size(); }

// The walk in execution, delayed until it is handed over where the robot stopped.
Proposal WalkOf(const Situation& s) {
  Proposal proposal{.plan = s.plan,
                    .smoothed = s.smoothed,
                    .robot_through = s.robot_through,
                    .grant = s.grant,
                    .course = s.course};
  if (GoesOn(s)) {
    proposal.plan =
        Delayed(s.plan, s.begun, std::max(s.hand_over, s.plan.Walk().start_of(s.begun + 1)));
    // The delay is no overlap that anybody found.
    Nth(proposal.smoothed, s.begun) = true;
  }
  if (s.stopped) {
    proposal.grant.through = std::min(proposal.grant.through, s.begun - 1);
    // After a delay half-steps are together that were not when the robot's margins were proved.
    proposal.robot_through = std::min(proposal.robot_through, s.begun - 1);
  }
  return proposal;
}

// How far apart the soles' centres are at the start, across the left one [m].
double WidthAtStart(const Place& place, const LiveConfig& config) {
  const auto [left, right] = StartOf(config.experiment, place.robot, *place.scene.ground);
  return std::abs((right.Inverse() * left).y);
}

// What a walk shall go on with, where a course is commanded: rest, once a list of footsteps was
// taken or refused. Null: none is.
std::shared_ptr<const Course> CourseFor(const Situation& s, const World& world) {
  const std::shared_ptr<const Course>& course = world.course;
  if (!course || course->kind != CourseKind::kFootsteps) return course;
  if (course->number != s.refused && !SameCourse(course, s.course)) return course;
  Course rest;
  rest.number = course->number;
  return std::make_shared<const Course>(std::move(rest));
}

// Whether the walk in execution does what was commanded, as far as it goes.
bool IsPlannedFor(const Situation& s, const World& world) {
  return world.course->number == s.refused || SameCourse(world.course, s.course);
}

}  // namespace

Replanner::Replanner(const Place& place, const LiveConfig& config, const SweptVolumes& volumes)
    : robot_(place.robot),
      config_(config),
      half_steps_(volumes, place.robot, config.experiment),
      alone_(place.robot, place.scene.Emptied(), config.experiment),
      set_is_proved_(!HasLevels(*place.scene.ground) && place.scene.friction >= Scene{}.friction),
      proved_alone_(HasLevels(*place.scene.ground)),
      width_(WidthAtStart(place, config)) {}

Replanner::Replanner(const Place& place, const LiveConfig& config)
    : robot_(place.robot),
      config_(config),
      half_steps_(place, config.experiment),
      alone_(place.robot, place.scene.Emptied(), config.experiment),
      proved_alone_(HasLevels(*place.scene.ground)),
      width_(WidthAtStart(place, config)) {}

std::shared_ptr<const PreparedWorld> Replanner::Prepare(std::shared_ptr<const World> world) const {
  return std::make_shared<const PreparedWorld>(std::move(world), robot_, config_.experiment,
                                               half_steps_);
}

bool Replanner::Arrives(const WalkPlan& plan, const World& world) const {
  return world.goal.ContainsStance(StanceAfter(plan.sequence, plan.sequence.size() - 1));
}

std::optional<Margin> Replanner::Prove(const Situation& s, const SuperposedWalk& walk, int last,
                                       const PreparedWorld& among, const NearRest* near,
                                       Proposal* proposal) const {
  const int from = std::max(proposal->robot_through + 1, s.begun);
  const Safety robot = alone_.OfRobot(walk, from, last, [&](int j) {
    return (set_is_proved_ && EndsWithSetElement(walk, j, half_steps_.set())) ||
           proved_alone_.Knows(walk, j);
  });
  for (int j = from; j <= robot.through; ++j) proved_alone_.Remember(walk, j);
  proposal->effort.check += robot.work.effort();
  proposal->robot_through = std::max(robot.through, proposal->robot_through);
  Grant& grant = proposal->grant;
  // What is proved against this world already need not be proved again.
  if (grant.version != among.world.version || grant.through < s.begun) {
    grant = {.version = among.world.version,
             .proved_at = s.now,
             .through = s.begun - 1,
             .valid_until = among.world.valid_until(),
             .near = {}};
  }
  const int first = grant.through + 1;
  const double since =
      first == s.begun ? s.now : walk.start_of(std::min(first, walk.num_half_steps() - 1));
  // Volumes know nothing of areas where soles already stand.
  const bool by_volume = half_steps_.volumes() != nullptr && among.world.scene.no_step.empty();
  const auto known = [&](int j) {
    return by_volume && IsolatedAndFree(walk, j, half_steps_.set(), *among.query);
  };
  const int until = std::min({last, proposal->robot_through, walk.num_half_steps() - 1});
  Safety safety = among.safety.AmongObstacles(walk, first, until, since, known);
  proposal->effort.check += safety.work.effort();
  for (int j = safety.through + 1; near && j <= until; j = safety.through + 1) {
    const bool follows = j == near->half_step() || std::ranges::count(grant.near, j - 1) > 0;
    if (!follows || j >= near->half_step() + kMostNear || !BeginsAtRest(walk, j)) break;
    const auto rest = NearRest::At(among.safety, config_.experiment, walk, j, walk.start_of(j));
    const double begin = j == first ? since : walk.start_of(j);
    if (!rest || rest->safety().AmongObstacles(walk, j, j, begin).through < j) break;
    grant.near.push_back(j);
    const int next = std::min(j + 1, walk.num_half_steps() - 1);
    safety = among.safety.AmongObstacles(walk, j + 1, until, walk.start_of(next), known);
    proposal->effort.check += safety.work.effort();
  }
  grant.through = safety.through;
  return safety.refused_by ? safety.refused_by : robot.refused_by;
}

std::optional<Margin> Replanner::Splice(const Situation& s, const WalkPlan& plan, int junction,
                                        const std::vector<Footstep>& footsteps, int at_once,
                                        const PreparedWorld& among, const NearRest* near,
                                        Proposal* proposal) const {
  Proposal changed = *proposal;
  changed.plan = Changed(plan, junction, footsteps);
  const bool more = junction + 1 < changed.plan.sequence.size();
  if (more && changed.plan.Walk().start_of(junction + 1) < s.hand_over) {
    changed.plan = Delayed(changed.plan, junction, s.hand_over);
  }
  changed.first_changed = junction + 1;
  changed.smoothed.resize(static_cast<size_t>(junction));
  changed.smoothed.resize(static_cast<size_t>(changed.plan.sequence.num_junctions()), false);
  // The walk is another one from t_{junction + 1} on. Cut after half-step `junction` it is the
  // same, and so is what was proved of it.
  changed.robot_through = std::min(proposal->robot_through, junction);
  changed.grant.through = std::min(proposal->grant.through, junction);
  const double check = ThreadSeconds();
  const SuperposedWalk walk = changed.plan.Walk();
  const int last = std::min(junction + at_once, walk.num_half_steps() - 1);
  std::optional<Margin> refused = Prove(s, walk, last, among, near, &changed);
  changed.seconds.check += ThreadSeconds() - check;
  if (refused) {
    proposal->seconds = changed.seconds;
    proposal->effort = changed.effort;
    return refused;
  }
  *proposal = std::move(changed);
  return std::nullopt;
}

void Replanner::Shorten(const Situation& s, const PreparedWorld& among, const NearRest* near,
                        std::mt19937_64& random, Proposal* proposal) const {
  const SuperposedWalk walk = proposal->plan.Walk();
  const std::vector<int> junctions =
      Junctions(s, walk, walk.num_half_steps() - 1, /*arrives=*/false);
  if (junctions.empty()) return;
  Proposal shorter = *proposal;
  const bool changed = Change(s, proposal->plan, junctions.front(), among, near, random, &shorter);
  proposal->planned = shorter.planned;
  proposal->nodes = shorter.nodes;
  proposal->effort = shorter.effort;
  if (!changed || shorter.plan.sequence.size() >= proposal->plan.sequence.size()) return;
  shorter.kind = ProposalKind::kShortened;
  shorter.reason = "fewer footsteps";
  *proposal = std::move(shorter);
}

std::vector<int> Replanner::Junctions(const Situation& s, const SuperposedWalk& walk, int through,
                                      bool arrives) const {
  int first = s.begun;  // the latest half-step that will have begun
  while (!s.stopped && first + 1 < walk.num_half_steps() &&
         walk.start_of(first + 1) <= s.hand_over) {
    ++first;
  }
  const std::string& policy = config_.live.policy;
  if (policy == "stop_and_replan" && !(s.stopped && walk.end_of(s.begun) <= s.now)) return {};
  if (policy == "paper" && !s.stopped) first += arrives ? 2 : 4;
  const int last = std::min(through, walk.num_half_steps() - 1);
  if (last < first) return {};
  std::vector<int> junctions;
  if (arrives) {
    for (int j = last; j >= first && junctions.size() < 3; --j) junctions.push_back(j);
    if (junctions.back() != first) junctions.push_back(first);
  } else {
    for (int j = first; j <= last && junctions.size() < 4; ++j) junctions.push_back(j);
  }
  // When all nodes were used up before the last of them was tried, another one begins.
  std::ranges::rotate(junctions, junctions.begin() + s.used_up % std::ssize(junctions));
  return junctions;
}

std::string Replanner::Describe(const Situation& s, const PreparedWorld& among,
                                Margin refused) const {
  refused.at.half_step += s.first;
  if (refused.stop_after >= 0) refused.stop_after += s.first;
  return among.safety.evaluator().Describe(refused);
}

Proposal Replanner::Propose(const Situation& s, const PreparedWorld& among,
                            std::mt19937_64& random) const {
  const double begin = ThreadSeconds();
  Proposal proposal = WalkOf(s);
  const SuperposedWalk walk = proposal.plan.Walk();
  if (GoesOn(s) && walk.end_of(s.begun + 1) > among.world.valid_until()) {
    proposal.kind = ProposalKind::kUnsafe;
    proposal.reason = "the latest measurement is too old for another half-step";
    return proposal;
  }
  const int all = walk.num_half_steps() - 1;
  const std::optional<NearRest> near_rest = NearRest::Of(s, walk, among.safety, config_.experiment);
  const NearRest* near = near_rest ? &*near_rest : nullptr;
  const std::optional<Margin> refused = Prove(s, walk, all, among, near, &proposal);
  const std::shared_ptr<const Course> course = CourseFor(s, among.world);
  const bool planned_for = course && IsPlannedFor(s, among.world);
  const bool arrives = course ? planned_for && !RunsShort(s, proposal, *course)
                              : Arrives(proposal.plan, among.world);
  proposal.seconds.check = ThreadSeconds() - begin;
  if (!refused && arrives) {
    Improve(s, among, near, random, &proposal);
    return proposal;
  }
  proposal.reason = refused       ? Describe(s, among, *refused)
                    : planned_for ? "to go on as commanded"
                    : course      ? "another command: " + among.world.course->Text()
                                  : "the walk does not end in the goal";
  if (config_.live.policy == "stop_and_replan" && !s.stopped) {
    // Nothing more begins but what brings the foot that is in the air back to the floor.
    proposal.grant.through = std::min(proposal.grant.through, s.begun / 2 * 2 + 1);
  }
  const bool from_the_end = course ? planned_for : arrives;
  ChangeAnywhere(s, Junctions(s, walk, proposal.grant.through, from_the_end), among, near, random,
                 &proposal);
  return proposal;
}

void Replanner::Improve(const Situation& s, const PreparedWorld& among, const NearRest* near,
                        std::mt19937_64& random, Proposal* proposal) const {
  if (GoesOn(s)) {
    proposal->kind = ProposalKind::kResumed;
    proposal->reason = "nothing is in the way any more";
    proposal->first_changed = s.begun + 1;
    return;
  }
  const double smooth = ThreadSeconds();
  if (FindOverlaps(among.safety, config_, s.hand_over, s.begun, config_.live.smooth_ahead, proposal,
                   s.hurry)) {
    proposal->kind = ProposalKind::kSmoothed;
    proposal->reason = "overlaps";
  }
  proposal->seconds.smooth = ThreadSeconds() - smooth;
  if (among.world.course || s.hurry.stop_requested()) return;
  if (proposal->kind == ProposalKind::kSafe && s.shorten) Shorten(s, among, near, random, proposal);
}

void Replanner::ChangeAnywhere(const Situation& s, const std::vector<int>& junctions,
                               const PreparedWorld& among, const NearRest* near,
                               std::mt19937_64& random, Proposal* proposal) const {
  const WalkPlan plan = proposal->plan;
  const std::shared_ptr<const Course> course = CourseFor(s, among.world);
  for (const int junction : junctions) {
    if (proposal->nodes >= config_.experiment.planner.max_nodes) break;
    if (course ? Follow(s, plan, junction, *course, among, near, random, proposal)
               : Change(s, plan, junction, among, near, random, proposal)) {
      const bool listed = course && course->kind == CourseKind::kFootsteps;
      proposal->kind = proposal->first_changed < 0 ? ProposalKind::kSafe
                       : listed                    ? ProposalKind::kCommanded
                                                   : ProposalKind::kChanged;
      return;
    }
    const std::string why = proposal->planned.status == PlanStatus::kSolved
                                ? "a plan was refused"
                                : proposal->planned.sentence;
    if (!proposal->reason.ends_with(why)) proposal->reason += "; " + why;
  }
  proposal->kind = ProposalKind::kUnsafe;
  proposal->refuses = course && course->kind == CourseKind::kFootsteps && !junctions.empty();
}

}  // namespace halfstep
