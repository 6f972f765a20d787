#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/collision/collision_world.h"
#include "planner/scene/scene.h"
#include "smoothing/margins/margin.h"
#include "wpg/motion/posture.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Distances of a robot's bodies, in one posture at a time t of the walk [s], to a scene's
/// obstacles, less the uncertainty of these at t, to the solids of its ground, and to each other.
/// A body on a foot does not count solids whose top is at or below its sole (within
/// kSoleRounding): the sole's plane lies between them. Const; scratch is the caller's.
class BodyClearances {
 public:
  /// What queries remember, such as separating directions of earlier postures. Use one for each
  /// thread.
  struct Scratch {
    std::vector<CollisionWorld::Scratch> bodies;  ///< by body of the robot
    /// By pair: the direction that separated it last, in W.
    std::vector<Eigen::Vector3d> pair_normals_W;
    std::vector<Eigen::Vector3d> centers_W;  ///< of the bodies' bounding spheres, in W [m]
    std::vector<double> lateral;  ///< of each leg body: its inner end along the waist's y axis [m]
    long queries = 0;             ///< body against scene, or pair of bodies, that were not culled
  };

  /// `robot` is borrowed and must outlive this.
  BodyClearances(const RobotModel& robot, const Scene& scene);

  Scratch MakeScratch() const;                          ///< for queries of this object
  size_t num_bodies() const { return shapes_.size(); }  ///< those of the robot
  /// The margin of an obstacle changes at no more than this speed [m/s] (Obstacle::speed).
  double obstacle_speed(int obstacle) const { return world_.speed(obstacle); }
  bool has_solids() const { return world_.has_solids(); }  ///< whether the ground has any
  /// Pairs of the robot's own bodies that are watched.
  size_t num_pairs() const { return robot_.self_pairs.size(); }

  /// Notes where the bodies are in a posture. PairClears and OfPair need this to be called for
  /// their posture before. Precondition: its links are placed.
  void Place(const Posture& posture, Scratch* scratch) const;

  /// Whether a body, held still, keeps `clearance` [m] from every obstacle at all times of [t −
  /// half_width, t + half_width], and from the solids that count for a sole that is lower by up to
  /// `sinks` ≥ 0 [m].
  bool BodyClears(size_t body, const Posture& posture, double t, double clearance, Scratch* scratch,
                  double half_width = 0.0, double sinks = 0.0) const;
  /// Whether the bodies of a pair keep `clearance` [m].
  bool PairClears(size_t pair, const Posture& posture, double clearance, Scratch* scratch) const {
    return QuickClears(pair, clearance, *scratch) || Separates(pair, posture, clearance, scratch);
  }
  /// The clearance of one body, and that of one pair; `cap` [m] when nothing is nearer. With a
  /// `half_width` [s], that of the obstacle whose margin may be the least within it
  /// (CollisionWorld::FindNearest). `sinks` as for BodyClears.
  Margin OfBody(size_t body, const Posture& posture, double t, double cap, Scratch* scratch,
                double half_width = 0.0, double sinks = 0.0) const;
  /// The clearance of one pair of bodies, as OfBody.
  Margin OfPair(size_t pair, const Posture& posture, double cap, Scratch* scratch) const;

  /// The same with witness points and normals, which derivatives need. NearestTo looks for the
  /// nearest obstacle within `cap` [m]; in SeparationOf, `a` is the first body of the pair.
  CollisionWorld::Nearest NearestTo(size_t body, const Posture& posture, double t, double cap,
                                    Scratch* scratch, double half_width = 0.0,
                                    double sinks = 0.0) const;
  /// How the bodies of a pair lie to each other; `a` is the first of them.
  Separation SeparationOf(size_t pair, const Posture& posture, Scratch* scratch) const;

  /// The first body, or the first pair, that is found to keep less than `clearance` [m]; none when
  /// all keep it.
  std::optional<Margin> FirstBodyBelow(const Posture& posture, double t, double clearance,
                                       Scratch* scratch) const;
  /// The first pair of bodies that does not keep `clearance` [m]; none when all keep it.
  std::optional<Margin> FirstPairBelow(const Posture& posture, double clearance,
                                       Scratch* scratch) const;
  /// The smallest clearance of any body to the obstacles, and that of any pair; `cap` [m] when
  /// nothing is nearer.
  Margin NearestObstacle(const Posture& posture, double t, double cap, Scratch* scratch) const;
  /// The smallest clearance of any pair, as NearestObstacle.
  Margin NearestPair(const Posture& posture, double cap, Scratch* scratch) const;

 private:
  // Up to here solids do not count for a body [m].
  double Above(size_t body, const Posture& posture, double sinks) const;
  // A lower bound of the distance of a pair, from Place's numbers alone [m]; whether it tells that
  // a pair keeps a clearance [m].
  double QuickBound(size_t pair, const Scratch& scratch) const;
  bool QuickClears(size_t pair, double clearance, const Scratch& scratch) const {
    const Quick& quick = quick_[pair];
    const double gap = quick.legs * (scratch.lateral[quick.a] - scratch.lateral[quick.b]);
    if (quick.legs != 0 && gap >= clearance) return true;
    const double apart = quick.radii + clearance;
    const double distance2 =
        (scratch.centers_W[quick.a] - scratch.centers_W[quick.b]).squaredNorm();
    return apart <= 0.0 || distance2 >= apart * apart;
  }
  // Whether their shapes tell so.
  bool Separates(size_t pair, const Posture& posture, double clearance, Scratch* scratch) const;

  struct Quick {
    size_t a, b;
    double radii;  // of both spheres [m]
    int legs;      // 1: a is of the left leg, b of the right one; −1: the other way; 0: else
  };

  const RobotModel& robot_;
  CollisionWorld world_;
  std::vector<Quick> quick_;            // of each pair
  std::vector<CollisionShape> shapes_;  // of the robot's bodies
};

}  // namespace halfstep
