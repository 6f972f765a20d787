#pragma once

#include <array>
#include <cmath>
#include <memory>

#include "wpg/motion/lipm.h"
#include "wpg/motion/motion_model.h"
#include "wpg/motion/unit_time.h"
#include "wpg/robot/gravity.h"

namespace halfstep {

/// A model of a user: the CoM goes by one polynomial from rest to rest while both feet stand, and
/// the ZMP follows from it, p = c − (z_c/g)·c̈. The polynomial, 126x⁵ − 420x⁶ + 540x⁷ − 315x⁸ +
/// 70x⁹, is C⁴ where it meets rest: the ZMP has to be C². A quintic's would jump in its speed.
class PolynomialModel : public MotionModel {
 public:
  explicit PolynomialModel(double com_height) : com_height_(com_height) {}

  Proposal Propose(HalfStepKind kind, const HalfStepShape& shape, double duration) const override {
    return {.com = std::make_shared<Com>(kind, shape, duration),
            .zmp = std::make_shared<Zmp>(kind, shape, duration, com_height_ / kGravity)};
  }
  Eigen::Vector2d ComAcceleration(const WalkJet& jet) const override {
    return Lipm(com_height_).ComAcceleration(jet);
  }
  Eigen::Vector2d ComJerk(const WalkJet& jet) const override {
    return Lipm(com_height_).ComJerk(jet);
  }
  std::vector<std::pair<std::string_view, double>> numbers() const override {
    return {{"polynomial_com_height", com_height_}};
  }

 private:
  // The polynomial on its window of σ: [0, t2] of an up, [t1, 1] of a down half-step.
  class Com : public Profile {
   public:
    Com(HalfStepKind kind, const HalfStepShape& shape, double duration)
        : time_{.duration = duration},
          begin_(kind == HalfStepKind::kUp ? 0.0 : shape.t1()),
          end_(kind == HalfStepKind::kUp ? shape.t2() : 1.0) {}

    ProfileJet At(double tau) const override {
      const double sigma = time_.Of(tau);
      return time_.Jet(
          {.value = D(0, sigma), .s = D(1, sigma), .ss = D(2, sigma), .sss = D(3, sigma)}, sigma);
    }
    ProfileJet ByShape(double HalfStepShape::*number, double tau) const override {
      if (number != &HalfStepShape::shift) return {};
      const double sigma = time_.Of(tau);
      return time_.Slope(
          {.value = DByShift(0, sigma), .s = DByShift(1, sigma), .ss = DByShift(2, sigma)}, 1.0);
    }
    ProfileAccuracy Accuracy(double time) const override {
      return time_.Accuracy(
          {.error = {.value = Error(0), .s = Error(1), .ss = Error(2)},
           .most = {.value = Most(0), .s = Most(1), .ss = Most(2), .sss = Most(3)}},
          time);
    }
    double SecondBound(double, double) const override {
      return time_.Second(kMost[2] / std::pow(end_ - begin_, 2));
    }
    Range ThirdRange(double, double) const override {
      return time_.Third({0.0, kMost[3] / std::pow(end_ - begin_, 3)});
    }
    void AddKnots(std::vector<double>* knots) const override {
      if (begin_ > 0.0) knots->push_back(begin_ * time_.duration);
      knots->push_back(end_ * time_.duration);
    }

   protected:
    // sup of the derivatives of the polynomial by their order, from above.
    static constexpr std::array<double, 5> kMost = {1.0, 2.47, 9.4, 79.0, 625.0};

    // The n-th derivative in σ.
    double D(int n, double sigma) const {
      const double w = end_ - begin_, x = (sigma - begin_) / w;
      if (x <= 0.0 || x >= 1.0) return n == 0 && x >= 1.0 ? 1.0 : 0.0;
      double value = 0.0;
      for (int k = 9; k >= std::max(5, n); --k) {
        double c = std::array{126.0, -420.0, 540.0, -315.0, 70.0}[static_cast<size_t>(k - 5)];
        for (int i = 0; i < n; ++i) c *= k - i;
        value += c * std::pow(x, k - n);
      }
      return value / std::pow(w, n);
    }
    // At least the largest |D(n)|.
    double Most(int n) const {
      double sum = 0.0;
      for (int k = 9; k >= std::max(5, n); --k) {
        double c = std::array{126.0, 420.0, 540.0, 315.0, 70.0}[static_cast<size_t>(k - 5)];
        for (int i = 0; i < n; ++i) c *= k - i;
        sum += c;
      }
      return sum / std::pow(end_ - begin_, n);
    }
    // How far D(n) may be off: its terms by 32 roundings each, σ by 16 where the window's ends are.
    double Error(int n) const { return kRoundoff * (32.0 * Most(n) + 16.0 * Most(n + 1)); }
    // Its derivative with respect to the shift's fraction, which moves the window's inner end out
    // by half of it.
    double DByShift(int n, double sigma) const {
      const double w = end_ - begin_, x = (sigma - begin_) / w;
      const double outward = begin_ > 0.0 ? 1.0 - x : x;
      const double moved = begin_ > 0.0 ? outward : -outward;
      return 0.5 * (D(n + 1, sigma) * moved - n * D(n, sigma) / w);
    }

    UnitTime time_;
    double begin_, end_;
  };

  // p = F − k·F_σσ, k = z_c/(g·T²). The θ of its UnitJet is T itself, so ω is 1.
  class Zmp final : public Com {
   public:
    Zmp(HalfStepKind kind, const HalfStepShape& shape, double duration, double per_acceleration)
        : Com(kind, shape, duration), k_(per_acceleration / (duration * duration)) {
      time_.omega = 1.0;
    }
    ProfileJet At(double tau) const override {
      const double sigma = time_.Of(tau), by_T = 2.0 * k_ / time_.duration;
      const auto p = [&](int n) { return D(n, sigma) - k_ * D(n + 2, sigma); };
      return time_.Jet({.value = p(0),
                        .s = p(1),
                        .ss = p(2),
                        .sss = p(3),
                        .theta = by_T * D(2, sigma),
                        .theta_s = by_T * D(3, sigma),
                        .theta_ss = by_T * D(4, sigma)},
                       sigma);
    }
    ProfileJet ByShape(double HalfStepShape::*number, double tau) const override {
      if (number != &HalfStepShape::shift) return {};
      const double sigma = time_.Of(tau);
      const auto p = [&](int n) { return DByShift(n, sigma) - k_ * DByShift(n + 2, sigma); };
      return time_.Slope({.value = p(0), .s = p(1), .ss = p(2)}, 1.0);
    }
    ProfileAccuracy Accuracy(double time) const override {
      const auto error = [&](int n) { return Error(n) + k_ * Error(n + 2); };
      const auto most = [&](int n) { return Most(n) + k_ * Most(n + 2); };
      return time_.Accuracy(
          {.error = {.value = error(0), .s = error(1), .ss = error(2)},
           .most = {.value = most(0), .s = most(1), .ss = most(2), .sss = most(3)}},
          time);
    }
    double SecondBound(double, double) const override {
      const double w = end_ - begin_;
      return time_.Second(kMost[2] / std::pow(w, 2) + k_ * kMost[4] / std::pow(w, 4));
    }

   private:
    double k_;
  };

  double com_height_;
};

}  // namespace halfstep
