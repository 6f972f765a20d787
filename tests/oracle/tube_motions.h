#pragma once

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <optional>

#include "tests/oracle/nasty_draws.h"
#include "tests/oracle/plain_robot.h"

namespace halfstep::oracle {

/// How far a motion stays from the planned one at every instant, by smoothing/README.md, "Tubes".
struct PlainTube {
  double foot = 0, foot_turn = 0;    ///< of each sole's centre [m]; of the sole, any axis [rad]
  double waist = 0, waist_turn = 0;  ///< of the waist's origin [m]; of the waist [rad]
  double joint = 0;                  ///< of each leg joint [rad]
  double joint_speed = 0;            ///< [rad/s]
  double zmp = 0;                    ///< of the whole robot's ZMP [m]

  PlainTube Scaled(double times) const {
    return {times * foot,  times * foot_turn,   times * waist, times * waist_turn,
            times * joint, times * joint_speed, times * zmp};
  }
};

/// A posture, legs by forward kinematics.
struct TubePosture {
  Eigen::Isometry3d X_WB;
  std::array<Vector6, 2> q;
  std::array<std::array<Eigen::Isometry3d, 7>, 2> X_BLink;  ///< of each leg, last its sole

  Eigen::Isometry3d X_WSole(size_t leg) const { return X_WB * X_BLink[leg][6]; }
};

/// Postures within a tube around a planned one, either from one of waist and soles and all joint
/// angles, or from waist and both soles by inverse kinematics; as far that way as the tube holds
/// all of them.
class TubeMotions {
 public:
  /// Borrows the robot and the draw; `plan` reaches.
  TubeMotions(const PlainRobot& robot, const PlainTube& tube, const TubePosture& plan, Draw* draw)
      : robot_(robot), tube_(tube), plan_(plan), draw_(draw) {}

  /// Errors at random, at the ends of what is allowed half of the time.
  TubePosture AtRandom() { return Furthest(DrawWay()); }
  /// Errors that lower `value` as straight as its slope about the plan says, some left out.
  TubePosture Lowering(const std::function<double(const TubePosture&)>& value);

 private:
  // Six balls (shift [m], turn [rad]) of waist and soles, or one of these and twelve joints.
  struct Way {
    bool by_places = false;
    int base = -1;  // by joints: the one that is moved, −1 the waist
    Eigen::Matrix<double, 18, 1> error = Eigen::Matrix<double, 18, 1>::Zero();
  };
  // Components that are a vector in a ball; those after them are numbers by themselves.
  static int Balls(const Way& way) { return way.by_places ? 6 : 2; }
  double Radius(const Way& way, int component) const;
  Way DrawWay();
  std::optional<TubePosture> Along(const Way& way, double part) const;
  bool IsWithin(const TubePosture& moved) const;
  TubePosture Furthest(const Way& way) const;

  const PlainRobot& robot_;
  const PlainTube tube_;
  const TubePosture plan_;
  Draw* draw_;
};

}  // namespace halfstep::oracle
