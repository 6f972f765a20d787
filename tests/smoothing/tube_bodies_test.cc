// Nothing of a robot goes farther in a tube than its bounds say, and some of it not by far less.
//
// A few thousand motions; HALFSTEP_TUBE=10000 for that many of each robot.

#include <gtest/gtest.h>

#include "smoothing/margins/tube_shift.h"
#include "tests/smoothing/drawn_motion.h"
#include "tests/smoothing/tube_cases.h"
#include "tests/smoothing/tube_draw.h"
#include "tests/smoothing/tube_margins.h"
#include "wpg/geometry/support_polygon.h"

namespace halfstep {
namespace {

// The farthest that a body's vertices go.
double WayOf(const RobotBody& body, const Eigen::Isometry3d& X, const Eigen::Isometry3d& moved) {
  const Eigen::Matrix3Xd vertices = body.shape.vertices;
  return (X * vertices - moved * vertices).colwise().norm().maxCoeff();
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

}  // namespace
}  // namespace halfstep
