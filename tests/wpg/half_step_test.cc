#include "wpg/motion/half_step_tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "opt/problem/derivative_check.h"
#include "wpg/motion/lipm.h"
#include "wpg/motion/rest_to_rest.h"

namespace halfstep {
namespace {

constexpr HalfStepKind kKinds[] = {HalfStepKind::kUp, HalfStepKind::kDown};

class HalfStepTest : public testing::Test {
 protected:
  double Uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random_);
  }
  HalfStepShape Shape() {
    return {.shift = Uniform(0.03, 0.4),
            .foot_delay = Uniform(0.0, 0.2),
            .bump_ramp = Bump(),
            .foot_ramp = Uniform(0, 1) < 0.5 ? 0.5 : Uniform(0.1, 0.5),
            .lift_share = Uniform(0, 1) < 0.5 ? 1.0 : Uniform(0.2, 1.0),
            .support_point = Uniform(-0.03, 0.06)};
  }
  double Bump() { return Uniform(0, 1) < 0.5 ? 1.0 : Uniform(0.1, 1.0); }
  HalfStep Random() {
    HalfStep half_step;
    half_step.support = Uniform(0, 1) < 0.5 ? Side::kLeft : Side::kRight;
    half_step.kind = Uniform(0, 1) < 0.5 ? HalfStepKind::kUp : HalfStepKind::kDown;
    const double x = Uniform(-0.3, 0.3), y = Sign(half_step.swing()) * Uniform(0.16, 0.3);
    half_step.X_SF = Foothold::Level({x, y, Uniform(-0.5, 0.5)});
    half_step.duration = Uniform(1.0, 3.0);
    half_step.via_height = Uniform(0.05, 0.25);
    half_step.via_lateral = Uniform(0.19, 0.24);
    half_step.shape = Shape();
    return half_step;
  }
  // With the swing foot up to 0.2 m lower, or 4 cm higher.
  HalfStep RandomOnLevels() {
    HalfStep half_step = Random();
    half_step.X_SF.height = Uniform(-0.2, 0.04);
    half_step.shape.rise_begin = Uniform(0.0, 0.75);
    half_step.shape.rise_end = Uniform(0.85, 1.0);
    half_step.shape.crouch = Uniform(0.0, 0.1);
    return half_step;
  }
  Lipm RandomLipm() { return Lipm(Uniform(0.6, 1.0)); }

 private:
  std::mt19937 random_{4};
};

// Of each profile (value, first, second).
Eigen::VectorXd Stacked(const ProfileJets& jets) {
  Eigen::VectorXd all(3 * kNumProfiles);
  int i = 0;
  for (const ProfileJet& p : jets) {
    all.segment<3>(i) << p.value, p.first, p.second;
    i += 3;
  }
  return all;
}

// Their derivatives in τ and in T.
Eigen::MatrixXd Derivatives(const ProfileJets& jets) {
  Eigen::MatrixXd all(3 * kNumProfiles, 2);
  int i = 0;
  for (const ProfileJet& p : jets) {
    all.block<3, 1>(i, 0) << p.first, p.second, p.third;
    all.block<3, 1>(i, 1) << p.value_T, p.first_T, p.second_T;
    i += 3;
  }
  return all;
}

TEST_F(HalfStepTest, DerivativesInTimeAndDuration) {
  double worst = 0;
  int checked = 0;
  for (int i = 0; i < 400; ++i) {
    const HalfStep h = i % 2 == 0 ? Random() : RandomOnLevels();
    const Lipm lipm = RandomLipm();
    const HalfStepTracks tracks(h, lipm);
    const double tau = Uniform(0, h.duration);
    bool near_knot = false;
    std::vector<double> knots = tracks.Knots();
    knots.push_back(0.0);
    for (double knot : knots) {
      near_knot = near_knot || std::abs(knot - tau) < 5e-4;
    }
    if (near_knot) continue;
    ++checked;
    const auto function = [&](const Eigen::VectorXd& d) {
      HalfStep longer = h;
      longer.duration += d[1];
      return Stacked(HalfStepTracks(longer, lipm).Profiles(tau + d[0]));
    };
    const Eigen::MatrixXd jacobian = Derivatives(tracks.Profiles(tau));
    const DerivativeReport report = CheckJacobian(function, Eigen::Vector2d::Zero(), jacobian);
    worst = std::max(worst, report.worst_error);
    EXPECT_TRUE(report.Passed(1e-6)) << "tau " << tau << " of " << h.duration << ", shift "
                                     << h.shape.shift << ": " << report.Describe();
  }
  EXPECT_GT(checked, 350);
  EXPECT_LT(worst, 1e-7);
}

TEST_F(HalfStepTest, OnePercentOrASignInOneDerivativeIsCaught) {
  HalfStep h;
  h.X_SF = Foothold::Level({0.2, -0.21, 0.2});
  const HalfStepTracks tracks(h, Lipm());
  const double tau = 1.5;  // every profile but the ZMP's second rest moves
  const auto function = [&](const Eigen::VectorXd& d) {
    HalfStep longer = h;
    longer.duration += d[1];
    return Stacked(HalfStepTracks(longer, Lipm()).Profiles(tau + d[0]));
  };
  const Eigen::MatrixXd jacobian = Derivatives(tracks.Profiles(tau));
  ASSERT_TRUE(CheckJacobian(function, Eigen::Vector2d::Zero(), jacobian).Passed(1e-6));
  for (int i = 0; i < 15; ++i) {
    for (int j = 0; j < 2; ++j) {
      if (std::abs(jacobian(i, j)) < 1e-2) continue;
      for (double factor : {1.01, -1.0}) {
        Eigen::MatrixXd wrong = jacobian;
        wrong(i, j) *= factor;
        const auto report = CheckJacobian(function, Eigen::Vector2d::Zero(), wrong);
        EXPECT_FALSE(report.Passed(1e-6)) << report.Describe();
        EXPECT_EQ(report.row, i);
        EXPECT_EQ(report.column, j);
      }
    }
  }
}

TEST_F(HalfStepTest, RestsAtBothEnds) {
  for (int i = 0; i < 300; ++i) {
    const HalfStep h = Random();
    const HalfStepTracks tracks(h, RandomLipm());
    for (double end : {0.0, 1.0}) {
      // At the end itself, beyond it, and a microsecond inside.
      const double inside = end == 0.0 ? 1e-9 : h.duration - 1e-9;
      for (double tau : {end * h.duration, 3 * end * h.duration - h.duration, inside}) {
        const WalkJet x = tracks.At(tau);
        const WalkState expected = end == 0.0 ? h.Start() : h.End();
        EXPECT_LT((x.value - expected).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_LT(std::abs(x.value[kComX] - x.value[kZmpX]), 1e-12);
        EXPECT_LT(std::abs(x.value[kComY] - x.value[kZmpY]), 1e-12);
        EXPECT_LT(x.first.cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_LT(x.second.cwiseAbs().maxCoeff(), tau == inside ? 1e-4 : 1e-15);
      }
    }
  }
}

TEST_F(HalfStepTest, GoesFromMidFeetToAboveTheSupportSoleAndBack) {
  HalfStep h;
  h.X_SF = Foothold::Level({0.1, -0.2, 0.4});
  h.via_height = 0.12;
  h.via_lateral = 0.22;
  WalkState floor, via;
  // CoM, ZMP, waist yaw, left foot, right foot, waist z.
  floor << 0.05, -0.1, 0.05, -0.1, 0.2, 0, 0, 0, 0, 0.1, -0.2, 0, 0.4, 0;
  via << 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -0.22, 0.12, 0, 0;
  EXPECT_EQ(h.Start(), floor);
  EXPECT_EQ(h.End(), via);
  h.kind = HalfStepKind::kDown;
  EXPECT_EQ(h.Start(), via);
  EXPECT_EQ(h.End(), floor);
  // A swing foot that stands lower takes the waist with it; one that stands higher does not.
  h.X_SF.height = -0.1;
  floor[kRightZ] = floor[kWaistZ] = -0.1;
  EXPECT_EQ(h.End(), floor);
  EXPECT_EQ(h.Start(), via);
  h.X_SF.height = floor[kRightZ] = 0.1;
  h.shape.crouch = 0.02;
  floor[kWaistZ] = via[kWaistZ] = -0.02;
  EXPECT_EQ(h.End(), floor);
  EXPECT_EQ(h.Start(), via);
}

TEST_F(HalfStepTest, RestsOnTheSupportPointOnTheSideOfTheSwingFoot) {
  HalfStep h;
  h.support = Side::kLeft;
  h.X_SF = Foothold::Level({0.1, -0.2, 0.4});
  h.shape.support_point = 0.03;
  const WalkState centre = [&] {
    HalfStep plain = h;
    plain.shape.support_point = 0.0;
    return plain.AtVia();
  }();
  WalkState moved = WalkState::Zero();
  moved[kComY] = moved[kZmpY] = -0.03;
  EXPECT_EQ(h.AtVia(), centre + moved);
  EXPECT_EQ(h.Mirrored().AtVia(), Mirrored(h.AtVia()));
  EXPECT_EQ(h.Mirrored().AtVia()[kComY], 0.03);
}

TEST_F(HalfStepTest, TheFootIsInTheAirOnlyWhileTheZmpRestsOnTheSupportSide) {
  for (int i = 0; i < 100; ++i) {
    const HalfStep h = Random();
    const Lipm lipm = RandomLipm();
    const HalfStepTracks tracks(h, lipm);
    const double bump =
        RestToRest(lipm.omega() * h.duration, h.shape.shift, h.shape.bump_ramp).bump();
    const bool up = h.kind == HalfStepKind::kUp;
    const int z = FootIndex(h.swing()) + 2;
    for (int k = 1; k < 200; ++k) {
      const double tau = h.duration * k / 200;
      const WalkJet x = tracks.At(tau);
      const bool flight = up ? tau > tracks.t2() : tau < tracks.t1();
      if (!flight) {
        EXPECT_EQ(x.value[z], 0.0);
      } else {
        EXPECT_GT(x.value[z], 0.0);
        EXPECT_LE(x.value[z], h.via_height);
        // On the support side of the shift: beyond it by the bump at most.
        const double p = tracks.of(kZmpX).At(tau).value;
        EXPECT_GE(up ? p : 1 - p, 1.0 - 1e-15);
        EXPECT_LE(up ? p : 1 - p, 1.0 + bump + 1e-15);
      }
      const double speed = x.first.segment<2>(FootIndex(h.swing())).norm();
      if (tau <= tracks.horizontal_begin() || tau >= tracks.horizontal_end()) {
        EXPECT_EQ(speed, 0.0);
      } else {
        EXPECT_GT(speed, 0.0);
      }
      EXPECT_TRUE(x.value.segment<4>(FootIndex(h.support)).isZero(0));
    }
    // The delay is kept at the end on the floor.
    const double delay =
        up ? tracks.horizontal_begin() - tracks.t2() : tracks.t1() - tracks.horizontal_end();
    EXPECT_NEAR(delay, h.shape.foot_delay * h.duration, 1e-14);
    EXPECT_NEAR(up ? tracks.horizontal_end() : tracks.horizontal_begin(), up ? h.duration : 0.0,
                1e-15);
  }
}

TEST_F(HalfStepTest, DownIsUpInReversedTime) {
  for (int i = 0; i < 100; ++i) {
    HalfStep up = Random();
    up.kind = HalfStepKind::kUp;
    HalfStep down = up;
    down.kind = HalfStepKind::kDown;
    const Lipm lipm = RandomLipm();
    const double tau = Uniform(0, up.duration);
    const WalkJet forth = HalfStepTracks(up, lipm).At(tau);
    const WalkJet back = HalfStepTracks(down, lipm).At(up.duration - tau);
    EXPECT_LT((forth.value - back.value).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((forth.first + back.first).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LT((forth.second - back.second).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST_F(HalfStepTest, LeftAndRightAreMirrorImagesExactly) {
  for (int i = 0; i < 100; ++i) {
    const HalfStep h = Random(), m = h.Mirrored();
    EXPECT_EQ(m.support, h.swing());
    EXPECT_EQ(m.Mirrored(), h);
    const Lipm lipm = RandomLipm();
    const double tau = Uniform(0, h.duration);
    const WalkJet a = HalfStepTracks(h, lipm).At(tau), b = HalfStepTracks(m, lipm).At(tau);
    EXPECT_EQ(b.value, Mirrored(a.value));
    EXPECT_EQ(b.first, Mirrored(a.first));
    EXPECT_EQ(b.second, Mirrored(a.second));
  }
}

TEST_F(HalfStepTest, AScaledDurationKeepsTheFractionsOfTime) {
  const HalfStepShape shape{.shift = 0.05, .foot_delay = 0.1};
  for (HalfStepKind kind : kKinds) {
    const HalfStepTracks two({.kind = kind, .duration = 2.0, .shape = shape}, Lipm());
    const HalfStepTracks three({.kind = kind, .duration = 3.0, .shape = shape}, Lipm());
    EXPECT_NEAR(two.t1(), 0.95, 1e-15);
    EXPECT_NEAR(two.t2(), 1.05, 1e-15);
    EXPECT_NEAR(three.t1(), 1.425, 1e-15);
    for (double sigma : {0.1, 0.3, 0.6, 0.9}) {  // Smoothsteps do not know of the LIPM.
      const ProfileJets a = two.Profiles(2 * sigma), b = three.Profiles(3 * sigma);
      EXPECT_NEAR(a[kFootProfile].value, b[kFootProfile].value, 1e-15);
      EXPECT_NEAR(a[kLiftProfile].first, 1.5 * b[kLiftProfile].first, 1e-14);
    }
  }
}

TEST_F(HalfStepTest, RefusesADelayThatLeavesNoTimeToMove) {
  // The flight lasts t1: 0.25, 0.3 and 0.475 of T.
  for (const auto& [shift, delay] : {std::pair{0.5, 0.3}, {0.4, 0.3}, {0.05, 0.31}, {0.05, -0.1}}) {
    const HalfStepShape shape{.shift = shift, .foot_delay = delay};
    for (HalfStepKind kind : kKinds) {
      EXPECT_THROW(HalfStepTracks({.kind = kind, .shape = shape}, Lipm()), std::logic_error)
          << shift;
    }
  }
  // The longest one allowed still lets the foot arrive.
  const HalfStepTracks tracks({.shape = {.shift = 0.5, .foot_delay = 0.22}}, Lipm());
  EXPECT_GT(tracks.horizontal_end(), tracks.horizontal_begin());
  EXPECT_NEAR(tracks.Profiles(2.0 - 1e-6)[kFootProfile].value, 1.0, 1e-9);
}

}  // namespace
}  // namespace halfstep
