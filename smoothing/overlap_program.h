#pragma once

#include <Eigen/Core>
#include <vector>

#include "opt/problem.h"
#include "smoothing/homotopy_parameters.h"
#include "smoothing/margin_evaluator.h"

namespace halfstep {

/// Which nonlinear program over a sequence's homotopy parameters.
struct ProgramOptions {
  bool heights = false;    ///< height scales η are variables beside the overlaps
  bool durations = false;  ///< so are the durations T
  double least_height_scale = 0.2;
  double least_duration = 0.5;  ///< as a fraction of the planned one
  double most_duration = 1.5;   ///< as a fraction of the planned one
  int instants = 20;  ///< per half-step. Fewer: cheaper, and more is left to the certificate
  double sharpness =
      60.0;  ///< ρ of the aggregation: a row lies up to log(count)/ρ below the least slack
  double cutoff = 3.0;  ///< statements with more slack do not count
};

/// The program `fastest` of a sequence:
///
///     minimize D = Σ T − Σ Δ    subject to    every slack ≥ 0 at the program's instants,
///
/// over s, and η and T when asked for, with Δ_i = s_i·B_i(T), 0 ≤ s_i ≤ 1, where B_i is a smooth
/// lower bound (by at most 1 ms) of the natural overlap bound: so the overlaps' bounds are simple
/// ones at all T. Slacks are scaled margins (SlackRow), gathered per half-step and family into
///     −log(e^{−ρc} + Σ e^{−ρ·slack})/ρ  ≤ least slack,
/// one row each: 9n rows with a band of variables. Source: smoothing/README.md, "Overlap program".
class OverlapProgram {
 public:
  /// `sequence` and `evaluator` are borrowed and must outlive this and its problems.
  OverlapProgram(const HalfStepSequence& sequence, const MarginEvaluator& evaluator,
                 const ProgramOptions& options);

  opt::Problem MakeProblem() const;

  int num_variables() const { return static_cast<int>(variables_.size()); }
  /// x (n) of a point of the homotopy (values outside the variables' bounds are clamped), and back.
  Eigen::VectorXd ToVariables(const HomotopyParameters& parameters) const;
  HomotopyParameters ToParameters(const Eigen::VectorXd& x) const;

  /// D [s] at x and its gradient (n).
  double Duration(const Eigen::VectorXd& x) const;
  Eigen::VectorXd DurationGradient(const Eigen::VectorXd& x) const;

  int num_rows() const { return sequence_.size() * kNumMarginFamilies; }
  /// Aggregated slacks (num_rows) at x, and the Jacobian when `jacobian` is not null (rows × n,
  /// zero outside the band).
  Eigen::VectorXd Slacks(const Eigen::VectorXd& x, Eigen::MatrixXd* jacobian) const;
  /// Whether row and variable may depend on each other, at any x.
  bool InBand(int row, int variable) const;

 private:
  // B_i and its derivatives with respect to T_i and T_{i+1}.
  struct Bound {
    double value, before, after;
  };
  Bound OverlapBound(int junction, const std::vector<double>& durations) const;
  int IndexOf(const HomotopyParameter& parameter) const;  // in x, −1: not a variable
  void SlacksOfHalfStep(const Eigen::VectorXd& x, const class SuperposedWalk& walk, int half_step,
                        class SlackEvaluator* slacks, Eigen::VectorXd* values,
                        Eigen::MatrixXd* jacobian) const;

  const HalfStepSequence& sequence_;
  const MarginEvaluator& evaluator_;
  ProgramOptions options_;
  HomotopyParameters planned_;
  std::vector<HomotopyParameter> variables_;
};

}  // namespace halfstep
