#include "smoothing/walk/homotopy_parameters.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "smoothing/walk/parameter_complaint.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/motion/lipm.h"

namespace halfstep {
namespace {

using Family = HomotopyParameter::Family;

// Three steps of 2.0, 1.0 and 3.0 s a half-step; t1 = 0.45 T, t2 = 0.55 T.
HalfStepSequence ThreeSteps() {
  std::vector<Footstep> footsteps = {
      {.side = Side::kRight, .X_WF = Foothold::Level({0.2, -0.105, 0})},
      {.side = Side::kLeft, .X_WF = Foothold::Level({0.2, 0.105, 0})},
      {.side = Side::kRight, .X_WF = Foothold::Level({0.2, -0.105, 0})}};
  footsteps[1].duration = 1.0;
  footsteps[2].duration = 3.0;
  return MakeSequence(StandingFeet(), footsteps, 0.24, {.shift = 0.1, .support_point = 0.02},
                      std::make_shared<Lipm>());
}

TEST(HomotopyParameters, PlannedMotionHasNoOverlapFullHeightAndTheRestAsPlanned) {
  const HomotopyParameters planned = PlannedMotion(ThreeSteps());
  EXPECT_EQ(planned.overlaps, std::vector<double>(5, 0.0));
  EXPECT_EQ(planned.height_scales, std::vector<double>(3, 1.0));
  EXPECT_EQ(planned.durations, (std::vector<double>{2, 2, 1, 1, 3, 3}));
  EXPECT_EQ(planned.support_points, std::vector<double>(3, 0.02));
  EXPECT_EQ(planned.of(ParameterFamily::kViaAlong), std::vector<double>(3, 0.0));
  EXPECT_EQ(planned.zmp_shifts, std::vector<double>(6, 0.1));
  EXPECT_EQ(planned.of(ParameterFamily::kZmpBumpRamp), std::vector<double>(6, 1.0));
}

TEST(HomotopyParameters, EachParameterIsNamedOnceAndReachesItsOwnValue) {
  const HalfStepSequence sequence = ThreeSteps();
  const std::vector<HomotopyParameter> all = AllParameters(sequence);
  ASSERT_EQ(all.size(), 5u + 3u + 6u + 3u + 3u + 3u * 6u + 3u + 2u * 6u + 3u * 3u);
  HomotopyParameters parameters = PlannedMotion(sequence);
  for (size_t i = 0; i < all.size(); ++i) all[i].in(parameters) = static_cast<double>(i);
  EXPECT_EQ(parameters.overlaps, (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_EQ(parameters.height_scales, (std::vector<double>{5, 6, 7}));
  EXPECT_EQ(parameters.durations, (std::vector<double>{8, 9, 10, 11, 12, 13}));
  EXPECT_EQ(parameters.support_points, (std::vector<double>{14, 15, 16}));
  EXPECT_EQ(parameters.of(ParameterFamily::kViaLateral), (std::vector<double>{17, 18, 19}));
  EXPECT_EQ(parameters.of(ParameterFamily::kFootRamp),
            (std::vector<double>{20, 21, 22, 23, 24, 25}));
  EXPECT_EQ(parameters.of(ParameterFamily::kFootDelay).front(), 26);
  EXPECT_EQ(parameters.of(ParameterFamily::kLiftShare).back(), 37);
  EXPECT_EQ(parameters.of(ParameterFamily::kViaAlong), (std::vector<double>{38, 39, 40}));
  EXPECT_EQ(parameters.zmp_shifts.front(), 41);
  EXPECT_EQ(parameters.of(ParameterFamily::kZmpBumpRamp).back(), 52);
  EXPECT_EQ(parameters.footstep_xs.front(), 53);
  EXPECT_EQ(parameters.footstep_ys, (std::vector<double>{56, 57, 58}));
  EXPECT_EQ(parameters.footstep_yaws.back(), 61);
  const HomotopyParameter beyond{Family::kHeightScale, 3};
  EXPECT_THROW(beyond.in(parameters), std::out_of_range);
}

TEST(NaturalOverlapBound, ByHand) {
  const HalfStepSequence sequence = ThreeSteps();
  const HomotopyParameters planned = PlannedMotion(sequence);
  const double expected[] = {0.9, 1.0, 0.45, 1.0, 1.35};
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(KindOfJunction(i), i % 2 == 0 ? JunctionKind::kUpDown : JunctionKind::kDownUp);
    EXPECT_NEAR(NaturalOverlapBound(planned, i), expected[i], 1e-15);
  }
  // The durations given count, not the planned ones.
  HomotopyParameters given = planned;
  given.durations = {2, 1, 0.5, 4, 4, 4};
  const double changed[] = {0.45, 0.5, 0.225, 4, 1.8};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(NaturalOverlapBound(given, i), changed[i], 1e-15);
  }
  // So do their ZMPs' shifts, up→down only.
  HomotopyParameters shifted = planned;
  shifted.zmp_shifts = {0.2, 0.1, 0.1, 0.3, 0.05, 0.02};
  const double moved[] = {0.8, 1.0, 0.35, 1.0, 1.425};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(NaturalOverlapBound(shifted, i), moved[i], 1e-15);
  }
}

TEST(CheckParameters, AcceptsAllThatIsInBoundsBothEndsIncluded) {
  WalkDraw draw(10);
  for (int i = 0; i < 200; ++i) {
    const HalfStepSequence sequence = draw.Sequence(3);
    EXPECT_NO_THROW(CheckParameters(sequence, draw.ExtremeParameters(sequence)));
    EXPECT_NO_THROW(CheckParameters(sequence, PlannedMotion(sequence)));
  }
}

TEST(ComplaintAbout, NamesTheParameterItsValueAndWhatIsValid) {
  const HalfStepSequence sequence = ThreeSteps();
  const auto complaint = [&](const std::function<void(HomotopyParameters*)>& fault) {
    HomotopyParameters parameters = PlannedMotion(sequence);
    fault(&parameters);
    return ComplaintAbout(sequence, parameters);
  };
  EXPECT_EQ(complaint([](auto*) {}), "");
  EXPECT_EQ(complaint([](auto* p) { p->durations.pop_back(); }),
            "durations: 5 numbers (valid: 6, for 6 half-steps)");
  EXPECT_EQ(complaint([](auto* p) { p->durations[2] = -1; }),
            "durations[2]: -1 s (valid: above 0 s)");
  const std::string overlap = complaint([](auto* p) { p->overlaps[0] = 7; });
  EXPECT_EQ(overlap.find("overlaps[0]: 7 s (valid: at most 0.9 s, the natural bound"), 0u)
      << overlap;
}

TEST(CheckParameters, RefusesEachSingleFault) {
  const HalfStepSequence sequence = ThreeSteps();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::function<void(HomotopyParameters*)>> faults = {
      [](auto* p) { p->overlaps.pop_back(); },
      [](auto* p) { p->height_scales.push_back(1); },
      [](auto* p) { p->durations.pop_back(); },
      [](auto* p) { p->overlaps[0] = -kLongestRest - 1; },
      [](auto* p) { p->overlaps[0] = 0.9 + 1e-9; },
      [](auto* p) { p->overlaps[1] = 1.0 + 1e-9; },
      [](auto* p) { p->overlaps[4] = 1.35 + 1e-9; },
      [=](auto* p) { p->overlaps[2] = nan; },
      [](auto* p) { p->height_scales[1] = -0.1; },
      [=](auto* p) { p->height_scales[1] = nan; },
      [=](auto* p) { p->height_scales[1] = infinity; },
      [](auto* p) { p->support_points.pop_back(); },
      [](auto* p) { p->support_points[2] = -1.1; },
      [](auto* p) { p->of(ParameterFamily::kViaLateral)[0] = 0.0; },
      [](auto* p) { p->of(ParameterFamily::kFootRamp)[5] = 0.51; },
      [](auto* p) { p->of(ParameterFamily::kFootDelay)[1] = 0.21; },
      [](auto* p) { p->of(ParameterFamily::kLiftShare)[3] = 0.19; },
      [](auto* p) { p->of(ParameterFamily::kLiftShare).pop_back(); },
      [](auto* p) { p->of(ParameterFamily::kViaAlong)[2] = 0.51; },
      [](auto* p) { p->zmp_shifts[4] = 0.009; },
      [](auto* p) { p->overlaps[0] = 0.9, p->zmp_shifts[1] = 0.12; },
      [](auto* p) { p->of(ParameterFamily::kZmpBumpRamp)[0] = 1.01; },
      [](auto* p) { p->of(ParameterFamily::kZmpBumpRamp).pop_back(); },
      [](auto* p) { p->footstep_xs[1] = 0.51; },
      [](auto* p) { p->footstep_ys[0] = -0.51; },
      [=](auto* p) { p->footstep_yaws[2] = nan; },
      [](auto* p) { p->footstep_yaws.pop_back(); },
      [=](auto* p) { p->support_points[2] = nan; },
      [](auto* p) { p->durations[3] = 0; },
      [](auto* p) { p->durations[3] = -1; },
      [=](auto* p) { p->durations[3] = nan; },
      [](auto* p) { p->overlaps[0] = 0.5, p->durations[1] = 1.1; }};
  for (size_t i = 0; i < faults.size(); ++i) {
    HomotopyParameters parameters = PlannedMotion(sequence);
    faults[i](&parameters);
    EXPECT_THROW(CheckParameters(sequence, parameters), std::logic_error) << "fault " << i;
  }
}

}  // namespace
}  // namespace halfstep
