#include "experiments/survey/starter_config.h"

#include "experiments/config/scaled_defaults.h"
#include "experiments/run/half_step_table.h"
#include "experiments/survey/self_gaps.h"
#include "experiments/survey/stance_search.h"
#include "smoothing/walk/superposed_walk.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

std::string FootstepLine(Side foot, const Pose2& at) {
  return Formatted("  - {foot: %s, x_m: %.4f, y_m: %.4f}\n", std::string(Name(foot)).c_str(), at.x,
                   at.y);
}

// Up a flight, as items of a list, and what of the half-steps' form is not the robot's usual one.
std::string LinesOf(const ClimbedStairs& stairs, const RobotModel& robot,
                    const HalfStep& half_step) {
  const HalfStepSequence sequence = WalkAlong(stairs.flight, true, robot, half_step);
  std::string text = "footsteps:  # the scene tells their heights\n";
  for (int i = 1; i < sequence.size(); i += 2) {
    const PlacedHalfStep& down = Nth(sequence.half_steps, i);
    const Foothold at = down.X_WS * down.half_step.X_SF;
    text += FootstepLine(down.half_step.swing(), at.Planar());
  }
  ExperimentConfig usual;
  ScaleDefaults(MeasuresOf(robot), &usual);
  const std::string changed = Differences(stairs.half_step, usual.half_step);
  if (changed.empty()) return text;
  return text + "# Half-steps that are certified on these stairs, up and down:\nhalf_step: {" +
         changed + "}\n";
}

// Six steps straight ahead, as items of a list.
std::string FootstepLines(const RobotModel& robot, const HalfStep& half_step) {
  const HalfStepSequence sequence = SixSteps(robot, half_step);
  const SuperposedWalk walk(sequence, PlannedMotion(sequence));
  const double usual = kStride * MeasuresOf(robot).leg_length;
  std::string text;
  for (int i = 1; i < walk.num_half_steps(); i += 2) {
    const Side foot = Opposite(walk.half_step(i).support);
    const Pose2 at = FootPose(walk.At(walk.end_of(i)).value, foot);
    if (i == 1 && at.x < usual - 1e-6) {
      text += Formatted(
          "  # Steps of %.3f m in place of %.3f m: with longer ones a leg comes to its limits.\n",
          at.x, usual);
    }
    text += FootstepLine(foot, at);
  }
  return text;
}

}  // namespace

std::string StarterConfigText(const RobotModel& robot, const StarterConfig& config) {
  const HalfStep half_step = DefaultHalfStep(robot);
  std::string text =
      "# Keys and their values for this robot: `halfstep explain-config --robot " +
      config.robot_file +
      "`\n"
      "# (or with a key, or with a word). Any key can be set on the command line:\n"
      "# `halfstep run THIS.yaml --set half_step.duration_s=1.5`.\n"
      "robot: " +
      config.robot_file + "  # `halfstep list robots`; `halfstep robot` makes one of a URDF\n" +
      "scene: " + config.scene + (config.scene == "none" ? "  # an empty floor; " : "  # ") +
      "`halfstep list scenes`\n";
  if (config.stairs) {
    text += LinesOf(*config.stairs, robot, half_step);
  } else if (config.goal) {
    text += Formatted(
        "goal: {x_m: %g, y_m: %g, radius_m: 0.1}  # a planner finds the footsteps; in place of it "
        "`footsteps:`\n",
        (*config.goal)[0], (*config.goal)[1]);
  } else {
    text +=
        "footsteps:  # of the soles' centres; in place of them `goal: {x_m: 2, y_m: 0}` plans\n" +
        FootstepLines(robot, half_step);
  }
  if (!config.why_search.empty()) {
    text += "# This robot " + config.why_search +
            ".\n# So a search looks for another walk.\n"
            "smoothing: {methods: [halfstep/sqp]}\n";
  }
  if (text.find("\nhalf_step: ") == std::string::npos) {
    text += Formatted(
        "# half_step: {duration_s: %.3g, via_height_m: %.3g}  # how long each lasts, how high the "
        "foot rises\n",
        half_step.duration, half_step.via_height);
  }
  return text +
         "# smoothing:  # methods are run one after the other: `halfstep list methods`\n"
         "#   methods: [dichotomy, halfstep/sqp]\n"
         "#   optimizer: {footsteps: true}  # footsteps move a little, too\n"
         "#   margins: {clearance_m: 0.005}\n";
}

std::string StairsSceneText(const Flight& flight) {
  return Formatted(
      "# %d treads of %.4g cm, each %.4g cm high: planner/README.md, \"Levels\".\n"
      "surfaces:\n"
      "  - name: flight\n"
      "    stairs: {at: {x_m: %.6g}, rise_m: %.6g, run_m: %.6g, width_m: %.3g, count: %d}\n",
      flight.treads, 100 * flight.run, 100 * flight.rise, 0.5 * flight.run, flight.rise, flight.run,
      kFlightWidth, flight.treads);
}

}  // namespace halfstep
