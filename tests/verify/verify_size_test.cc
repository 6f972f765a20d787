// What `halfstep verify` grants goes by the robot: HRP-2 at a tenth of a metre and at four metres
// is verified, and what is a hair for a man is refused where it is many times what a dwarf can do.

#include <gmock/gmock.h>

#include "experiments/verify/tolerances.h"
#include "experiments/verify/verify_run.h"
#include "tests/patterns.h"
#include "tests/places.h"
#include "tests/verify/verify_mutation.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr double kSmall = 0.071;  // legs of 5 cm

std::string Times(const std::string& key, double value) { return key + "=" + ShortestText(value); }

// Two half-steps on the empty floor, and demanded margins of the robot's size.
TamperedWalk WalkOf(double size) {
  return {
      .overrides = {"scene=none", "smoothing.limits.foot_speed_m_s=none",
                    Times("footsteps.0.x_m", 0.274 * size), Times("footsteps.0.y_m", -0.105 * size),
                    Times("smoothing.margins.floor_m", 0.005 * size),
                    Times("smoothing.margins.zmp_m", 0.01 * size),
                    Times("smoothing.margins.zmp_robot_m", 0.01 * size),
                    Times("smoothing.margins.self_clearance_m", 0.005 * size)},
      .size = size};
}

verify::MethodVerification Verified(const TamperedRun& run) {
  return VerifyProved({.run = run.run().string(), .method = "dichotomy"}).front();
}

TEST(VerifySize, DwarfsAndGiantsAreVerified) {
  for (const double size : {kSmall, 2.6}) {
    const verify::MethodVerification result = Verified(TamperedRun(WalkOf(size)));
    EXPECT_TRUE(result.verified) << size << "\n" << verify::Describe(result);
  }
}

// All that says how much torque there is to spare is made to say: none, and none is demanded.
TEST(VerifySize, EffortsBelowWhatTheWalkNeedsAreRefused) {
  TamperedRun run(WalkOf(kSmall));
  const auto yaml = run.urdf().parent_path() / "hrp2.yaml";
  std::string text = ReadText(yaml);
  WriteText(yaml, text.substr(0, text.find("effort_limits_n_m:")));
  text = ReadText(run.urdf());
  WriteText(run.urdf(), AllReplaced(text, "effort=\"0\"", "effort=\"1e-6\""));
  run.EditCertificate([](TamperedRun::Table& table) {
    for (auto& row : table) {
      if (row[2] == "torque") row[5] = row[6] = "0";
    }
  });
  run.EditTrajectory([](TamperedRun::Table& table) {
    const auto& header = table.front();
    const auto column = std::find(header.begin(), header.end(), "torque_margin_n_m");
    const auto at = static_cast<size_t>(column - header.begin());
    for (size_t row = 1; row < table.size(); ++row) table[row][at] = "0";
  });
  run.Rehash();
  const verify::MethodVerification result = Verified(run);
  EXPECT_FALSE(result.verified);
  EXPECT_THAT(result.reasons, Contains(HasSubstr("joint torques: ")));
  EXPECT_THAT(result.reasons, Contains(HasSubstr("torque_margin_n_m is 0, but -0.000")));
}

// A millimetre is a fiftieth of such a leg.
TEST(VerifySize, ARowThatIsOffByAHairOfHrp2sIsRefused) {
  TamperedRun run(WalkOf(kSmall));
  run.EditTrajectory([](TamperedRun::Table& table) {
    double zmp = std::stod(table[table.size() / 2][10]);
    table[table.size() / 2][10] = ShortestText(zmp + 5e-9);
  });
  run.Rehash();
  EXPECT_THAT(Verified(run).reasons, Contains(HasSubstr("zmp is off the walk")));
}

TEST(Tolerances, AreThoseOfHrp2TimesItsSize) {
  const verify::Tolerances hrp2(LoadRobot(InSources("wpg/robots/hrp2.yaml")));
  EXPECT_NEAR(hrp2.size, 1, 1e-3);
  EXPECT_NEAR(hrp2.played, 1e-3, 1e-6);
  EXPECT_NEAR(hrp2.torque, 1e-3, 1e-4);
  const TamperedRun run(WalkOf(kSmall));
  const RobotModel robot = LoadRobot((run.urdf().parent_path() / "hrp2.yaml").string());
  const verify::Tolerances small(robot);
  EXPECT_NEAR(small.size, kSmall * hrp2.size, 1e-6);
  EXPECT_NEAR(small.length, 1e-9 * kSmall, 1e-14);
  EXPECT_NEAR(small.torque, std::pow(kSmall, 4) * hrp2.torque, 1e-3 * small.torque);
  EXPECT_NEAR(small.momentum_step, 2e-3 * std::sqrt(kSmall), 1e-6);
  RobotModel weak = robot;
  weak.legs[0].joints[0].max_torque = 1e-9;
  EXPECT_NEAR(verify::Tolerances(weak).torque, 1e-12, 1e-18);
}

}  // namespace
}  // namespace halfstep
