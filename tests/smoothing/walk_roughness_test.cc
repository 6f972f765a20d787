#include "smoothing/program/walk_roughness.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "opt/problem/derivative_check.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

// By Simpson's rule between knots; jerk from the third derivative of the LIPM.
WalkRoughness Sampled(const SuperposedWalk& walk, int samples) {
  std::vector<double> knots = Knots(walk);
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    knots.push_back(walk.start_of(i) + 0.5 * walk.tracks(i).duration());
  }
  std::sort(knots.begin(), knots.end());
  const double omega = dynamic_cast<const Lipm&>(walk.model()).omega(), omega2 = omega * omega;
  WalkRoughness roughness;
  for (size_t i = 0; i + 1 < knots.size(); ++i) {
    const double h = (knots[i + 1] - knots[i]) / (2 * samples);
    if (h <= 0.0) continue;
    for (int s = 0; s <= 2 * samples; ++s) {
      const WalkJet jet = walk.At(knots[i] + h * s);
      const double weight = h / 3 * (s == 0 || s == 2 * samples ? 1 : s % 2 == 1 ? 4 : 2);
      roughness.com_acceleration += weight * jet.second.segment<2>(kComX).squaredNorm();
      roughness.com_jerk +=
          weight *
          (omega2 * (jet.first.segment<2>(kComX) - jet.first.segment<2>(kZmpX))).squaredNorm();
      for (Side side : {Side::kLeft, Side::kRight}) {
        roughness.foot_speed += weight * jet.first.segment<3>(FootIndex(side)).squaredNorm();
      }
    }
  }
  return roughness;
}

void ExpectNear(const WalkRoughness& a, const WalkRoughness& b, double relative) {
  EXPECT_NEAR(a.com_acceleration, b.com_acceleration, relative * b.com_acceleration);
  EXPECT_NEAR(a.com_jerk, b.com_jerk, relative * b.com_jerk);
  EXPECT_NEAR(a.foot_speed, b.foot_speed, relative * b.foot_speed);
}

TEST(WalkRoughness, IsTheIntegralOfTheWalksOwnAccelerations) {
  WalkDraw draw(310);
  for (int i = 0; i < Draws(20); ++i) {
    const HalfStepSequence sequence = draw.Sequence(2);
    const SuperposedWalk walk(sequence, draw.Parameters(sequence, 0.0, 1.0));
    ExpectNear(RoughnessOf(walk), Sampled(walk, 40), 1e-6);
  }
}

TEST(WalkRoughness, DoesNotDependOnWhereTheWalkIsOrOnItsSide) {
  WalkDraw draw(311);
  for (int i = 0; i < Draws(20); ++i) {
    const HalfStepSequence sequence = draw.Sequence(2);
    const HomotopyParameters parameters = draw.Parameters(sequence, 0.0, 1.0);
    const WalkRoughness roughness = RoughnessOf(SuperposedWalk(sequence, parameters));
    ExpectNear(RoughnessOf(SuperposedWalk(Mirrored(sequence), Mirrored(parameters))), roughness,
               1e-9);
    ExpectNear(RoughnessOf(SuperposedWalk(Moved(draw.Pose(3, 3), sequence), parameters)), roughness,
               1e-9);
  }
}

TEST(WalkRoughness, WithoutOverlapsHalfStepsAddUp) {
  const HalfStepSequence sequence = WalkDraw(312).Sequence(2);
  HalfStepSequence first = sequence, second = sequence;
  first.half_steps.resize(2);
  second.half_steps.erase(second.half_steps.begin(), second.half_steps.begin() + 2);
  const auto roughness = [](const HalfStepSequence& s) {
    return RoughnessOf(SuperposedWalk(s, PlannedMotion(s)));
  };
  EXPECT_NEAR(roughness(sequence).com_acceleration,
              roughness(first).com_acceleration + roughness(second).com_acceleration, 1e-9);
  EXPECT_NEAR(roughness(sequence).foot_speed,
              roughness(first).foot_speed + roughness(second).foot_speed, 1e-9);
}

TEST(WalkRoughness, GradientAgreesWithDifferences) {
  WalkDraw draw(313);
  const RoughnessWeights all[] = {{1, 0, 0}, {0, 0.01, 0}, {0, 0, 1}, {0.05, 0.001, 0.1}};
  for (int i = 0; i < Draws(10); ++i) {
    const HalfStepSequence sequence = draw.Sequence(2);
    const HomotopyParameters parameters = draw.Parameters(sequence, 0.05, 0.95);
    const std::vector<HomotopyParameter> parameter = AllParameters(sequence);
    const Eigen::Index n = static_cast<Eigen::Index>(parameter.size());
    for (const RoughnessWeights& weights : all) {
      const auto function = [&](const Eigen::VectorXd& d) {
        HomotopyParameters moved = parameters;
        for (Eigen::Index p = 0; p < n; ++p) parameter[static_cast<size_t>(p)].in(moved) += d[p];
        return Eigen::VectorXd::Constant(
            1, WeightedRoughness(SuperposedWalk(sequence, moved), weights, nullptr));
      };
      ParameterGradient gradient;
      const SuperposedWalk walk(sequence, parameters);
      const double value = WeightedRoughness(walk, weights, &gradient);
      const WalkRoughness roughness = RoughnessOf(walk);
      EXPECT_NEAR(value,
                  weights.com_acceleration * roughness.com_acceleration +
                      weights.com_jerk * roughness.com_jerk +
                      weights.foot_speed * roughness.foot_speed,
                  1e-12 * (1 + value));
      Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(1, n);
      for (const auto& [p, slope] : gradient) {
        jacobian(0, std::find(parameter.begin(), parameter.end(), p) - parameter.begin()) += slope;
      }
      const DerivativeReport report =
          CheckJacobian(function, Eigen::VectorXd::Zero(n), jacobian, 1e-4);
      EXPECT_TRUE(report.Passed(1e-5)) << report.Describe();
      jacobian(0, 0) = 1.02 * jacobian(0, 0) + 0.01;
      EXPECT_FALSE(CheckJacobian(function, Eigen::VectorXd::Zero(n), jacobian, 1e-4).Passed(1e-5));
    }
  }
}

}  // namespace
}  // namespace halfstep
