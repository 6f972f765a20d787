#pragma once

#include <array>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "experiments/verify/half_step_motion.h"
#include "experiments/verify/leg_guide.h"
#include "experiments/verify/played_motion.h"
#include "experiments/verify/robot_posture.h"
#include "experiments/verify/walk_floor.h"
#include "experiments/verify/walk_text.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// What the whole robot's momentum (RobotMomentum) asks for at an instant.
struct WalkDynamics {
  /// Distance of its ZMP inside the support polygon [m]; −∞: it has none.
  double zmp = -std::numeric_limits<double>::infinity();
  /// Joint torques by Index(Side) [N m], infinite where nothing can be said.
  std::array<Vector6d, 2> torques = {Vector6d::Constant(std::numeric_limits<double>::infinity()),
                                     Vector6d::Constant(std::numeric_limits<double>::infinity())};
  /// The friction coefficient that the soles need; ∞ where nothing can be said.
  double friction = std::numeric_limits<double>::infinity();

  /// A joint's limit − |torque| [N m]; −∞ where nothing can be said.
  double TorqueMargin(const RobotModel& robot, size_t side, size_t joint) const;
  double LeastTorqueMargin(const RobotModel& robot) const;  ///< of all joints of both legs
};

/// The walk that the files of a run describe: the half-steps of its footsteps with the starts,
/// durations, heights and support points of half_steps.csv, superposed:
///
///     f(t) = f_0(0) + Σ_i [ f_i(clamp(t − t_i, 0, T_i)) − f_i(0) ].
///
/// Nothing of it is the prover's. Borrows the robot. Source: [Perrin2011] §IV; smoothing/README.md,
/// "The homotopy".
class DescribedWalk {
 public:
  /// Precondition: as many rows as half-steps, at least one, durations > 0, each a half-step that
  /// there can be (HalfStepMotion). `floor`: below the walk [m], −∞ where there is none; where it
  /// is not given the plan is on one level, which is the floor.
  DescribedWalk(const RobotModel& robot, const WalkPlan& planned,
                const std::vector<HalfStepRow>& rows, const std::optional<double>& floor = {});

  /// A half-step, and what is known of those before it, so that an instant costs the same in any
  /// walk.
  struct Piece {
    HalfStepMotion motion;            ///< in W
    double start = 0;                 ///< t_i [s]
    WalkNumbers begin{};              ///< when those before it have ended
    double ended = 0;                 ///< by when it and those before it have [s]
    double begins = 0;                ///< before that neither it nor one after it begins [s]
    std::array<double, 2> heights{};  ///< of the soles before it, where it raises a foot [m]

    double end() const { return start + motion.duration(); }  ///< [s]
  };
  /// Of these half-steps, which need not be a walk from its beginning on. The same precondition.
  static std::vector<Piece> PiecesOf(const RobotModel& robot, const WalkPlan& planned,
                                     const std::vector<HalfStepRow>& rows);

  /// The walk that ends with half-step `last`, from 0. Precondition: there is one.
  DescribedWalk StopBranch(int last) const;

  const RobotModel& robot() const { return robot_; }              ///< that walks
  const WalkFloor& floor() const { return floor_; }               ///< below it
  int num_half_steps() const { return static_cast<int>(size_); }  ///< n
  /// Height z_c of the pendulum [m].
  double pendulum_height() const { return robot_.com_height - crouch_; }
  /// Whether it is an up half-step, from 0.
  bool IsUp(int half_step) const { return piece(half_step).motion.half_step().up; }
  /// When a half-step, counted from 0, begins and ends [s].
  std::pair<double, double> WindowOf(int half_step) const;
  /// When the ZMP of a half-step, counted from 0, goes from foot to foot [s].
  std::pair<double, double> ShiftOf(int half_step) const;
  /// Duration of the walk [s].
  double end() const { return pieces_->at(size_ - 1).end(); }
  /// All quantities and two time derivatives at t [s], in W.
  WalkInstant At(double t) const;

  /// About the joint angles at t [rad], for PostureOf(); nan where nothing is known.
  std::array<Vector6d, 2> NearAngles(double t) const { return guide_.Near(t); }

  /// All that a row of trajectory.csv says at t [s], but for the margins. Joint angles are nan
  /// where a leg does not reach.
  PlayedRow Row(double t) const;
  /// q̇ of both legs by Index(Side) [rad/s]: central differences over twice
  /// Tolerances::speed_step, one-sided ones over one at the walk's ends.
  std::array<Vector6d, 2> JointSpeeds(double t) const;

  WalkDynamics DynamicsAt(double t) const;  ///< at t [s]

  Support SupportAt(double t) const;  ///< who carries at t [s]
  /// The latest half-step that has begun, counted from 1.
  int HalfStepAt(double t) const;
  /// Whether a foot (Index(Side)) is in the air, and moves horizontally or may do so.
  bool MovesHorizontally(double t, int side) const;

  /// Height of the place where a foot stands at t, or stood last [m].
  double FootholdHeight(double t, int side) const;
  /// The same of the place where it lands, while it is in the air; in a walk that ends before, of
  /// the place where it came from.
  double LandingHeight(double t, int side) const;

  /// An upper bound of |c⁗| over [begin, end] [m/s⁴]: c̈ = ω²(c − p) is
  /// differentiated twice, and the closed-form bounds of all half-steps under way are added up.
  double ComFourthBound(double begin, double end) const;

 private:
  RobotPosture PostureAt(double t) const;
  // Finds angles near by from `from` [s] to the end.
  void Guide(double from);
  double Local(double t, size_t piece) const { return t - (*pieces_)[piece].start; }
  const Piece& piece(int half_step) const { return Nth(*pieces_, half_step); }
  // The first half-step that has not ended at t, or the last.
  size_t FirstActive(double t) const;
  // Whether the foot that half-step `up` raised stands again.
  bool HasLanded(double t, size_t up) const;
  // The step in the air, or −1.
  int StepInAir(double t) const;

  const RobotModel& robot_;
  WalkFloor floor_;
  double crouch_;
  std::shared_ptr<const std::vector<Piece>> pieces_;  // also of what was cut from this one
  size_t size_;
  LegGuide guide_;
};

}  // namespace halfstep::verify
