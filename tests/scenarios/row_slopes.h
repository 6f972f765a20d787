#pragma once

#include <vector>

#include "smoothing/program/watched_instants.h"
#include "tests/smoothing/test_walks.h"

namespace halfstep {

/// Rows of a table at x, and their slopes along a random direction by differences of two steps.
struct RowSlopes {
  Eigen::VectorXd direction, values;
  std::vector<double> nonzeros;  ///< of the table's Jacobian
  Eigen::VectorXd coarse, fine;

  RowSlopes(const WatchedInstants& table, const Eigen::VectorXd& x, WalkDraw* draw)
      : direction(x.size()) {
    for (double& along : direction) along = draw->Uniform(-1, 1);
    table.Evaluate(x, &values, &nonzeros);
    const auto slope = [&](double h) {
      Eigen::VectorXd more, less;
      table.Evaluate(x + h * direction, &more, nullptr);
      table.Evaluate(x - h * direction, &less, nullptr);
      return Eigen::VectorXd((more - less) / (2 * h));
    };
    coarse = slope(1e-5);
    fine = slope(2e-6);
  }
};

}  // namespace halfstep
