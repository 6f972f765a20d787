#include "wpg/motion/rest_to_rest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "opt/problem/derivative_check.h"
#include "wpg/motion/lipm.h"
#include "wpg/motion/smoothstep.h"

namespace halfstep {
namespace {

// Value and its first two derivatives in σ.
Eigen::Vector3d Jet(const UnitJet& f) { return {f.value, f.s, f.ss}; }

class RestToRestTest : public testing::Test {
 protected:
  double Uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random_);
  }
  // θ from 0.5 to 60 and shifts from 0.01 to 0.5, the ends more often than their share.
  double Theta() { return 0.5 * std::pow(120.0, Clamped()); }
  double Shift() { return 0.01 * std::pow(50.0, Clamped()); }
  // Round bumps, bumps with a flat top, and mixtures, in turn.
  double Ramp() {
    ++draws_;
    if (draws_ % 3 == 0) return 1.0;
    return draws_ % 3 == 1 ? Uniform(0.1, 0.5) : Uniform(0.5, 1.0);
  }
  // Where the bump changes its formula, as a fraction of its length; 1: nowhere.
  static double Knot(double ramp) { return ramp == 1.0 ? 1.0 : std::min(ramp, 0.5); }

 private:
  double Clamped() { return std::clamp(Uniform(-0.1, 1.1), 0.0, 1.0); }
  std::mt19937 random_{3};
  int draws_ = 0;
};

TEST_F(RestToRestTest, SatisfiesTheLipmEverywhere) {
  double worst = 0, worst_slope = 0;
  for (int i = 0; i < 300; ++i) {
    const double theta = Theta();
    const RestToRest shift(theta, Shift(), Ramp());
    for (int k = 0; k < 40; ++k) {
      const double sigma = Uniform(0, 1);
      const UnitJet c = shift.Com(sigma), p = shift.Zmp(sigma);
      // Rounding in the power series grows with θ. T = 3 s and z_c = 0.6 m are θ = 12.
      const double rounding = (theta < 30 ? 1e-13 : 3e-12) * (1 + shift.bump());
      worst = std::max(worst, std::abs(c.value - c.ss / (theta * theta) - p.value) / rounding);
      // Differentiated once: a jet that only fits its value would not.
      const double slope = 30 * theta * rounding + 1e-13 * std::abs(p.s);
      worst_slope = std::max(worst_slope, std::abs(c.s - c.sss / (theta * theta) - p.s) / slope);
    }
  }
  EXPECT_LT(worst, 1.0);
  EXPECT_LT(worst_slope, 1.0);
}

TEST_F(RestToRestTest, BeginsAndEndsAtRestAsALimit) {
  for (int i = 0; i < 300; ++i) {
    const double theta = Theta();
    const RestToRest shift(theta, Shift(), Ramp());
    const double scale = (1 + theta * theta) * (1 + shift.bump());
    for (const bool com : {true, false}) {
      const auto at = [&](double s) { return com ? shift.Com(s) : shift.Zmp(s); };
      EXPECT_EQ(Jet(at(0)), Eigen::Vector3d(0, 0, 0));
      EXPECT_EQ(Jet(at(1)), Eigen::Vector3d(1, 0, 0));
      // The slope near the ends is what their second derivative, 0 there, lets it be.
      const double e = 1e-9;
      EXPECT_LT(std::abs(at(e).value), 1e-12 * scale);
      EXPECT_LT(std::abs(at(1 - e).value - 1), 1e-12 * scale);
      EXPECT_LT(std::abs(at(e).s), 1e-12 * scale);
      EXPECT_LT(std::abs(at(1 - e).s), 1e-12 * scale);
    }
  }
}

TEST_F(RestToRestTest, ValueAndTwoDerivativesAreContinuous) {
  for (int i = 0; i < 300; ++i) {
    const double theta = Theta(), width = Shift();
    const double ramp = Ramp(), knot = std::min(ramp, 0.5);
    const RestToRest shift(theta, width, ramp);
    const double r = 1 / width, first = 0.5 - 0.5 * width;
    // How much the jets change across 2e over the seam, at most: e times the next derivative.
    const double e = 1e-10;
    // Of the shift, 15/8, 10/√3 and 60; of the bump, at most 384 for each order.
    const double b = 384 * shift.bump() / std::pow(first * 2 * knot, 3);
    const Eigen::Vector3d zmp_change(2 * r + b, 6 * r * r + b, 60 * r * r * r + b);
    const double s = theta * theta * (1 + shift.bump());
    const Eigen::Vector3d com_change(s, s, s * (10 * r + theta));
    const double rise = first * knot;
    for (double seam : {0.0, rise, first - rise, first, 0.5, 1 - first, 1 - rise, 1.0}) {
      const Eigen::Vector3d zmp = Jet(shift.Zmp(seam + e)) - Jet(shift.Zmp(seam - e));
      const Eigen::Vector3d com = Jet(shift.Com(seam + e)) - Jet(shift.Com(seam - e));
      for (int d = 0; d < 3; ++d) {
        EXPECT_LT(std::abs(zmp[d]), 2 * e * zmp_change[d] + 1e-12 * (zmp_change[d] + 1))
            << "derivative " << d << " of the ZMP at " << seam;
        EXPECT_LT(std::abs(com[d]), 4 * e * com_change[d] + 1e-11 * (1 + com_change[d]))
            << "derivative " << d << " of the CoM at " << seam;
      }
    }
  }
}

TEST_F(RestToRestTest, IsAntisymmetric) {
  const RestToRest shift(7.0, 0.05);
  for (int i = 0; i < 100; ++i) {
    const double sigma = Uniform(0, 1);
    EXPECT_NEAR(shift.Com(sigma).value + shift.Com(1 - sigma).value, 1, 1e-14);
    EXPECT_NEAR(shift.Zmp(sigma).value + shift.Zmp(1 - sigma).value, 1, 1e-14);
    EXPECT_NEAR(shift.Com(sigma).s, shift.Com(1 - sigma).s, 1e-13);
  }
}

// How large the bump is (wpg/README.md): about 18, 9 and 5 % for z_c = 0.8 m.
TEST_F(RestToRestTest, BumpOfThreeDurations) {
  const double omega = Lipm(0.8).omega();
  for (const auto& [duration, percent] : {std::pair{1.6, 18}, {2.0, 9}, {2.4, 5}}) {
    const RestToRest shift(omega * duration, 0.1 / duration);
    EXPECT_NEAR(100 * shift.bump(), percent, 0.6) << duration;
    double least = 0, most = 0;
    for (int k = 0; k <= 10000; ++k) {
      const double p = shift.Zmp(k / 10000.0).value;
      least = std::min(least, p), most = std::max(most, p);
    }
    EXPECT_NEAR(-least, shift.bump(), 1e-6);
    EXPECT_NEAR(most - 1, shift.bump(), 1e-6);
  }
}

// A flat top pushes as much with less: the bump goes less far.
TEST_F(RestToRestTest, AFlatTopIsConstantAndLowerThanARoundOne) {
  const RestToRest round(5.0, 0.05), flat(5.0, 0.05, 0.2);
  EXPECT_LT(flat.bump(), 0.75 * round.bump());
  const double first = 0.475;
  for (const double x : {0.2, 0.35, 0.5, 0.8}) {
    EXPECT_NEAR(flat.Zmp(x * first).value, -flat.bump(), 1e-14);
    EXPECT_NEAR(flat.Zmp(x * first).s, 0.0, 1e-12);
  }
  EXPECT_GT(flat.Zmp(0.19 * first).value, -flat.bump());
}

TEST_F(RestToRestTest, DerivativesInSigmaAndTheta) {
  for (int i = 0; i < 300; ++i) {
    // Beyond, the differences are worth less than the derivatives.
    const double theta = std::clamp(Theta(), 0.51, 30.0), width = Shift();
    const double ramp = Ramp();
    const RestToRest shift(theta, width, ramp);
    const double x[] = {Uniform(0.01, 0.99), theta};
    const double from_end = 0.5 - std::abs(x[0] - 0.5), first = 0.5 - 0.5 * width;
    const double step = std::min(1e-3 * width, 1e-4);
    bool near_knot = false;
    for (double knot : {first, first * Knot(ramp), first * (1 - Knot(ramp))}) {
      near_knot = near_knot || std::abs(from_end - knot) < 3 * step;
    }
    if (near_knot) continue;
    for (const bool com : {true, false}) {
      // Scaled by powers of the shortest piece, so that derivatives of all orders count alike.
      const double w = std::min(width, first * Knot(ramp));
      const auto function = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
        const RestToRest moved(x[1] + y[1], width, ramp);
        const UnitJet f = com ? moved.Com(x[0] + w * y[0]) : moved.Zmp(x[0] + w * y[0]);
        return Eigen::Vector3d(f.value, w * f.s, w * w * f.ss);
      };
      const UnitJet f = com ? shift.Com(x[0]) : shift.Zmp(x[0]);
      Eigen::MatrixXd jacobian(3, 2);
      jacobian << w * f.s, f.theta, w * w * f.ss, w * f.theta_s, w * w * w * f.sss,
          w * w * f.theta_ss;
      const DerivativeReport report =
          CheckJacobian(function, Eigen::Vector2d::Zero(), jacobian, 1e-3);
      EXPECT_TRUE(report.Passed(1e-8))
          << (com ? "com, theta " : "zmp, theta ") << x[1] << ", shift " << width << ", sigma "
          << x[0] << ": " << report.Describe();
    }
  }
}

// Against central differences, which a slope that is a thousandth off does not pass.
TEST_F(RestToRestTest, DerivativesInShiftAndBumpRamp) {
  int looked_at = 0;
  for (int i = 0; i < 600; ++i) {
    const double theta = std::clamp(Theta(), 0.51, 20.0), width = std::clamp(Shift(), 0.02, 0.45);
    const double ramp = std::clamp(Ramp(), 0.11, 0.999), first = 0.5 - 0.5 * width;
    if (std::abs(ramp - 0.5) < 1e-3) continue;  // a kink
    const double sigma = Uniform(0.01, 0.99), from_end = 0.5 - std::abs(sigma - 0.5);
    bool near_knot = false;
    for (double knot : {first, first * Knot(ramp), first * (1 - Knot(ramp))}) {
      near_knot = near_knot || std::abs(from_end - knot) < 1e-3;
    }
    if (near_knot) continue;
    ++looked_at;
    const RestToRest profile(theta, width, ramp);
    for (const bool com : {true, false}) {
      const double w = std::min(width, first * Knot(ramp));  // so that all orders count alike
      const auto jet = [&](const UnitJet& f) {
        return Eigen::Vector3d(f.value, w * f.s, w * w * f.ss);
      };
      const auto function = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
        const RestToRest moved(theta, width + w * y[0], ramp + ramp * y[1]);
        return jet(com ? moved.Com(sigma) : moved.Zmp(sigma));
      };
      Eigen::MatrixXd jacobian(3, 2);
      jacobian.col(0) = w * jet(com ? profile.ComByShift(sigma) : profile.ZmpByShift(sigma));
      jacobian.col(1) =
          ramp * jet(com ? profile.ComByBumpRamp(sigma) : profile.ZmpByBumpRamp(sigma));
      const DerivativeReport report =
          CheckJacobian(function, Eigen::Vector2d::Zero(), jacobian, 1e-4);
      EXPECT_TRUE(report.Passed(1e-6))
          << (com ? "com, theta " : "zmp, theta ") << theta << ", shift " << width << ", ramp "
          << ramp << ", sigma " << sigma << ": " << report.Describe();
      const double largest = jacobian.cwiseAbs().maxCoeff();
      if (largest < 1e-2) continue;
      EXPECT_FALSE(
          CheckJacobian(function, Eigen::Vector2d::Zero(), 1.001 * jacobian, 1e-4).Passed(1e-6));
    }
  }
  EXPECT_GT(looked_at, 300);
}

TEST_F(RestToRestTest, BumpsGoOverIntoTheRoundOneAndIntoThatWithoutATop) {
  const RestToRest round(6.0, 0.05), nearly(6.0, 0.05, 1 - 1e-9);
  const RestToRest half(6.0, 0.05, 0.5), above(6.0, 0.05, 0.5 + 1e-9);
  for (int k = 0; k <= 100; ++k) {
    const double sigma = 0.01 * k;
    EXPECT_NEAR(round.Com(sigma).value, nearly.Com(sigma).value, 1e-8);
    EXPECT_NEAR(round.Zmp(sigma).ss, nearly.Zmp(sigma).ss, 1e-5);
    EXPECT_NEAR(half.Com(sigma).value, above.Com(sigma).value, 1e-8);
    EXPECT_NEAR(half.Zmp(sigma).ss, above.Zmp(sigma).ss, 1e-5);
  }
}

TEST_F(RestToRestTest, RefusesWhatItCannotSum) {
  EXPECT_THROW(RestToRest(0.4, 0.1), std::logic_error);
  EXPECT_THROW(RestToRest(61, 0.1), std::logic_error);
  EXPECT_THROW(RestToRest(7, 0.009), std::logic_error);
  EXPECT_THROW(RestToRest(7, 0.6), std::logic_error);
  EXPECT_THROW(RestToRest(7, 0.1, 0.09), std::logic_error);
  EXPECT_THROW(RestToRest(7, 0.1, 1.01), std::logic_error);
  EXPECT_THROW(RestToRest(std::numeric_limits<double>::quiet_NaN(), 0.1), std::logic_error);
}

TEST(SmoothstepTest, IsC2FromZeroToOneAndAntisymmetric) {
  const Smoothstep step{0.2, 0.7};
  for (double sigma : {-1.0, 0.0, 0.2}) EXPECT_EQ(Jet(step.At(sigma)), Eigen::Vector3d(0, 0, 0));
  for (double sigma : {0.7, 1.0, 2.0}) EXPECT_EQ(Jet(step.At(sigma)), Eigen::Vector3d(1, 0, 0));
  const double e = 1e-7;  // jets change by e times the next derivative, at most 60/0.5³ here
  EXPECT_LT((Jet(step.At(0.2 + e)) - Eigen::Vector3d(0, 0, 0)).norm(), 500 * e);
  EXPECT_LT((Jet(step.At(0.7 - e)) - Eigen::Vector3d(1, 0, 0)).norm(), 500 * e);
  EXPECT_DOUBLE_EQ(step.At(0.45).value, 0.5);
  for (int k = 1; k < 100; ++k) {
    const double sigma = 0.2 + 0.005 * k;
    EXPECT_NEAR(step.At(sigma).value + step.At(0.9 - sigma).value, 1, 1e-15);
    EXPECT_LT(step.At(sigma - 0.005).value, step.At(sigma).value);
    const auto function = [&](const Eigen::VectorXd& s) -> Eigen::VectorXd {
      return Jet(step.At(s[0]));
    };
    const UnitJet f = step.At(sigma);
    const DerivativeReport report = CheckJacobian(function, Eigen::VectorXd::Constant(1, sigma),
                                                  Eigen::Vector3d(f.s, f.ss, f.sss), 1e-4);
    EXPECT_TRUE(report.Passed(1e-9)) << report.Describe();
  }
}

// A model solves each motion once in a row, and whatever it solved before changes nothing.
TEST(LipmTest, WhatWasAskedBeforeChangesNothing) {
  HalfStepShape round, flat;
  flat.bump_ramp = 0.3;
  HalfStepShape shifted = round;
  shifted.shift *= 1.1;
  const auto values = [](const Lipm& model, const HalfStepShape& shape, double duration) {
    const MotionModel::Proposal motion = model.Propose(HalfStepKind::kUp, shape, duration);
    std::vector<double> all;
    for (double part = 0.05; part < 1.0; part += 0.1) {
      const ProfileJet com = motion.com->At(part * duration), zmp = motion.zmp->At(part * duration);
      all.insert(all.end(), {com.value, com.first, com.second, zmp.value, zmp.first});
    }
    return all;
  };
  const Lipm low(0.6), high(0.8);
  const std::vector<double> first = values(high, round, 1.6);
  for (const auto& other : {values(high, round, 1.7), values(high, flat, 1.6),
                            values(high, shifted, 1.6), values(low, round, 1.6)}) {
    EXPECT_NE(other, first);
    EXPECT_EQ(values(high, round, 1.6), first);
  }
}

}  // namespace
}  // namespace halfstep
