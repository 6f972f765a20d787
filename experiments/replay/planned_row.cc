#include "experiments/replay/planned_row.h"

#include "wpg/check.h"
#include "wpg/motion/posture.h"
#include "wpg/nth.h"

namespace halfstep::replay {

TrajectoryRow PlannedRow(const RobotModel& robot, const SuperposedWalk& walk, double t) {
  const LocalTime at = walk.Locate(t);
  const WalkState x = walk.At(at).value;
  const Posture posture = SolvePosture(robot, x);
  HALFSTEP_CHECK(posture.reachable, "a leg does not reach at " << t << " s");
  const Eigen::Vector3d p_WB = posture.X_WB.translation();
  TrajectoryRow row;
  row.t = t;
  row.zmp = {x[kZmpX], x[kZmpY]};
  row.waist = {p_WB.x(), p_WB.y(), p_WB.z(), x[kWaistYaw]};
  const int step = walk.StepInAir(at);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    Nth(row.stands, side) = step < 0 || walk.half_step(2 * step).support == side;
    Nth(row.soles, side) = x.segment<4>(FootIndex(side));
    Nth(row.q, side) = Nth(posture.ik, side).q;
  }
  return row;
}

}  // namespace halfstep::replay
