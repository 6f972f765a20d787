#include "experiments/live/sensor.h"

namespace halfstep {

void StandInSensor::Begin(double origin) {
  truth_ = truth_.Since(origin);
  walks_ = true;
  frame_ = 1;
}

std::optional<Frame> StandInSensor::Next(double now) {
  const SensingConfig& sensing = options_.sensing;
  Frame frame{.taken = static_cast<double>(frame_) * sensing.period, .world = {}};
  // A robot that waits has time for each frame, and none is lost.
  if (frame.taken + (walks_ ? sensing.delay : 0.0) > now) return std::nullopt;
  ++frame_;
  frame.world = Measure(truth_, frame.taken, options_, random_);
  if (!walks_) return frame;
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const bool lost = part(random_) < sensing.lost;
  if (lost || !truth_.IsSeen(frame.taken)) frame.world.reset();
  return frame;
}

}  // namespace halfstep
