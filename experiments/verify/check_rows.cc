#include "experiments/verify/check_rows.h"

#include <algorithm>
#include <cmath>

#include "experiments/verify/robot_numbers.h"
#include "experiments/verify/tolerances.h"

namespace halfstep::verify {
namespace {

// Numbers beyond this are no walk: [m], [rad], [m/s²] …
constexpr double kHuge = 1e4;

std::string At(double t) { return Formatted("at t = %.6g s", t); }
const char* SideName(int side) { return side == 0 ? "left" : "right"; }
size_t Of(int side) { return static_cast<size_t>(side); }

bool OfHumanSize(const PlayedRow& row) {
  const auto most = [](const auto& v) { return v.cwiseAbs().maxCoeff(); };
  double largest = std::max({std::abs(row.t), most(row.com), most(row.com_velocity),
                             most(row.com_acceleration), most(row.zmp), most(row.waist)});
  for (size_t s = 0; s < 2; ++s) largest = std::max({largest, most(row.soles[s]), most(row.q[s])});
  return largest <= kHuge;
}

}  // namespace

bool CheckIsMotion(const std::vector<PlayedRow>& rows, Findings* findings) {
  const long before = findings->disagreements();
  findings->Say("rows: " + Count(std::ssize(rows)) + ", times from 0, increasing; finite numbers");
  if (rows.size() < 2) findings->Disagree("rows: fewer than two");
  for (size_t i = 0; i < rows.size(); ++i) {
    const std::string line = Formatted("trajectory.csv:%zu: ", i + 2);
    if (!rows[i].AllFinite()) {
      findings->Disagree(line + "a number is not finite");
    } else if (!OfHumanSize(rows[i])) {
      findings->Disagree(line + "a number is beyond 10,000");
    }
    if (i == 0 ? rows[i].t != 0 : !(rows[i].t > rows[i - 1].t)) {
      findings->Disagree(line + "the times do not increase from 0");
    }
    if (i > 0 && rows[i].half_step < rows[i - 1].half_step) {
      findings->Disagree(line + "the half-steps do not increase");
    }
  }
  return findings->disagreements() == before;
}

SolePolygon PolygonOf(const PlayedRow& row, const RobotModel& robot) {
  if (row.support == Support::kBoth) return {{row.X_WS(0), row.X_WS(1)}, robot.sole_size};
  return {{row.X_WS(static_cast<int>(row.support))}, robot.sole_size};
}

double ZmpMargin(const PlayedRow& row, const RobotModel& robot) {
  return PolygonOf(row, robot).Margin(row.zmp);
}

double ReachMargin(const RobotModel& robot, const PlayedRow& row, int side) {
  const Leg& leg = robot.legs[Of(side)];
  const auto frames = PlaceLegAt(leg, row.q[Of(side)]).X_BLink;
  const Eigen::Vector3d hip_at = frames[2] * (leg.joints[2].X_BLink.inverse() * leg.hip_B);
  const Eigen::Vector3d ankle_at = frames[3] * (leg.joints[3].X_BLink.inverse() * leg.ankle_B);
  return StretchedLength(leg) - (ankle_at - hip_at).norm();
}

double JointMargin(const RobotModel& robot, const PlayedRow& row, int side, int joint) {
  const LegJoint& of = robot.legs[Of(side)].joints[Of(joint)];
  const double q = row.q[Of(side)][joint];
  return std::min(q - of.lower, of.upper - q);
}

void CheckConsistency(const PlayedMotion& motion, const DescribedWalk& walk, Findings* findings) {
  const RobotModel& robot = motion.robot();
  const std::vector<PlayedRow>& rows = motion.rows();
  const Tolerances near(robot);
  const double k = walk.pendulum_height() / kGravity;  // z_c/g
  Check soles("soles by forward kinematics", "m or rad", 0, near.sole);
  Check waist("waist under the CoM", "m", 0, near.sole);
  Check pendulum("pendulum", "m", 0, near.pendulum);
  // What the trapezoidal rule's error leaves.
  Check velocity("CoM velocity", "m/s", 0, 0);
  Check acceleration("CoM acceleration", "m/s²", 0, 0);
  Check standing("standing feet", "m or rad", 0, near.length);
  for (size_t i = 0; i < rows.size(); ++i) {
    const PlayedRow& row = rows[i];
    const auto here = [&row] { return At(row.t); };
    const Placement at = motion.PlaceRow(row);
    for (int side = 0; side < 2; ++side) {
      const Eigen::Isometry3d X_WSole = at.X_WB * at.X_BLink[Of(side)][6];
      const Eigen::Isometry3d stated = ToIsometry(row.X_WS(side), row.soles[Of(side)][2]);
      const double apart = (X_WSole.translation() - stated.translation()).norm();
      // For small angles the Frobenius norm is √2 times the angle.
      const double turned = (X_WSole.linear() - stated.linear()).norm() / std::sqrt(2.0);
      const auto where = [&] { return std::string(SideName(side)) + " foot " + At(row.t); };
      soles.Add(-std::max(apart, turned), where);
      if (!row.Stands(side)) continue;
      // Support and the walk's own may change within rounding of each other.
      const double z = row.soles[Of(side)][2];
      standing.Add(-std::min(std::abs(z - walk.FootholdHeight(row.t - near.inside, side)),
                             std::abs(z - walk.FootholdHeight(row.t + near.inside, side))),
                   where);
      if (i > 0 && rows[i - 1].Stands(side)) {
        const Eigen::Vector4d slid = row.soles[Of(side)] - rows[i - 1].soles[Of(side)];
        standing.Add(-slid.cwiseAbs().maxCoeff(), where);
      }
    }
    const Eigen::Vector2d forward(std::cos(row.waist[3]), std::sin(row.waist[3]));
    const Eigen::Vector2d under = row.com.head<2>() - robot.com_x_B * forward;
    const double lift = walk.At(row.t).value[kWaistZ];
    waist.Add(-std::max({(row.waist.head<2>() - under).norm(),
                         std::abs(row.waist[2] - (robot.waist_height + lift)),
                         std::abs(row.com.z() - (robot.com_height + lift))}),
              here);
    const Eigen::Vector2d residual = k * row.com_acceleration - row.com.head<2>() + row.zmp;
    pendulum.Add(-residual.norm(), here);
    if (i == 0) continue;
    // Trapezoidal rule against the difference of the rows.
    const PlayedRow& last = rows[i - 1];
    const double dt = row.t - last.t;
    const Eigen::Vector2d v = (row.com - last.com).head<2>() / dt;
    const Eigen::Vector2d a = (row.com_velocity - last.com_velocity) / dt;
    // Differences of rounded numbers say nothing over a short last interval.
    const double rounding = near.length + 1e-14 * near.size / dt;
    const double fourth = walk.ComFourthBound(last.t, row.t);
    const double jump = (row.com_acceleration - last.com_acceleration).norm();
    const double v_error = dt * jump / 12 + dt * dt * dt * fourth / 12;
    const double a_error = dt * dt * fourth / 12;
    velocity.Add(rounding + v_error - (v - (row.com_velocity + last.com_velocity) / 2).norm(),
                 here);
    acceleration.Add(
        rounding + a_error - (a - (row.com_acceleration + last.com_acceleration) / 2).norm(), here);
  }
  for (const Check* check : {&soles, &waist, &pendulum, &velocity, &acceleration, &standing}) {
    check->Conclude(findings);
  }
}

}  // namespace halfstep::verify
