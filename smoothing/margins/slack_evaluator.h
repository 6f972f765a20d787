#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/margins/slack_sink.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// The statements of an instant that are nearer to their limits than a cutoff, with derivatives
/// along homotopy parameters. Each is smooth by itself (one for each polygon edge, or end of a
/// joint's range).
struct InstantSlacks {
  std::vector<SlackRow> rows;                 ///< one for each statement
  std::vector<HomotopyParameter> parameters;  ///< on which the robot's posture there depends
  Eigen::MatrixXd gradient;  ///< ∂slack/∂parameter, obstacles held still (rows × parameters)
  /// ∂t/∂parameter of the instant's absolute time, for every parameter that moves it; empty where
  /// obstacles rest. A row's whole derivative is gradient + SlackRow::rate · ∂t/∂parameter.
  ParameterRates times;

  /// The whole derivative of a row along a parameter.
  double Slope(size_t row, const HomotopyParameter& parameter) const;
};

/// Evaluates slacks and their analytic derivatives: each statement's gradient is pulled back from
/// its witness points through the leg inverse kinematics to the walk's quantities, and multiplied
/// by how the superposition moves these along each parameter. Use one for each thread.
class SlackEvaluator {
 public:
  /// `evaluator` is borrowed. Statements with slack above `cutoff` are left out. Derivatives are
  /// taken along the parameters that are `wanted`; without it, along all. Soles that stand are
  /// looked at when `footsteps_move`.
  SlackEvaluator(const MarginEvaluator& evaluator, double cutoff, ParameterFilter wanted = {},
                 bool footsteps_move = false);

  /// Evaluates the instant (half-step, τ). Where the instant itself moves with some parameters,
  /// `moving` has the rate dτ/dparameter of each. Among obstacles that move, `times` lists the
  /// parameters of all half-steps before it. Without `gradient` only the slacks are filled.
  /// When a leg does not reach or is stretched to the singularity, there is one negative row of
  /// `reach`, with derivatives 0, and there are no rows of joints, ground or clearances.
  void At(const SuperposedWalk& walk, const LocalTime& at, const ParameterRates& moving,
          bool gradient, InstantSlacks* out);

  /// The instants that were evaluated.
  const Work& work() const { return scratch_.work; }

 private:
  const MarginEvaluator& evaluator_;
  ParameterFilter wanted_;
  SlackSink sink_;
  MarginEvaluator::Scratch scratch_;
};

}  // namespace halfstep
