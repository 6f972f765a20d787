// What swept volumes call free on levels is certified: clearance from all solids, and the floor
// family of the foot that swings.

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "planner/swept/swept_volume_bake.h"
#include "planner/swept/swept_volume_query.h"
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

}  // namespace
}  // namespace halfstep
