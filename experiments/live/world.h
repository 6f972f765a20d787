#pragma once

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "experiments/live/course.h"
#include "experiments/live/live_config.h"
#include "experiments/live/true_world.h"
#include "planner/scene/scene.h"
#include "planner/search/goal_region.h"

namespace halfstep {

/// What the robot knows of the world: an immutable snapshot after a frame of measurements. Every
/// obstacle of the scene carries its measurement (ObstacleMotion: r, v, t_m, horizon), so what is
/// proved against `scene` holds until valid_until() as long as obstacles keep to r and v.
struct World {
  int version = 0;           ///< counts the frames of measurements, from 0
  double measured_at = 0.0;  ///< t_m of the frame, a time of the walk [s]
  Scene scene;               ///< what is there, as measured
  /// Of each obstacle: where it was first measured of all the places that are one up to the errors,
  /// and when [s].
  struct Stay {
    Eigen::Isometry3d X_WO;  ///< that first measurement
    double since = 0.0;      ///< its time [s]
  };
  std::vector<Stay> stays;                    ///< by obstacle of `scene`
  std::vector<size_t> areas;                  ///< which no-step areas of the scene file are there
  GoalRegion goal;                            ///< where to go, where `course` is null
  std::shared_ptr<const Course> course = {};  ///< what was commanded in place of the goal
  /// The earliest version that no later one contradicts: an obstacle was not where it could not
  /// have been. What was proved against earlier versions is void; against this one and later ones
  /// it is not.
  int sound_since = 0;

  /// How long what is proved against the scene holds [s]; +∞ when no obstacle can move.
  double valid_until() const;
};

/// Whether the world `b` is so different from `a`, which was looked at, that it has to be looked
/// at, although nothing is void.
bool DiffersClearly(const World& a, const World& b);

class PastWorlds;

/// An obstacle or a no-step area that is not as a past world said: the latest such world.
struct Contradiction {
  std::string name;       ///< of the obstacle; of an area "no-step area 1"
  int version = -1;       ///< of the past world; −1: there is none
  bool was_there = true;  ///< in that world; where it was not, the rest is 0
  double moved = 0.0;     ///< how far a point of it is from where it was measured then [m]
  double elapsed = 0.0;   ///< between both measurements [s]
  double errors = 0.0;    ///< those of both measurements, added [m]
  double speed = 0.0;     ///< that the past world states [m/s]

  /// How far it may have moved [m].
  double allowed() const { return errors + speed * elapsed; }
  /// By how much it has moved farther than that [m].
  double beyond() const { return moved - allowed(); }
  /// "bar: 0.534 m from where world 4 had it 0.2 s before, 0.01 m are allowed".
  std::string Text() const;
  bool operator==(const Contradiction&) const = default;  ///< in all of these
};

/// The world after a frame, and which obstacles or areas contradict what was known. `past` has the
/// versions so far, up to `last`. An obstacle contradicts an earlier version when a point of it is
/// farther from where it was measured then than both errors and its speed then allow, and when it
/// was not there; a no-step area when it was not there. Every version that is not void yet counts:
/// an obstacle that is taken to rest and creeps contradicts an old one, although never the last.
/// What vanishes contradicts nothing. An obstacle that has stayed for `sensing.rests_after` is
/// taken to rest: its speed is that of the drift.
struct WorldUpdate {
  World world;                                ///< the world after the frame
  std::vector<Contradiction> contradictions;  ///< of worlds that were not void, each name once
};
/// The world after `frame`, from the one before it, `last`.
WorldUpdate Updated(const World& last, const PastWorlds& past, World frame,
                    const LiveOptions& options);

/// The same world for a walk that begins at time `origin` [s]: all times are counted from there.
World Since(World world, double origin);

/// An obstacle of a scene as it was measured at t [s].
Obstacle Measured(Obstacle obstacle, const Eigen::Isometry3d& X_WO, double t,
                  const LiveOptions& options);

/// The stand-in for motion capture: a frame of what is truly there at t [s], positions off by the
/// noise. Version and `sound_since` are for Updated() to fill.
World Measure(const TrueWorld& truth, double t, const LiveOptions& options,
              std::mt19937_64& random);

}  // namespace halfstep
