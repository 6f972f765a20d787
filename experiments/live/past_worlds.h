#pragma once

#include <Eigen/Geometry>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "experiments/live/world.h"

namespace halfstep {

/// How far a point of a shape is, when its frame is at one pose, from where it is at another, at
/// most [m].
double Displacement(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, const Shape& shape);
/// The same of a shape no point of which is farther than `radius` [m] from its frame's origin.
double Displacement(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double radius);

/// Where everything was measured in the worlds so far, kept so that a new one is compared with all
/// of them without looking at each: runs of measurements are known by a ball around them.
class PastWorlds {
 public:
  /// Precondition: `worlds` in the order of their versions.
  explicit PastWorlds(std::span<const World> worlds = {});

  /// Keeps a world for later questions.
  void Add(const World& world);

  /// What of `now` contradicts a world from version `since` on, in the order of its obstacles, then
  /// of its areas; `now` is newer than all of them.
  std::vector<Contradiction> Latest(const World& now, int since) const;

 private:
  struct Place {
    int version;
    Eigen::Isometry3d X_WO;
    double error, speed, measured_at;
  };
  // Some places, one after the other, together.
  struct Run {
    Eigen::Vector3d center;
    double radius;         // of a ball around the places of the frame's origin [m]
    Eigen::Matrix3d axes;  // of the first place
    double turn;           // farthest from these axes [rad]
    double error, speed;   // least
    double last_measured_at;
  };
  // An obstacle without a gap: it was there in the world after `absent` and in all since.
  struct Track {
    int absent = -1;      // the latest version without it
    double radius = 0.0;  // about its frame's origin [m]
    std::vector<Place> places = {};
    std::vector<Run> runs = {}, long_runs = {};  // each of kRun places; of kRun runs
  };

  static Run Together(std::span<const Place> places);
  static Contradiction Between(const Place& before, const Obstacle& now, double radius);
  static bool MayContradict(const Run& run, const Obstacle& now, double radius);
  // The latest version that the obstacle contradicts, as long as it is from `since` on; −1: none.
  Contradiction Latest(const Obstacle& now, int since) const;

  int last_ = -1;  // version
  std::map<std::string, Track> tracks_;
  std::map<size_t, int> areas_absent_;  // by area of the last world: the latest version without it
};

}  // namespace halfstep
