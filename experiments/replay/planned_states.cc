#include "experiments/replay/planned_states.h"

#include <algorithm>

#include "experiments/control/state_estimate.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/leg_torques.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"

namespace halfstep::replay {
namespace {

// The quantities of a walk that a row has.
WalkState QuantitiesOf(const RobotModel& robot, const TrajectoryRow& row) {
  const Eigen::Vector3d p_WC = row.X_WB() * Eigen::Vector3d(robot.com_x_B, 0.0, 0.0);
  WalkState x;
  x << p_WC.head<2>(), row.zmp, row.waist[3], row.soles[0], row.soles[1],
      row.waist[2] - robot.waist_height;
  return x;
}

// With differences of neighbouring rows; at rest at the ends.
WalkJet JetAt(const RobotModel& robot, const std::vector<TrajectoryRow>& rows, size_t i) {
  WalkJet jet;
  jet.value = QuantitiesOf(robot, rows[i]);
  if (i == 0 || i + 1 == rows.size()) return jet;
  const double before = rows[i].t - rows[i - 1].t, after = rows[i + 1].t - rows[i].t;
  const WalkState rise_before = (jet.value - QuantitiesOf(robot, rows[i - 1])) / before;
  const WalkState rise_after = (QuantitiesOf(robot, rows[i + 1]) - jet.value) / after;
  jet.first = (after * rise_before + before * rise_after) / (before + after);
  jet.second = 2.0 / (before + after) * (rise_after - rise_before);
  return jet;
}

FootLoads LoadsOf(const RobotModel& robot, const TrajectoryRow& row, const Eigen::Vector2d& zmp) {
  if (!row.stands[1]) return FootLoads::OneFoot(Side::kLeft);
  if (!row.stands[0]) return FootLoads::OneFoot(Side::kRight);
  const auto place = [](const Eigen::Vector4d& sole) { return Pose2{sole[0], sole[1], sole[3]}; };
  return FootLoads::BothFeet(place(row.soles[0]), place(row.soles[1]), robot.sole_size, zmp);
}

Eigen::Vector3d Between(double x, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a + x * (b - a);
}

}  // namespace

PlannedStates::PlannedStates(const RobotModel& robot, const ReferenceMotion& motion)
    : motion_(motion) {
  for (size_t i = 0; i < motion_.rows().size(); ++i) {
    whole_.push_back(WholeOf(robot, motion_.rows(), i));
  }
}

PlannedStates::Whole PlannedStates::WholeOf(const RobotModel& robot,
                                            const std::vector<TrajectoryRow>& rows, size_t i) {
  const TrajectoryRow& row = rows[i];
  const WalkJet jet = JetAt(robot, rows, i);
  Whole whole;
  whole.com = row.X_WB() * control::CentreOfMass(robot, row.q);
  whole.zmp = row.zmp;
  whole.force = kGravity * robot.mass;
  Posture posture = SolvePosture(robot, jet.value);
  if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) return whole;
  const Eigen::Matrix3d R_WB = row.X_WB().linear();
  whole.velocity =
      posture.waist_velocity + R_WB * control::CentreOfMassVelocity(robot, row.q, posture.speeds) +
      jet.first[kWaistYaw] * Eigen::Vector3d::UnitZ().cross(whole.com - row.X_WB().translation());
  const RobotDynamics dynamics(robot, jet, posture, kGravity);
  whole.force = dynamics.contact()[5];
  const std::optional<Eigen::Vector2d> zmp = dynamics.Zmp();
  if (!zmp) return whole;
  whole.zmp = *zmp;
  const FootLoads loads = LoadsOf(robot, row, *zmp);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto s = static_cast<size_t>(Index(side));
    const Vector6d on_foot = loads.On(side, dynamics.contact());
    whole.torques[s] = LegTorques(dynamics, side, on_foot);
    const Vector6d on_ankle = on_foot - dynamics.leg(side)[5].force;
    const Eigen::Vector3d ankle =
        row.X_WB() * LegForwardKinematics(robot.legs[s], row.q[s])[5].translation();
    whole.ankle_moments[s] = on_ankle.head<3>() - (ankle - dynamics.O()).cross(on_ankle.tail<3>());
  }
  return whole;
}

control::PlannedState PlannedStates::At(double t) const {
  const std::vector<TrajectoryRow>& rows = motion_.rows();
  const auto after = std::upper_bound(rows.begin(), rows.end(), t,
                                      [](double x, const TrajectoryRow& row) { return x < row.t; });
  const size_t i =
      std::clamp<size_t>(static_cast<size_t>(after - rows.begin()), 1, rows.size() - 1) - 1;
  const double x = std::clamp((t - rows[i].t) / (rows[i + 1].t - rows[i].t), 0.0, 1.0);
  const Whole &a = whole_[i], &b = whole_[i + 1];
  const JointTargets targets = motion_.TargetsAt(t);
  const TrajectoryRow row = motion_.RowAt(t);
  control::PlannedState state;
  state.t = t;
  state.q = targets.q;
  state.speeds = targets.speed;
  state.X_WB = row.X_WB();
  state.stands = row.stands;
  for (size_t s = 0; s < 2; ++s) {
    state.X_WSole[s] = TrajectoryRow::Upright(row.soles[s]);
    state.torques[s] = a.torques[s] + x * (b.torques[s] - a.torques[s]);
    state.ankle_moments[s] = Between(x, a.ankle_moments[s], b.ankle_moments[s]);
  }
  state.com = Between(x, a.com, b.com);
  state.com_velocity = Between(x, a.velocity, b.velocity);
  state.zmp = a.zmp + x * (b.zmp - a.zmp);
  state.force = a.force + x * (b.force - a.force);
  return state;
}

}  // namespace halfstep::replay
