#include "experiments/control/joint_errors.h"

#include <gtest/gtest.h>

#include "experiments/config/data_folder.h"
#include "experiments/control/ankle_bush.h"

namespace halfstep::control {
namespace {

// What stays of a servo's sag by 0.04 rad after a second, when measurements are so old [s].
double LeftOf(double gain, double age) {
  constexpr double kSag = 0.04;
  JointErrors errors(gain, 0.025);
  std::deque<double> seen(static_cast<size_t>(age / kControlPeriod + 0.5), -kSag);
  double q = -kSag;
  for (int i = 0; i < 200; ++i) {
    const double next = kControlPeriod * (i + 1);
    MeasuredState measured{.t = next - age, .q = {}, .speeds = {}, .loads = {}};
    measured.q.fill(Vector6d::Constant(seen.front()));
    seen.pop_front();
    q = errors.Integrated(measured, next)[1][2] - kSag;
    seen.push_back(q);
    errors.Note(next, {Vector6d::Zero(), Vector6d::Zero()});
  }
  return q / -kSag;
}

TEST(JointErrorsTest, MakesServosAtRestStifferByTheFactor) {
  for (const double age : {0.01, 0.02, 0.05}) EXPECT_NEAR(LeftOf(4.0, age), 0.2, 0.01) << age;
  EXPECT_NEAR(LeftOf(0.06, 0.01), 1.0 / 1.06, 0.001);
  EXPECT_EQ(LeftOf(-1.0, 0.01), 1.0);
}

TEST(AnkleBushTest, YieldsAsASpringWithADamperAndTurnsAboutTheAnkle) {
  const RobotModel robot = LoadRobot((RobotsFolder() / "hrp2.yaml").string());
  AnkleBush bush(robot.legs[0], JointSpring{1000.0, 50.0}), rigid(robot.legs[0], {});
  const Eigen::Vector2d moment(10.0, -20.0);
  for (int i = 0; i < 50; ++i) bush.Yield(moment, 0.001);  // D/K
  EXPECT_NEAR(bush.turn().x(), 0.01 * (1.0 - std::exp(-1.0)), 1e-4);
  EXPECT_NEAR(bush.turn().y(), -0.02 * (1.0 - std::exp(-1.0)), 2e-4);
  EXPECT_LT((bush.X_RestSole() * bush.ankle() - bush.ankle()).norm(), 1e-12);
  const Eigen::Isometry3d later = bush.X_RestSole(0.001);
  bush.Yield(moment, 0.001);
  EXPECT_LT((later.matrix() - bush.X_RestSole().matrix()).norm(), 2e-5);
  rigid.Yield(moment, 1.0);
  EXPECT_TRUE(rigid.X_RestSole().isApprox(Eigen::Isometry3d::Identity(), 0.0));
}

}  // namespace
}  // namespace halfstep::control
