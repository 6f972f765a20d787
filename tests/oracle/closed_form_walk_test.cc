// The oracle's walks against the readmes' own conditions and against the project.

#include <gtest/gtest.h>

#include "smoothing/walk/superposed_walk.h"
#include "tests/oracle/closed_form_walk.h"
#include "tests/oracle/nasty_draws.h"
#include "tests/oracle/project_side.h"
#include "tests/oracle/rest_to_rest_closed_form.h"
#include "tests/places.h"

namespace halfstep::oracle {
namespace {

TEST(RestToRestClosedFormTest, KeepsTheLipmAndItsEnds) {
  for (const double theta : {0.6, 3.0, 6.94, 20.0}) {
    for (const double shift : {0.01, 0.05, 0.5}) {
      for (const double ramp : {1.0, 0.24, 0.7}) {
        const RestToRestClosedForm pair(theta, shift, ramp);
        const auto c = [&](double sigma) { return pair.At(static_cast<Real>(sigma)); };
        // c″ = θ²(c − p) by differences of the slope, away from the knots.
        for (const double sigma : {0.11, 0.2, 0.31, 0.5 - 0.2 * shift, 0.5 + 0.3 * shift, 0.83}) {
          const Real h = 1e-7;
          const Real s = sigma;
          const double second =
              static_cast<double>((pair.At(s + h).c_rate - pair.At(s - h).c_rate) / (2 * h));
          const double expected = theta * theta * static_cast<double>(c(sigma).c - c(sigma).p);
          EXPECT_NEAR(second, expected, 1e-6 * (1 + theta * theta)) << theta << " " << shift;
        }
        EXPECT_NEAR(static_cast<double>(c(1e-12).c_rate), 0, 1e-9);
        EXPECT_NEAR(static_cast<double>(c(0.5).c), 0.5, 1e-15);
        const double knot = 0.5 - 0.5 * shift;
        EXPECT_NEAR(static_cast<double>(c(knot - 1e-9).c - c(knot + 1e-9).c), 0, 1e-7);
      }
    }
  }
}

TEST(ClosedFormWalkTest, AgreesWithTheProject) {
  const PlainRobot robot(InSources("wpg/robots/hrp2.yaml"));
  for (unsigned seed = 0; seed < 46; ++seed) {  // with rests among them; the last 16 over levels
    Draw draw(seed);
    WalkPlan plan;
    PlainScene scene;
    if (seed < 30) {
      plan = DrawPlan(robot, &draw);
    } else {
      DrawLevels(LevelKind(seed), robot, &draw, &plan, &scene);
    }
    const ClosedFormWalk oracle(plan);
    const SuperposedWalk walk(ToSequence(plan), ToParameters(plan));
    ASSERT_NEAR(oracle.duration(), walk.duration(), 1e-12);
    for (int k = 0; k <= 50; ++k) {
      const double t = walk.duration() * k / 50;
      const WalkState state = oracle.At(static_cast<Real>(t));
      const WalkJet jet = walk.At(t);
      const double far = 1e-12 + 1e-15 * jet.value.cwiseAbs().maxCoeff();
      EXPECT_LT((state.value.com - jet.value.segment<2>(kComX)).norm(), far) << seed << " " << t;
      EXPECT_LT((state.value.zmp - jet.value.segment<2>(kZmpX)).norm(), far);
      EXPECT_NEAR(state.value.waist_yaw, jet.value[kWaistYaw], far);
      EXPECT_NEAR(state.value.waist_z, jet.value[kWaistZ], far) << seed << " " << t;
      EXPECT_NEAR(state.second.waist_z, jet.second[kWaistZ], 1e-9) << seed << " " << t;
      EXPECT_LT((state.rate.com - jet.first.segment<2>(kComX)).norm(), 1e-10);
      EXPECT_LT((state.second.com - jet.second.segment<2>(kComX)).norm(), 1e-9);
      EXPECT_NEAR(state.second.waist_yaw, jet.second[kWaistYaw], 1e-9);
      for (int foot = 0; foot < 2; ++foot) {
        const int q = foot == 0 ? kLeftX : kRightX;
        const auto& feet = state.value.feet[static_cast<size_t>(foot)];
        EXPECT_LT((feet - jet.value.segment<4>(q)).norm(), far);
        const auto& rates = state.rate.feet[static_cast<size_t>(foot)];
        EXPECT_LT((rates - jet.first.segment<4>(q)).norm(), 1e-10);
        const auto& seconds = state.second.feet[static_cast<size_t>(foot)];
        EXPECT_LT((seconds - jet.second.segment<4>(q)).norm(), 1e-9) << seed << " " << t;
      }
    }
  }
}

}  // namespace
}  // namespace halfstep::oracle
