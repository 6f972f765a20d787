// `halfstep verify` of walks whose waist sways.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "experiments/run/exit_status.h"
#include "experiments/verify/described_sway.h"
#include "tests/verify/verify_mutation.h"
#include "wpg/motion/waist_sway.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

TEST(DescribedSway, IsTheSwayOfTheHalfStep) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> near(-0.02, 0.02);
  WaistSway sway;
  for (int k = 0; k < WaistSway::kControls; ++k)
    sway.controls.emplace_back(near(random), near(random));
  const double T = 1.3;
  const verify::DescribedSway described{sway.controls, T};
  double most = 0;
  for (double tau = -0.1; tau < T + 0.1; tau += 0.003) {
    const auto jet = sway.At(tau, T);
    EXPECT_LT((described.Derivative(0, tau) - Eigen::Vector2d(jet[0].value, jet[1].value)).norm(),
              1e-15);
    EXPECT_LT((described.Derivative(1, tau) - Eigen::Vector2d(jet[0].first, jet[1].first)).norm(),
              1e-13);
    EXPECT_LT((described.Derivative(2, tau) - Eigen::Vector2d(jet[0].second, jet[1].second)).norm(),
              1e-11);
    most = std::max(most, std::hypot(jet[0].third, jet[1].third));
  }
  EXPECT_NEAR(described.ThirdBound(), most, 1e-9 * most);
}

TamperedRun Compensated() {
  return TamperedRun(
      TamperedWalk{.config = "fig3_two_half_steps",
                   .overrides = {"half_step.compensation=two", "output.period_s=0.01"}});
}

TEST(VerifyCompensation, AcceptsACompensatedWalk) {
  const Outcome outcome = Compensated().Verify();
  EXPECT_EQ(outcome.status, kSuccess) << outcome.out << outcome.err;
}

// The certificate's motion is not the one that the config describes.
TEST(VerifyCompensation, RefusesACompensationThatTheConfigDoesNotAskFor) {
  for (const std::string other : {"one", "none"}) {
    TamperedRun run = Compensated();
    TamperedRun::Replace(run.run() / "config.yaml", "compensation: two", "compensation: " + other);
    run.Rehash();
    const Outcome outcome = run.Verify();
    EXPECT_EQ(outcome.status, kNotVerified);
    EXPECT_THAT(outcome.out, HasSubstr("com")) << outcome.out;
  }
}

TEST(VerifyCompensation, RefusesAComThatDoesNotSway) {
  TamperedRun run = Compensated();
  const auto plain = TamperedRun(
      TamperedWalk{.config = "fig3_two_half_steps",
                   .overrides = {"half_step.compensation=none", "output.period_s=0.01"}});
  const auto of_plain = TamperedRun::Cells(ReadText(plain.trajectory()));
  run.EditTrajectory([&](TamperedRun::Table& table) {
    const auto& header = table.front();
    const auto column =
        static_cast<size_t>(std::find(header.begin(), header.end(), "com_x_m") - header.begin());
    ASSERT_LT(column, header.size());
    for (size_t i = 1; i < std::min(table.size(), of_plain.size()); ++i) {
      table[i][column] = of_plain[i][column];
    }
  });
  run.Rehash();
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, kNotVerified);
  EXPECT_THAT(outcome.out, HasSubstr("pendulum"));
}

}  // namespace
}  // namespace halfstep
