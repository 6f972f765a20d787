#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/verify/described_walk.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/experiments/child_process.h"
#include "tests/verify/plan_of.h"

namespace halfstep::verify {

/// Two shipped experiments.
inline const Experiment& Fig5() {
  static const Experiment experiment = Prepare(LoadConfig(ShippedConfig("fig5_box"), {}));
  return experiment;
}
inline const Experiment& Fig4() {
  static const Experiment experiment = Prepare(LoadConfig(ShippedConfig("fig4_raw_sequence"), {}));
  return experiment;
}

/// What half_steps.csv would say of a walk.
inline std::vector<HalfStepRow> RowsOf(const SuperposedWalk& walk) {
  std::vector<HalfStepRow> rows;
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    const auto n = static_cast<size_t>(i);
    rows.push_back(
        {i % 2 == 0 ? "up" : "down", std::string(Name(walk.half_step(i).support)), walk.start_of(i),
         walk.parameters().durations[n], walk.parameters().height_scales[n / 2],
         walk.parameters().support_points[n / 2],
         FormColumns{walk.parameters().of(ParameterFamily::kViaLateral)[n / 2],
                     walk.parameters().of(ParameterFamily::kFootRamp)[n],
                     walk.parameters().of(ParameterFamily::kFootDelay)[n],
                     walk.parameters().of(ParameterFamily::kLiftShare)[n],
                     walk.parameters().of(ParameterFamily::kViaAlong)[n / 2],
                     walk.parameters().zmp_shifts[n],
                     walk.parameters().of(ParameterFamily::kZmpBumpRamp)[n],
                     {walk.parameters().footstep_xs[n / 2], walk.parameters().footstep_ys[n / 2],
                      walk.parameters().footstep_yaws[n / 2]},
                     walk.parameters().of(ParameterFamily::kRiseBegin)[n],
                     walk.parameters().of(ParameterFamily::kRiseEnd)[n]},
         true});
  }
  return rows;
}

}  // namespace halfstep::verify
