#include "experiments/export/joint_motion.h"

#include "smoothing/walk/posture_tangent.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/motion/posture.h"

namespace halfstep {
namespace {

constexpr double kApart = 1e-6;  // rows are at least [s]; messages count whole nanoseconds

JointMotion MotionOf(const RobotModel& robot, const SuperposedWalk& walk, const TrajectoryRow& row,
                     const std::string& path) {
  const WalkJet jet = walk.At(row.t);
  Posture posture = SolvePosture(robot, jet.value);
  if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) {
    throw InputError({path + ": at " + ShortestText(row.t) +
                      " s a leg is stretched so far that its joint speeds have no bound: cannot "
                      "be played (valid: a feasible walk; --method picks one)"});
  }
  // Along time, the tangent of the walk's values is their first derivative, and so on.
  const PostureTangent in_time = Differentiate(
      robot, jet, posture, {.value = jet.first, .first = jet.second, .second = WalkState::Zero()});
  return {.row = row,
          .speeds = posture.speeds,
          .accelerations = in_time.speeds,
          .waist_velocity = posture.waist_velocity,
          .waist_yaw_rate = jet.first[kWaistYaw]};
}

}  // namespace

std::vector<JointMotion> MotionOfRows(const RobotModel& robot, const SuperposedWalk& walk,
                                      const std::vector<TrajectoryRow>& rows, size_t stride,
                                      const std::string& path) {
  std::vector<JointMotion> motion;
  for (size_t i = 0; i < rows.size(); ++i) {
    const bool last = i + 1 == rows.size();
    if (!last && (i % stride != 0 || rows.back().t - rows[i].t < kApart)) continue;
    motion.push_back(MotionOf(robot, walk, rows[i], path));
  }
  return motion;
}

}  // namespace halfstep
