#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
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
/// of them without looking at each: all measurements of an obstacle, and runs of them, are known by
/// a ball around them. An obstacle that rests costs about the same after a minute as after a day.
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
  // What mostly is as in the place before.
  struct Like {
    Eigen::Matrix3d axes;
    double error, speed;
    bool operator==(const Like&) const = default;
  };
  struct Place {
    int version;
    int like;  // index
    double measured_at;
    Eigen::Vector3d p_WO;
  };
  // Some places, one after the other, together.
  struct Run {
    Eigen::Vector3d center;
    double radius;         // of a ball around the places of the frame's origin [m]
    Eigen::Matrix3d axes;  // of the first place
    double turn;           // farthest from these axes [rad]
    double error, speed;   // least
    double last_measured_at;
    void Widen(const Like& like);  // takes in one more
  };
  // An obstacle without a gap: it was there in the world after `absent` and in all since.
  struct Track {
    std::string name = {};
    int absent = -1;      // the latest version without it
    double radius = 0.0;  // about its frame's origin [m]
    size_t number = 0;    // of the tracks that were begun
    std::vector<Place> places = {};
    std::vector<Like> likes = {};
    Run all = {};                                // of all places
    size_t refit = 1;                            // how many there are when `all` gets a new centre
    std::vector<Run> runs = {}, long_runs = {};  // each of kRun places; of kRun runs; soon
    Run Together(std::span<const Place> some) const;
    void Add(const Place& place);
  };

  // The track of an obstacle that was there in the last world; null: it was not. In most worlds
  // obstacles are there in the same order: `likely` is where it is there, and then the next one.
  Track* Find(const std::string& name, size_t* likely) const;
  // Lets memory bring the track that is there in the last world a little behind that place: among
  // many obstacles none is at hand any more.
  void Fetch(size_t likely) const;
  // But for its name.
  static Contradiction Between(const Track& track, const Place& before, const Obstacle& now);
  static bool MayContradict(const Run& run, const Obstacle& now, double radius);
  // The latest place that the obstacle contradicts, as long as it is of version `since` or later;
  // null: none.
  static const Place* Latest(const Track& track, const Obstacle& now, int since);

  int last_ = -1;  // version
  std::map<std::string, std::unique_ptr<Track>> tracks_;
  std::vector<Track*> recent_;          // of the last world, in its order
  size_t begun_ = 0;                    // tracks
  std::map<size_t, int> areas_absent_;  // by area of the last world: the latest version without it
};

}  // namespace halfstep
