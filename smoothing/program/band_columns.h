#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "smoothing/program/overlap_variables.h"

namespace halfstep {

/// The columns of a band of variables at a point x: gradients along their parameters, and what
/// these are with respect to x. They differ by overlaps alone, whose variables are fractions of a
/// bound.
class BandColumns {
 public:
  /// `variables` and `band`, which is in ascending order, are borrowed; `at` is the point of the
  /// homotopy that x (n) stands for.
  BandColumns(const OverlapVariables& variables, const std::vector<int>& band,
              const Eigen::VectorXd& x, const HomotopyParameters& at);

  /// How many there are.
  Eigen::Index size() const { return static_cast<Eigen::Index>(band_.size()); }
  /// The column of a parameter. Precondition: its variable is in the band.
  Eigen::Index Of(const HomotopyParameter& parameter) const {
    return ColumnOf(variables_.IndexOf(parameter));
  }
  /// Writes the gradient with respect to the band's variables, of one along their parameters (both
  /// of this size).
  void Pull(const Eigen::VectorXd& along_parameters, double* by_x) const;

 private:
  // What a derivative along the parameter of one column adds to another.
  struct Term {
    Eigen::Index from, to;
    double factor;
  };
  Eigen::Index ColumnOf(int variable) const {
    return std::lower_bound(band_.begin(), band_.end(), variable) - band_.begin();
  }

  const OverlapVariables& variables_;
  const std::vector<int>& band_;
  std::vector<Eigen::Index> overlaps_;  // their columns
  std::vector<Term> terms_;             // of these
};

}  // namespace halfstep
