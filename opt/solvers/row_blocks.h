#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "opt/solvers/envelope_matrix.h"

namespace halfstep::opt {

/// Rows of a sparse matrix A (m×n) as dense blocks of rows whose columns are nearly the same, found
/// from its pattern: products go without an index for each entry. Rows are in the order of the
/// blocks here: the i-th is row order()[i] of A.
class RowBlocks {
 public:
  /// `rows`: which (k), ascending.
  RowBlocks(const Eigen::SparseMatrix<double>& A, const std::vector<int>& rows);

  const std::vector<int>& order() const { return order_; }  ///< (k)
  /// Zeros of the shape of AᵀA, for AddGram.
  EnvelopeMatrix MakeGram() const;

  void Times(const Eigen::VectorXd& d, Eigen::ArrayXd* Ad) const;           ///< A d (k)
  void AddTransposed(const Eigen::ArrayXd& z, Eigen::VectorXd* sum) const;  ///< sum (n) += Aᵀz
  void AddGram(const Eigen::ArrayXd& theta, EnvelopeMatrix* K) const;       ///< K += AᵀΘA
  long multiplications() const { return multiplications_; }  ///< what AddGram takes, about

 private:
  struct Block {
    std::vector<int> columns;  // in the order of their positions
    std::vector<int> rows;     // of A
    Eigen::Index first = 0;    // of its rows, here
    // Transposed, (columns × rows): padded by zeros to a multiple of kTile columns.
    Eigen::MatrixXd entries;
  };

  // Rows with equal columns.
  static std::vector<Block> EqualRows(const Eigen::SparseMatrix<double>& At,
                                      const std::vector<int>& rows);
  // Joins groups where the zeros that this adds cost less than a further block.
  void Merge(std::vector<Block> groups);

  Eigen::Index n_;
  std::vector<int> position_;  // of each column in the envelope
  std::vector<Block> blocks_;
  std::vector<int> order_;
  Eigen::Index widest_ = 0;  // rows of entries of a block, at most
  long multiplications_ = 0;
};

}  // namespace halfstep::opt
