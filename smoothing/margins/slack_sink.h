#pragma once

#include <Eigen/Core>
#include <vector>

#include "smoothing/margins/family_traits.h"
#include "smoothing/walk/posture_tangent.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// One statement at one instant, as its slack (margin − demanded)/Scale(family): at least 0 when
/// met.
struct SlackRow {
  MarginFamily family = MarginFamily::kZmp;  ///< the statement's family
  double slack = 0.0;                        ///< (margin − demanded)/Scale(family)
  /// ∂slack/∂t with the robot held still: what obstacles that move do to it [1/s].
  double rate = 0.0;
};

/// Takes the statements of an instant that are nearer to their limits than a cutoff, with
/// derivatives along homotopy parameters. Owned by a SlackEvaluator, which fills the tangents.
class SlackSink {
 public:
  /// Statements with slack above `cutoff` are left out.
  explicit SlackSink(double cutoff) : cutoff_(cutoff) {}

  /// Derivatives along the parameters on which the instant depends: of the walk's quantities, and
  /// of the posture (empty where joint speeds have no bound).
  std::vector<WalkSensitivity> sensitivities;
  std::vector<PostureTangent> tangents;  ///< of the same parameters
  /// Whether footsteps are among the variables. If not, nothing is said of soles that stand.
  bool footsteps_move = false;

  /// Forgets the parameters, for another instant.
  void Clear() {
    sensitivities.clear();
    tangents.clear();
    rows_.clear();
    gradient_.clear();
  }
  /// Says to which family the statements that follow belong, and what is demanded of them [its
  /// unit].
  void Begin(MarginFamily family, double demanded);

  /// The margin beyond which statements are left out [its unit].
  double cutoff_margin() const { return demanded_ + cutoff_ * scale_; }

  /// Adds a statement unless it is beyond the cutoff; `derivative(i)` is ∂margin/∂parameter i with
  /// obstacles held still, `rate` is ∂margin/∂t by what these do [its unit/s].
  template <typename Derivative>
  void Add(double margin, const Derivative& derivative, double rate = 0.0) {
    if (!AddSlack(margin, rate)) return;
    for (size_t i = 0; i < sensitivities.size(); ++i) {
      gradient_.push_back(derivative(i) / scale_);
    }
  }

  const std::vector<SlackRow>& rows() const { return rows_; }  ///< added so far
  /// ∂slack/∂parameter (rows × parameters).
  Eigen::MatrixXd Gradient() const;

 private:
  // False: beyond the cutoff.
  bool AddSlack(double margin, double rate);

  double cutoff_;
  MarginFamily family_ = MarginFamily::kZmp;
  double demanded_ = 0.0, scale_ = 1.0;
  std::vector<SlackRow> rows_;
  std::vector<double> gradient_;  // row-major
};

}  // namespace halfstep
