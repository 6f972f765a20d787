#include "experiments/run/crouched_forms.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "experiments/run/certified_half_steps.h"
#include "experiments/run/half_step_table.h"
#include "experiments/run/level_crossings.h"
#include "planner/collision/collision_world.h"
#include "planner/search/step_set.h"
#include "smoothing/margins/demandable.h"
#include "smoothing/margins/tube_shift.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/standing_bounds.h"

namespace halfstep {
namespace {

constexpr int kSteps = 4;             // of crouch
constexpr double kCrouchStep = 0.05;  // [m], of HRP-2
constexpr double kAtLeast = 0.5;      // of the robot's height: what hangs lower is walked around

double LowestPoint(const Obstacle& obstacle) {
  return BoundsOf(obstacle.shape, obstacle.X_WO).min().z();
}

std::string Hangs(const Obstacle& obstacle, double needed) {
  return Quote(obstacle.name) + Formatted(
                                    " hangs %.3f m above the floor, where half-steps upright "
                                    "need %.3f m",
                                    LowestPoint(obstacle), needed);
}

// In millimetres, as one writes it.
double CrouchOf(int step, double size) { return std::round(1e3 * step * kCrouchStep * size) / 1e3; }

// What half-steps keep above the robot: the clearance, and what volumes are larger by [m].
double RoomAbove(const ExperimentConfig& config, const RobotModel& robot) {
  const MarginLimits limits = Demandable(config.smoothing.limits, robot);
  const SweptVolumeOptions& volumes = config.swept_volumes.options;
  return limits.demanded_of(MarginFamily::kClearance) + TubeShift(robot, limits.tube).body +
         volumes.cell + volumes.displacement;
}

// The floor in cells, and which of them a column may stand on.
class ColumnMap {
 public:
  ColumnMap(const ExperimentConfig& config, const Place& place, double top)
      : spacing_(0.05 * SizeOf(place.robot)) {
    area_ = AreaOf(config, place, 2.0);
    count_ = (area_.sizes() / spacing_).cast<int>() + Eigen::Vector2i::Ones();
    constexpr double kMost = 40000;
    if (const double cells = area_.sizes().prod() / (spacing_ * spacing_); cells > kMost) {
      spacing_ *= std::sqrt(cells / kMost);
      count_ = (area_.sizes() / spacing_).cast<int>() + Eigen::Vector2i::Ones();
    }
    const double low = config.half_step.via_height;
    const CollisionShape column(MakeCylinder(1.5 * spacing_, std::max(0.1 * top, top - low)));
    const CollisionWorld world(place.scene);
    CollisionWorld::Scratch scratch;
    free_.resize(static_cast<size_t>(count_.prod()));
    for (int cell = 0; cell < count_.prod(); ++cell) {
      Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
      X.translation() << PlaceOf(cell), 0.5 * (top + low);
      free_[static_cast<size_t>(cell)] = world.Clears(column, X, 0.0, 0.0, &scratch);
    }
  }

  // Whether the column comes from a place to the goal.
  bool Leads(const Eigen::Vector2d& from, const GoalRegion& goal) const {
    std::vector<bool> seen(free_.size());
    std::deque<int> open = {CellOf(from)};
    seen[static_cast<size_t>(open.front())] = true;
    while (!open.empty()) {
      const int cell = open.front();
      open.pop_front();
      if (goal.Distance(PlaceOf(cell)) <= 2.0 * spacing_) return true;
      const int x = cell % count_.x(), y = cell / count_.x();
      for (int v = std::max(0, y - 1); v <= std::min(count_.y() - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(count_.x() - 1, x + 1); ++u) {
          const int next = v * count_.x() + u;
          if (Nth(seen, next) || !Nth(free_, next)) continue;
          seen[static_cast<size_t>(next)] = true;
          open.push_back(next);
        }
      }
    }
    return false;
  }

 private:
  Eigen::Vector2d PlaceOf(int cell) const {
    return area_.min() + spacing_ * Eigen::Vector2d(cell % count_.x(), cell / count_.x());
  }
  int CellOf(const Eigen::Vector2d& p_W) const {
    const Eigen::Vector2i at = ((p_W - area_.min()) / spacing_).array().round().cast<int>();
    const Eigen::Vector2i in = at.cwiseMax(0).cwiseMin(count_ - Eigen::Vector2i::Ones());
    return in.y() * count_.x() + in.x();
  }

  double spacing_;  // [m]
  Eigen::AlignedBox2d area_;
  Eigen::Vector2i count_;
  std::vector<bool> free_;
};

}  // namespace

Overhead::Overhead(const ExperimentConfig& config, const Place& place)
    : config_(config),
      place_(place),
      top_(StandingBounds(place.robot).max().z() - config.half_step.crouch),
      room_(RoomAbove(config, place.robot)) {
  const double step = kCrouchStep * SizeOf(place.robot);
  for (const Obstacle& obstacle : place.scene.obstacles) {
    if (!obstacle.rests()) continue;
    const double missing = top_ + room_ - LowestPoint(obstacle);
    const int steps = static_cast<int>(std::ceil(missing / step - 1e-9));
    if (steps >= 1 && steps <= kSteps) steps_.push_back(steps);
  }
  std::ranges::sort(steps_);
  steps_.erase(std::ranges::unique(steps_).begin(), steps_.end());
}

bool Overhead::Bars() const {
  const auto feet = StartOf(config_, place_.robot, *place_.scene.ground);
  const Eigen::Vector2d from = MidFeet(feet[0].Planar(), feet[1].Planar()).position();
  return !ColumnMap(config_, place_, top_).Leads(from, GoalOn(config_.goal, *place_.scene.ground));
}

CrouchedForm Overhead::FormOf(int step) const {
  constexpr int kShare = 5;
  const double size = SizeOf(place_.robot);
  const int all = MakeStepSet(config_.step_set, PrototypeOf(config_), [](const HalfStep&) {
                    return true;
                  }).size();
  CrouchedForm best;
  for (const double lift : {1.0, 0.64, 0.48, 0.32}) {
    ExperimentConfig tried = config_;
    tried.half_step.crouch = config_.half_step.crouch + CrouchOf(step, size);
    tried.half_step.via_height = std::round(1e3 * lift * config_.half_step.via_height) / 1e3;
    const int places = CertifiedHalfSteps(place_.robot, tried).size();
    if (places > best.places) best = {tried.half_step, places, {}};
    if (kShare * places >= all) {
      best = {tried.half_step, places, {}};
      break;
    }
  }
  const Obstacle* lowest = nullptr;  // of what it helps with
  for (const Obstacle& obstacle : place_.scene.obstacles) {
    if (!obstacle.rests()) continue;
    const double missing = top_ + room_ - LowestPoint(obstacle);
    if (missing <= 0.0 || missing > kCrouchStep * size * step) continue;
    if (lowest == nullptr || LowestPoint(obstacle) < LowestPoint(*lowest)) lowest = &obstacle;
  }
  if (lowest != nullptr) best.reason = Hangs(*lowest, top_ + room_);
  return best;
}

std::vector<CrouchedForm> Overhead::Forms() const {
  constexpr size_t kMost = 2;
  std::vector<CrouchedForm> forms;
  for (auto step = steps_.rbegin(); step != steps_.rend() && forms.size() < kMost; ++step) {
    CrouchedForm form = FormOf(*step);
    if (form.places > 0) forms.push_back(std::move(form));
  }
  return forms;
}

std::string HangsTooLow(const Obstacle& obstacle, const RobotModel& robot, double clearance) {
  const double top = StandingBounds(robot).max().z(), low = LowestPoint(obstacle);
  if (low < kAtLeast * top || low >= top + clearance) return "";
  return Hangs(obstacle, top + clearance);
}

}  // namespace halfstep
