#include "opt/solvers/elastic_subproblem.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace halfstep::opt {
namespace {

using Array = Eigen::ArrayXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr int kMostIterations = 60;
constexpr double kTolerance = 1e-9;           // of the first complementarity
constexpr double kFractionToBoundary = 0.99;  // of the way to the boundary that a step goes at most

// With s = c + A d + u, where u ≥ 0 is what a row lacks, z ∈ [0, ν] the rows' duals and y those of
// the bounds, the central path is
//     g + B d − Aᵀz − y_l + y_u = 0,   s z = u (ν − z) = (d − l) y_l = (h − d) y_u = μ.
class InteriorPoint {
 public:
  explicit InteriorPoint(const ElasticSubproblem& problem)
      : p_(problem), nu_(problem.penalty.array()), At_(problem.A.transpose()) {
    d_ = 0.5 * (p_.lower + p_.upper);
    const double width = (p_.upper - p_.lower).maxCoeff();
    mu_ = std::max(0.1 * p_.g.lpNorm<Eigen::Infinity>() * width, 1e-12);
    to_lower_ = d_ - p_.lower;
    to_upper_ = p_.upper - d_.matrix();
    y_lower_ = mu_ / to_lower_;
    y_upper_ = mu_ / to_upper_;
    // The point of the central path for this d.
    const Array v = p_.c + p_.A * d_;
    z_ = 2.0 * mu_ * nu_ / (nu_ * v + 2.0 * mu_ + ((nu_ * v).square() + 4.0 * mu_ * mu_).sqrt());
    z_ = z_.max(1e-12 * nu_).min((1.0 - 1e-12) * nu_);
    s_ = (mu_ / z_).max(v + 1e-300);
    u_ = s_ - v;
    // Rounding may have left nothing of the smaller one.
    const Array least = mu_ / (nu_ - z_);
    u_ = u_.max(1e-3 * least);
    s_ = v + u_;
  }

  ElasticStep Run() {
    const double first = mu_;
    for (int i = 0; i < kMostIterations; ++i) {
      const VectorXd residual = Residual();
      const double dual_error = residual.lpNorm<Eigen::Infinity>();
      if (mu_ <= kTolerance * first && dual_error <= 1e-7 * (1.0 + p_.g.lpNorm<Eigen::Infinity>()))
        break;
      if (!Factorize()) break;
      const Move affine = Direction(residual, 0.0, nullptr);
      const double far = StepLimit(affine);
      const double ratio = Complementarity(affine, far) / mu_;
      const double target = mu_ * std::max(ratio * ratio * ratio, 1e-6);
      const Move move = Direction(residual, target, &affine);
      if (!move.d.allFinite()) break;
      Advance(move, std::min(1.0, kFractionToBoundary * StepLimit(move)));
      mu_ = Complementarity(move, 0.0);
    }
    return {d_.cwiseMax(p_.lower).cwiseMin(p_.upper), z_.matrix(), algebra_};
  }

 private:
  struct Move {
    VectorXd d;
    Array s, u, z, y_lower, y_upper;
  };

  VectorXd Residual() const {
    return p_.g + p_.hessian.Times(d_) - At_ * z_.matrix() - y_lower_.matrix() + y_upper_.matrix();
  }

  bool Factorize() {
    stiffness_ = s_ + z_ * u_ / (nu_ - z_);
    if (K_.size() == 0) {
      MakePattern();
      factors_.analyzePattern(K_);
    }
    Assemble(z_ / stiffness_, y_lower_ / to_lower_ + y_upper_ / to_upper_ + p_.hessian.sigma());
    factors_.factorize(K_);
    algebra_ += factors_.matrixL().nestedExpression().nonZeros();
    if (factors_.info() != Eigen::Success) return false;
    if (p_.hessian.empty()) return true;
    KU_ = factors_.solve(p_.hessian.U());
    small_.compute(p_.hessian.C() - p_.hessian.U().transpose() * KU_);
    return true;
  }

  // Calls add(j, i, a_ij) for the entries of AᵀA's column b on and below the diagonal, once for
  // each row i of A that makes one.
  template <typename Add>
  void ForColumn(Eigen::Index b, const Add& add) const {
    for (SparseMatrix::InnerIterator of_b(p_.A, b); of_b; ++of_b) {
      for (SparseMatrix::InnerIterator entry(At_, of_b.row()); entry; ++entry) {
        if (entry.row() >= b) add(entry.row(), of_b.row(), of_b.value() * entry.value());
      }
    }
  }

  // Where K_, the lower triangle of σI + AᵀΘA + the bounds' diagonal, has entries.
  void MakePattern() {
    const Eigen::Index n = d_.size();
    K_.resize(n, n);
    std::vector<Eigen::Index> rows;
    // The last column that has an entry in each row.
    Eigen::VectorX<Eigen::Index> met = Eigen::VectorX<Eigen::Index>::Constant(n, -1);
    for (Eigen::Index b = 0; b < n; ++b) {
      rows.assign(1, b);
      met[b] = b;
      ForColumn(b, [&](Eigen::Index j, Eigen::Index, double) {
        if (std::exchange(met[j], b) != b) rows.push_back(j);
      });
      std::sort(rows.begin(), rows.end());
      K_.startVec(b);
      for (const Eigen::Index j : rows) K_.insertBack(j, b) = 0.0;
    }
    K_.finalize();
  }

  void Assemble(const Array& theta, const Array& diagonal) {
    VectorXd column = VectorXd::Zero(d_.size());
    for (Eigen::Index b = 0; b < d_.size(); ++b) {
      ForColumn(b, [&](Eigen::Index j, Eigen::Index i, double product) {
        column[j] += theta[i] * product;
      });
      column[b] += diagonal[b];
      for (SparseMatrix::InnerIterator entry(K_, b); entry; ++entry) {
        entry.valueRef() = std::exchange(column[entry.row()], 0.0);
      }
    }
  }

  // Newton's step to complementarities `mu`, with the products of `affine` as second order terms.
  Move Direction(const VectorXd& residual, double mu, const Move* affine) const {
    Array rs = mu - s_ * z_, ru = mu - u_ * (nu_ - z_);
    Array rl = mu - to_lower_ * y_lower_, rh = mu - to_upper_ * y_upper_;
    if (affine) {
      rs -= affine->s * affine->z;
      ru += affine->u * affine->z;
      rl -= affine->d.array() * affine->y_lower;
      rh += affine->d.array() * affine->y_upper;
    }
    const Array w = nu_ - z_;
    const Array rho = (rs - z_ * ru / w) / stiffness_;
    Move move;
    const VectorXd right =
        -residual + At_ * rho.matrix() + (rl / to_lower_ - rh / to_upper_).matrix();
    move.d = factors_.solve(right);
    if (!p_.hessian.empty()) {
      move.d += KU_ * small_.solve(p_.hessian.U().transpose() * move.d);
    }
    const Array Ad = p_.A * move.d;
    move.z = rho - z_ / stiffness_ * Ad;
    move.u = (ru + u_ * move.z) / w;
    move.s = Ad + move.u;
    move.y_lower = (rl - y_lower_ * move.d.array()) / to_lower_;
    move.y_upper = (rh + y_upper_ * move.d.array()) / to_upper_;
    return move;
  }

  double StepLimit(const Move& m) const {
    double limit = 1.0;
    const auto keep = [&limit](const Array& value, const Array& change) {
      for (Eigen::Index i = 0; i < value.size(); ++i) {
        if (change[i] < 0.0) limit = std::min(limit, -value[i] / change[i]);
      }
    };
    keep(s_, m.s);
    keep(u_, m.u);
    keep(z_, m.z);
    keep(nu_ - z_, -m.z);
    keep(to_lower_, m.d.array());
    keep(to_upper_, -m.d.array());
    keep(y_lower_, m.y_lower);
    keep(y_upper_, m.y_upper);
    return limit;
  }

  // Mean of the products after a step of α.
  double Complementarity(const Move& m, double alpha) const {
    const auto product = [alpha](const Array& a, const Array& da, const Array& b, const Array& db) {
      return ((a + alpha * da) * (b + alpha * db)).sum();
    };
    const Array d = m.d.array();
    const double sum = product(s_, m.s, z_, m.z) + product(u_, m.u, nu_ - z_, -m.z) +
                       product(to_lower_, d, y_lower_, m.y_lower) +
                       product(to_upper_, -d, y_upper_, m.y_upper);
    return sum / static_cast<double>(2 * s_.size() + 2 * d_.size());
  }

  void Advance(const Move& m, double alpha) {
    d_ += alpha * m.d;
    s_ += alpha * m.s;
    u_ += alpha * m.u;
    z_ += alpha * m.z;
    y_lower_ += alpha * m.y_lower;
    y_upper_ += alpha * m.y_upper;
    to_lower_ += alpha * m.d.array();
    to_upper_ -= alpha * m.d.array();
  }

  const ElasticSubproblem& p_;
  Array nu_;
  double mu_;
  SparseMatrix At_;
  VectorXd d_;
  Array s_, u_, z_, to_lower_, to_upper_, y_lower_, y_upper_;
  Array stiffness_;  // s + z u/(ν − z): Δz = … − z/stiffness · AΔd
  Eigen::SimplicialLDLT<SparseMatrix> factors_;
  SparseMatrix K_;
  long algebra_ = 0;
  Eigen::MatrixXd KU_;
  Eigen::PartialPivLU<Eigen::MatrixXd> small_;
};

}  // namespace

ElasticStep Solve(const ElasticSubproblem& problem) { return InteriorPoint(problem).Run(); }

double TotalViolation(const VectorXd& v) { return (-v).cwiseMax(0.0).sum(); }

}  // namespace halfstep::opt
