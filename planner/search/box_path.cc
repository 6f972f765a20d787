#include "planner/search/box_path.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <queue>
#include <tuple>
#include <unordered_map>

#include "wpg/check.h"
#include "wpg/elementary.h"
#include "wpg/geometry/simple_polygon.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using Cell = std::array<int, 3>;  // steps along x and y of the start, turns

class GridSearch {
 public:
  GridSearch(const BoxWorld& world, const BoxGrid& grid, const Pose2& X_WM, const GoalRegion& goal,
             const Eigen::AlignedBox2d& workspace)
      : world_(world), grid_(grid), X_WM_(X_WM), goal_(goal), workspace_(workspace) {}

  BoxPath Run(PlanMonitor* monitor) {
    BoxPath result;
    Enter({0, 0, 0}, -1, 0.0);
    while (!open_.empty()) {
      if (monitor->Stop()) {
        result.stopped = true;
        return result;
      }
      const auto [key, index] = open_.top();
      open_.pop();
      const Node node = Nth(nodes_, index);
      if (node.cost > best_.at(KeyOf(node.cell))) continue;  // reached more cheaply since
      monitor->CountNode();
      const Pose2 X = PoseOf(node.cell);
      if (!workspace_.contains(X.position()) || !world_.IsClear(X)) {
        result.start_blocked = index == 0;
        continue;
      }
      if (AtGoal(X)) {
        for (int i = index; i >= 0; i = Nth(nodes_, i).parent) {
          result.path.push_back(PoseOf(Nth(nodes_, i).cell));
        }
        std::reverse(result.path.begin(), result.path.end());
        return result;
      }
      Leave(node.cell, index, node.cost);
    }
    return result;
  }

 private:
  struct Node {
    Cell cell;
    int parent;
    double cost;
  };
  using Waiting = std::pair<double, int>;  // cost so far and left, index: the least first

  static std::uint64_t KeyOf(const Cell& cell) {
    const auto bits = [](int i) { return static_cast<std::uint64_t>(i) & 0x1fffff; };
    return bits(cell[0]) << 42 | bits(cell[1]) << 21 | bits(cell[2]);
  }

  Pose2 PoseOf(const Cell& cell) const {
    return X_WM_ * Pose2{cell[0] * grid_.spacing, cell[1] * grid_.spacing,
                         cell[2] * 2.0 * std::numbers::pi / grid_.yaws};
  }

  bool IsIn(const Pose2& X) const {
    return goal_.Distance(X.position()) <= 0.71 * grid_.spacing &&
           goal_.Turn(X.yaw) <= std::numbers::pi / grid_.yaws;
  }

  bool AtGoal(const Pose2& X) const {
    if (goal_.part == GoalPart::kMidFeet) return IsIn(X);
    const double y = 0.5 * world_.box().feet_apart;
    return (goal_.part != GoalPart::kRightFoot && IsIn(X * Pose2{0.0, y, 0.0})) ||
           (goal_.part != GoalPart::kLeftFoot && IsIn(X * Pose2{0.0, -y, 0.0}));
  }

  void Enter(const Cell& cell, int parent, double cost) {
    const auto [best, is_new] = best_.try_emplace(KeyOf(cell), cost);
    if (!is_new && best->second <= cost) return;
    best->second = cost;
    nodes_.push_back({cell, parent, cost});
    const double left =
        goal_.Distance(PoseOf(cell).position()) - world_.box().feet_apart - grid_.spacing;
    open_.push({cost + std::max(0.0, left), static_cast<int>(nodes_.size()) - 1});
  }

  void Leave(const Cell& cell, int index, double cost) {
    constexpr double kSideways = 1.6, kBackwards = 1.5;  // of the cost of walking ahead
    const double turn = 2.0 * std::numbers::pi / grid_.yaws;
    const double heading = cell[2] * turn;
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        if (x == 0 && y == 0) continue;
        const double off = Atan2(y, x) - heading, ahead = Cos(off);
        const double factor = ahead >= 0.0 ? kSideways + (1.0 - kSideways) * ahead
                                           : kSideways + (kSideways - kBackwards) * ahead;
        Enter({cell[0] + x, cell[1] + y, cell[2]}, index,
              cost + factor * grid_.spacing * Hypot(x, y));
      }
    }
    for (int way : {1, -1}) {
      const int turned = (cell[2] + way + grid_.yaws) % grid_.yaws;
      Enter({cell[0], cell[1], turned}, index, cost + 0.3 * turn);
    }
  }

  const BoxWorld& world_;
  BoxGrid grid_;
  Pose2 X_WM_;
  const GoalRegion& goal_;
  Eigen::AlignedBox2d workspace_;
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, double> best_;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> open_;
};

}  // namespace

BoxWorld::BoxWorld(const Scene& scene, const RobotBox& box)
    : scene_(scene),
      box_(box),
      level_(scene.ground->OnlyLevel() ? scene.ground->HeightEverywhere()
                                       : std::numeric_limits<double>::quiet_NaN()),
      world_(scene),
      shape_(MakeBox({box.length, box.width, box.height})) {}

bool BoxWorld::IsClear(const Pose2& X_WM) const {
  CollisionWorld::Scratch scratch;
  if (!world_.Clears(shape_, ToIsometry(X_WM, level_ + 0.5 * box_.height), 0.0, 0.0, &scratch))
    return false;
  if (scene_.no_step.empty()) return true;
  const Eigen::Matrix2Xd ground = SoleCorners(X_WM, {box_.length, box_.width});
  for (const Eigen::Matrix2Xd& polygon : scene_.no_step) {
    if (PolygonsTouch(ground, polygon)) return false;
  }
  return true;
}

BoxPath FindBoxPath(const BoxWorld& world, const BoxGrid& grid, const Pose2& X_WM,
                    const GoalRegion& goal, const Eigen::AlignedBox2d& workspace,
                    PlanMonitor* monitor) {
  HALFSTEP_CHECK(grid.spacing > 0.0 && grid.yaws >= 4,
                 "spacing = " << grid.spacing << ", yaws = " << grid.yaws);
  return GridSearch(world, grid, X_WM, goal, workspace).Run(monitor);
}

}  // namespace halfstep
