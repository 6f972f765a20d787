#pragma once

#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// How far apart two values of one number may be, and how far the played motion may leave the walk:
/// one tolerance for each kind of number, made from the robot, so that what is a hair for one robot
/// is not a limb of another. Each is HRP-2's number times a factor that is 1 for HRP-2: lengths go
/// by the leg's length ℓ, times by √ℓ as a pendulum's do, torques by m·g·ℓ. What a joint's limit
/// can be told from is never more than a thousandth of the least limit.
struct Tolerances {
  /// Those of a robot.
  explicit Tolerances(const RobotModel& robot);

  double size;  ///< ℓ over HRP-2's 0.705 m
  double time;  ///< √size: how much longer what the robot does takes it than it takes HRP-2

  /// How far the played motion, straight between rows, may leave the walk where nobody says how
  /// far [m]: 1 mm for HRP-2.
  double played;
  double length;        ///< one length from two sides [m]; angles of standing feet as well
  double sole;          ///< a sole by forward kinematics against its columns [m], [rad]
  double pendulum;      ///< residual of the pendulum's equation [m]
  double row;           ///< a number of a row against the walk [m], [rad], [m/s], [m/s²]
  double column;        ///< a margin column, [m], [rad] or [m/s]
  double claim;         ///< a claimed margin, [m], [rad], [m/s]
  double joint_speed;   ///< that is a difference of joint angles [rad/s]
  double momentum;      ///< the robot's ZMP by second differences of joint angles [m]
  double torque;        ///< joint torques by the same, which feet's shares magnify [N m]
  double friction;      ///< the needed coefficient by the same, which a short lever magnifies
  double acceleration;  ///< joint accelerations by second differences of joint angles [rad/s²]
  double distance;      ///< by how much the program may claim more than verify measures [m]
  /// How far the program's distances may be from verify's [m]. Its slabs and meshes are searched to
  /// 1e-6 m whatever the robot's size (planner/collision/separation.h).
  double slab;
  double inside;  ///< of an interval, where its ends are looked at [s]

  double speed_step;         ///< half of that between angles of a first difference [s]
  double momentum_step;      ///< between the places of a second difference [s]
  double acceleration_step;  ///< between the joint angles of a second difference [s]
};

}  // namespace halfstep::verify
