#include "planner/search/step_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "wpg/check.h"
#include "wpg/elementary.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

std::vector<double> Chosen(const std::vector<double>& all, const std::vector<int>& elements) {
  std::vector<double> chosen;
  for (int i : elements) chosen.push_back(Nth(all, i));
  return chosen;
}

// Room to walk around what stands between the start and the goal.
Eigen::AlignedBox2d DefaultWorkspace(const PlanRequest& request) {
  constexpr double kRoom = 2.0;
  Eigen::AlignedBox2d box(request.goal.X_WG.position());
  for (const Foothold& sole : request.start) box.extend(sole.Planar().position());
  const Eigen::Vector2d room = Eigen::Vector2d::Constant(kRoom);
  return {box.min() - room, box.max() + room};
}

}  // namespace

StepGraph::StepGraph(const PlanRequest& request, std::vector<int> elements)
    : request_(request),
      elements_(std::move(elements)),
      costs_(Chosen(request.cost.OfElements(request.set), elements_)),
      reach_(request.set, elements_, request.cost.OfElements(request.set)),
      workspace_(request.workspace.value_or(DefaultWorkspace(request))) {
  const bool level_set = request.levels.empty();
  const bool one_level = level_set && !request.ground;
  HALFSTEP_CHECK(!one_level || request.start[0].height == request.start[1].height,
                 "the soles stand at " << request.start[0].height << " m and "
                                       << request.start[1].height << " m");
  HALFSTEP_CHECK(
      !one_level || !request.in_air || request.in_air->X_WS.height == request.start[0].height,
      "on one foot at " << request.in_air->X_WS.height << " m");
  if (request.set.num_forms() > 1) {
    for (int i : elements_) changes_.push_back(request.set.ChangeOf(i));
  }
  for (Side support : {Side::kLeft, Side::kRight}) {
    for (int i : elements_) {
      if (level_set) Nth(request.set.placements, i).CheckLevel();
      Nth(placements_, Index(support)).push_back(request.set.Placement(i, support));
    }
  }
}

std::vector<StepState> StepGraph::FreeStarts() const {
  if (request_.in_air) return {*request_.in_air};
  std::vector<StepState> starts;
  for (int form = 0; form < request_.set.num_forms(); ++form) {
    for (Side support : {Side::kLeft, Side::kRight}) {
      const Foothold& X_WS = Nth(request_.start, Index(support));
      HalfStep up = request_.set.PrototypeOf(form);
      up.support = support;
      up.kind = HalfStepKind::kUp;
      up.X_SF = X_WS.Inverse() * Nth(request_.start, Index(Opposite(support)));
      if (form > 0) up.standing_crouch = request_.set.prototype.shape.crouch;
      if (!request_.start_is_free || request_.start_is_free(up, X_WS)) {
        starts.push_back({X_WS, support, form});
      }
    }
  }
  return starts;
}

double StepGraph::OnLevel(double height) const {
  constexpr double kSame = 1e-8;  // [m] heights of one level differ by less, by different sums
  const std::vector<double>& levels = request_.levels;
  const auto above = std::ranges::lower_bound(levels, height);
  if (above != levels.end() && *above - height <= kSame) return *above;
  if (above != levels.begin() && height - *(above - 1) <= kSame) return *(above - 1);
  return height;
}

Foothold StepGraph::Landing(const StepState& from, int k) const {
  Foothold X_WF = from.X_WS * Nth(Nth(placements_, Index(from.support)), k);
  X_WF.height = looks_up_heights() ? HeightAt(X_WF.Planar(), from) : OnLevel(X_WF.height);
  return X_WF;
}

void StepGraph::Landings(const StepState& from, std::vector<Foothold>* X_WF) const {
  const auto [s, c] = SinCos(from.X_WS.yaw);
  X_WF->clear();
  X_WF->reserve(elements_.size());
  // Most often all is at one height.
  const bool as_in_set = !looks_up_heights() && request_.levels.empty();
  for (const Foothold& X_SF : Nth(placements_, Index(from.support))) {
    const double height = as_in_set            ? from.X_WS.height + X_SF.height
                          : looks_up_heights() ? std::numeric_limits<double>::quiet_NaN()
                                               : OnLevel(from.X_WS.height + X_SF.height);
    X_WF->push_back({{from.X_WS.x + c * X_SF.x - s * X_SF.y, from.X_WS.y + s * X_SF.x + c * X_SF.y,
                      from.X_WS.yaw + X_SF.yaw},
                     height});
  }
}

bool StepGraph::DownIsFree(const StepState& from, int k) {
  if (!Fits(from, k) || IsForbidden(from, k)) return false;
  ++queries_;
  return request_.query.DownIsFree(Nth(elements_, k), from.support, from.X_WS);
}

bool StepGraph::UpIsFree(const StepState& from, int k) {
  if (!Fits(from, k)) return false;
  ++queries_;
  return request_.query.UpIsFree(Nth(elements_, k), from.support, from.X_WS);
}

// The middle of the feet is at most half an element away from the foot that landed before the last.
double StepGraph::SteadySteps(const StepState& from) const {
  const double distance = goal().Distance(from.X_WS.Planar().position()),
               turn = goal().Turn(from.X_WS.yaw);
  if (goal().part != GoalPart::kMidFeet) return reach_.Steps(distance, turn);
  const double before_last = reach_.Steps(distance - 0.5 * reach_.one(), 0.0);
  return std::max(before_last > 0.0 ? 1.0 + before_last : 0.0, reach_.Steps(0.0, turn));
}

int StepGraph::LeastSteps(const StepState& from) const {
  constexpr double kRounding = 1e-9;  // a bound that exceeds an integer by less is that integer
  constexpr double kMany = 1e6;
  const double steady = std::min(SteadySteps(from), kMany);
  int steps = std::max(1, static_cast<int>(std::ceil(steady - kRounding)));
  if (goal().part == GoalPart::kLeftFoot || goal().part == GoalPart::kRightFoot) {
    const Side side = goal().part == GoalPart::kLeftFoot ? Side::kLeft : Side::kRight;
    const bool odd = side != from.support;  // the first footstep is the other foot's
    if ((steps % 2 == 1) != odd) ++steps;
  }
  return steps;
}

void StepGraph::Forbid(const StepState& from, int k) { forbidden_.push_back({from, k}); }

bool StepGraph::IsForbidden(const StepState& from, int k) const {
  return std::find(forbidden_.begin(), forbidden_.end(), Edge{from, k}) != forbidden_.end();
}

std::vector<int> AllElements(const StepSet& set) {
  std::vector<int> all(static_cast<size_t>(set.size()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace halfstep
