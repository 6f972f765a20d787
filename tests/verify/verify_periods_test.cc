// Right walks are verified whatever their period, or said to be too coarse; wrong ones never.

#include <gmock/gmock.h>

#include "experiments/commands/commands.h"
#include "tests/verify/verify_mutation.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

using testing::HasSubstr;

struct Case {
  std::string name;
  TamperedWalk walk;
  bool verified = true;  ///< else its rows are too coarse
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

std::vector<Case> Cases() {
  const std::string fig4 = "fig4_raw_sequence";
  const std::string few =  // of its footsteps
      "footsteps=[{foot: right, x_m: 0.0978, y_m: -0.1013, yaw_deg: 4.30}, "
      "{foot: left, x_m: 0.1636, y_m: 0.1173, yaw_deg: 8.59}, "
      "{foot: right, x_m: 0.2912, y_m: -0.0721, yaw_deg: 12.89}]";
  return {{"RowsEvery10ms", {.overrides = {"output.period_s=0.01"}}},
          {"RowsEvery50ms", {.overrides = {"output.period_s=0.05"}}, false},
          {"ZmpShiftsIn20ms",
           {.config = fig4,
            .overrides = {few, "half_step.zmp_shift_s=0.02", "smoothing.profile=limit",
                          "output.period_s=0.005"}}},
          {"RowsAsTheZmpShifts",
           {.overrides = {"half_step.zmp_shift_s=0.02", "smoothing.profile=limit"}}},
          {"ZmpShiftsIn46ms",
           {.config = fig4,
            .overrides = {few, "half_step.zmp_shift_s=0.046", "smoothing.profile=limit"}}},
          {"LowRobot", {.config = fig4, .overrides = {few}, .com_height = 0.577}}};
}

class Periods : public testing::TestWithParam<Case> {};

TEST_P(Periods, WhatIsRightIsNotRefused) {
  const TamperedRun run(GetParam().walk);
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, GetParam().verified ? kSuccess : kTooCoarse)
      << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(GetParam().verified ? "\n  verified\n" : "too coarse"));
}

// Where the config does not say how far rows are apart, quick shifts of the ZMP do.
TEST(RowPeriod, IsFineWhereTheZmpShiftsWithinFiveRows) {
  for (const auto& [shift, period] : {std::pair{"0.024", 0.001}, {"0.026", 0.005}}) {
    TamperedRun run(
        {.overrides = {std::string("half_step.zmp_shift_s=") + shift, "smoothing.profile=limit"}});
    run.EditTrajectory([&](TamperedRun::Table& table) {
      EXPECT_EQ(std::stod(table[2][0]), period) << shift;
      EXPECT_EQ(std::stod(table[101][0]), 100 * period) << shift;
    });
  }
}

// One row's knee bent by 10 mrad, the CoM a millimetre aside, its acceleration changed by 0.05
// m/s²: all hashes follow.
TEST_P(Periods, WhatIsWrongIsRefused) {
  for (const auto& [column, change] :
       {std::pair{"q_RLEG_JOINT3_rad", 0.01}, std::pair{"com_y_m", 0.001},
        std::pair{"com_ax_m_s2", 0.05}}) {
    TamperedRun run(GetParam().walk);
    run.EditTrajectory([&](TamperedRun::Table& table) {
      const auto& header = table.front();
      const auto at =
          static_cast<size_t>(std::find(header.begin(), header.end(), column) - header.begin());
      std::string& cell = table[table.size() / 2][at];
      cell = ShortestText(std::stod(cell) + change);
    });
    run.Rehash();
    const Outcome outcome = run.Verify();
    EXPECT_EQ(outcome.status, kNotVerified) << column << "\n" << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("off the walk of half_steps.csv"));
  }
}

INSTANTIATE_TEST_SUITE_P(Verify, Periods, testing::ValuesIn(Cases()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace halfstep
