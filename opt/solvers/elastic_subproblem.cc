#include "opt/solvers/elastic_subproblem.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "opt/solvers/envelope_matrix.h"
#include "opt/solvers/row_blocks.h"

namespace halfstep::opt {
namespace {

using Array = Eigen::ArrayXd;
using Eigen::VectorXd;

constexpr int kMostIterations = 60;
constexpr double kTolerance = 1e-10;  // of ‖g‖∞ times the largest width: complementarity at the end
constexpr double kFractionToBoundary = 0.99;  // of the way to the boundary that a step goes at most

// The rows that a step within the bounds can violate.
std::vector<int> Reached(const ElasticSubproblem& p) {
  const VectorXd reach = p.A.cwiseAbs() * p.lower.cwiseAbs().cwiseMax(p.upper.cwiseAbs());
  std::vector<int> rows;
  for (Eigen::Index i = 0; i < reach.size(); ++i) {
    if (p.c[i] < reach[i] || p.c[i] < 0.0) rows.push_back(static_cast<int>(i));
  }
  return rows;
}

// With s = c + A d + u, where u ≥ 0 is what a row lacks, z ∈ [0, ν] the rows' duals and y those of
// the bounds, the central path is
//     g + B d − Aᵀz − y_l + y_u = 0,   s z = u (ν − z) = (d − l) y_l = (h − d) y_u = μ.
class InteriorPoint {
 public:
  explicit InteriorPoint(const ElasticSubproblem& problem)
      : p_(problem),
        A_(problem.A, Reached(problem)),
        K_(A_.MakeGram()),
        nu_(Ordered(problem.penalty)) {
    d_ = 0.5 * (p_.lower + p_.upper);
    to_lower_ = d_ - p_.lower;
    to_upper_ = p_.upper - d_.matrix();
    const double width = (p_.upper - p_.lower).maxCoeff();
    first_ = std::max(p_.g.lpNorm<Eigen::Infinity>() * width, 1e-11);
    // The rows' point of the central path for this d.
    Array v;
    A_.Times(d_, &v);
    v += Ordered(p_.c);
    z_ = 2.0 * first_ * nu_ /
         (nu_ * v + 2.0 * first_ + ((nu_ * v).square() + 4.0 * first_ * first_).sqrt());
    z_ = z_.max(1e-12 * nu_).min((1.0 - 1e-12) * nu_);
    s_ = (first_ / z_).max(v + 1e-300);
    u_ = s_ - v;
    // Rounding may have left nothing of the smaller one.
    const Array least = first_ / (nu_ - z_);
    u_ = u_.max(1e-3 * least);
    s_ = v + u_;
    // The bounds' multipliers make up for what the rows' leave of the gradient: no residual.
    y_lower_ = y_upper_ = Array::Zero(d_.size());
    const Array rest = Residual(p_.hessian.Times(d_)).array(), least_y = first_ / to_lower_;
    y_lower_ = least_y + rest.max(0.0);
    y_upper_ = least_y + (-rest).max(0.0);
    mu_ = ((s_ * z_).sum() + (u_ * (nu_ - z_)).sum() + (to_lower_ * y_lower_).sum() +
           (to_upper_ * y_upper_).sum()) /
          Products();
  }

  ElasticStep Run() {
    double gap = 0.0;
    for (int i = 0; i < kMostIterations; ++i) {
      const VectorXd curved = p_.hessian.Times(d_), residual = Residual(curved);
      gap = Gap(residual);
      const double dual_error = residual.lpNorm<Eigen::Infinity>();
      if (gap <= p_.gap * Saved(curved)) break;
      if (mu_ <= kTolerance * first_ && dual_error <= 1e-7 * (1.0 + p_.g.lpNorm<Eigen::Infinity>()))
        break;
      if (!Factorize()) break;
      const Move affine = Direction(residual, 0.0, nullptr);
      const double ratio = Complementarity(affine, Limit(affine, 1.0)) / mu_;
      const double target = mu_ * std::max(ratio * ratio * ratio, 1e-6);
      const Move move = Direction(residual, target, &affine);
      if (!move.d.allFinite()) break;
      const Lengths lengths = Limit(move, kFractionToBoundary);
      mu_ = Complementarity(move, lengths);
      Advance(move, lengths);
    }
    VectorXd duals = VectorXd::Zero(p_.c.size());
    for (Eigen::Index k = 0; k < z_.size(); ++k) duals[RowAt(k)] = z_[k];
    return {d_.cwiseMax(p_.lower).cwiseMin(p_.upper), duals, gap, algebra_};
  }

 private:
  struct Move {
    VectorXd d;
    Array s, u, z, y_lower, y_upper;
  };
  // How far a step goes: d, s and u, and the multipliers z and y.
  struct Lengths {
    double primal, dual;
  };

  int RowAt(Eigen::Index k) const { return A_.order()[static_cast<size_t>(k)]; }

  // Of the rows of the problem, those of A_.
  Array Ordered(const VectorXd& of_rows) const {
    Array ordered(static_cast<Eigen::Index>(A_.order().size()));
    for (Eigen::Index k = 0; k < ordered.size(); ++k) ordered[k] = of_rows[RowAt(k)];
    return ordered;
  }

  // `curved`: B d.
  VectorXd Residual(const VectorXd& curved) const {
    VectorXd residual = p_.g + curved - y_lower_.matrix() + y_upper_.matrix();
    A_.AddTransposed(-z_, &residual);
    return residual;
  }

  double Products() const { return static_cast<double>(2 * s_.size() + 2 * d_.size()); }

  // What the cost at d exceeds the least one by, at most: z and y bound the cost of any d' within
  // the bounds by that of d less the products, up to the residual times d' − d.
  double Gap(const VectorXd& residual) const {
    return Products() * mu_ + residual.cwiseAbs().dot(p_.upper - p_.lower);
  }

  // How much less d costs than 0.
  double Saved(const VectorXd& curved) const {
    return (p_.penalty.array() * (-p_.c.array()).max(0.0)).sum() -
           (nu_ * (u_ - s_).max(0.0)).sum() - p_.g.dot(d_) - 0.5 * d_.dot(curved);
  }

  bool Factorize() {
    stiffness_ = s_ + z_ * u_ / (nu_ - z_);
    K_.SetZero();
    A_.AddGram(z_ / stiffness_, &K_);
    K_.AddDiagonal(y_lower_ / to_lower_ + y_upper_ / to_upper_ + p_.hessian.sigma());
    algebra_ += A_.multiplications() + K_.multiplications();
    if (!K_.Factorize()) return false;
    if (p_.hessian.empty()) return true;
    KU_.resize(d_.size(), p_.hessian.U().cols());
    for (Eigen::Index k = 0; k < KU_.cols(); ++k) KU_.col(k) = K_.Solve(p_.hessian.U().col(k));
    small_.compute(p_.hessian.C() - p_.hessian.U().transpose() * KU_);
    return true;
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
    VectorXd right = -residual + (rl / to_lower_ - rh / to_upper_).matrix();
    A_.AddTransposed(rho, &right);
    move.d = K_.Solve(right);
    if (!p_.hessian.empty()) {
      move.d += KU_ * small_.solve(p_.hessian.U().transpose() * move.d);
    }
    Array Ad;
    A_.Times(move.d, &Ad);
    move.z = rho - z_ / stiffness_ * Ad;
    move.u = (ru + u_ * move.z) / w;
    move.s = Ad + move.u;
    move.y_lower = (rl - y_lower_ * move.d.array()) / to_lower_;
    move.y_upper = (rh + y_upper_ * move.d.array()) / to_upper_;
    return move;
  }

  // `fraction` of the way to the boundary, at most the whole step. A curved cost binds multipliers
  // to d, and both go equally far.
  Lengths Limit(const Move& m, double fraction) const {
    const auto decrease = [](const Array& value, const auto& of) {
      return value.size() > 0 ? (of / value).maxCoeff() : 0.0;
    };
    const double primal =
        std::max({decrease(s_, -m.s), decrease(u_, -m.u), decrease(to_lower_, -m.d.array()),
                  decrease(to_upper_, m.d.array())});
    const double dual = std::max({decrease(z_, -m.z), decrease(nu_ - z_, m.z),
                                  decrease(y_lower_, -m.y_lower), decrease(y_upper_, -m.y_upper)});
    const double both = std::max(primal, dual);
    const bool curved = p_.hessian.sigma() > 0.0;
    return {fraction / std::max(fraction, curved ? both : primal),
            fraction / std::max(fraction, curved ? both : dual)};
  }

  // Mean of the products after a step.
  double Complementarity(const Move& m, const Lengths& by) const {
    const auto product = [&by](const Array& a, const auto& da, const auto& b, const auto& db) {
      return ((a + by.primal * da) * (b + by.dual * db)).sum();
    };
    const auto d = m.d.array();
    const double sum = product(s_, m.s, z_, m.z) + product(u_, m.u, nu_ - z_, -m.z) +
                       product(to_lower_, d, y_lower_, m.y_lower) +
                       product(to_upper_, -d, y_upper_, m.y_upper);
    return sum / Products();
  }

  void Advance(const Move& m, const Lengths& by) {
    d_ += by.primal * m.d;
    s_ += by.primal * m.s;
    u_ += by.primal * m.u;
    to_lower_ += by.primal * m.d.array();
    to_upper_ -= by.primal * m.d.array();
    z_ += by.dual * m.z;
    y_lower_ += by.dual * m.y_lower;
    y_upper_ += by.dual * m.y_upper;
  }

  const ElasticSubproblem& p_;
  const RowBlocks A_;
  EnvelopeMatrix K_;  // σI + AᵀΘA + the bounds' diagonal, or its factor
  Array nu_;
  double mu_, first_;  // mean of the products; μ where it begins
  VectorXd d_;
  Array s_, u_, z_, to_lower_, to_upper_, y_lower_, y_upper_;
  Array stiffness_;  // s + z u/(ν − z): Δz = … − z/stiffness · AΔd
  long algebra_ = 0;
  Eigen::MatrixXd KU_;
  Eigen::PartialPivLU<Eigen::MatrixXd> small_;
};

}  // namespace

ElasticStep Solve(const ElasticSubproblem& problem) { return InteriorPoint(problem).Run(); }

double TotalViolation(const VectorXd& v) { return (-v).cwiseMax(0.0).sum(); }

}  // namespace halfstep::opt
