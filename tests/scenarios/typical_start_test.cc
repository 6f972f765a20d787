#include "smoothing/methods/typical_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "smoothing/walk/parameter_complaint.h"
#include "tests/scenarios/load_experiment.h"

namespace halfstep {
namespace {

class TypicalStartTest : public testing::Test {
 protected:
  HomotopyParameters Typical(const ParameterChoice& choice,
                             const std::vector<FixedParameter>& fixed = {},
                             const TypicalForm* form = nullptr) const {
    return TypicalStart(e_.sequence, ParameterTable(e_.sequence, fixed, choice), e_.robot, form);
  }
  static ParameterChoice Everything() {
    ParameterChoice choice = EveryFamily();
    choice.bound("least_duration") = 0.2;
    return choice;
  }

  const Experiment e_ = LoadExperiment("bar_8cm");
  const HomotopyParameters planned_ = PlannedMotion(e_.sequence);
};

TEST_F(TypicalStartTest, IsAPointOfTheHomotopyWithinItsRanges) {
  const ParameterTable table(e_.sequence, {}, Everything());
  for (const TypicalForm& form : TypicalForms()) {
    const HomotopyParameters start = Typical(Everything(), {}, &form);
    EXPECT_EQ(ComplaintAbout(e_.sequence, start), "") << form.name;
    for (const ParameterRow& row : table.rows()) {
      EXPECT_GE(row.parameter.in(start), row.lower) << form.name;
      EXPECT_LE(row.parameter.in(start), row.upper) << form.name;
    }
    for (int i = 0; i < e_.sequence.num_junctions(); ++i) {
      const bool up_down = KindOfJunction(i) == JunctionKind::kUpDown;
      EXPECT_NEAR(start.overlaps[static_cast<size_t>(i)],
                  (up_down ? form.up_down : form.down_up) * NaturalOverlapBound(start, i), 1e-12);
    }
  }
}

// Without a form each step has its own.
TEST_F(TypicalStartTest, StepsHaveTheirForms) {
  const HomotopyParameters start = Typical(Everything());
  const TypicalForm& form = FormOfStep(e_.sequence, 0);
  EXPECT_EQ(start.height_scales[0], form.height_scale);
  EXPECT_EQ(start.of(ParameterFamily::kFootRamp)[0], form.foot_ramp);
  EXPECT_EQ(start.of(ParameterFamily::kLiftShare)[0], form.lift_share);
  EXPECT_LT(start.durations[0], planned_.durations[0]);
  const HomotopyParameters slow = Typical(Everything(), {}, &TypicalForms().back());
  EXPECT_LT(DurationOf(start), DurationOf(slow));
  EXPECT_LT(DurationOf(slow), DurationOf(planned_));
}

// Times go with the root of the pendulum's height, lengths with the robot's own.
TEST_F(TypicalStartTest, FormsAreScaledToTheRobot) {
  const HomotopyParameters start = Typical(Everything());
  RobotModel robot = e_.robot;
  robot.com_height *= 0.81;
  robot.standing_width *= 0.9;
  const HomotopyParameters smaller =
      TypicalStart(e_.sequence, ParameterTable(e_.sequence, {}, Everything()), robot);
  EXPECT_NEAR(smaller.durations[0], 0.9 * start.durations[0], 1e-12);
  EXPECT_NEAR(smaller.support_points[0], 0.9 * start.support_points[0], 1e-12);
  EXPECT_EQ(smaller.height_scales, start.height_scales);
}

TEST_F(TypicalStartTest, WhatIsFixedStays) {
  using Family = HomotopyParameter::Family;
  const HomotopyParameters start = Typical(Everything(), {{{Family::kDuration, 3}, 1.9},
                                                          {{Family::kHeightScale, 1}, 0.7},
                                                          {{Family::kOverlap, 5}, 0.1}});
  EXPECT_EQ(start.durations[3], 1.9);
  EXPECT_EQ(start.height_scales[1], 0.7);
  EXPECT_EQ(start.overlaps[5], 0.1);
  EXPECT_LT(start.durations[2], 1.9);
  EXPECT_LT(start.height_scales[0], 0.7);
}

TEST_F(TypicalStartTest, FamiliesThatAreNotMovedStayPlanned) {
  const HomotopyParameters start = Typical({.heights = true});
  EXPECT_NE(start.height_scales, planned_.height_scales);
  EXPECT_NE(start.overlaps, planned_.overlaps) << "overlaps always move";
  for (const ParameterFamily family : AllParameterFamilies()) {
    if (family == ParameterFamily::kHeightScale || family == ParameterFamily::kOverlap) continue;
    EXPECT_EQ(start.of(family), planned_.of(family)) << Traits(family).name;
  }
  ParameterChoice no_shorter{.durations = true};
  no_shorter.bound("least_duration") = 1.0;
  EXPECT_EQ(Typical(no_shorter).durations, planned_.durations);
}

}  // namespace
}  // namespace halfstep
