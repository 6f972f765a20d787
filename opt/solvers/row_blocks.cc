#include "opt/solvers/row_blocks.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "opt/solvers/band_order.h"

namespace halfstep::opt {
namespace {

using Eigen::Index;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr int kTile = 4;           // columns of a block are gone through by so many
constexpr size_t kCandidates = 8;  // blocks before a group that it may join
// What products of a block cost besides the entries' own work, in multiplications: once a block,
// and for each entry of its AᵀΘA.
constexpr Index kBlockCost = 400, kGatherCost = 4;

Index Tiles(size_t columns) { return (static_cast<Index>(columns) + kTile - 1) / kTile; }

Index Cost(size_t columns, size_t rows) {
  const Index tiles = Tiles(columns), entries = kTile * kTile * tiles * (tiles + 1) / 2;
  return kBlockCost + entries * (static_cast<Index>(rows) + kGatherCost);
}

// kTile rows of V from i on times those of W from j on, transposed. Eigen would check each entry.
using Tile = Eigen::Matrix<double, kTile, kTile>;
Tile TileOfProduct(const Eigen::MatrixXd& V, Index i, const Eigen::MatrixXd& W, Index j) {
  using Column = Eigen::Matrix<double, kTile, 1>;
  Column sums[kTile];
  for (Column& sum : sums) sum.setZero();
  const double *v = V.data() + i, *w = W.data() + j;
  for (Index k = 0; k < V.cols(); ++k, v += V.rows(), w += W.rows()) {
    const Column column = Eigen::Map<const Column, Eigen::Aligned16>(v);
    for (int b = 0; b < kTile; ++b) sums[b] += column * w[b];
  }
  Tile product;
  for (int b = 0; b < kTile; ++b) product.col(b) = sums[b];
  return product;
}

}  // namespace

RowBlocks::RowBlocks(const SparseMatrix& A, const std::vector<int>& rows) : n_(A.cols()) {
  const SparseMatrix At = A.transpose();
  std::vector<Block> groups = EqualRows(At, rows);
  std::vector<std::vector<int>> cliques;
  for (const Block& group : groups) cliques.push_back(group.columns);
  position_ = BandPositions(cliques, static_cast<int>(n_));
  Merge(std::move(groups));
  std::vector<Index> place(static_cast<size_t>(n_));  // of a column in its block
  for (Block& block : blocks_) {
    block.first = static_cast<Index>(order_.size());
    order_.insert(order_.end(), block.rows.begin(), block.rows.end());
    multiplications_ += Cost(block.columns.size(), block.rows.size());
    widest_ = std::max(widest_, kTile * Tiles(block.columns.size()));
    block.entries.setZero(kTile * Tiles(block.columns.size()),
                          static_cast<Index>(block.rows.size()));
    for (size_t k = 0; k < block.columns.size(); ++k) {
      place[static_cast<size_t>(block.columns[k])] = static_cast<Index>(k);
    }
    for (size_t k = 0; k < block.rows.size(); ++k) {
      for (SparseMatrix::InnerIterator entry(At, block.rows[k]); entry; ++entry) {
        block.entries(place[static_cast<size_t>(entry.row())], static_cast<Index>(k)) =
            entry.value();
      }
    }
  }
}

std::vector<RowBlocks::Block> RowBlocks::EqualRows(const SparseMatrix& At,
                                                   const std::vector<int>& rows) {
  std::map<std::vector<int>, std::vector<int>> rows_of;
  std::vector<int> columns;
  for (const int row : rows) {
    columns.clear();
    for (SparseMatrix::InnerIterator entry(At, row); entry; ++entry) {
      columns.push_back(static_cast<int>(entry.row()));
    }
    rows_of[columns].push_back(row);
  }
  std::vector<Block> groups;
  for (auto& [of, equal] : rows_of) groups.push_back({of, std::move(equal), 0, {}});
  return groups;
}

void RowBlocks::Merge(std::vector<Block> groups) {
  const auto before = [this](int v, int w) {
    return position_[static_cast<size_t>(v)] < position_[static_cast<size_t>(w)];
  };
  for (Block& group : groups) std::sort(group.columns.begin(), group.columns.end(), before);
  std::sort(groups.begin(), groups.end(), [&](const Block& a, const Block& b) {
    return std::lexicographical_compare(a.columns.begin(), a.columns.end(), b.columns.begin(),
                                        b.columns.end(), before);
  });
  std::vector<int> joint, best_joint;
  for (Block& group : groups) {
    Index best_gain = 0;
    Block* best = nullptr;
    for (size_t k = blocks_.size() - std::min(kCandidates, blocks_.size()); k < blocks_.size();
         ++k) {
      Block& other = blocks_[k];
      joint.clear();
      std::set_union(group.columns.begin(), group.columns.end(), other.columns.begin(),
                     other.columns.end(), std::back_inserter(joint), before);
      const Index gain = Cost(group.columns.size(), group.rows.size()) +
                         Cost(other.columns.size(), other.rows.size()) -
                         Cost(joint.size(), group.rows.size() + other.rows.size());
      if (gain <= best_gain) continue;
      best_gain = gain;
      best = &other;
      best_joint = joint;
    }
    if (!best) {
      blocks_.push_back(std::move(group));
      continue;
    }
    best->columns = best_joint;
    best->rows.insert(best->rows.end(), group.rows.begin(), group.rows.end());
  }
}

EnvelopeMatrix RowBlocks::MakeGram() const {
  std::vector<int> first(position_.size());
  for (size_t p = 0; p < first.size(); ++p) first[p] = static_cast<int>(p);
  for (const Block& block : blocks_) {
    if (block.columns.empty()) continue;
    const int begin = position_[static_cast<size_t>(block.columns.front())];
    for (const int v : block.columns) {
      int& of = first[static_cast<size_t>(position_[static_cast<size_t>(v)])];
      of = std::min(of, begin);
    }
  }
  return {position_, std::move(first)};
}

void RowBlocks::Times(const Eigen::VectorXd& d, Eigen::ArrayXd* Ad) const {
  Ad->resize(static_cast<Index>(order_.size()));
  Eigen::VectorXd own(widest_);
  for (const Block& block : blocks_) {
    auto part = own.head(block.entries.rows());
    part.setZero();
    for (size_t k = 0; k < block.columns.size(); ++k) {
      part[static_cast<Index>(k)] = d[block.columns[k]];
    }
    Ad->segment(block.first, block.entries.cols()).matrix().noalias() =
        block.entries.transpose() * part;
  }
}

void RowBlocks::AddTransposed(const Eigen::ArrayXd& z, Eigen::VectorXd* sum) const {
  Eigen::VectorXd own(widest_);
  for (const Block& block : blocks_) {
    auto part = own.head(block.entries.rows());
    part.noalias() = block.entries * z.segment(block.first, block.entries.cols()).matrix();
    for (size_t k = 0; k < block.columns.size(); ++k) {
      (*sum)[block.columns[k]] += part[static_cast<Index>(k)];
    }
  }
}

void RowBlocks::AddGram(const Eigen::ArrayXd& theta, EnvelopeMatrix* K) const {
  Eigen::MatrixXd weighted;
  std::vector<int> places;
  for (const Block& block : blocks_) {
    const Index rows = block.entries.cols();
    weighted.noalias() = block.entries * theta.segment(block.first, rows).matrix().asDiagonal();
    places.clear();
    for (const int v : block.columns) places.push_back(position_[static_cast<size_t>(v)]);
    const auto count = static_cast<Index>(places.size());
    for (Index i = 0; i < count; i += kTile) {
      for (Index j = 0; j <= i; j += kTile) {
        const Tile sum = TileOfProduct(weighted, i, block.entries, j);
        for (Index a = i; a < std::min(count, i + kTile); ++a) {
          double* to = K->Row(places[static_cast<size_t>(a)]);
          for (Index b = j; b < std::min(a + 1, j + kTile); ++b) {
            to[places[static_cast<size_t>(b)]] += sum(a - i, b - j);
          }
        }
      }
    }
  }
}

}  // namespace halfstep::opt
