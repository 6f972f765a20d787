#pragma once

#include <map>
#include <string>

#include "tests/oracle/nasty_draws.h"
#include "wpg/motion/walk_state.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::oracle {

/// Errors of computed numbers against exact ones, over the bounds of smoothing/README.md,
/// "Rounding".
struct RoundingTally {
  /// Of one elementary quantity.
  struct Part {
    long draws = 0;         ///< with a bound
    long undecided = 0;     ///< without one
    double largest = 0;     ///< error over bound
    double of_typical = 0;  ///< the sum of log₁₀(bound), over draws its mean
  };
  std::map<std::string, Part> parts;  ///< by name

  void Add(const std::string& part, double error, double bound);
  void Add(const RoundingTally& other);
};

/// Forms of half-steps at random times, widths, ramps, θ: value and two derivatives.
void DrawForms(long draws, unsigned seed, RoundingTally* tally);
/// Quantities of drawn walks (nasty_draws.h) at random instants; of `steps` steps where that is
/// above 0.
void DrawWalks(const std::string& robot_file, long draws, int steps, unsigned seed,
               RoundingTally* tally);
/// Legs of a robot that is `scale` times as large, at poses from bent to stretched to 1e-12 of
/// their length, up to 1 km from the origin, with yaws of many turns; the pose is moved by as much
/// as is said to be its error.
void DrawLegs(const RobotModel& robot, double scale, long draws, unsigned seed,
              RoundingTally* tally);

/// Legs of such a robot that have no closed form, on the way from their neighbour that has one, at
/// angles of up to 1 rad: what is computed of their neighbourhood.
void DrawNeighbourhoods(const RobotModel& robot, double scale, long draws, unsigned seed,
                        RoundingTally* tally);

/// What such a robot's masses ask for: joints' accelerations, the floor's wrench, the ZMP, the
/// torques of one foot that stands alone and of two that share, and the friction that one needs.
/// Half of the feet move as knees that are nearly stretched let them, half as they like.
/// Bounds are those of intervals of no width. With `of_bound` below 1 these are made too small.
void DrawDynamics(const RobotModel& robot, double scale, long draws, unsigned seed,
                  RoundingTally* tally, double of_bound = 1.0);

/// Sums, products and quotients of random numbers (wpg/rounded.h).
void DrawNumbers(long draws, unsigned seed, RoundingTally* tally);
/// Points inside the support polygon of two soles, up to 900 m away and down to 1e-13 m from being
/// in line with each other.
void DrawSupports(long draws, unsigned seed, RoundingTally* tally);
/// Distances of polygons as large as soles, treads and rooms, of corners that are exact.
void DrawPolygons(long draws, unsigned seed, RoundingTally* tally);
/// Slabs between two bodies of a robot, apart, up to 900 m away: how much wider than the exact one
/// along the same direction.
void DrawDistances(const RobotModel& robot, long draws, unsigned seed, RoundingTally* tally);

/// A robot that is `scale` times as large, of the same stuff.
RobotModel ScaledRobot(RobotModel robot, double scale);
/// Values and first derivatives of an upright posture, both soles level: each leg from bent to
/// stretched to 1e-12 of its length, up to 1 km away, with yaws of many turns.
WalkJet DrawPose(const RobotModel& robot, double scale, Draw* draw);

}  // namespace halfstep::oracle
