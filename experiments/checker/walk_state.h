#pragma once

#include <array>
#include <optional>
#include <vector>

#include "experiments/checker/leg_motion.h"
#include "experiments/checker/push.h"
#include "experiments/checker/support.h"
#include "experiments/checker/walk_motion.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::checker {

/// The robot's walk on an interval of time, in which the same soles stand.
class WalkState {
 public:
  /// What moves the links, and the floor's part of it.
  struct Dynamics {
    std::array<std::array<Push, 6>, 2> links;  ///< of the legs by Index(Side)
    Push floor;                                ///< of all bodies
    Eigen::Vector3d reference;                 ///< moments are about this point [m]
    Seen<1> zmp;                               ///< of the robot in its plane, seen from there [m]
    Seen<1> lean;                              ///< f_t/f_z: how far it moves per metre of height

    /// The robot's ZMP in the plane of a height, in W [m].
    Seen<1> At(const Interval& z) const {
      const Interval higher = z - Interval(reference.z());
      return {zmp[0] + Rate(reference.x()) + higher * lean[0],
              zmp[1] + Rate(reference.y()) + higher * lean[1]};
    }
  };

  /// Borrows all but the times.
  WalkState(const RobotModel& robot, const std::array<LegSolver, 2>& solvers,
            const WalkMotion& motion, const Interval& waist_height, double from, double to);

  const WalkNumbers& numbers() const { return numbers_; }  ///< of the walk
  /// The flight that it is part of, or null: both soles stand.
  const WalkMotion::Flight* flight() const { return flight_; }
  bool Stands(size_t side) const {
    return flight_ == nullptr || flight_->side != side;
  }                                          ///< a foot
  double h() const { return h_; }            ///< nothing is farther from the middle [s]
  double middle() const { return middle_; }  ///< [s]
  /// Of a point that is at points[i] in the plane of the sole with Index(Side) i, and goes `lean`
  /// aside per metre of height: seen along that line all corners are in one plane.
  template <int N>
  std::vector<SupportEdge<N>> Support(const std::array<Seen<N>, 2>& points,
                                      const Seen<N>& lean = {}) const;
  /// Of a sole: its corners, seen from above, and its height [m]. Precondition: it stands.
  std::array<std::array<Interval, 2>, 4> CornersOf(size_t side) const;
  /// Of a sole [m].
  const Interval& HeightOf(size_t side) const { return numbers_[kSole + 4 * side + 2].at[0]; }
  /// Whether both soles are at one height, to 10⁻¹⁰ m, as planner and margins count it.
  bool AreLevel() const { return (HeightOf(0) - HeightOf(1)).Magnitude() < 1e-10; }

  /// OffsetLeg::Foot of a leg.
  FrameIn<Curve> foot(size_t side) const { return X_WB_.Inverse() * carried_[side]; }
  const FrameIn<Curve>& sole(size_t side) const { return soles_[side]; }  ///< its frame in W
  /// Stretched leg − hip–ankle distance [m].
  Curve reach(size_t side) {
    return robot_.legs[side].closed_form() ? solvers_[side].Reach(X_WB_, carried_[side])
                                           : solvers_[side].Reach(leg(side).q[3]);
  }
  /// Throw NotDefined where the legs may not reach.
  const LegPosture& leg(size_t side);
  /// Of a robot's body: that of its link, or of the waist.
  const FrameIn<Curve>& FrameOfBody(const RobotBody& body);
  /// Bounds of where the centre of a body's bounding sphere is at any instant.
  const Vector& CenterOf(size_t body);
  /// Of the whole robot; throws NotDefined too where the floor may not push.
  const Dynamics& dynamics();

 private:
  const RobotModel& robot_;
  const std::array<LegSolver, 2>& solvers_;
  double from_, to_, middle_, h_;
  WalkNumbers numbers_;
  const WalkMotion::Flight* flight_;
  FrameIn<Curve> X_WB_;
  std::array<FrameIn<Curve>, 2> soles_, carried_;
  std::array<std::optional<LegPosture>, 2> legs_;
  std::array<bool, 2> unknown_{};  // whether no posture was found
  std::vector<std::optional<Vector>> centers_;
  std::optional<Dynamics> dynamics_;
};

/// Has to come before states are asked for legs without closed form: these are followed from the
/// first of the knots [s], which hold the motion's, to the last. States' intervals have to lie
/// between two neighbours.
void FollowLegs(const RobotModel& robot, const WalkMotion& motion, const Interval& waist_height,
                const std::vector<double>& knots, std::array<LegSolver, 2>* solvers);

}  // namespace halfstep::checker
