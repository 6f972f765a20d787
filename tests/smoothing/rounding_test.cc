#include "smoothing/margins/rounding.h"

#include <gtest/gtest.h>

#include "tests/wpg/hrp2.h"

namespace halfstep {
namespace {

TEST(Rounding, OfPlacesGoesByTheWayFromTheOrigin) {
  const Rounding rounding(Hrp2());
  WalkState x = WalkState::Zero();
  EXPECT_EQ(rounding.Of(x), 1e-12);
  x[kComX] = -9.0;
  EXPECT_EQ(rounding.Of(x), 1e-12);
  // A coordinate of 5 km has less than a picometre left.
  x[kComX] = -5000.0;
  EXPECT_NEAR(rounding.Of(x), 5e-10, 1e-15);
}

// 1e-6 N m is nothing for a man, and more than a dwarf's ankle gives.
TEST(Rounding, OfTorquesGoesByWeightAndLeg) {
  RobotModel robot = Hrp2();
  const double man = Rounding(robot).torque;
  EXPECT_NEAR(man, 1e-6, 1e-7);
  robot.mass *= 50.0;
  EXPECT_NEAR(Rounding(robot).torque, 50.0 * man, 1e-9);
  robot.mass *= 1e-6 / 50.0;
  EXPECT_NEAR(Rounding(robot).torque, 1e-6 * man, 1e-15);
}

}  // namespace
}  // namespace halfstep
