#pragma once

#include <Eigen/Core>
#include <vector>

#include "smoothing/margins/family_traits.h"
#include "smoothing/margins/instant.h"
#include "smoothing/walk/posture_gradient.h"
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
/// derivatives along homotopy parameters. Owned by a SlackEvaluator, which fills the sensitivities.
class SlackSink {
 public:
  /// Statements with slack above `cutoff` are left out.
  explicit SlackSink(double cutoff) : cutoff_(cutoff) {}

  /// Derivatives of the walk's quantities along the parameters on which the instant depends; empty
  /// where only slacks are wanted.
  std::vector<WalkSensitivity> sensitivities;
  /// Whether footsteps are among the variables. If not, nothing is said of soles that stand.
  bool footsteps_move = false;

  /// Forgets the parameters, for another instant.
  void Clear() {
    sensitivities.clear();
    tangents_.clear();
    rows_.clear();
    gradient_.clear();
  }
  /// Says to which family the statements that follow belong, and what is demanded of them [its
  /// unit].
  void Begin(MarginFamily family, double demanded);

  /// The margin beyond which statements are left out [its unit].
  double cutoff_margin() const { return demanded_ + cutoff_ * scale_; }

  /// Adds a statement unless it is beyond the cutoff; `gradient()` is a WalkJet, the margin's
  /// gradient with respect to the walk's quantities with obstacles held still, `rate` is ∂margin/∂t
  /// by what these do [its unit/s].
  template <typename Gradient>
  void Add(double margin, const Gradient& gradient, double rate = 0.0) {
    if (AddSlack(margin, rate) && !sensitivities.empty()) AddSlopes(gradient());
  }
  /// The same of a margin that is a function of the posture at a regular instant: `add(gradient)`
  /// adds to a PostureGradient that is zero.
  template <typename AddTo>
  void AddOfPosture(Instant* at, double margin, const AddTo& add, double rate = 0.0) {
    const auto gradient = [&] {
      PostureGradient of_posture;
      add(&of_posture);
      return PulledBack(at->robot(), at->jet(), at->posture(), of_posture);
    };
    Add(margin, gradient, rate);
  }
  /// The same where a margin is differentiated along one parameter after the other: `derivative(i)`
  /// is ∂margin/∂parameter i. Dearer by as many times as there are parameters.
  template <typename Derivative>
  void AddAlong(double margin, const Derivative& derivative) {
    if (!AddSlack(margin, 0.0)) return;
    for (size_t i = 0; i < sensitivities.size(); ++i) {
      gradient_.push_back(derivative(i) / scale_);
    }
  }
  /// Derivatives of the posture along the parameters, made when first asked for. Precondition: the
  /// instant is regular.
  const std::vector<PostureTangent>& Tangents(Instant* at);

  const std::vector<SlackRow>& rows() const { return rows_; }  ///< added so far
  /// ∂slack/∂parameter (rows × parameters).
  Eigen::MatrixXd Gradient() const;

 private:
  // False: beyond the cutoff.
  bool AddSlack(double margin, double rate);
  // Of the statement added last.
  void AddSlopes(const WalkJet& gradient);

  double cutoff_;
  MarginFamily family_ = MarginFamily::kZmp;
  double demanded_ = 0.0, scale_ = 1.0;
  std::vector<SlackRow> rows_;
  std::vector<double> gradient_;  // row-major
  std::vector<PostureTangent> tangents_;
};

}  // namespace halfstep
