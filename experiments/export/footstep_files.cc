#include "experiments/export/footstep_files.h"

#include "experiments/export/message_float.h"
#include "wpg/files/input_error.h"
#include "wpg/nth.h"

namespace halfstep {

std::string StepTargetsYaml(const HalfStepSequence& sequence) {
  std::string text = "footsteps:\n";
  for (int step = 0; step < sequence.num_steps(); ++step) {
    const PlacedHalfStep& down = Nth(sequence.half_steps, 2 * step + 1);
    const Foothold X_WF = down.X_WS * down.half_step.X_SF;
    if (X_WF.height != 0.0) {
      throw InputError(
          {"humanoid_nav_msgs: has no heights (valid: footsteps at z = 0; the format "
           "`footsteps` for others)"});
    }
    text += "- pose: {x: " + MessageFloat(X_WF.x) + ", y: " + MessageFloat(X_WF.y) +
            ", theta: " + MessageFloat(X_WF.yaw) +
            "}\n  leg: " + (down.half_step.swing() == Side::kLeft ? "1" : "0") + "\n";
  }
  return text;
}

}  // namespace halfstep
