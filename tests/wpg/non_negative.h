#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

namespace halfstep {

/// The x ≥ 0 with the least ‖A x − b‖. Source: C. L. Lawson and R. J. Hanson, Solving Least Squares
/// Problems, 1974, ch. 23.
inline Eigen::VectorXd NonNegativeLeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::Index n = A.cols();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> free;
  for (Eigen::Index round = 0; round < 10 * n; ++round) {
    const Eigen::VectorXd downhill = A.transpose() * (b - A * x);
    Eigen::Index best = -1;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (std::find(free.begin(), free.end(), j) != free.end()) continue;
      if (downhill[j] > 1e-11 * b.norm() && (best < 0 || downhill[j] > downhill[best])) best = j;
    }
    if (best < 0) break;
    free.push_back(best);
    for (;;) {
      const Eigen::VectorXd of_free = A(Eigen::all, free).colPivHouseholderQr().solve(b);
      Eigen::VectorXd there = Eigen::VectorXd::Zero(n);
      for (size_t k = 0; k < free.size(); ++k)
        there[free[k]] = of_free[static_cast<Eigen::Index>(k)];
      double step = 1.0;
      for (const Eigen::Index j : free) {
        if (there[j] <= 0.0) step = std::min(step, x[j] / (x[j] - there[j]));
      }
      x += step * (there - x);
      if (step >= 1.0) break;
      std::erase_if(free, [&](Eigen::Index j) { return x[j] <= 1e-15; });
      for (Eigen::Index j = 0; j < n; ++j) {
        if (std::find(free.begin(), free.end(), j) == free.end()) x[j] = 0.0;
      }
      if (free.empty()) break;
    }
  }
  return x;
}

}  // namespace halfstep
