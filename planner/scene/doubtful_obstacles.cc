#include "planner/scene/doubtful_obstacles.h"

#include <cmath>
#include <variant>

#include "wpg/check.h"
#include "wpg/files/text.h"
#include "wpg/robot/gravity.h"

namespace halfstep {
namespace {

constexpr double kMost = 20.0;          // of sizes and distances, in heights and extents
constexpr double kLeast = 1.0 / 500.0;  // of sizes, in heights
constexpr double kFastest = 10.0;       // of speeds, in √(g·height)

// The worst obstacle of a kind, and how many there are.
struct Kind {
  const Obstacle* worst = nullptr;
  double value = 0.0;
  int count = 0;

  void Add(const Obstacle& obstacle, double its_value, bool doubtful, bool larger_is_worse) {
    if (!doubtful) return;
    ++count;
    if (worst == nullptr || (larger_is_worse ? its_value > value : its_value < value)) {
      worst = &obstacle;
      value = its_value;
    }
  }
};

const char* QuestionAbout(const Obstacle& obstacle) {
  return std::holds_alternative<TriangleMesh>(obstacle.shape)
             ? ": is its file in other units (`mesh.scale`: 0.001 for millimetres)?"
             : ": are its numbers metres?";
}

}  // namespace

std::vector<std::string> DoubtfulObstacles(const Scene& scene, double height,
                                           const Eigen::AlignedBox2d& walk) {
  HALFSTEP_CHECK(height > 0 && !walk.isEmpty(), "height = " << height);
  const double most = kMost * (height + walk.sizes().norm());
  Kind large, small, far, fast;
  for (const Obstacle& obstacle : scene.obstacles) {
    const Eigen::AlignedBox3d bounds = BoundsOf(obstacle.shape, obstacle.X_WO);
    const double size = bounds.sizes().maxCoeff();
    const Eigen::AlignedBox2d from_above(bounds.min().head<2>(), bounds.max().head<2>());
    const double distance = walk.exteriorDistance(from_above);
    const double speed = obstacle.speed();
    large.Add(obstacle, size, size > most, true);
    small.Add(obstacle, size, size < kLeast * height, false);
    far.Add(obstacle, distance, distance > most, true);
    fast.Add(obstacle, speed, speed > kFastest * std::sqrt(kGravity * height), true);
  }
  std::vector<std::string> told;
  const auto tell = [&](const Kind& kind, const std::string& what) {
    if (kind.count == 0) return;
    const std::string others = kind.count > 1 ? Formatted(" (and %d others)", kind.count - 1) : "";
    told.push_back(scene.name + ": obstacle " + kind.worst->name + others + what +
                   QuestionAbout(*kind.worst));
  };
  tell(large, Formatted(" is %.4g m long, %.3g times as the robot is high", large.value,
                        large.value / height));
  tell(small, Formatted(" is %.4g m small, 1/%.3g of the robot's height", small.value,
                        height / small.value));
  tell(far, Formatted(" is %.4g m away from the walk, %.3g times as far as the robot is high",
                      far.value, far.value / height));
  tell(fast, Formatted(" has points that move at up to %.4g m/s (a turn is about the origin of its "
                       "frame), and its margin falls as fast",
                       fast.value));
  return told;
}

}  // namespace halfstep
