#pragma once

#include <Eigen/Core>
#include <string>

namespace halfstep::opt {

/// Neighbouring entries of x that mean the same thing. Bounds may be ±inf; lower ≤ upper.
struct VariableBlock {
  std::string name;         ///< for reports only: "overlap"
  std::string unit;         ///< "s"
  Eigen::VectorXd initial;  ///< (n)
  Eigen::VectorXd lower;    ///< (n)
  Eigen::VectorXd upper;    ///< (n)
};

/// Which block of a Problem; obtained from Problem::AddVariables.
struct BlockId {
  int index = -1;
};

}  // namespace halfstep::opt
