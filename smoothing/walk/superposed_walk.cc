#include "smoothing/walk/superposed_walk.h"

#include <algorithm>

#include "smoothing/walk/footstep_families.h"
#include "smoothing/walk/walk_rounding.h"
#include "wpg/check.h"

namespace halfstep {
SuperposedWalk::SuperposedWalk(const HalfStepSequence& sequence,
                               const HomotopyParameters& parameters)
    : parameters_(parameters), model_(sequence.model) {
  CheckParameters(sequence, parameters);
  const std::vector<PlacedHalfStep> placed = WithFootsteps(sequence, parameters).half_steps;
  const std::vector<HalfStepFootsteps> footsteps = FootstepsOf(sequence);
  pieces_.reserve(placed.size());
  for (size_t i = 0; i < placed.size(); ++i) {
    HalfStep half_step = placed[i].half_step;
    for (const ParameterFamily family : AllParameterFamilies()) {
      const ParameterFamilyTraits& traits = Traits(family);
      double* number = traits.number_of(&half_step);
      if (number == nullptr) continue;
      const double value =
          HomotopyParameter{family, traits.index_at(static_cast<int>(i))}.in(parameters);
      *number = traits.factor ? *number * value : value;
    }
    const Foothold& X_WS = placed[i].X_WS;
    pieces_.push_back({.half_step = half_step,
                       .planned = placed[i].half_step,
                       .X_WS = X_WS,
                       .on = footsteps[i],
                       .tracks = {half_step, *model_, X_WS}});
  }
  UpdateStarts(1);
}

void SuperposedWalk::UpdateStarts(int from) {
  for (size_t i = static_cast<size_t>(from); i < pieces_.size(); ++i) {
    pieces_[i].start =
        pieces_[i - 1].start + (pieces_[i - 1].tracks.duration() - parameters_.overlaps[i - 1]);
  }
}

void SuperposedWalk::SetOverlap(int junction, double overlap) {
  HALFSTEP_CHECK(junction >= 0 && junction + 1 < num_half_steps(), "junction " << junction);
  const size_t i = static_cast<size_t>(junction);
  const double bound = NaturalOverlapBound(parameters_, junction);
  HALFSTEP_CHECK(
      overlap >= -kLongestRest && overlap <= bound + kOverlapTolerance,
      "overlap " << overlap << " s of junction " << junction << ", bound " << bound << " s");
  parameters_.overlaps[i] = overlap;
  UpdateStarts(junction + 1);
}

SuperposedWalk SuperposedWalk::StopBranch(int last) const {
  HALFSTEP_CHECK(last >= 0 && last < num_half_steps(), "half-step " << last);
  SuperposedWalk branch;
  branch.model_ = model_;
  branch.pieces_.assign(pieces_.begin(), pieces_.begin() + last + 1);
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    const std::vector<double>& all = parameters_.of(family);
    const int count = traits.index_at(last) + (traits.joins() ? 0 : 1);
    branch.parameters_.of(family).assign(all.begin(), all.begin() + count);
  }
  return branch;
}

LocalTime SuperposedWalk::Locate(double t) const {
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), t,
                                      [](double time, const Piece& p) { return time < p.start; });
  const int i = static_cast<int>(after - pieces_.begin()) - 1;
  return {i, std::clamp(t, 0.0, duration()) - start_of(i)};
}

int SuperposedWalk::FirstActive(const LocalTime& at) const {
  int i = at.half_step;
  while (i > 0 && LocalTo(i - 1, at) < piece(i - 1).tracks.duration()) --i;
  return i;
}

int SuperposedWalk::LastActive(const LocalTime& at) const {
  int i = at.half_step;
  while (i + 1 < num_half_steps() && LocalTo(i + 1, at) > 0.0) ++i;
  return i;
}

WalkJet SuperposedWalk::At(const LocalTime& at) const {
  const int first = FirstActive(at), last = LastActive(at);
  WalkJet jet;
  jet.value = piece(first).tracks.start();
  for (int i = first; i <= last; ++i) piece(i).tracks.AddMotion(LocalTo(i, at), &jet);
  return jet;
}

WalkState SuperposedWalk::SecondBounds(double begin, double end) const {
  WalkState bounds = WalkState::Zero();
  const int first = FirstActive(Locate(begin)), last = LastActive(Locate(end));
  for (int i = first; i <= last; ++i) {
    const Piece& p = piece(i);
    p.tracks.AddSecondBounds(begin - p.start, end - p.start, &bounds);
  }
  return bounds;
}

WalkThirds SuperposedWalk::ThirdRanges(double begin, double end) const {
  WalkThirds thirds;
  const double time = LocalTimeRounding(*this, Locate(end));
  const int first = FirstActive(Locate(begin - 2.0 * time));
  const int last = LastActive(Locate(end + 2.0 * time));
  for (int i = first; i <= last; ++i) {
    const Piece& p = piece(i);
    p.tracks.AddThirdRanges(begin - p.start, end - p.start, time, &thirds);
  }
  return thirds;
}

int SuperposedWalk::StepInAir(const LocalTime& at) const {
  const int first = FirstActive(at) / 2, last = LastActive(at) / 2;
  for (int step = first; step <= last; ++step) {
    const int up = 2 * step;
    if (LocalTo(up, at) < piece(up).tracks.t2()) continue;
    const Piece* down = DownOf(step);
    if (down == nullptr || LocalTo(up + 1, at) <= down->tracks.t1()) return step;
  }
  return -1;
}

bool SuperposedWalk::MovesHorizontally(int step, const LocalTime& at) const {
  const int up = 2 * step;
  const double in_up = LocalTo(up, at);
  const bool begun = in_up >= piece(up).tracks.horizontal_begin();
  const bool rising = in_up <= piece(up).tracks.duration();
  const Piece* down = DownOf(step);
  if (down == nullptr) return begun && rising;
  const double in_down = LocalTo(up + 1, at);
  return (begun || in_down >= 0.0) && (in_down <= down->tracks.horizontal_end() || rising);
}

double SuperposedWalk::LeastHeight(int step, double begin, double end) const {
  constexpr double kSteepest = 15.0 / 8.0;  // S'(½)
  const Piece& up = piece(2 * step);
  const Piece* down = DownOf(step);
  // Fractions of the rise that is done, and of the sinking that is still to come.
  const double lift_off = up.tracks.lift_begin(), rise = up.tracks.lift_end() - lift_off;
  const auto risen = [&](double t) {
    return std::clamp((t - up.start - lift_off) / rise, 0.0, 1.0);
  };
  const auto left = [&](double t) {
    if (down == nullptr) return 1.0;
    const double sinks = down->start + down->tracks.lift_begin();
    const double sinking = down->tracks.lift_end() - down->tracks.lift_begin();
    return 1.0 - std::clamp((t - sinks) / sinking, 0.0, 1.0);
  };
  const double support = up.X_WS.height, via = support + up.half_step.via_height;
  const double from = support + up.half_step.X_SF.height;
  const double to = down == nullptr ? via : support + down->half_step.X_SF.height;
  const double done = Smoothstep{}.At(risen(begin)).value;
  const double still = Smoothstep{}.At(left(end)).value;
  const double monotone = (1.0 - done) * from + (1.0 - still) * to + via * (done + still - 1.0);
  // Both are concave in between, so their sum is least at an end.
  const double sum = std::min(risen(begin) + left(begin), risen(end) + left(end));
  const double lower = std::min(from, to);
  return std::max(monotone, lower + kSteepest * (via - lower) * std::min(0.0, sum - 1.0));
}

bool SuperposedWalk::InAir(const LocalTime& at, Side foot) const {
  const int step = StepInAir(at);
  return step >= 0 && half_step(2 * step).swing() == foot;
}

SupportPolygon SupportAt(const SuperposedWalk& walk, const LocalTime& at, const WalkState& x,
                         const Eigen::Vector2d& sole_size) {
  const int step = walk.StepInAir(at);
  if (step >= 0) return {walk.X_WS(2 * step).Planar(), sole_size};
  return {FootPose(x, Side::kLeft), FootPose(x, Side::kRight), sole_size};
}

}  // namespace halfstep
