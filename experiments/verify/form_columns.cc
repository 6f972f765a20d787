#include "experiments/verify/form_columns.h"

namespace halfstep::verify {

const std::array<FormColumn, 7>& AllFormColumns() {
  using C = FormColumns;
  using S = HalfStepShape;
  static constexpr std::array<FormColumn, 7> kColumns = {{
      {"via_lateral", "via_laterals", "via_lateral_m", &C::via_lateral, &HalfStep::via_lateral,
       nullptr, 0.01, 1, "via point at ", "", "another via point"},
      {"foot_ramp", "foot_ramps", "foot_ramp", &C::foot_ramp, nullptr, &S::foot_ramp, 0.1, 0.5,
       "foot ramp ", "", nullptr},
      {"foot_delay", "foot_delays", "foot_delay", &C::foot_delay, nullptr, &S::foot_delay, 0, 0.2,
       "foot delay ", "", nullptr},
      {"lift_share", "lift_shares", "lift_share", &C::lift_share, nullptr, &S::lift_share, 0.2, 1,
       "lift share ", "", nullptr},
      {"via_along", "via_alongs", "via_along_m", &C::via_along, &HalfStep::via_along, nullptr, -0.5,
       0.5, "via point ", " ahead", "a via point elsewhere along"},
      {"zmp_shift", "zmp_shifts", "zmp_shift", &C::zmp_shift, nullptr, &S::shift, 0.01, 0.5,
       "ZMP's shift ", "", nullptr},
      {"zmp_bump_ramp", "zmp_bump_ramps", "zmp_bump_ramp", &C::zmp_bump_ramp, nullptr,
       &S::bump_ramp, 0.1, 1, "ZMP's bump ramp ", "", nullptr},
  }};
  return kColumns;
}

FormColumns PlannedForm(const HalfStep& planned) {
  HalfStep half_step = planned;
  FormColumns form;
  for (const FormColumn& one : AllFormColumns()) form.*one.value = one.in(&half_step);
  return form;
}

}  // namespace halfstep::verify
