#pragma once

#include <chrono>

namespace halfstep {

/// Lets the time of an episode pass. In lockstep it passes when it is told to, and nothing that is
/// computed takes any.
class EpisodeClock {
 public:
  virtual ~EpisodeClock() = default;
  /// Now it is 0.
  virtual void Begin() {}
  /// Returns when it is t [s], at once when it is later already.
  virtual void WaitUntil(double /*t*/) {}
  /// The time, if it passes by itself; else `now` [s].
  virtual double Time(double now) const { return now; }
  /// Whether it passes by itself.
  virtual bool passes() const { return false; }
};

/// Time as it passes.
class WallClock final : public EpisodeClock {
 public:
  void Begin() override;
  void WaitUntil(double t) override;
  double Time(double now) const override;
  bool passes() const override { return true; }
  /// By how much WaitUntil() returned too late at most since Begin() [s].
  double latest() const { return latest_; }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double latest_ = 0.0;
};

}  // namespace halfstep
