#pragma once

#include <optional>
#include <random>

#include "experiments/live/live_config.h"
#include "experiments/live/true_world.h"
#include "experiments/live/world.h"

namespace halfstep {

/// A frame of measurements.
struct Frame {
  double taken = 0.0;  ///< t_m [s]
  /// What was measured; none when the frame was lost. `version` and `sound_since` are for
  /// Updated() to fill.
  std::optional<World> world;
};

/// Where measurements of the world come from. Times are those of the walk [s]; before Begin() they
/// are those of the waiting robot, which waits from 0 on.
class Sensor {
 public:
  virtual ~Sensor() = default;
  /// The walk begins at `origin` [s]: from now on times are counted from there.
  virtual void Begin(double origin) = 0;
  /// The next frame that has arrived by `now`, in the order in which they were taken.
  virtual std::optional<Frame> Next(double now) = 0;
  /// From when on nothing happens in the world any more, so that an episode whose robot rests in
  /// the goal may end [s]; +∞ as long as that is not known.
  virtual double QuietFrom() const = 0;
};

/// The stand-in for motion capture: what is truly there, off by a noise, late or lost.
class StandInSensor final : public Sensor {
 public:
  /// The noise is drawn from `seed`: the same truth, options and seed give the same frames.
  StandInSensor(TrueWorld truth, const LiveOptions& options, std::uint64_t seed)
      : truth_(std::move(truth)), options_(options), random_(seed) {}
  void Begin(double origin) override;
  std::optional<Frame> Next(double now) override;
  double QuietFrom() const override { return truth_.end() + options_.sensing.period; }

  /// What truly happens, in times of the walk once that has begun.
  const TrueWorld& truth() const { return truth_; }
  /// Something more happens in the true world (TrueWorld::Append).
  void Append(const ScriptEvent& event) { truth_.Append(event); }

 private:
  TrueWorld truth_;
  LiveOptions options_;
  std::mt19937_64 random_;
  bool walks_ = false;
  long frame_ = 0;  // the next one
};

}  // namespace halfstep
