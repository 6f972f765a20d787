#include "experiments/survey/six_steps_config.h"

#include "experiments/survey/self_gaps.h"
#include "experiments/survey/stance_search.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/files/text.h"

namespace halfstep {

std::string SixStepsConfig(const RobotModel& robot, const std::string& robot_file) {
  const HalfStepSequence sequence = SixSteps(robot, DefaultHalfStep(robot));
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  std::string text =
      "# Six steps straight ahead; all else by default: `halfstep explain-config --robot " +
      robot_file + "`.\nrobot: " + robot_file + "\nscene: none\nfootsteps:\n";
  for (int i = 1; i < walk.num_half_steps(); i += 2) {
    const Side foot = Opposite(walk.half_step(i).support);
    const Pose2 at = FootPose(walk.At(walk.end_of(i)).value, foot);
    text += Formatted("  - {foot: %s, x_m: %.4f, y_m: %.4f}\n", std::string(Name(foot)).c_str(),
                      at.x, at.y);
  }
  return text;
}

}  // namespace halfstep
