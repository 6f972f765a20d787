#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "planner/collision/separation.h"
#include "wpg/motion/half_step_tracks.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Where a robot's bodies are during a half-step, or a rest at one of its ends, by halves of
/// halves: piece 1 is all of it, pieces 2n and 2n + 1 are those of n. Each is made when it is first
/// asked for. Source: planner/README.md, "Planning in time".
class HalfStepPieces {
 public:
  /// The bodies over some of the local times, seen from the support sole. What it says holds for
  /// all of these times.
  struct Piece {
    double mid = 0.0, half = 0.0;            ///< of its local times [s]
    bool bounded = false;                    ///< whether the motion has a bound; else no more
    std::vector<Eigen::Isometry3d> X_SBody;  ///< at mid
    std::vector<double> displacement;        ///< of each body from there, at most [m]
    std::optional<CollisionShape> around;    ///< upright, holds all bodies wherever they are
  };

  /// Local times `from` to `to` of the tracks [s]; equal: a rest. What is passed by reference is
  /// borrowed: the robot's bodies have these shapes.
  HalfStepPieces(const RobotModel& robot, const MotionBounds& bounds,
                 const std::vector<CollisionShape>& shapes, HalfStepTracks tracks, double from,
                 double to)
      : robot_(robot),
        bounds_(bounds),
        shapes_(shapes),
        tracks_(std::move(tracks)),
        from_(from),
        to_(to) {}

  double from() const { return from_; }         ///< [s]
  double lasts() const { return to_ - from_; }  ///< [s]; 0: a rest
  /// Piece n ≥ 1; counts in `made` when it is made. Valid for as long as this.
  const Piece& Of(int n, std::int64_t* made);

 private:
  Piece Make(int n) const;
  CollisionShape Around(const Piece& piece) const;

  const RobotModel& robot_;
  const MotionBounds& bounds_;
  const std::vector<CollisionShape>& shapes_;
  HalfStepTracks tracks_;
  double from_, to_;
  std::map<int, Piece> pieces_ = {};
};

}  // namespace halfstep
