#include "opt/solvers/envelope_matrix.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfstep::opt {
namespace {

using Segment = Eigen::Map<const Eigen::VectorXd>;

}  // namespace

EnvelopeMatrix::EnvelopeMatrix(std::vector<int> positions, std::vector<int> first)
    : positions_(std::move(positions)), first_(std::move(first)) {
  Eigen::Index size = 0;
  for (size_t p = 0; p < first_.size(); ++p) {
    offset_.push_back(size - first_[p]);
    size += static_cast<Eigen::Index>(p) - first_[p] + 1;
  }
  entries_.setZero(size);
  for (size_t i = 0; i < first_.size(); ++i) {
    for (size_t j = static_cast<size_t>(first_[i]); j <= i; ++j) {
      multiplications_ += static_cast<long>(j) - std::max(first_[i], first_[j]) + 1;
    }
  }
}

void EnvelopeMatrix::SetZero() { entries_.setZero(); }

void EnvelopeMatrix::AddDiagonal(const Eigen::ArrayXd& diagonal) {
  for (Eigen::Index v = 0; v < diagonal.size(); ++v) {
    const int p = PositionOf(static_cast<int>(v));
    Row(p)[p] += diagonal[v];
  }
}

bool EnvelopeMatrix::Factorize() {
  const int n = static_cast<int>(first_.size());
  for (int i = 0; i < n; ++i) {
    double* row = Row(i);
    const int begin = first_[static_cast<size_t>(i)];
    for (int j = begin; j < i; ++j) {
      const double* other = Row(j);
      const int from = std::max(begin, first_[static_cast<size_t>(j)]);
      row[j] =
          (row[j] - Segment(row + from, j - from).dot(Segment(other + from, j - from))) / other[j];
    }
    const double pivot = row[i] - Segment(row + begin, i - begin).squaredNorm();
    if (!(pivot > 0.0)) return false;
    row[i] = std::sqrt(pivot);
  }
  return true;
}

Eigen::VectorXd EnvelopeMatrix::Solve(const Eigen::VectorXd& right) const {
  const int n = static_cast<int>(first_.size());
  Eigen::VectorXd x(n);
  for (int v = 0; v < n; ++v) x[PositionOf(v)] = right[v];
  for (int i = 0; i < n; ++i) {
    const int begin = first_[static_cast<size_t>(i)];
    const double* row = Row(i);
    x[i] = (x[i] - Segment(row + begin, i - begin).dot(x.segment(begin, i - begin))) / row[i];
  }
  for (int i = n - 1; i >= 0; --i) {
    const int begin = first_[static_cast<size_t>(i)];
    const double* row = Row(i);
    x[i] /= row[i];
    x.segment(begin, i - begin) -= x[i] * Segment(row + begin, i - begin);
  }
  Eigen::VectorXd solution(n);
  for (int v = 0; v < n; ++v) solution[v] = x[PositionOf(v)];
  return solution;
}

}  // namespace halfstep::opt
