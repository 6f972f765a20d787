#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "smoothing/walk/parameter_table.h"
#include "wpg/nth.h"

namespace halfstep {

/// A derivative along homotopy parameters, term by term.
using ParameterGradient = std::vector<std::pair<HomotopyParameter, double>>;

/// The variables x of a program over a sequence: the free rows of a parameter table in its order.
/// An overlap's variable is s_i = Δ_i/B_i(T). B_i(T) is the natural overlap bound or, where T_i,
/// T_{i+1} or a ZMP's shift there is a variable, a smooth function at most 1 ms below it, so
/// 0 ≤ s_i ≤ 1 are simple bounds at all T. What is fixed keeps the value at which the table starts.
/// Source: smoothing/README.md, "Overlap program".
class OverlapVariables {
 public:
  /// `sequence` is borrowed and must outlive this.
  /// `resting`: whether the obstacles of the scene rest; if not, margins at an instant also depend
  /// on its absolute time.
  OverlapVariables(const HalfStepSequence& sequence, ParameterTable table, bool resting = true);

  const HalfStepSequence& sequence() const { return sequence_; }    ///< whose parameters they are
  int size() const { return static_cast<int>(variables_.size()); }  ///< n
  /// The parameter that is x[variable].
  const HomotopyParameter& at(int variable) const { return Nth(variables_, variable); }
  /// Of all parameters, fixed ones included.
  const ParameterTable& table() const { return table_; }

  /// x (n) of a point of the homotopy (overlaps above B_i are lowered to it), and back.
  Eigen::VectorXd ToVariables(const HomotopyParameters& parameters) const;
  /// The point of the homotopy that x (n) stands for.
  HomotopyParameters ToParameters(const Eigen::VectorXd& x) const;

  /// Index of a parameter's variable; −1 when it is not a variable.
  int IndexOf(const HomotopyParameter& parameter) const {
    return Nth(index_, table_.IndexOf(parameter));
  }
  /// The simple bounds of x (n).
  Eigen::VectorXd lower() const;
  Eigen::VectorXd upper() const;  ///< the upper ones
  /// Calls add(variable, value) for each term of the gradient with respect to x that a derivative
  /// `slope` along `parameter` makes; a variable may come several times.
  template <typename Add>
  void Pull(const HomotopyParameter& parameter, double slope, const Eigen::VectorXd& x,
            const HomotopyParameters& at, const Add& add) const {
    const int v = IndexOf(parameter);
    if (parameter.family != HomotopyParameter::Family::kOverlap) {
      if (v >= 0) add(v, slope);
      return;
    }
    if (v < 0) return;
    const Bound bound = OverlapBound(parameter.index, at);
    add(v, slope * bound.value);
    for (size_t side : {0, 1}) {
      const int half_step = parameter.index + static_cast<int>(side);
      const int T = IndexOf({HomotopyParameter::Family::kDuration, half_step});
      const int shift = IndexOf({HomotopyParameter::Family::kZmpShift, half_step});
      if (T >= 0) add(T, slope * x[v] * bound.by_duration[side]);
      if (shift >= 0) add(shift, slope * x[v] * bound.by_shift[side]);
    }
  }

  /// The variables on which an instant of half-step k may depend, at any x. At most four half-steps
  /// are ever under way at once, so these are the parameters of the three before and after it;
  /// among obstacles that move, of all before.
  std::vector<int> Band(int half_step) const;

 private:
  // B_i, and its derivatives with respect to T and the ZMP's shift of half-steps i and i + 1.
  struct Bound {
    double value;
    std::array<double, 2> by_duration = {}, by_shift = {};
  };
  Bound OverlapBound(int junction, const HomotopyParameters& at) const;

  const HalfStepSequence& sequence_;
  ParameterTable table_;
  bool resting_;
  HomotopyParameters start_;
  std::vector<HomotopyParameter> variables_;
  std::vector<int> index_;  // by row of the table: the variable, or −1
};

}  // namespace halfstep
