#include "wpg/motion/moved_footsteps.h"

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

size_t Of(Side side) { return static_cast<size_t>(Index(side)); }

}  // namespace

std::vector<HalfStepFootsteps> FootstepsOf(const HalfStepSequence& sequence) {
  std::vector<HalfStepFootsteps> all;
  std::array<int, 2> last = {-1, -1};
  for (int step = 0; step < sequence.num_steps(); ++step) {
    const HalfStep& up = Nth(sequence.half_steps, 2 * step).half_step;
    const int support = last[Of(up.support)];
    all.push_back({support, last[Of(up.swing())]});
    all.push_back({support, step});
    last[Of(up.swing())] = step;
  }
  return all;
}

HalfStepSequence WithFootstepsMoved(const HalfStepSequence& sequence,
                                    const std::vector<Pose2>& moves) {
  HALFSTEP_CHECK(moves.size() == static_cast<size_t>(sequence.num_steps()),
                 moves.size() << " moves of " << sequence.num_steps() << " footsteps");
  HalfStepSequence result = sequence;
  std::array<Foothold, 2> soles = sequence.start;
  std::array<bool, 2> moved = {false, false};
  for (size_t step = 0; step < moves.size(); ++step) {
    PlacedHalfStep &up = result.half_steps[2 * step], &down = result.half_steps[2 * step + 1];
    const size_t support = Of(up.half_step.support), swing = Of(up.half_step.swing());
    // By what is planned up to here alone, so that walks that begin alike are moved alike.
    const Foothold planned = down.X_WS * down.half_step.X_SF;
    if (!moved[support]) soles[support] = up.X_WS;
    up.X_WS = down.X_WS = soles[support];
    if (moved[support] || moved[swing]) up.half_step.X_SF = up.X_WS.Inverse() * soles[swing];
    moved[swing] = moves[step] != Pose2{};
    soles[swing] = moved[swing] ? planned * Foothold::Level(moves[step]) : planned;
    if (moved[support] || moved[swing]) down.half_step.X_SF = down.X_WS.Inverse() * soles[swing];
  }
  return result;
}

}  // namespace halfstep
