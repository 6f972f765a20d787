// The bounds of smoothing/README.md, "Rounding", against the oracle's precision. rounding_study
// draws more.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/oracle/rounding_draws.h"
#include "tests/places.h"
#include "tests/wpg/generated_robots.h"
#include "tests/wpg/shipped_robots.h"

namespace halfstep::oracle {
namespace {

// No bound is exceeded, and a tenth of those that are sharp would be.
void Expect(const RoundingTally& tally, const std::vector<std::string>& sharp) {
  for (const auto& [name, part] : tally.parts) {
    EXPECT_LE(part.largest, 1.0) << name;
    EXPECT_GT(part.draws, 0) << name;
  }
  for (const std::string& name : sharp) {
    ASSERT_TRUE(tally.parts.contains(name)) << name;
    EXPECT_GT(tally.parts.at(name).largest, 0.1) << name;
  }
}

TEST(RoundingTest, OfNumbers) {
  RoundingTally tally;
  DrawNumbers(5000, 1, &tally);
  Expect(tally, {"sum", "product", "quotient", "formula"});
}

TEST(RoundingTest, OfForms) {
  RoundingTally tally;
  DrawForms(20000, 1, &tally);
  Expect(tally, {});
}

TEST(RoundingTest, OfWalks) {
  RoundingTally tally;
  for (const std::string& robot : kShippedRobots) {
    DrawWalks(InSources("wpg/robots/") + robot + ".yaml", 2000, 0, 2, &tally);
  }
  // 4,000 half-steps.
  DrawWalks(kHrp2, 200, 2000, 3, &tally);
  Expect(tally, {"walk yaw", "walk yaw'", "walk yaw''"});
}

// Robots of 5 cm to 4 m. Where a leg is stretched to some 1e-9 of its length nothing is said.
TEST(RoundingTest, OfLegs) {
  for (const std::string& robot : kShippedRobots) {
    for (const double scale : {1.0, 0.035, 2.7}) {
      SCOPED_TRACE(robot + " × " + std::to_string(scale));
      RoundingTally tally;
      DrawLegs(ShippedRobot(robot), scale, 300, 4, &tally);
      tally.parts.erase("not found");
      Expect(tally, {"angle"});
      EXPECT_GT(tally.parts["speed"].undecided, 0);
      EXPECT_LT(tally.parts["speed"].undecided, tally.parts["speed"].draws);
    }
  }
}

// Legs without closed form, with hip and ankle axes that miss each other as public humanoids have
// them.
TEST(RoundingTest, OfLegsWithoutClosedForm) {
  RoundingTally tally;
  for (const GeneratedRobot& generated : OffsetRobots()) {
    const RobotModel robot = TemporaryRobot(generated).Load();
    for (const double scale : {1.0, 0.08, 6.0}) {
      DrawLegs(robot, scale, 100, 4, &tally);
      DrawNeighbourhoods(robot, scale, 300, 5, &tally);
    }
  }
  tally.parts.erase("not found");
  Expect(tally, {"angle", "YJ"});
}

// The same robots' forces. Bounds are far from sharp, for each is a sum of norms along a leg; so
// it takes much to make them too small.
TEST(RoundingTest, OfDynamics) {
  for (const std::string& robot : kShippedRobots) {
    for (const double scale : {1.0, 0.035, 2.7}) {
      SCOPED_TRACE(robot + " × " + std::to_string(scale));
      RoundingTally tally, too_small;
      DrawDynamics(ShippedRobot(robot), scale, 200, 9, &tally);
      Expect(tally, {});
      EXPECT_GT(tally.parts["zmp"].undecided, 0);
      DrawDynamics(ShippedRobot(robot), scale, 200, 9, &too_small, 1e-8);
      for (const char* name : {"acceleration", "floor force", "floor moment", "zmp", "torque"}) {
        EXPECT_GT(too_small.parts[name].largest, 1.0) << name;
      }
    }
  }
}

TEST(RoundingTest, OfSupports) {
  RoundingTally tally;
  DrawSupports(5000, 6, &tally);
  Expect(tally, {"support"});
}

TEST(RoundingTest, OfDistances) {
  RoundingTally tally;
  DrawPolygons(5000, 8, &tally);
  DrawDistances(Hrp2(), 1000, 7, &tally);
  Expect(tally, {});
}

}  // namespace
}  // namespace halfstep::oracle
