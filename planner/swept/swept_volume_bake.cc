#include "planner/swept/swept_volume_bake.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "wpg/nth.h"
#include "wpg/robot/sole_outline.h"

namespace halfstep {
namespace {

ElementVolumes BakeElement(const SweptVolumeBaker& baker, const MotionModel& model,
                           const StepSet& set, int i) {
  const HalfStep down = set.Down(i, Side::kLeft), up = set.Up(i, Side::kRight);
  if (!set.on_levels) return {.down = baker.Bake(down, model), .up = baker.Bake(up, model)};
  ElementVolumes element;
  if (auto parts = baker.BakeParts(down, model)) {
    element.down = std::move(parts->rest);
    element.down_swing = std::move(parts->swing);
    element.down_stand = std::move(parts->stand);
  }
  if (auto parts = baker.BakeParts(up, model)) {
    element.up = std::move(parts->rest);
    element.up_swing = std::move(parts->swing);
    element.up_stand = std::move(parts->stand);
  }
  return element;
}

}  // namespace

void MakeRoom(SweptVolumes* volumes) {
  ForEachVolume(*volumes, volumes->set.on_levels, [volumes](SweptVolumes::Volumes& all) {
    all.resize(volumes->set.placements.size());
  });
}

void PutElement(int i, ElementVolumes element, SweptVolumes* volumes) {
  std::vector<std::optional<BoxTree>*> from;
  const bool on_levels = volumes->set.on_levels;
  ForEachVolume(element, on_levels, [&](std::optional<BoxTree>& tree) { from.push_back(&tree); });
  size_t next = 0;
  ForEachVolume(*volumes, on_levels,
                [&](SweptVolumes::Volumes& all) { Nth(all, i) = std::move(*from[next++]); });
}

RobotModel WithFootPlates(RobotModel robot) {
  constexpr double kThick = 1e-3;  // [m] a hull needs some
  const Eigen::Matrix2Xd outline = FootOutline(robot);
  const Eigen::Index n = outline.cols();
  for (int leg = 0; leg < 2; ++leg) {
    const Leg& of = Nth(robot.legs, leg);
    const Eigen::Isometry3d X_LinkSole = of.joints[5].X_BLink.inverse() * of.X_BSole;
    Eigen::Matrix3Xd corners(3, 2 * n);
    corners << outline, outline, Eigen::RowVectorXd::Zero(n),
        Eigen::RowVectorXd::Constant(n, kThick);
    RobotBody plate;
    plate.name = "plate under " + std::string(Name(static_cast<Side>(leg))) + " foot";
    plate.leg = leg;
    plate.link = 5;
    plate.shape = MakeHull(X_LinkSole * corners);
    robot.bodies.push_back(std::move(plate));
  }
  return robot;
}

std::optional<SweptVolumes> BakeSweptVolumes(const RobotModel& robot, const MotionModel& model,
                                             const StepSet& set, const SweptVolumeOptions& options,
                                             const BakeHooks& hooks) {
  const RobotModel widened = set.on_levels ? WithFootPlates(robot) : robot;
  const SweptVolumeBaker baker(widened, options);
  const int size = set.size();
  SweptVolumes volumes{.set = set, .down = {}, .up = {}};
  MakeRoom(&volumes);

  std::mutex mutex;  // of what follows
  int done = 0;
  std::exception_ptr failure;
  std::atomic<int> next{0};
  std::atomic<bool> stopped{false};
  const auto bake = [&](int i) {
    if (hooks.recall) {
      if (auto known = hooks.recall(i)) return *std::move(known);
    }
    ElementVolumes element = BakeElement(baker, model, set, i);
    if (hooks.keep) hooks.keep(i, element);
    return element;
  };
  const auto work = [&] {
    try {
      for (int i = next++; i < size && !stopped; i = next++) {
        if (hooks.stop.stop_requested()) stopped = true;
        if (stopped) break;
        ElementVolumes element = bake(i);
        PutElement(i, std::move(element), &volumes);
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
