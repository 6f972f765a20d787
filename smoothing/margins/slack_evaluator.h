#pragma once

#include <Eigen/Core>
#include <vector>

#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/margins/slack_sink.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// The statements of an instant that are nearer to their limits than a cutoff, smooth one by one
/// (each polygon edge, each end of a joint's range), with derivatives along homotopy parameters.
struct InstantSlacks {
  std::vector<SlackRow> rows;
  std::vector<HomotopyParameter> parameters;  ///< on which the instant depends
  Eigen::MatrixXd gradient;                   ///< ∂slack/∂parameter (rows × parameters)
};

/// Evaluates slacks and their analytic derivatives: superposition → leg inverse kinematics →
/// witness points. One for each thread.
class SlackEvaluator {
 public:
  /// `evaluator` is borrowed. Statements with slack above `cutoff` are left out.
  SlackEvaluator(const MarginEvaluator& evaluator, double cutoff);

  /// At (half-step, τ). `moving`: with an instant that itself moves, the rate dτ/dparameter of each
  /// given parameter. Without `gradient` only the slacks are filled. Unreachable: one reach row,
  /// negative, and no joints or clearances.
  void At(const SuperposedWalk& walk, const LocalTime& at,
          const std::vector<std::pair<HomotopyParameter, double>>& moving, bool gradient,
          InstantSlacks* out);

  long instants() const { return scratch_.instants; }

 private:
  const MarginEvaluator& evaluator_;
  SlackSink sink_;
  MarginEvaluator::Scratch scratch_;
};

}  // namespace halfstep
