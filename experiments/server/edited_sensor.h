#pragma once

#include <functional>
#include <optional>
#include <string>

#include "experiments/live/live_config.h"
#include "experiments/live/sensor.h"
#include "experiments/live/true_world.h"
#include "experiments/server/client_inbox.h"

namespace halfstep {

/// The stand-in for motion capture of a world that people change while the robot walks: what they
/// do becomes events of its script, at the time at which it is taken in, once a sensing period.
class EditedSensor final : public Sensor {
 public:
  /// `inbox` is borrowed. `refuse` is told, in a sentence, why an edit cannot be.
  EditedSensor(TrueWorld truth, const LiveOptions& options, std::uint64_t seed, ClientInbox* inbox,
               std::function<void(const std::string&)> refuse);

  void Begin(double origin) override;
  std::optional<Frame> Next(double now) override;
  /// When a client asked for the end, or when the longest time is up.
  double QuietFrom() const override;

  /// What truly happened, in the times of the walk.
  const TrueWorld& truth() const { return sensor_.truth(); }

 private:
  // Appends what an edit says to the script; returns why not, "" when it does.
  std::string Apply(const Carry& carry, double now);
  std::string Apply(const MoveGoal& goal, double now);
  std::string Apply(const AddBox& box, double now);
  std::string Apply(const Remove& remove, double now);
  std::string Apply(const Command& command, double now);

  StandInSensor sensor_;
  LiveOptions options_;
  ClientInbox& inbox_;
  std::function<void(const std::string&)> refuse_;
  double next_ = 0.0;    // no edit is taken in before [s]
  double origin_ = 0.0;  // of the walk's time, in that of the script [s]
};

/// The event that carries an obstacle from X_WO so that none of its points is faster than the
/// obstacle's speed bound; where that is 0, and where it turns without going anywhere, it jumps.
ScriptEvent CarriedWithin(const Obstacle& obstacle, const Eigen::Isometry3d& X_WO,
                          const Carry& carry, double at);

}  // namespace halfstep
