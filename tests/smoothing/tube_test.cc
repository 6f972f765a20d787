// What a tube adds to demands and takes from margins.

#include "smoothing/margins/tube.h"

#include <gtest/gtest.h>

#include "smoothing/margins/demandable.h"
#include "smoothing/margins/family_traits.h"
#include "smoothing/margins/tube_shift.h"
#include "tests/smoothing/short_walks.h"
#include "tests/smoothing/test_scenes.h"
#include "tests/smoothing/tube_cases.h"

namespace halfstep {
namespace {

// Whatever the margins of a posture are, those without a tube are not less by more than bounds say.
TEST(Tube, ClearancesAreLessByWhatItTakesFromEachBody) {
  const RobotModel robot = Hrp2();
  const Scene scene = NarrowScene(robot, 0.01);
  const HalfStepSequence sequence = TwoSteps(robot);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  MarginLimits limits;
  const MarginEvaluator without(robot, scene, limits);
  limits.tube = SomeTube(1.0);
  const MarginEvaluator within = without.WithLimits(limits);
  const TubeShift shift(robot, limits.tube);
  MarginEvaluator::Scratch scratch = without.MakeScratch();
  for (double t = 0.0; t < walk.duration(); t += 0.1) {
    const MarginSet a = without.At(walk, walk.Locate(t), &scratch);
    const MarginSet b = within.At(walk, walk.Locate(t), &scratch);
    for (const auto& [family, most] : {std::pair{MarginFamily::kClearance, shift.body},
                                       std::pair{MarginFamily::kSelfClearance, shift.pair}}) {
      EXPECT_LT(Nth(b, family).value, Nth(a, family).value);
      EXPECT_GE(Nth(b, family).value, Nth(a, family).value - most);
    }
  }
}

TEST(Tube, OfZeroIsNone) {
  const RobotModel robot = Hrp2();
  for (const double raised : RaisedBy({}, robot)) EXPECT_EQ(raised, 0.0);
  const TubeShift shift(robot, {});
  EXPECT_EQ(shift.body + shift.off_feet + shift.pair + shift.sole, 0.0);
  EXPECT_EQ(Demandable({}, robot).raised, MarginLimits{}.raised);
}

// Whatever asks for demands gets them with the tube's share, and once only.
TEST(Tube, RaisesWhatIsDemandedOnce) {
  MarginLimits limits;
  limits.tube = SomeTube(1.0);
  const MarginEvaluator evaluator(Hrp2(), {}, limits);
  const MarginLimits& once = evaluator.limits();
  EXPECT_EQ(Nth(once.demanded, MarginFamily::kFloor), 0.005);
  EXPECT_NEAR(once.demanded_of(MarginFamily::kFloor), 0.005 + 0.0062, 2e-4);
  EXPECT_EQ(evaluator.WithLimits(once).limits().raised, once.raised);
  // Clearances have lost it already.
  for (const MarginFamily family : {MarginFamily::kClearance, MarginFamily::kSelfClearance}) {
    EXPECT_EQ(Nth(once.raised, family), 0.0);
    EXPECT_NE(Traits(family).in_tube, nullptr);
  }
}

}  // namespace
}  // namespace halfstep
