#include "experiments/verify/check_rows.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

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

bool MovesHorizontally(const PlayedMotion& motion, size_t i, int side) {
  const Eigen::Vector4d d = motion.rows()[i + 1].soles[Of(side)] - motion.rows()[i].soles[Of(side)];
  const double moved = Tolerances(motion.robot()).moved;
  return d.head<2>().norm() > moved || std::abs(d[3]) > moved;
}

double FootSpeed(const PlayedMotion& motion, size_t i, int side) {
  const PlayedRow &a = motion.rows()[i], &b = motion.rows()[i + 1];
  return (b.soles[Of(side)] - a.soles[Of(side)]).head<3>().norm() / (b.t - a.t);
}

double FootYawRate(const PlayedMotion& motion, size_t i, int side) {
  const PlayedRow &a = motion.rows()[i], &b = motion.rows()[i + 1];
  return std::abs(b.soles[Of(side)][3] - a.soles[Of(side)][3]) / (b.t - a.t);
}

double LandingMargin(const PlayedMotion& motion, size_t i, int side, const DescribedWalk& walk,
                     double limit) {
  const PlayedRow &a = motion.rows()[i], &b = motion.rows()[i + 1];
  const double from = a.soles[Of(side)][2], to = b.soles[Of(side)][2];
  const double above = std::max(from, to) - walk.LandingHeight(0.5 * (a.t + b.t), side);
  return LandingLimit(limit, above) - (from - to) / (b.t - a.t);
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

// Where the support changes between two rows: what supports the robot there is in both polygons.
void AddChange(PlayedRow a, PlayedRow b, const RobotModel& robot, Check* change) {
  if (a.support == b.support) return;
  std::swap(a.support, b.support);
  for (const PlayedRow* crossed : {&a, &b}) {
    change->Add(ZmpMargin(*crossed, robot), [&] { return At(a.t); });
  }
}

double JointMargin(const RobotModel& robot, const PlayedRow& row, int side, int joint) {
  const LegJoint& of = robot.legs[Of(side)].joints[Of(joint)];
  const double q = row.q[Of(side)][joint];
  return std::min(q - of.lower, of.upper - q);
}

double JointSpeedMargin(const PlayedMotion& motion, size_t i, int side, int joint, double scale) {
  const PlayedRow &a = motion.rows()[i], &b = motion.rows()[i + 1];
  const double limit = scale * motion.robot().legs[Of(side)].joints[Of(joint)].max_speed;
  return limit - std::abs(b.q[Of(side)][joint] - a.q[Of(side)][joint]) / (b.t - a.t);
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

void CheckRowMargins(const PlayedMotion& motion, const WalkFloor& floor,
                     const CertificateText& certificate, double tolerance, Findings* findings) {
  const RobotModel& robot = motion.robot();
  const std::vector<PlayedRow>& rows = motion.rows();
  const auto make = [&](Family family, const char* name, double slack) {
    return Check(name, kUnits[family], certificate.demanded[family], slack);
  };
  const Tolerances near(robot);
  Check joint = make(kJoint, "joint limits", near.length);
  Check joint_speed = make(kJointSpeed, "joint speeds", near.joint_speed);
  Check reach = make(kReach, "leg reach", near.length);
  Check moving = make(kFloor, "height of a moving sole", tolerance);
  Check foot_speed = make(kFootSpeed, "foot speed", near.foot_speed);
  Check foot_yaw_rate = make(kFootYawRate, "foot yaw rate", near.joint_speed);
  Check zmp = make(kZmp, "ZMP", near.length);
  Check change("ZMP where the support changes", "m", std::min(0.0, certificate.demanded[kZmp]),
               tolerance);
  Check above("soles above the floor", "m", 0, near.length);
  for (size_t i = 0; i < rows.size(); ++i) {
    const PlayedRow& row = rows[i];
    zmp.Add(ZmpMargin(row, robot), [&] { return At(row.t); });
    for (int side = 0; side < 2; ++side) {
      const auto leg_at = [&] { return std::string(SideName(side)) + " leg " + At(row.t); };
      reach.Add(ReachMargin(robot, row, side), leg_at);
      above.Add(floor.Above(row.soles[Of(side)][2]), leg_at);
      const bool paired = i + 1 < rows.size();
      // Rounded angles say little over a short last interval.
      const double rounding = paired ? 1e-12 / (rows[i + 1].t - row.t) : 0;
      for (int j = 0; j < 6; ++j) {
        const auto where = [&] {
          return robot.legs[Of(side)].joints[Of(j)].name + " " + At(row.t);
        };
        joint.Add(JointMargin(robot, row, side, j), where);
        if (!paired) continue;
        joint_speed.Add(
            rounding + JointSpeedMargin(motion, i, side, j, certificate.joint_speed_scale), where);
      }
      if (!paired) continue;
      if (certificate.foot_speed) {
        foot_speed.Add(*certificate.foot_speed + rounding - FootSpeed(motion, i, side), leg_at);
      }
      if (certificate.foot_yaw_rate) {
        foot_yaw_rate.Add(*certificate.foot_yaw_rate + rounding - FootYawRate(motion, i, side),
                          leg_at);
      }
      // The horizontal motion may begin or end between the rows: then the higher one counts.
      if (MovesHorizontally(motion, i, side)) {
        const double highest = std::max(row.soles[Of(side)][2], rows[i + 1].soles[Of(side)][2]);
        moving.Add(floor.Above(highest), leg_at);
      }
    }
    if (i + 1 < rows.size()) AddChange(row, rows[i + 1], robot, &change);
  }
  for (const Check* check : {&joint, &joint_speed, &reach, &above, &moving, &foot_speed,
                             &foot_yaw_rate, &zmp, &change}) {
    check->Conclude(findings);
  }
}

void CheckLanding(const PlayedMotion& motion, const DescribedWalk& walk,
                  const CertificateText& certificate, Findings* findings) {
  if (!certificate.landing_speed) return;
  const std::vector<PlayedRow>& rows = motion.rows();
  Check landing("landing speed", kUnits[kLandingSpeed], certificate.demanded[kLandingSpeed],
                Tolerances(motion.robot()).foot_speed);
  for (size_t i = 0; i + 1 < rows.size(); ++i) {
    const double rounding = 1e-12 / (rows[i + 1].t - rows[i].t);
    for (int side = 0; side < 2; ++side) {
      landing.Add(rounding + LandingMargin(motion, i, side, walk, *certificate.landing_speed),
                  [&] { return std::string(SideName(side)) + " leg " + At(rows[i].t); });
    }
  }
  landing.Conclude(findings);
}

void CheckDynamics(const std::vector<PlayedRow>& rows, const DescribedWalk& walk, double friction,
                   const CertificateText& certificate, Findings* findings) {
  struct Checked {
    Check check;
    std::function<double(const WalkDynamics&)> margin;
  };
  const Tolerances near(walk.robot());
  std::vector<Checked> all;
  const auto add = [&](Family family, const char* what, const char* unit, double rounding,
                       std::function<double(const WalkDynamics&)> margin) {
    const std::string& fault = walk.robot().masses.fault;
    if (certificate.demanded[family] == kNotDemanded || !fault.empty()) {
      findings->Say(std::string(what) + ": nothing is demanded" +
                    (fault.empty() ? "" : ", for " + fault));
      return;
    }
    all.push_back({Check(what, unit, certificate.demanded[family], rounding), std::move(margin)});
  };
  add(kZmpRobot, "ZMP of the whole robot", "m", near.momentum,
      [](const WalkDynamics& at) { return at.zmp; });
  add(kTorque, "joint torques", "N m", near.torque,
      [&](const WalkDynamics& at) { return at.LeastTorqueMargin(walk.robot()); });
  add(kFriction, "friction", "", near.friction,
      [&](const WalkDynamics& at) { return friction - at.friction; });
  if (all.empty()) return;
  for (const PlayedRow& row : rows) {
    const WalkDynamics dynamics = walk.DynamicsAt(row.t);
    for (Checked& of : all) of.check.Add(of.margin(dynamics), [&] { return At(row.t); });
  }
  for (const Checked& of : all) of.check.Conclude(findings);
}

}  // namespace halfstep::verify
