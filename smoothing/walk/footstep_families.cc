#include "smoothing/walk/footstep_families.h"

#include <algorithm>

#include "smoothing/walk/homotopy_parameters.h"
#include "wpg/motion/moved_footsteps.h"

namespace halfstep {

std::vector<Pose2> MovesOfFootsteps(const HomotopyParameters& parameters) {
  std::vector<Pose2> moves(parameters.footstep_xs.size());
  for (size_t j = 0; j < moves.size(); ++j) {
    moves[j] = {parameters.footstep_xs[j], parameters.footstep_ys[j], parameters.footstep_yaws[j]};
  }
  const bool none = std::ranges::all_of(moves, [](const Pose2& move) { return move == Pose2{}; });
  return none ? std::vector<Pose2>{} : moves;
}

HalfStepSequence WithFootsteps(const HalfStepSequence& sequence,
                               const HomotopyParameters& parameters) {
  const std::vector<Pose2> moves = MovesOfFootsteps(parameters);
  return moves.empty() ? sequence : WithFootstepsMoved(sequence, moves);
}

}  // namespace halfstep
