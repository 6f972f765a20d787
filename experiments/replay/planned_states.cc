#include "experiments/replay/planned_states.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "experiments/control/state_estimate.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/leg_torques.h"
#include "wpg/motion/standing_heights.h"
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

// The foot that a row has alone on the ground.
std::optional<Side> OnlyFoot(const TrajectoryRow& row) {
  if (!row.stands[1]) return Side::kLeft;
  if (!row.stands[0]) return Side::kRight;
  return std::nullopt;
}

// Precondition: the dynamics have a ZMP.
FootLoads LoadsOf(const RobotModel& robot, const TrajectoryRow& row, const WalkState& x,
                  const RobotDynamics& dynamics) {
  if (const auto only = OnlyFoot(row)) return FootLoads::OneFoot(*only);
  const StandingHeights heights(x, std::nullopt);
  const auto zmp = [&](Side side) { return *dynamics.Zmp(heights.of(side)); };
  if (!heights.level()) {
    const auto loads =
        FootLoads::OnLevels(x, heights, robot.sole_size, {zmp(Side::kLeft), zmp(Side::kRight)});
    if (loads) return *loads;
  }
  return FootLoads::BothFeet(FootPose(x, Side::kLeft), FootPose(x, Side::kRight), robot.sole_size,
                             zmp(Side::kLeft));
}

// Of the sole that stands, or halfway between two.
double HeightOfSupport(const TrajectoryRow& row) {
  WalkState soles = WalkState::Zero();
  for (const Side side : {Side::kLeft, Side::kRight}) {
    soles.segment<4>(FootIndex(side)) = Nth(row.soles, Index(side));
  }
  return StandingHeights(soles, OnlyFoot(row)).middle();
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
  FindLevels();
}

void PlannedStates::FindLevels() {
  const std::vector<TrajectoryRow>& rows = motion_.rows();
  for (size_t s = 0; s < 2; ++s) {
    double level = 0.0;
    const auto look = [&](size_t i) {
      if (rows[i].stands[s]) level = rows[i].soles[s].z();
      if (std::abs(level) < StandingHeights::kLevel) level = 0.0;
    };
    for (size_t i = 0; i < rows.size(); ++i) look(i);  // where it stood last
    for (size_t i = rows.size(); i-- > 0;) {
      look(i);
      whole_[i].levels[s] = level;
    }
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
  whole.tilt = dynamics.Tilt();
  const FootLoads loads = LoadsOf(robot, row, jet.value, dynamics);
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
  state.tilt = a.tilt + x * (b.tilt - a.tilt);
  state.zmp = a.zmp + x * (b.zmp - a.zmp);
  state.levels = x < 1.0 ? a.levels : b.levels;
  state.zmp_height = HeightOfSupport(row);
  if (state.zmp_height != 0.0) state.zmp += state.zmp_height * state.tilt;
  state.force = a.force + x * (b.force - a.force);
  return state;
}

}  // namespace halfstep::replay
