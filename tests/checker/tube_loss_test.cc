// Certificates of tubes in the interval checker.
#include "experiments/checker/tube_loss.h"

#include <gtest/gtest.h>

#include "experiments/checker/check_walk.h"
#include "experiments/verify/tube_raise.h"
#include "tests/checker/made_run.h"

namespace halfstep::checker {
namespace {

const MadeRun& InATube() {
  static const MadeRun run(R"(robot: hrp2
scene: scene.yaml
footsteps:
  - {foot: right, x_m: 0.2, y_m: -0.105}
)",
                           R"(obstacles:
  - name: box
    box: {size_m: [0.1, 0.1, 0.1]}
    pose: {xyz: [0.5, 0.0, 0.05]}
)",
                           R"(  profile: limit
  tube: {foot_m: 0.002, foot_deg: 0.2, waist_m: 0.002, waist_deg: 0.2, joint_rad: 0.002, joint_speed_rad_s: 0.05, zmp_m: 0.004}
)");
  return run;
}

bool IsProved(const WalkRun& walk) {
  return CheckWalk(WalkMotion(walk.tables), walk.robot, walk.scene, walk.certificate, walk.crouch)
      .proved();
}

TEST(TubeLoss, WalksInATubeAreProved) {
  ASSERT_TRUE(InATube().walk.certificate.tube);
  const TrajectoryCheck check = InATube().Check();
  EXPECT_TRUE(check.proved()) << (Missed(check).empty() ? "" : Missed(check)[0]->subject);
}

// Of verify's formulas it differs by rounding, and is no less.
TEST(TubeLoss, IsWhatATubeTakes) {
  const WalkRun& walk = InATube().walk;
  verify::TubeText tube = *walk.certificate.tube;
  for (auto& [name, by] : tube.raised) by = 0.0;
  const TubeLoss loss(tube, walk.robot);
  const auto fall = verify::FallInTube(tube.tube, walk.robot);
  const verify::BodyWays ways(tube.tube, walk.robot);
  const auto expect = [](double its, double exact) {
    EXPECT_GE(its, exact - 1e-16);
    EXPECT_LE(its, exact + 1e-12);
  };
  for (const verify::Family family : {verify::kFloor, verify::kNoStep, verify::kZmpRobot,
                                      verify::kJoint, verify::kJointSpeed, verify::kZmp}) {
    expect(loss.Demanded(family, 0.0), fall[family]);
    EXPECT_EQ(loss.Demanded(family, verify::kNotDemanded), verify::kNotDemanded);
  }
  const auto bodies = walk.robot.bodies.size();
  for (size_t a = 0; a < bodies; ++a) {
    const bool foot = walk.robot.bodies[a].link == 5;
    expect(loss.Demanded({.family = verify::kClearance, .a = a}), ways.bodies[a]);
    expect(loss.Demanded({.family = verify::kGround, .a = a}), foot ? 0.0 : ways.bodies[a]);
    for (size_t b = 0; b < bodies; ++b) {
      expect(loss.Demanded({.family = verify::kSelfClearance, .a = a, .b = b}),
             ways.nearer(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)));
    }
  }
}

TEST(TubeLoss, WiderTubesAreNotProved) {
  for (double Tube::*const of : {&Tube::foot, &Tube::joint, &Tube::joint_speed, &Tube::zmp}) {
    WalkRun walk = InATube().walk;
    walk.certificate.tube->tube.*of += of == &Tube::joint_speed ? 5.0 : 0.05;
    EXPECT_FALSE(IsProved(walk));
  }
  // What is demanded before the tube is then more.
  WalkRun walk = InATube().walk;
  for (auto& [name, by] : walk.certificate.tube->raised) by -= 0.05;
  EXPECT_FALSE(IsProved(walk));
}

}  // namespace
}  // namespace halfstep::checker
