#include "experiments/verify/check_chosen.h"

#include <algorithm>
#include <cmath>

#include "smoothing/methods/solver_method_options.h"

namespace halfstep::verify {
namespace {

constexpr double kMoved = 1e-9;  // of a number that is written in two tables

}  // namespace

void CheckChosen(const std::string& method, const std::vector<HalfStepRow>& half_steps,
                 const WalkPlan& planned, const SmoothingConfig& config, Findings* findings) {
  if (method == "given") return;
  const ParameterChoice& choice = config.options.Get(OptimizerGroup()).options.program.parameters;
  const auto is_fixed = [&](const std::string& name, size_t index) {
    return std::ranges::any_of(config.fixed, [&](const FixedConfig& one) {
      return one.parameter == name && one.index == static_cast<int>(index) + 1;
    });
  };
  Faults faults;
  const auto look = [&](size_t i, const char* key, const std::string& name, size_t index,
                        double value, double plan) {
    if (std::abs(value - plan) <= kMoved || is_fixed(name, index)) return;
    faults.Add(
        Formatted("half_steps.csv:%zu: %s is %.9g, planned %.9g, and config.yaml does not "
                  "let it move (smoothing.optimizer.%s: false)",
                  i + 2, name.c_str(), value, plan, key));
  };
  for (size_t i = 0; i < half_steps.size(); ++i) {
    const HalfStep& plan = planned.half_steps[i].half_step;
    const FormColumns is = half_steps[i].FormOf(plan), as_planned = plan.form;
    for (const FormColumn& form : kAllFormColumns) {
      if (choice.moves(form.key)) continue;
      look(i, form.key, form.name, form.of_step() ? i / 2 : i, is.*form.value,
           as_planned.*form.value);
    }
    if (!choice.support_points) {
      look(i, "support_points", "support_point", i / 2, half_steps[i].support_point,
           plan.support_point);
    }
    if (choice.footsteps) continue;
    look(i, "footsteps", "footstep_x", i / 2, is.footstep.x, 0);
    look(i, "footsteps", "footstep_y", i / 2, is.footstep.y, 0);
    look(i, "footsteps", "footstep_yaw", i / 2, is.footstep.yaw, 0);
  }
  faults.Conclude(findings);
  findings->Say("forms and footsteps: moved only where config.yaml lets methods move them");
}

}  // namespace halfstep::verify
