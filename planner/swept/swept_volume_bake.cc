#include "planner/swept/swept_volume_bake.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "wpg/nth.h"

namespace halfstep {

std::optional<SweptVolumes> BakeSweptVolumes(const RobotModel& robot, const MotionModel& model,
                                             const StepSet& set, const SweptVolumeOptions& options,
                                             const BakeHooks& hooks) {
  const SweptVolumeBaker baker(robot, options);
  const int size = set.size();
  SweptVolumes volumes{.set = set, .down = {}, .up = {}};
  volumes.down.resize(static_cast<size_t>(size));
  volumes.up.resize(static_cast<size_t>(size));

  std::mutex mutex;  // of what follows
  int done = 0;
  std::exception_ptr failure;
  std::atomic<int> next{0};
  std::atomic<bool> stopped{false};
  const auto bake = [&](int i) {
    if (hooks.recall) {
      if (auto known = hooks.recall(i)) return *std::move(known);
    }
    ElementVolumes element{.down = baker.Bake(set.Down(i, Side::kLeft), model),
                           .up = baker.Bake(set.Up(i, Side::kRight), model)};
    if (hooks.keep) hooks.keep(i, element);
    return element;
  };
  const auto work = [&] {
    try {
      for (int i = next++; i < size && !stopped; i = next++) {
        if (hooks.stop.stop_requested()) stopped = true;
        if (stopped) break;
        ElementVolumes element = bake(i);
        Nth(volumes.down, i) = std::move(element.down);
        Nth(volumes.up, i) = std::move(element.up);
        const std::lock_guard lock(mutex);
        ++done;
        if (!stopped && hooks.progress && !hooks.progress(static_cast<double>(done) / size)) {
          stopped = true;
        }
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      stopped = true;
      if (!failure) failure = std::current_exception();
    }
  };
  {
    const int wanted =
        hooks.threads > 0 ? hooks.threads : static_cast<int>(std::thread::hardware_concurrency());
    std::vector<std::jthread> threads;
    for (int i = 1; i < std::min(wanted, size); ++i) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  if (done < size) return std::nullopt;
  return volumes;
}

}  // namespace halfstep
