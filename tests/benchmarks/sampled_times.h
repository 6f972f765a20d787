#pragma once

#include <array>
#include <bitset>
#include <map>
#include <memory>
#include <vector>

#include "experiments/config/experiment.h"
#include "planner/collision/collision_world.h"
#include "planner/search/step_set.h"
#include "wpg/geometry/foothold.h"

namespace halfstep {

/// When half-steps of a set, and rests, may begin among the obstacles of a scene that move, by
/// samples: no proof, and none of the planner's code. For `timed_reference_study`.
class SampledTimes {
 public:
  static constexpr double kTick = 0.1;  ///< between samples [s]
  static constexpr int kTicks = 1024;   ///< of all times that are known
  using Ticks = std::bitset<kTicks>;    ///< by when something begins
  /// Half-steps, and rests on both feet after the first one and on one foot before it.
  enum Kind : int { kDown, kUp, kBothFeet, kOneFoot };

  /// Robot and set are borrowed. At each tick each body of the robot is to be at least `clearance`
  /// [m] from what moves.
  SampledTimes(const Place& place, const StepSet& set, double clearance);

  /// Of element i, or of a rest; the foot `support` stands at X_WS and carries. Of a rest: whether
  /// the robot may be there at that tick.
  Ticks Starts(Kind kind, int i, Side support, const Foothold& X_WS);
  /// How many questions were answered.
  long asked() const { return asked_; }

 private:
  // Of a half-step, or of one of its ends.
  struct Samples {
    std::vector<std::vector<Eigen::Isometry3d>> X_SBody = {};  // by tick and body
    double reach = 0.0;                                        // from the foot, seen from above [m]
  };

  // Whether an obstacle's bounds at tick k come so near to a point; seen from above.
  bool NearFromAbove(int k, const Eigen::Vector3d& point, double radius) const;
  // The same in space.
  bool Near(int k, const Eigen::Vector3d& point, double radius) const;
  bool Clears(const std::vector<Eigen::Isometry3d>& X_SBody, const Eigen::Isometry3d& X_WS, int k);
  const Samples& SamplesOf(Kind kind, int i, Side support);

  const RobotModel& robot_;
  const StepSet& set_;
  std::shared_ptr<const MotionModel> model_;
  CollisionWorld world_;
  double clearance_;
  std::vector<CollisionShape> shapes_;                   // of the robot's bodies
  std::vector<CollisionWorld::Scratch> scratch_;         // by body
  std::vector<std::vector<Eigen::AlignedBox3d>> boxes_;  // by tick, until all rests, and obstacle
  std::map<std::array<int, 3>, Samples> samples_;
  long asked_ = 0;
};

}  // namespace halfstep
