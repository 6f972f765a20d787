// How the replanner finds a first walk.

#include <algorithm>
#include <cmath>

#include "experiments/live/near_rest.h"
#include "experiments/live/overlap_search.h"
#include "experiments/live/prepared_world.h"
#include "experiments/live/replanner.h"
#include "experiments/run/planning.h"

namespace halfstep {

Proposal Replanner::Begin(const std::array<Foothold, 2>& start, const PreparedWorld& among,
                          int junctions, std::mt19937_64& random) const {
  Proposal proposal{.kind = ProposalKind::kUnsafe};
  const HalfStep like = PrototypeOf(config_.experiment);
  const std::optional<NearRest> near_rest =
      NearRest::AtStart(among.safety, config_.experiment, start, like);
  const NearRest* near = near_rest ? &*near_rest : nullptr;
  if (among.world.course) return BeginAlong(start, among, near, junctions, random);
  proposal.planned = Plan(start, {}, among, among.world.goal, near, /*rests=*/true,
                          config_.experiment.planner.max_nodes, random);
  proposal.reason = proposal.planned.sentence;
  if (proposal.planned.footsteps.empty()) return proposal;
  const auto refused = Start(start, proposal.planned.footsteps, among, near, junctions, &proposal);
  if (refused) proposal.reason = among.safety.evaluator().Describe(*refused);
  return proposal;
}

std::optional<Margin> Replanner::Start(const std::array<Foothold, 2>& start,
                                       const std::vector<Footstep>& footsteps,
                                       const PreparedWorld& among, const NearRest* near,
                                       int junctions, Proposal* proposal) const {
  const HalfStep like = PrototypeOf(config_.experiment);
  proposal->plan.sequence = MakeSequence(start, footsteps, like.via_lateral, like.shape,
                                         MotionModelOf(robot_, like.shape));
  proposal->plan.parameters = PlannedMotion(proposal->plan.sequence);
  const SuperposedWalk walk = proposal->plan.Walk();
  Situation situation;
  proposal->grant.version = -1;
  proposal->robot_through = -1;
  const auto refused = Prove(situation, walk, walk.num_half_steps() - 1, among, near, proposal);
  if (refused) return refused;
  if (proposal->grant.valid_until < walk.end_of(0)) {
    proposal->reason = "the first half-step ends later than what is measured of obstacles holds";
    return std::nullopt;
  }
  proposal->kind = ProposalKind::kChanged;
  proposal->first_changed = 0;
  proposal->smoothed.resize(static_cast<size_t>(proposal->plan.sequence.num_junctions()), false);
  while (FindOverlaps(among.safety, config_, 0.0, 0, junctions, proposal)) {
  }
  return std::nullopt;
}

Proposal Replanner::BeginAlong(const std::array<Foothold, 2>& start, const PreparedWorld& among,
                               const NearRest* near, int junctions, std::mt19937_64& random) const {
  Proposal proposal{.kind = ProposalKind::kUnsafe, .course = among.world.course};
  const Course& course = *among.world.course;
  const bool listed = course.kind == CourseKind::kFootsteps;
  CourseSteps steps;
  if (!listed) steps = StepsAhead(course, GaitOf({}, {}), {.feet = start}, 0.0);
  std::vector<Footstep> footsteps = listed ? Listed(course, start) : steps.footsteps;
  if (listed && footsteps.size() < course.footsteps.size()) footsteps.clear();
  if (footsteps.empty()) {
    proposal.reason = "nothing is to be walked: " + course.Text();
    return proposal;
  }
  const auto refused = Start(start, footsteps, among, near, junctions, &proposal);
  if (!refused) {
    if (proposal.kind != ProposalKind::kChanged) return proposal;
    if (listed) proposal.kind = ProposalKind::kCommanded;
    proposal.reason = course.Text() + ShortfallText(steps);
    return proposal;
  }
  proposal.reason = among.safety.evaluator().Describe(*refused);
  if (listed) {
    const auto last = static_cast<int>(footsteps.size()) - 1;
    const int which = std::clamp(refused->at.half_step / 2, 0, last);
    proposal.reason = course.NameOf(which) + proposal.reason;
  }
  if (listed || course.Rests()) return proposal;
  proposal.planned = Plan(start, {}, among, RegionAlong(course, start, Ahead(config_)), near,
                          /*rests=*/true, config_.experiment.planner.max_nodes, random);
  if (!proposal.planned.footsteps.empty() &&
      !Start(start, proposal.planned.footsteps, among, near, junctions, &proposal)) {
    return proposal;
  }
  footsteps.resize(static_cast<size_t>(std::max(0, refused->at.half_step / 2)));
  if (!footsteps.empty()) Start(start, footsteps, among, near, junctions, &proposal);
  return proposal;
}

}  // namespace halfstep
