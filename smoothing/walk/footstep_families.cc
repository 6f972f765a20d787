#include "smoothing/walk/footstep_families.h"

#include <algorithm>

#include "smoothing/walk/homotopy_parameters.h"
#include "wpg/motion/moved_footsteps.h"

namespace halfstep {
namespace {

// The last footstep of each foot stays, so that the walk ends where it was planned to end. So do
// those that are not followed by one of the other and one of the same foot, because what they bear
// on would not be the half-steps of half_steps().
bool Stays(const HalfStepSequence& sequence, int step) {
  if (step + 2 >= sequence.num_steps()) return true;
  const auto swing = [&sequence](int k) {
    return sequence.half_steps[2 * static_cast<size_t>(k)].half_step.swing();
  };
  return swing(step + 1) == swing(step) || swing(step + 2) != swing(step);
}

constexpr ParameterFamilyTraits OfMove(double Pose2::*move) {
  ParameterFamilyTraits traits{};
  traits.table = "half_steps";
  traits.of_form = true;
  traits.move = move;
  traits.count = [](const HalfStepSequence& sequence) { return sequence.num_steps(); };
  traits.planned = [](const HalfStepSequence&, int) { return 0.0; };
  traits.stays = Stays;
  // The landing, the next step, whose support it is, and the half-step that leaves it.
  traits.half_steps = [](int j) { return std::pair{2 * j + 1, 2 * j + 4}; };
  traits.index_at = [](int half_step) { return half_step / 2; };
  traits.least_itself = true;
  traits.chosen = &ParameterChoice::footsteps;
  return traits;
}

constexpr ParameterBoundKey kXBounds[] = {{"most_footstep_x_m",
                                           "of the move of a footstep along its x, to either side",
                                           &ParameterChoice::most_footstep_x, 0, 0.5, "m"}};
constexpr ParameterBoundKey kYBounds[] = {{"most_footstep_y_m",
                                           "of the move of a footstep along its y, to either side",
                                           &ParameterChoice::most_footstep_y, 0, 0.5, "m"}};
constexpr ParameterBoundKey kYawBounds[] = {{"most_footstep_yaw_rad",
                                             "of the turn of a footstep, to either side",
                                             &ParameterChoice::most_footstep_yaw, 0, 1, "rad"}};

constexpr ParameterFamilyTraits kX = [] {
  ParameterFamilyTraits traits = OfMove(&Pose2::x);
  traits.name = "footstep_x";
  traits.unit = "m";
  traits.column = "footstep_x_m";
  traits.rank = 10;
  traits.meaning = "how far the step's footstep is moved along its planned x";
  traits.values = &HomotopyParameters::footstep_xs;
  traits.least = -0.5;
  traits.most = 0.5;
  traits.key = "footsteps";
  traits.key_meaning = "places and yaws of footsteps are variables, but of the last two";
  traits.bounds = kXBounds;
  traits.range = [](const ParameterChoice& choice, double) {
    return std::pair{-choice.most_footstep_x, choice.most_footstep_x};
  };
  return traits;
}();

constexpr ParameterFamilyTraits kY = [] {
  ParameterFamilyTraits traits = OfMove(&Pose2::y);
  traits.name = "footstep_y";
  traits.unit = "m";
  traits.column = "footstep_y_m";
  traits.rank = 11;
  traits.meaning = "how far the step's footstep is moved along its planned y";
  traits.values = &HomotopyParameters::footstep_ys;
  traits.least = -0.5;
  traits.most = 0.5;
  traits.bounds = kYBounds;
  traits.range = [](const ParameterChoice& choice, double) {
    return std::pair{-choice.most_footstep_y, choice.most_footstep_y};
  };
  return traits;
}();

constexpr ParameterFamilyTraits kYaw = [] {
  ParameterFamilyTraits traits = OfMove(&Pose2::yaw);
  traits.name = "footstep_yaw";
  traits.unit = "rad";
  traits.column = "footstep_yaw_rad";
  traits.rank = 12;
  traits.meaning = "how far the step's footstep is turned";
  traits.values = &HomotopyParameters::footstep_yaws;
  traits.least = -1.0;
  traits.most = 1.0;
  traits.bounds = kYawBounds;
  traits.range = [](const ParameterChoice& choice, double) {
    return std::pair{-choice.most_footstep_yaw, choice.most_footstep_yaw};
  };
  return traits;
}();

}  // namespace

const ParameterFamilyTraits& FootstepTraits(ParameterFamily family) {
  switch (family) {
    case ParameterFamily::kFootstepX:
      return kX;
    case ParameterFamily::kFootstepY:
      return kY;
    default:
      return kYaw;
  }
}

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
