#pragma once

#include <array>
#include <span>
#include <string_view>

#include "smoothing/methods/walk_problem.h"

namespace halfstep {

/// What steps of fast walks look like: medians over the steps of one class in walks that searches
/// found, of HRP-2 under the profile `walkable`, double support of 0.1 s. Arrays: the step's
/// up half-step, then its down half-step. Source: smoothing/README.md, "Typical forms";
/// notebooks-data/drawn_walks/typical_forms.csv, which `make_data.sh` measures again.
struct TypicalForm {
  std::string_view name;           ///< "level"
  std::array<double, 2> duration;  ///< T [s], scaled by √z_c
  double up_down;                  ///< Δ in the step, of its natural bound
  double down_up;                  ///< Δ to the step after it, of its natural bound
  double height_scale;             ///< η
  double support_point;            ///< [m], scaled by the standing width, as the next
  double via_lateral;              ///< [m]
  double via_along;                ///< [m], scaled by the leg
  std::array<double, 2> foot_ramp, foot_delay, lift_share, zmp_shift, zmp_bump_ramp;  ///< fractions
};

/// All of them; the last is the slowest, of long steps.
std::span<const TypicalForm> TypicalForms();

/// The form for a step by its place in the walk and where its foot goes, whatever is in its way.
const TypicalForm& FormOfStep(const HalfStepSequence& sequence, int step, const RobotModel& robot);

/// A point near which fast walks are: each step in its own form, or in `form` where that is not
/// null, as far as the ranges of `choice` allow. Steps that would touch an obstacle so, at a few
/// instants, take the form over obstacles. ZMPs go from foot to foot for as long as is demanded
/// (MarginFamily::kDoubleSupport). What is fixed stays. Nothing is proved of it. `scratch` counts
/// the work.
HomotopyParameters TypicalStart(const WalkProblem& problem, const ParameterChoice& choice,
                                MarginEvaluator::Scratch* scratch,
                                const TypicalForm* form = nullptr);

}  // namespace halfstep
