#include "smoothing/walk/posture_gradient.h"

#include <gtest/gtest.h>

#include "smoothing/walk/posture_tangent.h"
#include "tests/smoothing/drawn_motion.h"

namespace halfstep {
namespace {

// A gradient with respect to everything, joints of one leg alone, or none but points.
PostureGradient Drawn(int kind, WalkDraw* draw) {
  PostureGradient gradient;
  if (kind == 2) return gradient;
  gradient.jet = DrawnRates(draw);
  const auto one = [draw] { return draw->Uniform(-1, 1); };
  gradient.waist = Eigen::Vector3d(one(), one(), one());
  gradient.waist_yaw = one();
  for (size_t s = 0; s < (kind == 0 ? 2 : 1); ++s) {
    gradient.sole_B[s] = Eigen::Vector3d(one(), one(), one());
    for (int j = 0; j < 6; ++j) {
      gradient.q[s][j] = one();
      gradient.speeds[s][j] = one();
    }
  }
  return gradient;
}

// The product with a tangent, before it is pulled back.
double Pushed(const PostureGradient& gradient, const WalkJet& along,
              const PostureTangent& tangent) {
  double sum = Product(gradient.jet, along) + gradient.waist.dot(tangent.waist) +
               gradient.waist_yaw * tangent.waist_yaw;
  for (size_t s = 0; s < 2; ++s) {
    sum += gradient.sole_B[s].dot(tangent.sole_B[s]) + gradient.q[s].dot(tangent.q[s]) +
           gradient.speeds[s].dot(tangent.speeds[s]);
  }
  return sum;
}

// PostureTangent agrees with differences (posture_tangent_test.cc), and this with it.
TEST(PostureGradient, IsTheTransposeOfTheTangent) {
  const RobotModel robot = Hrp2();
  WalkDraw draw(345);
  int checked = 0, caught = 0;
  for (int i = 0; i < Draws(200); ++i) {
    const SuperposedWalk walk = DrawnWalkOf(robot, &draw);
    const WalkJet jet = walk.At(draw.Uniform(0, walk.duration()));
    const auto posture = MovingPosture(robot, jet);
    if (!posture) continue;
    const WalkJet along = DrawnRates(&draw);
    const PostureTangent tangent = Differentiate(robot, jet, *posture, along);
    PostureGradient gradient = Drawn(i % 3, &draw);
    double pushed = Pushed(gradient, along, tangent);
    for (const RobotBody& body : robot.bodies) {
      const Eigen::Vector3d p_W = posture->OfBody(body) * Eigen::Vector3d(0.03, -0.02, 0.05);
      const Eigen::Vector3d weight = Eigen::Vector3d(draw.Uniform(-1, 1), draw.Uniform(-1, 1), 0.4);
      gradient.AddPoint(body, *posture, p_W, weight);
      pushed += weight.dot(PointTangent(body, *posture, tangent, p_W));
    }
    const WalkJet pulled = PulledBack(robot, jet, *posture, gradient);
    const double size = 1 + pulled.value.norm() + pulled.first.norm() + pulled.second.norm();
    EXPECT_NEAR(Product(pulled, along), pushed, 1e-11 * size);
    ++checked;
    // The control: a derivative that is off by a thousandth.
    WalkJet wrong = pulled;
    wrong.value[kWaistYaw] *= 1.001;
    caught += std::abs(Product(wrong, along) - pushed) > 1e-11 * size;
  }
  EXPECT_GT(checked, Draws(200) / 4);
  EXPECT_GT(caught, checked * 9 / 10);
}

}  // namespace
}  // namespace halfstep
