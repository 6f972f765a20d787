#include "smoothing/margins/rounding.h"

#include <gtest/gtest.h>

#include "tests/wpg/hrp2.h"

namespace halfstep {
namespace {

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
