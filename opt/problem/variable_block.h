#pragma once

#include <Eigen/Core>
#include <string>

namespace halfstep::opt {

/// Consecutive entries of x that have the same meaning. Bounds may be ±inf; lower ≤ upper.
struct VariableBlock {
  std::string name;         ///< for reports only: "overlap"
  std::string unit;         ///< "s"
  Eigen::VectorXd initial;  ///< (n)
  Eigen::VectorXd lower;    ///< (n)
  Eigen::VectorXd upper;    ///< (n)
};

/// Identifies a block of variables; returned by Problem::AddVariables.
struct BlockId {
  int index = -1;  ///< in the order in which blocks were added; −1: none
};

}  // namespace halfstep::opt
