#include <cmath>
#include <limits>

#include "tests/verify/wrong_material.h"

namespace halfstep::verify {

std::vector<Wrong> WrongSteps() {
  const Of check = Of::kOverlaps;
  return {
      {"StartDoesNotFollow", check, [](Material& m) { m.half_steps[1].start += 1e-6; },
       "half_steps.csv:3: start"},
      {"OverlapBeyondItsBound", check, [](Material& m) { (*m.overlaps)[0].overlap = 1; },
       "overlaps.csv:2: overlap"},
      {"HeightsOfAStepDiffer", check, [](Material& m) { m.half_steps[1].height_scale = 0.9; },
       "overlaps.csv:2: durations"},
      {"HeightsOfAStepDifferInHalfSteps", check,
       [](Material& m) { m.half_steps[1].height_scale = 0.9; },
       "half_steps.csv:3: another height scale"},
      {"SupportPointsOfAStepDiffer", check,
       [](Material& m) { m.half_steps[1].support_point += 1e-6; },
       "half_steps.csv:3: another support point"},
      {"SupportPointNotANumber", check, [](Material& m) { m.half_steps[0].support_point = NAN; },
       "half_steps.csv:2: a number is not finite"},
      {"RawHalfStepRestsElsewhere", check,
       [](Material& m) {
         m.overlaps.reset();
         m.half_steps[0].duration = m.planned.half_steps[0].half_step.duration;
         m.half_steps[0].height_scale = 1;
         m.half_steps[0].support_point = 0.01;
       },
       "half_steps.csv:2: support point"},
      {"ViaPointsOfAStepDiffer", check,
       [](Material& m) {
         for (size_t i : {0, 1}) {
           m.half_steps[i].form = m.half_steps[i].FormOf(m.planned.half_steps[i].half_step);
         }
         m.half_steps[1].form->via_lateral += 1e-6;
       },
       "half_steps.csv:3: another via point"},
      {"ViaPointsOfAStepDifferAlong", check,
       [](Material& m) {
         for (size_t i : {0, 1}) {
           m.half_steps[i].form = m.half_steps[i].FormOf(m.planned.half_steps[i].half_step);
         }
         m.half_steps[1].form->via_along += 1e-6;
       },
       "half_steps.csv:3: a via point elsewhere along"},
      {"OverlapBeyondTheBoundOfALongerShift", check,
       [](Material& m) {
         for (size_t i : {0, 1}) {
           m.half_steps[i].form = m.half_steps[i].FormOf(m.planned.half_steps[i].half_step);
           m.half_steps[i].form->zmp_shift = 0.5;
         }
       },
       "overlaps.csv:2: overlap"},
      {"ZmpShiftOfNoHalfStep", check,
       [](Material& m) {
         m.half_steps[0].form = m.half_steps[0].FormOf(m.planned.half_steps[0].half_step);
         m.half_steps[0].form->zmp_shift = NAN;
       },
       "half_steps.csv:2: ZMP's shift nan"},
      {"ZmpBumpOfNoHalfStep", check,
       [](Material& m) {
         m.half_steps[0].form = m.half_steps[0].FormOf(m.planned.half_steps[0].half_step);
         m.half_steps[0].form->zmp_bump_ramp = 1.1;
       },
       "half_steps.csv:2: ZMP's bump ramp 1.1"},
      {"FormNotANumber", check,
       [](Material& m) { m.half_steps[0].form = FormColumns{0.24, NAN, 0.1, 1, 0, 0.05, 1}; },
       "half_steps.csv:2: foot ramp nan"},
      {"FormOfNoHalfStep", check,
       [](Material& m) { m.half_steps[0].form = FormColumns{0.24, 0.5, 0.1, 0.1, 0, 0.05, 1}; },
       "half_steps.csv:2: lift share 0.1"},
      {"RawHalfStepInAForm", check,
       [](Material& m) {
         m.overlaps.reset();
         m.half_steps[0].duration = m.planned.half_steps[0].half_step.duration;
         m.half_steps[0].height_scale = 1;
         m.half_steps[0].form = FormColumns{0.24, 0.4, 0.1, 1, 0, 0.05, 1};
       },
       "half_steps.csv:2: a form that is not planned"},
      {"OverlapNegative", check, [](Material& m) { (*m.overlaps)[0].overlap = -3601; },
       "overlaps.csv:2: overlap"},
      {"OverlapOfAnotherKind", check, [](Material& m) { (*m.overlaps)[0].kind = "down_up"; },
       "overlaps.csv:2: kind"},
      {"OverlapBetweenOtherDurations", check,
       [](Material& m) { (*m.overlaps)[0].duration_after += 0.1; }, "overlaps.csv:2: durations"},
      {"DurationNegative", check, [](Material& m) { m.half_steps[0].duration = -1; },
       "half_steps.csv:2: duration"},
      {"DurationInfinite", check,
       [](Material& m) { m.half_steps[0].duration = std::numeric_limits<double>::infinity(); },
       "half_steps.csv:2: a number is not finite"},
      {"HeightNegative", check, [](Material& m) { m.half_steps[0].height_scale = -1; },
       "half_steps.csv:2: height scale"},
      {"RawHalfStepShorter", check,
       [](Material& m) {
         m.overlaps.reset();
         m.half_steps[0].duration = 0.75 * m.planned.half_steps[0].half_step.duration;
       },
       "half_steps.csv:2: duration"},
      {"RawHalfStepLower", check,
       [](Material& m) {
         m.overlaps.reset();
         m.half_steps[0].duration = m.planned.half_steps[0].half_step.duration;
         m.half_steps[0].height_scale = 0.9;
       },
       "half_steps.csv:2: height scale"},
      {"KindTurned", check, [](Material& m) { m.half_steps[0].kind = "down"; },
       "half_steps.csv:2: kind"},
      {"SupportTurned", check, [](Material& m) { m.half_steps[0].support = "right"; },
       "half_steps.csv:2: support"},
      {"FootstepMoved", check, [](Material& m) { m.footsteps[2].X_WF.x += 1e-6; },
       "footsteps.csv:4: "},
      {"FootstepFewer", check, [](Material& m) { m.footsteps.pop_back(); },
       "footsteps.csv: 2 rows"},
  };
}

}  // namespace halfstep::verify
