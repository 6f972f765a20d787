#include "experiments/report/robot_zmp.h"

#include <array>
#include <limits>
#include <optional>

#include "experiments/report/trajectory_states.h"
#include "wpg/motion/posture.h"
#include "wpg/motion/robot_dynamics.h"
#include "wpg/motion/standing_heights.h"
#include "wpg/robot/gravity.h"

namespace halfstep {
namespace {

// The derivatives of rows before, at and after an instant by the parabola through them.
void Differentiate(const std::array<double, 3>& t, const std::array<WalkState, 3>& x,
                   WalkJet* jet) {
  const double before = t[1] - t[0], after = t[2] - t[1];
  const WalkState in = (x[1] - x[0]) / before, out = (x[2] - x[1]) / after;
  jet->first = (after * in + before * out) / (before + after);
  jet->second = 2.0 * (out - in) / (before + after);
}

std::optional<RobotZmp> ZmpOf(const RobotModel& robot, const WalkJet& jet, double height) {
  Posture posture = SolvePosture(robot, jet.value);
  if (!posture.reachable || !SolveJointSpeeds(robot, jet, &posture)) return std::nullopt;
  const RobotDynamics dynamics(robot, jet, posture, kGravity);
  const std::optional<Eigen::Vector2d> zmp = dynamics.Zmp(height);
  if (!zmp) return std::nullopt;
  return RobotZmp{.zmp = *zmp, .tilt = dynamics.Tilt()};
}

// The sole that stands alone, if one does.
std::optional<Side> OnlySole(const std::string& support) {
  if (support == Name(Side::kLeft)) return Side::kLeft;
  if (support == Name(Side::kRight)) return Side::kRight;
  return std::nullopt;
}

}  // namespace

std::vector<RobotZmp> RobotZmps(const RobotModel& robot, const CsvTable& trajectory) {
  const std::vector<double> t = trajectory.Numbers("t_s");
  const std::vector<WalkState> states = StatesOf(robot, trajectory);
  const std::vector<double> vx = trajectory.Numbers("com_vx_m_s"),
                            vy = trajectory.Numbers("com_vy_m_s"),
                            ax = trajectory.Numbers("com_ax_m_s2"),
                            ay = trajectory.Numbers("com_ay_m_s2");
  const std::vector<std::string> supports = trajectory.Texts("support");
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<RobotZmp> zmps(t.size(), {.zmp = none, .tilt = none});
  if (!robot.masses.known()) return zmps;
  for (size_t i = 0; i < t.size(); ++i) {
    WalkJet jet{.value = states[i]};
    if (i > 0 && i + 1 < t.size()) {  // the walk begins and ends at rest
      Differentiate({t[i - 1], t[i], t[i + 1]}, {states[i - 1], states[i], states[i + 1]}, &jet);
    }
    jet.first.segment<2>(kComX) << vx[i], vy[i];
    jet.second.segment<2>(kComX) << ax[i], ay[i];
    const StandingHeights heights(states[i], OnlySole(supports[i]));
    zmps[i] = ZmpOf(robot, jet, heights.middle()).value_or(zmps[i]);
  }
  return zmps;
}

}  // namespace halfstep
