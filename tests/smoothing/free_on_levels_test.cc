// What swept volumes call free on levels is certified: clearance from all solids, and the floor
// family of the foot that swings.

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/swept/swept_volume_bake.h"
#include "planner/swept/swept_volume_query.h"
#include "smoothing/methods/walk_problem.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/planner/blocks_ground.h"
#include "tests/planner/swept_volume_draws.h"
#include "tests/smoothing/short_walks.h"

namespace halfstep {
namespace {

StepSet Rises() {
  StepSet set;
  set.prototype.duration = 2.0;
  set.prototype.shape = {.shift = 0.05, .foot_delay = 0.12, .foot_ramp = 0.4, .lift_share = 0.6};
  set.on_levels = true;
  set.placements = {{{0.25, -0.2, 0.0}, 0.0}, {{0.25, -0.2, 0.1}, 0.1}, {{0.25, -0.2, 0.0}, -0.1}};
  return set;
}

// The proof of one half-step whose support sole stands at X_WS.
Verdict Proved(const MarginEvaluator& evaluator, const HalfStep& half_step, const Foothold& X_WS) {
  std::array<Foothold, 2> start;
  Nth(start, Index(half_step.support)) = X_WS;
  Nth(start, Index(half_step.swing())) = X_WS * half_step.X_SF;
  const HalfStepSequence sequence = MakeSequence(
      start,
      {{.side = half_step.swing(),
        .X_WF = X_WS * half_step.X_SF,
        .via_height = half_step.via_height,
        .duration = half_step.duration}},
      half_step.via_lateral, half_step.shape, std::make_shared<Lipm>(evaluator.robot().com_height));
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const int i = half_step.kind == HalfStepKind::kUp ? 0 : 1;
  return CertifiedFeasibility(evaluator, {})
      .Check(walk, {walk.start_of(i), walk.end_of(i)}, &scratch)
      .verdict;
}

TEST(FreeOnLevels, IsCertified) {
  const RobotModel& robot = SweptRobot();
  static const SweptVolumes volumes = *BakeSweptVolumes(
      robot, LipmOf(robot), Rises(), {.cell = 0.02, .displacement = 0.01}, {.threads = 1});
  MarginLimits limits = Only(MarginFamily::kClearance, 0.005);
  limits.demanded_of(MarginFamily::kFloor) = 0.005;
  SweptDraw draw(77);
  int free = 0, not_certified = 0;
  for (int k = 0; k < 40; ++k) {
    const int i = k % 3;
    const Side support = k / 3 % 2 == 0 ? Side::kLeft : Side::kRight;
    const bool down = k / 6 % 2 == 0;
    const Foothold X_WS({0.0, 0.0, draw.Uniform(-0.4, 0.4)}, 0.3);
    const Foothold X_WF = X_WS * volumes.set.Placement(i, support);
    std::vector<GroundSolid> blocks;
    for (const Foothold& X : {X_WS, X_WF}) {
      GroundSolid block = Block("tread", -0.14, 0.16, -0.09, 0.09, X.height);
      block.polygon = (X.Planar().rotation() * block.polygon).colwise() + X.Planar().position();
      blocks.push_back(block);
    }
    for (int more = 0; more < 2; ++more) {
      const double x = draw.Uniform(-0.2, 0.4), y = draw.Uniform(-0.4, 0.4);
      blocks.push_back(Block("block", x, x + 0.06, y, y + 0.06, draw.Uniform(0.2, 0.5)));
    }
    Scene scene;
    scene.ground = std::make_shared<const BlocksGround>(BlocksGround::kNoFloor, blocks);
    const SweptVolumeQuery query(volumes, SoleCorners({}, {0.22, 0.14}), scene);
    const bool is_free =
        down ? query.DownIsFree(i, support, X_WS) : query.UpIsFree(i, support, X_WS);
    const Verdict verdict = Proved(MarginEvaluator(robot, scene, limits),
                                   down ? volumes.set.Down(i, support) : volumes.set.Up(i, support),
                                   down ? X_WS : X_WF);
    EXPECT_TRUE(verdict == Verdict::kFeasible || !is_free) << "draw " << k;
    free += is_free;
    not_certified += verdict != Verdict::kFeasible;
  }
  EXPECT_GE(free, 8);
  EXPECT_GE(not_certified, 8);
}

// Regression: the height of a sole was compared with its level to the bit, and 0.07 m lower than
// 0.11 m is not 0.04 m.
TEST(WalkOnLevels, IsTakenWhereHeightsAreOtherSums) {
  double from = 0.0, to = 0.0;
  for (int a = 0; a < 16 && from == 0.0; ++a) {
    for (int b = 0; b < 16; ++b) {
      const double x = 0.01 * a, y = 0.01 * b;
      if (x + (y - x) < y) std::tie(from, to) = std::pair(x, y);
    }
  }
  ASSERT_NE(from, to);
  Scene scene;
  scene.ground = std::make_shared<const BlocksGround>(
      0.0, std::vector<GroundSolid>{Block("near", -0.3, 0.15, -0.5, 0.5, from, 0.0),
                                    Block("far", 0.15, 0.6, -0.5, 0.5, to, 0.0)});
  const RobotModel& robot = SweptRobot();
  const HalfStepSequence sequence =
      MakeSequence({Foothold({0.0, 0.1, 0.0}, from), Foothold({0.0, -0.1, 0.0}, from)},
                   {{.side = Side::kRight, .X_WF = Foothold({0.35, -0.1, 0.0}, to)}}, 0.24, {},
                   std::make_shared<Lipm>(robot.com_height));
  EXPECT_NO_THROW(WalkProblem(robot, scene, sequence, {}));
}

}  // namespace
}  // namespace halfstep
