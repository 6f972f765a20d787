#include "experiments/live/isolated_half_steps.h"

#include <cmath>

namespace halfstep {
namespace {

// Whether a place differs from that of an element by no more than the rounding of placing it in the
// world: as much as margins are rounded by.
bool Same(const Footprint& a, const Footprint& b) {
  constexpr double kRounding = 1e-12;  // [m], [rad]
  return std::abs(a.x - b.x) <= kRounding && std::abs(a.y - b.y) <= kRounding &&
         std::abs(a.yaw - b.yaw) <= kRounding && a.height == b.height;
}

// Whether half-step j is executed as it was planned, from rest to rest.
bool Isolated(const SuperposedWalk& walk, int j) {
  const HomotopyParameters& at = walk.parameters();
  const auto i = static_cast<size_t>(j);
  return (i == 0 || at.overlaps[i - 1] <= 0.0) &&
         (i == at.overlaps.size() || at.overlaps[i] <= 0.0) && at.height_scales[i / 2] == 1.0 &&
         at.durations[i] == walk.half_step(j).duration;
}

}  // namespace

IsolatedHalfSteps::IsolatedHalfSteps(const RobotModel& robot, const ExperimentConfig& config,
                                     const SweptVolumes& volumes)
    : volumes_(volumes),
      alone_(robot, Scene{}, config),
      kept_(4 * static_cast<size_t>(volumes.set.size())) {}

std::optional<IsolatedHalfSteps::Element> IsolatedHalfSteps::Find(const SuperposedWalk& walk,
                                                                  int j) const {
  if (!Isolated(walk, j) || walk.X_WS(j).height != 0.0) return {};
  const HalfStep& half_step = walk.half_step(j);
  const bool down = half_step.kind == HalfStepKind::kDown;
  const Side support = down ? half_step.support : half_step.swing();
  const Footprint placement = down ? half_step.X_SF : half_step.X_SF.Inverse();
  for (int i = 0; i < volumes_.set.size(); ++i) {
    if (!Same(placement, volumes_.set.Placement(i, support))) continue;
    HalfStep like = down ? volumes_.set.Down(i, support) : volumes_.set.Up(i, support);
    like.X_SF = half_step.X_SF;
    if (like != half_step) return {};
    return Element{i, support, half_step.kind};
  }
  return {};
}

bool IsolatedHalfSteps::KeepsOfRobot(const SuperposedWalk& walk, int j) const {
  const std::optional<Element> element = Find(walk, j);
  if (!element) return false;
  const auto& [i, support, kind] = *element;
  const bool down = kind == HalfStepKind::kDown;
  const size_t at =
      4 * static_cast<size_t>(i) + (down ? 2 : 0) + static_cast<size_t>(Index(support));
  if (kept_[at] == Known::kNotAsked) {
    const HalfStep half_step = down ? volumes_.set.Down(i, support) : volumes_.set.Up(i, support);
    kept_[at] = alone_.Certifies(half_step, {}) ? Known::kKept : Known::kNotKept;
  }
  return kept_[at] == Known::kKept;
}

bool IsolatedHalfSteps::Clears(const SuperposedWalk& walk, int j,
                               const SweptVolumeQuery& query) const {
  const std::optional<Element> element = Find(walk, j);
  if (!element) return false;
  const auto& [i, support, kind] = *element;
  if (kind == HalfStepKind::kDown) return query.DownIsFree(i, support, walk.X_WS(j));
  // An up half-step is asked about by the sole that supported before.
  return query.UpIsFree(i, support, walk.X_WS(j) * walk.half_step(j).X_SF);
}

}  // namespace halfstep
