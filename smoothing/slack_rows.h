#pragma once

#include <Eigen/Core>
#include <vector>

#include "smoothing/margin_evaluator.h"
#include "smoothing/posture_tangent.h"
#include "smoothing/superposed_walk.h"

namespace halfstep {

/// One statement at one instant, as its slack (margin − demanded)/Scale(family): at least 0 when
/// met.
struct SlackRow {
  MarginFamily family = MarginFamily::kZmp;
  double slack = 0.0;
};

/// The statements of an instant that are nearer to their limits than a cutoff, smooth one by one
/// (each polygon edge, each end of a joint's range), with derivatives along homotopy parameters.
struct InstantSlacks {
  std::vector<SlackRow> rows;
  std::vector<HomotopyParameter> parameters;  ///< on which the instant depends
  Eigen::MatrixXd gradient;                   ///< ∂slack/∂parameter (rows × parameters)
};

/// Evaluates slacks and their analytic derivatives: superposition → leg inverse kinematics →
/// witness points. No-step areas have no rows: no parameter moves a footstep. One for each thread.
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
  // Adds a row when it is below the cutoff; `derivative(i)` is ∂margin/∂parameter i.
  template <typename Derivative>
  void Add(MarginFamily family, double margin, const Derivative& derivative, InstantSlacks* out);
  void AddFoot(const SuperposedWalk& walk, const LocalTime& at, const WalkJet& jet,
               InstantSlacks* out);
  void AddZmp(const SuperposedWalk& walk, const LocalTime& at, const WalkJet& jet,
              InstantSlacks* out);
  void AddJoints(const Posture& posture, InstantSlacks* out);
  void AddGround(const Posture& posture, InstantSlacks* out);
  void AddClearances(const Posture& posture, InstantSlacks* out);

  const MarginEvaluator& evaluator_;
  double cutoff_;
  MarginEvaluator::Scratch scratch_;
  bool gradient_ = false;
  std::vector<WalkSensitivity> sensitivities_;
  std::vector<PostureTangent> tangents_;
  std::vector<double> gradient_rows_;  // row-major, grown row by row
};

}  // namespace halfstep
