#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "opt/problem/scaled_rows.h"

namespace halfstep::opt {

/// What violated rows cost in an exact penalty function f + Σ_k ν_k Σ_{i in k} max(0, −c_i): one
/// penalty ν_k for each group of ScaledRows, so that a place whose multipliers are large raises the
/// price of its own rows only. Where ν_k exceeds the multipliers of group k, minimizers of the
/// program are minimizers of this function. Source: [Nocedal2006], theorem 17.3.
class RowPenalties {
 public:
  /// Penalties by the variables of a group, for a later problem with the same groups.
  using Memory = std::map<std::vector<int>, double>;

  /// Each ν is what `known` says, else `first`; 0 < first ≤ most. `rows` is borrowed.
  RowPenalties(const ScaledRows& rows, const Memory& known, double first, double most);

  /// ν of each row (m).
  Eigen::VectorXd OfRows() const;
  /// Σ_i ν_i max(0, −c_i) for c (m).
  double Owed(const Eigen::VectorXd& c) const;
  /// Σ_{i in k} max(0, −c_i) of each group k.
  std::vector<double> Violations(const Eigen::VectorXd& c) const;

  /// Raises ν_k tenfold where violations[k] > least[k]. False: none can be raised.
  bool Raise(const std::vector<double>& violations, const std::vector<double>& least);
  /// Takes back what was raised above `before` where violations[k] > most[k]. True: some was.
  bool TakeBack(const RowPenalties& before, const std::vector<double>& violations,
                const std::vector<double>& most);

  /// The group of a row.
  size_t GroupOf(Eigen::Index row) const { return rows_->groups()[static_cast<size_t>(row)]; }
  double Of(size_t group) const { return penalties_[group]; }  ///< ν_k
  /// Every group's ν, for a later problem.
  Memory Remembered() const;

 private:
  const ScaledRows* rows_;
  double most_;
  std::vector<double> penalties_;
};

}  // namespace halfstep::opt
