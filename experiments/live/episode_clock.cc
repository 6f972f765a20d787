#include "experiments/live/episode_clock.h"

#include <algorithm>
#include <thread>

namespace halfstep {

void WallClock::Begin() {
  begin_ = std::chrono::steady_clock::now();
  latest_ = 0.0;
}

void WallClock::WaitUntil(double t) {
  using Clock = std::chrono::steady_clock;
  std::this_thread::sleep_until(
      begin_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(t)));
  latest_ = std::max(latest_, Time(t) - t);
}

double WallClock::Time(double /*now*/) const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

}  // namespace halfstep
