#include "smoothing/walk/posture_tangent.h"

#include <gtest/gtest.h>

#include "opt/problem/derivative_check.h"
#include "tests/smoothing/drawn_motion.h"

namespace halfstep {
namespace {

// Joint angles and speeds, and the places of a point of each body (24 + 3·bodies).
Eigen::VectorXd Everything(const RobotModel& robot, const WalkJet& jet) {
  Posture posture = SolvePosture(robot, jet.value);
  Eigen::VectorXd all(24 + 3 * static_cast<Eigen::Index>(robot.bodies.size()));
  if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) {
    return Eigen::VectorXd::Constant(all.size(), std::nan(""));
  }
  all.head<24>() << posture.ik[0].q, posture.ik[1].q, posture.speeds[0], posture.speeds[1];
  for (size_t b = 0; b < robot.bodies.size(); ++b) {
    all.segment<3>(24 + 3 * static_cast<Eigen::Index>(b)) =
        posture.OfBody(robot.bodies[b]) * Eigen::Vector3d(0.03, -0.02, 0.05);
  }
  return all;
}

WalkJet DrawnJet(WalkDraw* draw) {
  const HalfStepSequence sequence = draw->Sequence(2);
  const SuperposedWalk walk(sequence, draw->Parameters(sequence, 0.0, 0.9));
  return walk.At(draw->Uniform(0, walk.duration()));
}

TEST(PostureTangent, AgreesWithDifferencesOfTheInverseKinematics) {
  const RobotModel robot = Hrp2();
  WalkDraw draw(340);
  int checked = 0;
  for (int i = 0; i < Draws(200); ++i) {
    const WalkJet jet = DrawnJet(&draw);
    const auto moving = MovingPosture(robot, jet);
    if (!moving) continue;
    const Posture& posture = *moving;
    ++checked;
    WalkJet along;
    for (int q = 0; q < kNumQuantities; ++q) {
      along.value[q] = draw.Uniform(-0.1, 0.1);
      along.first[q] = draw.Uniform(-1, 1);
    }
    const PostureTangent tangent = Differentiate(robot, jet, posture, along);
    const auto function = [&](const Eigen::VectorXd& h) {
      return Everything(robot, Along(jet, h[0], along));
    };
    Eigen::MatrixXd column(24 + 3 * static_cast<Eigen::Index>(robot.bodies.size()), 1);
    column.topRows<24>() << tangent.q[0], tangent.q[1], tangent.speeds[0], tangent.speeds[1];
    for (size_t b = 0; b < robot.bodies.size(); ++b) {
      const RobotBody& body = robot.bodies[b];
      column.block<3, 1>(24 + 3 * static_cast<Eigen::Index>(b), 0) = PointTangent(
          body, posture, tangent, posture.OfBody(body) * Eigen::Vector3d(0.03, -0.02, 0.05));
    }
    const Eigen::VectorXd here = Eigen::VectorXd::Zero(1);
    const DerivativeReport report = CheckJacobian(function, here, column, 1e-4);
    EXPECT_TRUE(report.Passed(1e-6)) << report.Describe();
    for (Eigen::Index broken : {Eigen::Index{2}, Eigen::Index{14}, column.rows() - 1}) {
      Eigen::MatrixXd wrong = column;
      wrong(broken, 0) = 1.05 * wrong(broken, 0) + 1e-3;
      EXPECT_FALSE(CheckJacobian(function, here, wrong, 1e-4).Passed(1e-6));
    }
  }
  EXPECT_GT(checked, Draws(200) / 4);
}

TEST(PostureTangent, AlongTimeItIsTheVelocity) {
  const RobotModel robot = Hrp2();
  WalkDraw draw(341);
  int checked = 0;
  for (int i = 0; i < Draws(100); ++i) {
    const WalkJet jet = DrawnJet(&draw);
    Posture posture = SolvePosture(robot, jet.value);
    if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) continue;
    ++checked;
    WalkJet rates;
    rates.value = jet.first;
    rates.first = jet.second;
    const PostureTangent tangent = Differentiate(robot, jet, posture, rates);
    EXPECT_LT((tangent.waist - posture.waist_velocity).norm(), 1e-12);
    for (size_t s = 0; s < 2; ++s) {
      const double size = 1 + posture.speeds[s].cwiseAbs().maxCoeff();
      EXPECT_LT((tangent.q[s] - posture.speeds[s]).cwiseAbs().maxCoeff(), 1e-9 * size);
    }
  }
  EXPECT_GT(checked, Draws(100) / 4);
}

}  // namespace
}  // namespace halfstep
