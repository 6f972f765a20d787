#include "smoothing/program/row_reserves.h"

#include <gtest/gtest.h>

namespace halfstep {
namespace {

constexpr int kHalfSteps = 3, kFamilies = 2;

// A candidate that keeps all rows, with a slack of `slack` everywhere between the instants.
RowReserves::Seen SeenWith(double slack) {
  const size_t places = kHalfSteps * kFamilies;
  return {std::vector<double>(places, 0.0), std::vector<double>(places, slack)};
}

TEST(RowReserves, GrowInTheHalfStepThatWasRefusedAndNowhereElse) {
  RowReserves reserves(kHalfSteps, kFamilies, 0.01);
  RowReserves::Seen seen = SeenWith(0.02);
  seen.samples[3] = 0.9;  // half-step 1, family 1: far from its limit
  reserves.Learn(seen, {{1, 0}, {2, 1}}, true);
  EXPECT_NEAR(reserves.of(1, 0), 0.02, 1e-12);
  EXPECT_NEAR(reserves.of(1, 1), 0.01, 1e-12);
  EXPECT_NEAR(reserves.of(2, 1), 0.02, 1e-12);
  EXPECT_NEAR(reserves.of(2, 0), 0.013, 1e-12);  // may be what the next proof refuses
  EXPECT_NEAR(reserves.of(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(reserves.of(0, 1), 0.01, 1e-12);
}

TEST(RowReserves, GrowWhereSamplesAreViolatedBetweenRowsThatAreKept) {
  RowReserves reserves(kHalfSteps, kFamilies, 0.01);
  RowReserves::Seen seen = SeenWith(0.02);
  seen.samples[0] = seen.samples[1] = -0.1;
  seen.rows[1] = -0.05;  // the solver is not there yet
  reserves.Learn(seen, {}, false);
  EXPECT_NEAR(reserves.of(0, 0), 0.013, 1e-12);
  EXPECT_NEAR(reserves.of(0, 1), 0.01, 1e-12);
}

// What stands still has a slack that no parameter changes: asking for more only stops the solver.
TEST(RowReserves, DoNotGrowWhereTheSolverCannotKeepThem) {
  RowReserves reserves(kHalfSteps, kFamilies, 0.01);
  RowReserves::Seen seen = SeenWith(0.001);
  seen.rows[0] = -0.009;
  for (int i = 0; i < 20; ++i) reserves.Learn(seen, {{0, 0}}, true);
  EXPECT_NEAR(reserves.of(0, 0), 0.01, 1e-12);
}

TEST(RowReserves, ShrinkAfterProofsButNotToWhatWasRefused) {
  RowReserves reserves(kHalfSteps, kFamilies, 0.01);
  const RowReserves::Seen seen = SeenWith(0.6);
  reserves.Learn(seen, {{1, 0}}, true);
  const double after = reserves.of(0, 0);
  EXPECT_NEAR(after, 0.01, 1e-12) << "not all was proved";
  reserves.Learn(seen, {}, false);
  EXPECT_NEAR(reserves.of(0, 0), after, 1e-12) << "nothing was tried";
  for (int i = 0; i < 50; ++i) reserves.Learn(seen, {}, true);
  EXPECT_NEAR(reserves.of(0, 0), 0.001, 1e-12);
  EXPECT_NEAR(reserves.of(1, 0), 0.015, 1e-12) << "half as much again as was refused";
  reserves.SetAll(0.01);
  for (int i = 0; i < 50; ++i) reserves.Learn(seen, {}, true);
  EXPECT_NEAR(reserves.of(1, 0), 0.001, 1e-12) << "forgotten";
}

TEST(RowReserves, StayWithinBounds) {
  RowReserves reserves(kHalfSteps, kFamilies, 0.01);
  for (int i = 0; i < 50; ++i) reserves.Learn(SeenWith(-1.0), {{0, 0}}, true);
  for (int k = 0; k < kHalfSteps; ++k) EXPECT_LE(reserves.of(k, 0), 0.4);
  reserves.SetAll(0.5);
  reserves.Learn(SeenWith(-1.0), {{0, 0}}, true);
  EXPECT_NEAR(reserves.of(0, 0), 0.5, 1e-12) << "what is more already stays";
}

}  // namespace
}  // namespace halfstep
