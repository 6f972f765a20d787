#pragma once

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "experiments/python/walk_setting.h"
#include "opt/problem/problem.h"
#include "smoothing/program/overlap_program.h"

namespace halfstep::python {

/// Selects a program for Python.
struct HeldProgramOptions {
  ProgramOptions program;
  bool overlaps = true;         ///< whether overlaps are variables
  double duration_limit = 0.0;  ///< for `safest` [s]; 0: that of the walk where methods begin
};

/// What came of looking at the walk of a point.
struct Refinement {
  bool proved = false;       ///< by the test of the problem, for all t
  double least_slack = 0.0;  ///< sampled, of the margins' scales
  std::string sentence;      ///< what refuses the walk; "" when it is proved
};

/// An overlap program as Python holds it: it owns what it needs. It remembers its last point, since
/// SciPy asks for values and derivatives in separate calls.
class HeldProgram {
 public:
  /// Takes a program for one thread; std::invalid_argument where another thread has it.
  class Use {
   public:
    explicit Use(std::atomic<bool>* taken);
    ~Use() { taken_->store(false); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    std::atomic<bool>* taken_;
  };

  HeldProgram(std::shared_ptr<const WalkSetting> setting, const HeldProgramOptions& options);

  /// To be held while anything below is called.
  Use Take() const { return Use(&taken_); }

  const opt::Problem& problem() const { return *problem_; }
  const OverlapProgram& program() const { return program_; }
  OverlapProgram& program() { return program_; }
  const std::shared_ptr<const WalkSetting>& setting() const { return setting_; }

  /// Each throws std::invalid_argument for an x of a wrong size. Outside of the simple bounds,
  /// where there is no walk, values go on linearly from the nearest point within: SciPy's solvers
  /// look there although they are asked not to.
  double Cost(const Eigen::VectorXd& x);
  Eigen::VectorXd Gradient(const Eigen::VectorXd& x);            ///< (n)
  const Eigen::VectorXd& Constraints(const Eigen::VectorXd& x);  ///< (m)
  /// In the order of problem().pattern().
  const std::vector<double>& Jacobian(const Eigen::VectorXd& x);
  /// Throws std::invalid_argument for an x outside of the simple bounds by more than rounding.
  HomotopyParameters ToParameters(const Eigen::VectorXd& x) const;

  /// Samples the walk of x, proves it, and watches the instants where that failed or slacks are
  /// small: rows change. Rows grow sharper when the walk was proved and softer when it was not.
  Refinement Refine(const Eigen::VectorXd& x, const std::stop_token& stop);
  void SetSharpness(double sharpness);

 private:
  // The nearest point within the bounds.
  Eigen::VectorXd Within(const Eigen::VectorXd& x) const;
  // Makes `x` the last point; what was known of another one is forgotten.
  void MoveTo(const Eigen::VectorXd& x);
  void EvaluateWithJacobian();
  void Forget();

  mutable std::atomic<bool> taken_ = false;
  std::shared_ptr<const WalkSetting> setting_;
  OverlapProgram program_;
  std::optional<opt::Problem> problem_;
  Eigen::VectorXd at_, within_;  // the last point, and the nearest one within the bounds
  std::optional<Eigen::VectorXd> constraints_;
  std::optional<std::vector<double>> jacobian_;
};

}  // namespace halfstep::python
