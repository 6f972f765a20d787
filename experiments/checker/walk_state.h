#pragma once

#include <array>
#include <optional>
#include <vector>

#include "experiments/checker/leg_motion.h"
#include "experiments/checker/walk_motion.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::checker {

using Rate = Taylor<1>;  ///< a function of time whose derivative is bounded

/// A closed way around soles' corners, counter-clockwise as doubles see it. A point that lies to
/// the left of every edge, by δ or more, is surrounded by it, and so is the disc of radius δ, which
/// no edge meets: so it lies in the corners' convex hull, whether the way is the hull's or not.
struct SupportEdges {
  /// An edge's unit normal to the left, and n·x on it [m].
  struct Edge {
    std::array<Interval, 2> n;  ///< the normal
    Interval at;                ///< n·x
  };
  std::vector<Edge> edges;  ///< in their order

  /// How far to the left of an edge a point is [m].
  template <int N>
  Taylor<N> Left(const Edge& edge, const std::array<Taylor<N>, 2>& p) const {
    return edge.n[0] * p[0] + edge.n[1] * p[1] - Taylor<N>(edge.at);
  }
};

/// The robot's walk on an interval of time, in which the same soles stand.
class WalkState {
 public:
  /// A force and its moment about the reference point [N], [N m].
  struct Wrench {
    VectorIn<Rate> force{};   ///< [N]
    VectorIn<Rate> moment{};  ///< [N m]
  };
  /// What moves the links, and the floor's part of it.
  struct Dynamics {
    std::array<std::array<Wrench, 6>, 2> links;  ///< of the legs by Index(Side)
    Wrench floor;                                ///< of all bodies
    Eigen::Vector2d reference;                   ///< moments are about this point of the floor [m]
    std::array<Rate, 2> zmp;                     ///< of the robot, seen from there [m]

    /// The robot's ZMP in W [m].
    std::array<Rate, 2> zmp_W() const {
      return {zmp[0] + Rate(reference.x()), zmp[1] + Rate(reference.y())};
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
  SupportEdges Support() const;              ///< of the soles that stand

  /// Stretched leg − hip–ankle distance [m].
  Curve reach(size_t side) const { return solvers_[side].Reach(X_WB_, carried_[side]); }
  /// Throw NotDefined where the legs may not reach.
  const LegPosture& leg(size_t side);
  /// Of a robot's body: that of its link, or of the waist.
  const FrameIn<Curve>& FrameOfBody(const RobotBody& body);
  /// Bounds of where the centre of a body's bounding sphere is at any instant.
  const Vector& CenterOf(size_t body);
  /// Of the whole robot; throws NotDefined too where the floor may not push.
  const Dynamics& dynamics();

 private:
  static Wrench Push(const BodyMass& body, const FrameIn<Curve>& X_W,
                     const Eigen::Vector2d& reference);

  const RobotModel& robot_;
  const std::array<LegSolver, 2>& solvers_;
  double middle_, h_;
  WalkNumbers numbers_;
  const WalkMotion::Flight* flight_ = nullptr;
  FrameIn<Curve> X_WB_;
  std::array<FrameIn<Curve>, 2> carried_;
  std::array<std::optional<LegPosture>, 2> legs_;
  std::vector<std::optional<Vector>> centers_;
  std::optional<Dynamics> dynamics_;
};

}  // namespace halfstep::checker
