// What keeps a walk off the solids of its ground: clearance, floor and ground against blocks.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "smoothing/margins/foot_solids.h"
#include "smoothing/margins/slack_evaluator.h"
#include "tests/planner/blocks_ground.h"
#include "tests/smoothing/row_differences.h"
#include "tests/smoothing/short_walks.h"
#include "wpg/motion/lipm.h"
#include "wpg/robot/sole_outline.h"

namespace halfstep {
namespace {

Scene On(double floor, std::vector<GroundSolid> blocks) {
  Scene scene;
  scene.ground = std::make_shared<const BlocksGround>(floor, std::move(blocks));
  return scene;
}

// The right foot goes 0.4 m ahead, past the left one.
HalfStepSequence LongStep(const RobotModel& robot, double via_height = 0.12) {
  const double y = 0.5 * robot.standing_width;
  return MakeSequence({Foothold::Level({0, y, 0}), Foothold::Level({-0.2, -y, 0})},
                      {{.side = Side::kRight,
                        .X_WF = Foothold::Level({0.2, -y, 0}),
                        .via_height = via_height,
                        .duration = 2.0}},
                      0.24, {}, std::make_shared<Lipm>(robot.com_height));
}

// How far ahead of the sole's centre the foot's bodies reach.
double Toe(const RobotModel& robot) {
  double toe = -1.0;
  for (const RobotBody& body : robot.bodies) {
    if (!IsOnFoot(body)) continue;
    const Leg& leg = Nth(robot.legs, body.leg);
    const Eigen::Isometry3d X_SoleBody = leg.X_BSole.inverse() * leg.joints[5].X_BLink;
    toe = std::max(toe, Support(body.shape, X_SoleBody.linear().row(0).transpose()) +
                            X_SoleBody.translation().x());
  }
  return toe;
}

// A block before the place where the right foot lands, `gap` [m] ahead of it.
Scene Riser(const RobotModel& robot, double gap, double top) {
  const double x = 0.2 + Toe(robot) + gap;
  return On(0.0, {Block("riser", x, x + 0.3, -1.0, 1.0, top)});
}

TEST(GroundSolids, ARiserIsRefusedWhereTheToeIsFiveMillimetresTooNear) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = LongStep(robot);
  const SuperposedWalk walk(sequence, Overlapped(sequence, 0.5));
  const MarginLimits limits = Only(MarginFamily::kClearance, 0.005);
  Certificate certificate;
  EXPECT_EQ(Certify(robot, Riser(robot, 0.00501, 0.15), limits, walk, &certificate).verdict,
            Verdict::kFeasible);
  double least = kUnlimited;
  for (const CertificateRow& row : certificate) least = std::min(least, row.margin.value);
  EXPECT_NEAR(least, 0.00501, 1e-9);
  for (const double gap : {0.00499, 0.00001}) {
    const Scene scene = Riser(robot, gap, 0.15);
    const Feasibility refused = Certify(robot, scene, limits, walk, &certificate);
    EXPECT_EQ(refused.verdict, Verdict::kViolated) << gap;
    const MarginEvaluator evaluator(robot, scene, limits);
    EXPECT_EQ(evaluator.Subject(refused.witness), "RLEG_LINK5 - riser");
    EXPECT_EQ(evaluator.statements(MarginFamily::kClearance).PlacedFeet(refused.witness),
              std::vector<Side>{Side::kRight});
  }
}

// A block whose top is at the soles bears them; one that is a millimetre higher is in the way, and
// one that is a millimetre lower does not touch.
TEST(GroundSolids, TheTopUnderASoleMayTouchItAndAMillimetreMoreIsInTheWay) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = LongStep(robot);
  const SuperposedWalk walk(sequence, Overlapped(sequence, 0.5));
  Certificate certificate;
  for (const double top : {-0.001, 0.0, 1e-9, 0.001}) {
    const Scene scene = On(BlocksGround::kNoFloor, {Block("platform", -2, 2, -2, 2, top)});
    const Feasibility answer =
        Certify(robot, scene, Only(MarginFamily::kClearance, 0.005), walk, &certificate);
    EXPECT_EQ(answer.verdict, top < 1e-6 ? Verdict::kFeasible : Verdict::kViolated) << top;
  }
}

// On a large block all is as on the floor.
TEST(GroundSolids, APlatformIsAFloor) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = LongStep(robot);
  const SuperposedWalk walk(sequence, Overlapped(sequence, 0.5));
  const MarginEvaluator flat(robot, {}, {}),
      block(robot, On(BlocksGround::kNoFloor, {Block("platform", -2, 2, -2, 2, 0.0)}), {});
  MarginEvaluator::Scratch a = flat.MakeScratch(), b = block.MakeScratch();
  int moving = 0;
  for (int n = 0; n <= 60; ++n) {
    const LocalTime at = walk.Locate(walk.duration() * n / 60);
    const MarginSet here = flat.At(walk, at, &a), there = block.At(walk, at, &b);
    EXPECT_EQ(Of(here, MarginFamily::kFloor).value, Of(there, MarginFamily::kFloor).value);
    moving += std::isfinite(Of(here, MarginFamily::kFloor).value);
    EXPECT_EQ(Of(there, MarginFamily::kGround).value, kUnlimited);
    // What is no foot is above the block by as much as above the floor.
    EXPECT_NEAR(Of(there, MarginFamily::kClearance).value, Of(here, MarginFamily::kGround).value,
                1e-9);
    EXPECT_EQ(Of(here, MarginFamily::kLandingSpeed).value,
              Of(there, MarginFamily::kLandingSpeed).value);
  }
  EXPECT_GT(moving, 15);
  Certificate rows_a, rows_b;
  EXPECT_EQ(Certify(robot, {}, {}, walk, &rows_a).verdict,
            Certify(robot, block.scene(), {}, walk, &rows_b).verdict);
}

// A curb across the way of the right foot, between its two places.
GroundSolid Curb(double height) { return Block("curb", -0.03, 0.03, -0.5, -0.01, height); }

// The least distance of the foot's flat outline from the curb while it moves, by points.
double DistanceFromCurb(const RobotModel& robot, const SuperposedWalk& walk, double height) {
  const Eigen::Matrix2Xd outline = FootOutline(robot);
  double least = kUnlimited;
  for (int n = 0; n <= 1000; ++n) {
    const LocalTime at = walk.Locate(walk.duration() * n / 1000);
    if (walk.StepInAir(at) != 0 || !walk.MovesHorizontally(0, at)) continue;
    const WalkState x = walk.At(at).value;
    const Pose2 X_WF = FootPose(x, Side::kRight);
    // The curb is longer than the foot is wide, so corners of the outline are the nearest.
    for (const Eigen::Vector2d& corner : outline.colwise()) {
      const double at_x = (X_WF.position() + X_WF.rotation() * corner).x();
      const double beside = std::max(std::abs(at_x) - 0.03, 0.0);
      least = std::min(least, std::hypot(beside, std::max(x[kRightZ] - height, 0.0)));
    }
    double front = -10.0, rear = 10.0;
    for (const Eigen::Vector2d& corner : outline.colwise()) {
      const double at_x = (X_WF.position() + X_WF.rotation() * corner).x();
      front = std::max(front, at_x), rear = std::min(rear, at_x);
    }
    if (front >= -0.03 && rear <= 0.03) least = std::min(least, x[kRightZ] - height);
  }
  return least;
}

TEST(GroundSolids, TheSwingFootIsCertifiedOverACurbAsFarAsItIsFromIt) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = LongStep(robot);
  int near = 0;
  for (const double share : {0.0, 0.4, 0.7}) {
    const SuperposedWalk walk(sequence, Overlapped(sequence, share));
    for (const double height : {0.02, 0.06, 0.09, 0.11}) {
      const double truth = DistanceFromCurb(robot, walk, height);
      if (truth <= 1e-4) continue;
      // Without a floor, which the foot is nearer to where its motion begins and ends.
      const Scene scene = On(BlocksGround::kNoFloor, {Curb(height)});
      Certificate certificate;
      const auto floor = [&](double demanded) {
        return Certify(robot, scene, Only(MarginFamily::kFloor, demanded), walk, &certificate);
      };
      const double demanded = truth - 5e-4;  // what instants 2 ms apart may miss
      ++near;
      EXPECT_EQ(floor(demanded).verdict, Verdict::kFeasible) << share << " " << height;
      const Feasibility refused = floor(truth + 1e-4);
      EXPECT_EQ(refused.verdict, Verdict::kViolated) << share << " " << height;
      EXPECT_EQ(MarginEvaluator(robot, scene, {}).Subject(refused.witness), "right foot - curb");
    }
  }
  EXPECT_GE(near, 3);
}

// One millimetre over an edge with a sole that is lower than it, and the foot is refused by both.
TEST(GroundSolids, AFootThatEntersABlockIsRefused) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = LongStep(robot, 0.12);
  const SuperposedWalk walk(sequence, Overlapped(sequence, 0.7));
  const Scene scene = On(0.0, {Curb(0.125)});
  for (const MarginFamily family : {MarginFamily::kFloor, MarginFamily::kClearance}) {
    Certificate certificate;
    const Feasibility refused = Certify(robot, scene, Only(family, 0.0), walk, &certificate);
    EXPECT_EQ(refused.verdict, Verdict::kViolated);
    EXPECT_EQ(refused.witness.family, family);
  }
}

bool Holds(const Eigen::Matrix2Xd& convex, const Eigen::Vector2d& p) {
  for (Eigen::Index i = 0; i < convex.cols(); ++i) {
    const Eigen::Vector2d a = convex.col(i), b = convex.col((i + 1) % convex.cols());
    if ((b - a).x() * (p - a).y() - (b - a).y() * (p - a).x() < 0.0) return false;
  }
  return true;
}

// Both feet onto a tread of 10 cm, and the tread: its edge is `behind` [m] behind the feet that
// stand on it.
HalfStepSequence StepUp(const RobotModel& robot, double rise = 0.1) {
  const double y = 0.5 * robot.standing_width;
  return MakeSequence(
      StandingFeet(robot),
      {{.side = Side::kRight, .X_WF = {{0.28, -y, 0.0}, rise}, .via_height = 0.22, .duration = 2.0},
       {.side = Side::kLeft, .X_WF = {{0.28, y, 0.0}, rise}, .via_height = 0.15, .duration = 2.0}},
      0.24, {.shift = 0.05, .foot_delay = 0.12, .foot_ramp = 0.4, .lift_share = 0.6},
      std::make_shared<Lipm>(robot.com_height));
}
Scene Tread(const RobotModel& robot, double top, double behind = 0.01) {
  const double edge = 0.28 + FootOutline(robot).row(0).minCoeff() - behind;
  return On(0.0, {Block("tread", edge, 2.0, -1.0, 1.0, top, 0.0)});
}

TEST(GroundSolids, AStepUpIsCertifiedAndATreadThatIsAMillimetreHigherIsNot) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = StepUp(robot);
  MarginLimits limits = Only(MarginFamily::kFloor, 0.005);
  limits.demanded_of(MarginFamily::kClearance) = 0.005;
  limits.demanded_of(MarginFamily::kGround) = 0.0;
  int certified = 0;
  for (const double share : {0.0, 0.3}) {
    const SuperposedWalk walk(sequence, Overlapped(sequence, share));
    Certificate certificate;
    const Scene scene = Tread(robot, 0.1);
    const Feasibility answer = Certify(robot, scene, limits, walk, &certificate);
    EXPECT_EQ(answer.verdict, Verdict::kFeasible)
        << share << ": " << MarginEvaluator(robot, scene, limits).Describe(answer.witness);
    certified += answer.verdict == Verdict::kFeasible;
    const Scene higher = Tread(robot, 0.101);
    const Feasibility refused = Certify(robot, higher, limits, walk, &certificate);
    EXPECT_EQ(refused.verdict, Verdict::kViolated);
    // The riser as much nearer to the toe of the foot that waits before it as there is room.
    const Scene nearer = Tread(robot, 0.1,
                               0.28 + FootOutline(robot).row(0).minCoeff() -
                                   FootOutline(robot).row(0).maxCoeff() - 0.0045);
    EXPECT_EQ(Certify(robot, nearer, limits, walk, &certificate).verdict, Verdict::kViolated);
  }
  EXPECT_EQ(certified, 2);
  // Down again: the foot comes from above the edge.
  const double y = 0.5 * robot.standing_width;
  const HalfStepSequence down = MakeSequence(
      {Foothold({0.28, y, 0.0}, 0.1), Foothold({0.28, -y, 0.0}, 0.1)},
      {{.side = Side::kRight, .X_WF = Foothold::Level({0.0, -y, 0.0}), .via_height = 0.15},
       {.side = Side::kLeft, .X_WF = Foothold::Level({0.0, y, 0.0}), .via_height = 0.22}},
      0.24, {.shift = 0.05, .foot_delay = 0.12, .foot_ramp = 0.4, .lift_share = 0.6},
      std::make_shared<Lipm>(robot.com_height));
  Certificate certificate;
  const Feasibility answer = Certify(robot, Tread(robot, 0.1), limits,
                                     SuperposedWalk(down, PlannedMotion(down)), &certificate);
  EXPECT_EQ(answer.verdict, Verdict::kFeasible)
      << MarginEvaluator(robot, Tread(robot, 0.1), limits).Describe(answer.witness);
}

// How fast a foot sinks counts in the last centimetre above where it lands, not above the floor.
TEST(GroundSolids, LandingSpeedCountsAboveTheLanding) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = StepUp(robot);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  MarginLimits limits = Only(MarginFamily::kLandingSpeed, 0.0);
  limits.landing_speed = 0.3;
  const MarginEvaluator evaluator(robot, Tread(robot, 0.1), limits);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  int low = 0;
  for (int n = 0; n <= 400; ++n) {
    const LocalTime at = walk.Locate(walk.duration() * n / 400);
    if (walk.StepInAir(at) != 0) continue;
    const WalkJet jet = walk.At(at);
    const double height = jet.value[kRightZ] - 0.1;
    const double expected = 0.3 * std::max(1.0, height / 0.01) + jet.first[kRightZ];
    EXPECT_NEAR(Of(evaluator.At(walk, at, &scratch), MarginFamily::kLandingSpeed).value, expected,
                1e-12);
    low += height < 0.01 && jet.first[kRightZ] < 0.0;
  }
  EXPECT_GT(low, 3);
}

// Certified walks over drawn blocks: no vertex of a foot's body is in a block at any time.
TEST(GroundSolids, NoPointOfACertifiedFootIsEverInsideABlock) {
  const RobotModel robot = Hrp2();
  WalkDraw draw(711);
  const HalfStepSequence sequence = LongStep(robot);
  int certified = 0, refused = 0;
  for (int i = 0; i < Draws(24); ++i) {
    std::vector<GroundSolid> blocks;
    for (int k = 0; k < 3; ++k) {
      const double x = draw.Uniform(-0.5, 0.5), y = draw.Uniform(-0.4, 0.0);
      GroundSolid block = Block("block", -0.02, 0.02, -0.05, 0.05, draw.Uniform(0.01, 0.12));
      const Pose2 X_WO{x, y, draw.Uniform(-3, 3)};
      block.polygon = (X_WO.rotation() * block.polygon).colwise() + X_WO.position();
      blocks.push_back(block);
    }
    const SuperposedWalk walk(sequence, Overlapped(sequence, draw.Uniform(0.0, 0.8)));
    MarginLimits limits = Only(MarginFamily::kFloor, 0.0);
    limits.demanded_of(MarginFamily::kClearance) = 0.0;
    Certificate certificate;
    const Feasibility answer = Certify(robot, On(0.0, blocks), limits, walk, &certificate);
    bool inside = false;
    for (int n = 0; n <= 200; ++n) {
      const Posture posture = SolvePosture(robot, walk.At(walk.duration() * n / 200).value);
      for (const RobotBody& body : robot.bodies) {
        const Eigen::Matrix3Xd points_W =
            posture.OfBody(body) * Eigen::Matrix3Xd(body.shape.vertices);
        for (const Eigen::Vector3d& p : points_W.colwise()) {
          for (const GroundSolid& block : blocks) {
            if (p.z() > block.top - 1e-6) continue;
            inside = inside || Holds(block.polygon, p.head<2>());
          }
        }
      }
    }
    EXPECT_FALSE(inside && answer.verdict == Verdict::kFeasible);
    certified += answer.verdict == Verdict::kFeasible;
    refused += inside;
  }
  EXPECT_GT(certified, Draws(24) / 10);
  EXPECT_GT(refused, Draws(24) / 10);
}

// Rows of a certificate hold throughout their intervals, with blocks that begin to count within
// them, as the foot rises past their tops.
TEST(GroundSolids, RowsOfACertificateHoldThroughoutTheirIntervals) {
  const RobotModel robot = Hrp2();
  const HalfStepSequence sequence = LongStep(robot);
  WalkDraw draw(712);
  int of_blocks = 0;
  for (int i = 0; i < Draws(8); ++i) {
    const SuperposedWalk walk(sequence, Overlapped(sequence, draw.Uniform(0.0, 0.8)));
    MarginLimits limits;
    limits.demanded.fill(-100.0);
    limits.demanded_of(MarginFamily::kFriction) = kNotDemanded;
    const double x = draw.Uniform(0.0, 0.15);
    const Scene scene = On(0.0, {Curb(draw.Uniform(0.01, 0.1)),
                                 Block("block", 0.36 + x, 0.6, -1, 1, draw.Uniform(0.02, 0.1))});
    const MarginEvaluator evaluator(robot, scene, limits);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    Certificate certificate;
    ASSERT_EQ(CertifiedFeasibility(evaluator, {}).Certify(walk, &scratch, &certificate).verdict,
              Verdict::kFeasible);
    for (const CertificateRow& row : certificate) {
      if (row.family != MarginFamily::kFloor && row.family != MarginFamily::kClearance) continue;
      const double claimed = row.margin.value - row.bound;
      if (!std::isfinite(claimed) || claimed < 0.0) continue;
      for (const double part : {1e-9, draw.Uniform(0, 1), draw.Uniform(0, 1), 1 - 1e-9}) {
        const LocalTime at = walk.Locate(row.begin + part * (row.end - row.begin));
        EXPECT_GE(Of(evaluator.At(walk, at, &scratch), row.family).value, claimed - 1e-9)
            << Name(row.family) << " in " << row.begin << " … " << row.end;
      }
      of_blocks += row.margin.other >= 0;
    }
  }
  EXPECT_GT(of_blocks, Draws(8) * 5);
}

TEST(GroundSolids, RowsHaveDerivatives) {
  const RobotModel robot = Hrp2();
  const Scene scene = On(0.0, {Curb(0.05), Block("block", 0.37, 0.6, -1, 1, 0.09)});
  const MarginEvaluator evaluator(robot, scene, Only(MarginFamily::kFloor, 0.0));
  const RowDifferences found =
      CompareLeastRow(evaluator, LongStep(robot), MarginFamily::kFloor, 20.0, 714);
  EXPECT_GE(found.compared, Draws(60));
}

TEST(SolidGap, IsTheDistanceOfAFlatOutlineFromAPrism) {
  const RobotModel robot = Hrp2();
  const Eigen::Matrix2Xd outline = FootOutline(robot);
  const Scene scene = On(0.0, {Block("block", 0.0, 0.3, 0.0, 0.2, 0.1, 0.04)});
  const FootSolids solids(robot, scene);
  WalkDraw draw(715);
  std::vector<SolidGap> gaps;
  int apart = 0, inside = 0;
  for (int i = 0; i < Draws(200); ++i) {
    const Foothold X_WF(draw.Pose(0.5, 3), draw.Uniform(0.0, 0.2));
    solids.Near(X_WF, 10.0, &gaps);
    ASSERT_EQ(gaps.size(), 1u);
    // By points of the outline's edges and of the block's.
    const Eigen::Matrix2Xd sole =
        (X_WF.Planar().rotation() * outline).colwise() + X_WF.Planar().position();
    double truth = kUnlimited;
    for (Eigen::Index k = 0; k < sole.cols(); ++k) {
      for (int n = 0; n < 40; ++n) {
        const Eigen::Vector2d p =
            sole.col(k) + (sole.col((k + 1) % sole.cols()) - sole.col(k)) * n / 40.0;
        const Eigen::Vector3d at(p.x(), p.y(), X_WF.height);
        const Eigen::Vector3d nearest =
            at.cwiseMax(Eigen::Vector3d(0.0, 0.0, 0.04)).cwiseMin(Eigen::Vector3d(0.3, 0.2, 0.1));
        truth = std::min(truth, (at - nearest).norm());
      }
    }
    if (gaps[0].Distance() > 0.0) {
      EXPECT_LE(gaps[0].Distance(), truth + 1e-12);
      EXPECT_GE(gaps[0].Distance(), gaps[0].beside > 0.0 ? truth - 0.006 : 0.0);
      ++apart;
    } else {
      ++inside;
      EXPECT_LT(gaps[0].above, 1e-12);
    }
    for (const double cap : {0.5 * gaps[0].Distance(), 1.5 * gaps[0].Distance()}) {
      std::vector<SolidGap> near;
      if (cap <= 0.0) continue;
      solids.Near(X_WF, cap, &near);
      EXPECT_EQ(near.size(), cap > gaps[0].Distance() ? 1u : 0u);
    }
  }
  EXPECT_GT(apart, Draws(200) / 3);
  EXPECT_GT(inside, Draws(200) / 50);
}

}  // namespace
}  // namespace halfstep
