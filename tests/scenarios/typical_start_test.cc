#include "smoothing/methods/typical_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "smoothing/walk/parameter_complaint.h"
#include "tests/places.h"
#include "tests/scenarios/load_experiment.h"

namespace halfstep {
namespace {

class TypicalStartTest : public testing::Test {
 protected:
  HomotopyParameters Typical(const ParameterChoice& choice,
                             const std::vector<FixedParameter>& fixed = {},
                             const TypicalForm* form = nullptr) const {
    return In(e_.robot, e_.scene, choice, fixed, form);
  }
  HomotopyParameters In(const RobotModel& robot, const Scene& scene, const ParameterChoice& choice,
                        const std::vector<FixedParameter>& fixed = {},
                        const TypicalForm* form = nullptr) const {
    const WalkProblem problem(robot, scene, e_.sequence, e_.config.smoothing.limits, fixed);
    MarginEvaluator::Scratch scratch = problem.evaluator().MakeScratch();
    return TypicalStart(problem, choice, &scratch, form);
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

// Without a form each step has its own: by what it does, or that over an obstacle that it would
// touch.
TEST_F(TypicalStartTest, StepsHaveTheirForms) {
  const HomotopyParameters free = In(e_.robot, {}, Everything());
  const HomotopyParameters over_bar = Typical(Everything());
  const auto form = [](std::string_view name) {
    const auto forms = TypicalForms();
    return *std::find_if(forms.begin(), forms.end(),
                         [&](const TypicalForm& f) { return f.name == name; });
  };
  int over = 0;
  for (int j = 0; j < e_.sequence.num_steps(); ++j) {
    const size_t at = static_cast<size_t>(j);
    EXPECT_EQ(free.height_scales[at], FormOfStep(e_.sequence, j, e_.robot).height_scale);
    if (over_bar.height_scales[at] == free.height_scales[at]) continue;
    EXPECT_EQ(over_bar.height_scales[at], form("over").height_scale) << j;
    EXPECT_EQ(over_bar.of(ParameterFamily::kLiftShare)[2 * at + 1], form("over").lift_share[1]);
    ++over;
  }
  EXPECT_GT(over, 0);
  EXPECT_LT(over, e_.sequence.num_steps());
  const HomotopyParameters slow = Typical(Everything(), {}, &TypicalForms().back());
  EXPECT_LT(DurationOf(free), DurationOf(slow));
  EXPECT_LT(DurationOf(free), DurationOf(over_bar));
  EXPECT_LT(std::max(DurationOf(over_bar), DurationOf(slow)), DurationOf(planned_));
}

// What notebooks-data/typical_forms.py measured is what searches begin with.
TEST(TypicalForms, AreThoseThatWereMeasured) {
  std::ifstream table(InSources("notebooks-data/drawn_walks/typical_forms.csv"));
  std::string line, cell;
  ASSERT_TRUE(std::getline(table, line));  // its header
  for (const TypicalForm& form : TypicalForms()) {
    if (form.name == "high") break;
    ASSERT_TRUE(std::getline(table, line)) << form.name;
    std::istringstream cells(line);
    std::getline(cells, cell, ',');
    EXPECT_EQ(cell, form.name);
    std::getline(cells, cell, ',');  // how many steps
    std::vector<double> values = {form.up_down,       form.down_up,     form.height_scale,
                                  form.support_point, form.via_lateral, form.via_along};
    for (const auto& halves : {form.duration, form.foot_ramp, form.foot_delay, form.lift_share,
                               form.zmp_shift, form.zmp_bump_ramp}) {
      values.insert(values.end(), halves.begin(), halves.end());
    }
    for (const double value : values) {
      ASSERT_TRUE(std::getline(cells, cell, ',')) << form.name;
      EXPECT_DOUBLE_EQ(std::stod(cell), value) << form.name;
    }
    EXPECT_FALSE(std::getline(cells, cell, ','));
  }
  EXPECT_FALSE(std::getline(table, line));
}

TEST_F(TypicalStartTest, FormsGoByWhatAStepDoes) {
  const auto names = [this](const std::vector<Footstep>& footsteps) {
    const HalfStepSequence walk =
        MakeSequence(e_.sequence.start, footsteps, 0.24, {}, e_.sequence.model);
    std::vector<std::string_view> of;
    for (int j = 0; j < walk.num_steps(); ++j) of.push_back(FormOfStep(walk, j, e_.robot).name);
    return of;
  };
  const auto to = [](Side side, double x, double y, double yaw) {
    return Footstep{.side = side, .X_WF = Foothold::Level({x, y, yaw})};
  };
  const double w = 0.5 * e_.robot.standing_width;
  EXPECT_EQ(
      names({to(Side::kRight, 0.1, -w, 0), to(Side::kLeft, 0.2, w, 0),
             to(Side::kRight, 0.3, -w, -0.4), to(Side::kLeft, 0.1, w, 0.0),
             to(Side::kRight, 0.3, -w - 0.15, -0.4), to(Side::kLeft, 0.3, w, -0.4)}),
      (std::vector<std::string_view>{"first", "level", "turning", "backward", "sideways", "last"}));
}

// Times go with the root of the pendulum's height, lengths with the robot's own.
TEST_F(TypicalStartTest, FormsAreScaledToTheRobot) {
  const HomotopyParameters start = In(e_.robot, {}, Everything());
  RobotModel robot = e_.robot;
  robot.com_height *= 0.81;
  robot.standing_width *= 0.9;
  const HomotopyParameters smaller = In(robot, {}, Everything());
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
  // That of a form beside the fixed one, here the one over obstacles.
  const auto over = std::ranges::find(TypicalForms(), "over", &TypicalForm::name);
  EXPECT_EQ(start.height_scales[0], over->height_scale);
  EXPECT_NE(start.height_scales[0], start.height_scales[1]);
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
