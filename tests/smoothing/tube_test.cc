// Motions within a tube around a certified walk keep what is demanded; what a tube takes from the
// margins is never exceeded, and not by far too much.
//
// A few thousand motions; HALFSTEP_TUBE=10000 for that many of each robot.

#include "smoothing/margins/tube.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "smoothing/margins/demandable.h"
#include "smoothing/margins/family_traits.h"
#include "smoothing/proof/certified_feasibility.h"
#include "tests/smoothing/drawn_motion.h"
#include "tests/smoothing/short_walks.h"
#include "tests/smoothing/test_scenes.h"
#include "tests/smoothing/tube_draw.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep {
namespace {

int Motions(int few) {
  const char* wish = std::getenv("HALFSTEP_TUBE");
  return wish == nullptr ? Draws(few) : std::atoi(wish);
}

constexpr double kDegree = 0.017453292519943295;

Tube SomeTube(double size) {
  return {.foot = 0.005 * size,
          .foot_turn = 0.5 * kDegree,
          .waist = 0.005 * size,
          .waist_turn = 0.5 * kDegree,
          .joint = 0.005,
          .joint_speed = 0.1,
          .zmp = 0.01 * size};
}

// The farthest that a body's vertices go.
double WayOf(const RobotBody& body, const Eigen::Isometry3d& X, const Eigen::Isometry3d& moved) {
  const Eigen::Matrix3Xd vertices = body.shape.vertices;
  return (X * vertices - moved * vertices).colwise().norm().maxCoeff();
}

Pose2 SeenFromAbove(const Eigen::Isometry3d& X) {
  return {X.translation().x(), X.translation().y(), std::atan2(X(1, 0), X(0, 0))};
}

// What bodies do in a tube, against its bounds: the largest of (observed / bound).
struct Ratios {
  double body = 0.0, pair = 0.0, sole = 0.0, support = 0.0;
  double clearance = 0.0;  // of the body that goes farthest, against the bound of all
};

class TubeMotions {
 public:
  TubeMotions(const RobotModel& robot, const Tube& tube, unsigned seed)
      : robot_(robot),
        tube_(tube),
        shift_(robot, tube),
        draw_(robot, tube, seed),
        clearances_(robot, {}),
        scratch_(clearances_.MakeScratch()) {}

  // Draws `motions` near postures of random walks.
  Ratios Look(int motions) {
    while (motions > 0) {
      const SuperposedWalk walk = DrawnWalkOf(robot_, &draw_.draw());
      for (int i = 0; i < 5; ++i) {
        const WalkJet jet = walk.At(walk.Locate(draw_.draw().Uniform(0, walk.duration())));
        const auto plan = MovingPosture(robot_, jet);
        if (!plan) continue;
        for (int k = 0; k < 10; ++k, --motions) Compare(*plan, draw_.Near(*plan));
      }
    }
    return ratios_;
  }

 private:
  static void Raise(double observed, double bound, double* ratio) {
    EXPECT_LE(observed, bound + 1e-9);
    if (bound > 0.0) *ratio = std::max(*ratio, observed / bound);
  }

  void Compare(const Posture& plan, const Posture& moved) {
    for (size_t b = 0; b < robot_.bodies.size(); ++b) {
      const RobotBody& body = robot_.bodies[b];
      const double way = WayOf(body, plan.OfBody(body), moved.OfBody(body));
      Raise(way, shift_.bodies[b], &ratios_.body);
      Raise(way, shift_.body, &ratios_.clearance);
    }
    std::vector<double> planned;
    constexpr double kCap = 2.0;
    clearances_.Place(plan, &scratch_);
    for (size_t p = 0; p < robot_.self_pairs.size(); ++p) {
      planned.push_back(clearances_.OfPair(p, plan, kCap, &scratch_).value);
    }
    clearances_.Place(moved, &scratch_);
    for (size_t p = 0; p < robot_.self_pairs.size(); ++p) {
      if (planned[p] < 0.0) continue;  // depths are not distances
      const double now = clearances_.OfPair(p, moved, kCap, &scratch_).value;
      Raise(planned[p] - now, shift_.pairs[p] + 2e-6, &ratios_.pair);  // slabs: to 1e-6 m
    }
    for (size_t s = 0; s < 2; ++s) {
      Eigen::Matrix3Xd outline = Eigen::Matrix3Xd::Zero(3, robot_.sole_outline.cols());
      outline.topRows<2>() = robot_.sole_outline;
      Raise((plan.X_WLink[s][6] * outline - moved.X_WLink[s][6] * outline)
                .colwise()
                .norm()
                .maxCoeff(),
            shift_.sole, &ratios_.sole);
    }
    const auto support = [this](const Posture& posture) {
      return SupportPolygon(SeenFromAbove(posture.X_WLink[0][6]),
                            SeenFromAbove(posture.X_WLink[1][6]), robot_.sole_size);
    };
    const Eigen::Vector2d p = 0.5 * (plan.X_WLink[0][6].translation().head<2>() +
                                     plan.X_WLink[1][6].translation().head<2>());
    const Eigen::Vector2d zmp = p + tube_.zmp * draw_.InBall().head<2>();
    Raise(support(plan).Margin(p) - support(moved).Margin(zmp), tube_.zmp + shift_.sole,
          &ratios_.support);
  }

  const RobotModel& robot_;
  Tube tube_;
  TubeShift shift_;
  TubeDraw draw_;
  BodyClearances clearances_;
  BodyClearances::Scratch scratch_;
  Ratios ratios_;
};

// Once with all of a tube, and once with what leaves only one way to each body.
TEST(Tube, NothingOfARobotGoesFartherThanItsBoundAndOftenGoesHalfOfIt) {
  for (const RobotModel& robot : RobotsOfAllKinds()) {
    const double size = LegScale(robot);
    const Tube tube = SomeTube(size);
    Tube by_waist = tube, by_feet = tube;
    by_waist.foot = by_waist.foot_turn = 1.0;
    by_feet.waist = by_feet.waist_turn = 1.0;
    unsigned seed = 1;
    for (const Tube& one : {tube, by_waist, by_feet}) {
      const Ratios ratios = TubeMotions(robot, one, seed++).Look(Motions(100));
      std::printf(
          "%-22s observed of the bound: bodies %.2f, farthest %.2f, pairs %.2f, soles "
          "%.2f, support %.2f\n",
          robot.name.c_str(), ratios.body, ratios.clearance, ratios.pair, ratios.sole,
          ratios.support);
      EXPECT_GT(ratios.body, 0.5) << robot.name;
    }
  }
}

// A robot whose hip and ankle axes do not meet, too.
TEST(Tube, HoldsForOffsetLegs) {
  for (const RobotModel& robot : RobotsWithOffsets()) {
    EXPECT_GT(TubeMotions(robot, SomeTube(LegScale(robot)), 7).Look(Motions(50)).body, 0.5);
  }
}

// All that a tube is about, of one posture: by family, the least margin.
std::map<MarginFamily, double> MarginsOf(const MarginEvaluator& evaluator, const Posture& posture,
                                         const SuperposedWalk& walk, const LocalTime& at) {
  const RobotModel& robot = evaluator.robot();
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  const BodyClearances& clearances = evaluator.clearances();
  std::map<MarginFamily, double> margins;
  margins[MarginFamily::kClearance] =
      clearances.NearestObstacle(posture, walk.Absolute(at), 0.3, &scratch.bodies).value;
  margins[MarginFamily::kSelfClearance] =
      clearances.NearestPair(posture, 0.3, &scratch.bodies).value;
  double joint = kUnlimited, ground = kUnlimited, floor = kUnlimited, no_step = kUnlimited;
  for (size_t s = 0; s < 2; ++s) {
    for (int j = 0; j < 6; ++j) {
      const LegJoint& limits = Nth(robot.legs[s].joints, j);
      const double q = posture.ik[s].q[j];
      joint = std::min({joint, q - limits.lower, limits.upper - q});
    }
    const Eigen::Isometry3d& X_WS = posture.X_WLink[s][6];
    const Side side = static_cast<Side>(s);
    if (!walk.InAir(at, side)) {
      no_step = std::min(no_step, evaluator.place().areas.NearestTo(SeenFromAbove(X_WS)).distance);
      continue;
    }
    const int step = at.half_step / 2;
    if (!walk.MovesHorizontally(step, at)) continue;
    for (Eigen::Index k = 0; k < robot.sole_outline.cols(); ++k) {
      const Eigen::Vector2d c = robot.sole_outline.col(k);
      floor = std::min(floor, (X_WS * Eigen::Vector3d(c.x(), c.y(), 0.0)).z());
    }
  }
  for (const RobotBody& body : robot.bodies) {
    if (IsOnFoot(body)) continue;
    const Eigen::Isometry3d& X = posture.OfBody(body);
    const Eigen::Vector3d down = X.linear().transpose() * -Eigen::Vector3d::UnitZ();
    ground = std::min(ground, X.translation().z() - Support(body.shape, down));
  }
  margins[MarginFamily::kJoint] = joint;
  margins[MarginFamily::kGround] = ground;
  margins[MarginFamily::kFloor] = floor;
  margins[MarginFamily::kNoStep] = no_step;
  return margins;
}

// A box beside the left foot's way and an area ahead of where the feet land.
Scene NarrowScene(const RobotModel& robot, double gap) {
  Scene scene;
  Obstacle box;
  box.name = "box";
  box.shape = Box{{0.1, 0.1, 0.3}};
  const double outer = 0.5 * robot.standing_width + robot.sole_outline.row(1).maxCoeff();
  box.X_WO = ToIsometry(Pose2{0.1, outer + 0.05 + gap, 0.0}, 0.15);
  scene.obstacles.push_back(box);
  Eigen::Matrix2Xd area(2, 4);
  const double x = 0.2 + robot.sole_outline.row(0).maxCoeff() + gap;
  area << x, x + 0.1, x + 0.1, x, -0.5, -0.5, 0.5, 0.5;
  scene.no_step.push_back(area);
  return scene;
}

// A walk that is as near to its limits as a tube lets it be, in every family that holds in a tube.
class NarrowTube {
 public:
  // Certificates take `parts` of the tube that motions have.
  NarrowTube(const Tube& tube, double parts)
      : tube_(tube), sequence_(TwoSteps(robot_)), walk_(sequence_, PlannedMotion(sequence_)) {
    limits_.tube = {.foot = parts * tube.foot,
                    .foot_turn = parts * tube.foot_turn,
                    .waist = parts * tube.waist,
                    .waist_turn = parts * tube.waist_turn,
                    .joint = parts * tube.joint,
                    .joint_speed = parts * tube.joint_speed,
                    .zmp = parts * tube.zmp};
    const MarginEvaluator evaluator(robot_, scene_, limits_);
    MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
    least_ = evaluator.At(walk_, walk_.Locate(0.0), &scratch);
    for (double t = 0.0; t <= walk_.duration(); t += 0.001) {
      const MarginSet now = evaluator.At(walk_, walk_.Locate(t), &scratch);
      for (size_t f = 0; f < now.size(); ++f) {
        if (now[f].value < least_[f].value) least_[f] = now[f];
      }
    }
    // Demands just what the walk has, and nothing of other families.
    limits_.demanded.fill(-100.0);
    limits_.demanded_of(MarginFamily::kFriction) = kNotDemanded;
    for (const MarginFamily family : AllMarginFamilies()) {
      if (Traits(family).in_tube == nullptr) continue;
      // What is between samples; that of soles, ZMP and speeds changes fast.
      const bool fast = family == MarginFamily::kFloor || family == MarginFamily::kZmpRobot ||
                        family == MarginFamily::kJointSpeed;
      limits_.demanded_of(family) = Nth(least_, family).value -
                                    Nth(RaisedBy(limits_.tube, robot_), family) -
                                    (fast ? 5e-3 : 2e-4);
    }
  }

  // The verdict with these demands, in the tube that motions have or in that of the certificates.
  Feasibility Certified(bool in_all) const {
    MarginLimits limits = limits_;
    if (in_all) limits.tube = tube_;
    Certificate rows;
    return Certify(robot_, scene_, limits, walk_, &rows);
  }
  // How many of `motions` drawn ones have a margin below what is asked, by family; half of them
  // where one of the families is nearest to its limit.
  std::map<MarginFamily, int> Beyond(int motions) const {
    const MarginEvaluator evaluator(robot_, scene_, {});
    TubeDraw draw(robot_, tube_, 3);
    std::map<MarginFamily, int> beyond;
    for (int i = 0; i < motions; ++i) {
      const double anywhere = draw.draw().Uniform(0, walk_.duration());
      const Margin& nearest = least_[static_cast<size_t>(i / 2) % least_.size()];
      const LocalTime at = walk_.Locate(i % 2 == 0 ? anywhere : nearest.t);
      const Posture plan = SolvePosture(robot_, walk_.At(at).value);
      for (const auto& [family, margin] : MarginsOf(evaluator, draw.Near(plan), walk_, at)) {
        if (margin < Nth(limits_.demanded, family)) ++beyond[family];
      }
    }
    return beyond;
  }

 private:
  Tube tube_;
  RobotModel robot_ = Hrp2();
  HalfStepSequence sequence_;
  SuperposedWalk walk_;
  Scene scene_ = NarrowScene(robot_, 0.05);
  MarginLimits limits_;
  MarginSet least_;
};

TEST(Tube, EveryMotionWithinTheTubeOfACertifiedWalkKeepsWhatIsDemanded) {
  const NarrowTube narrow(SomeTube(1.0), 1.0);
  const Feasibility answer = narrow.Certified(true);
  ASSERT_EQ(answer.verdict, Verdict::kFeasible) << Name(answer.witness.family);
  EXPECT_THAT(narrow.Beyond(Motions(2000)), testing::IsEmpty());
}

// A walk that is certified in a tube half as wide is refused in all of it, and motions in all of it
// miss what is demanded.
TEST(Tube, OfHalfTheWidthIsNotEnough) {
  const NarrowTube narrow(SomeTube(1.0), 0.5);
  const Feasibility answer = narrow.Certified(false);
  EXPECT_EQ(answer.verdict, Verdict::kFeasible) << Name(answer.witness.family);
  EXPECT_EQ(narrow.Certified(true).verdict, Verdict::kViolated);
  const auto beyond = narrow.Beyond(Motions(2000));
  EXPECT_TRUE(beyond.contains(MarginFamily::kJoint));
  EXPECT_TRUE(beyond.contains(MarginFamily::kNoStep));
}

// The same of a tenth, for what few of the drawn motions do to the full.
TEST(Tube, OfATenthOfTheWidthIsNotEnoughForBodies) {
  const auto beyond = NarrowTube(SomeTube(1.0), 0.1).Beyond(Motions(2000));
  EXPECT_TRUE(beyond.contains(MarginFamily::kClearance));
  EXPECT_TRUE(beyond.contains(MarginFamily::kGround));
}

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
