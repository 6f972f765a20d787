#include "experiments/bench/bench_scene.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "planner/search/plan_shortcut.h"
#include "wpg/check.h"
#include "wpg/elementary.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/robot_measures.h"
#include "wpg/robot/robot_model.h"
#include "wpg/robot/standing_bounds.h"

namespace halfstep {
namespace {

// Of ℓ: the way, half of the room's breadth, what stays free at the ends, the thickness of walls.
constexpr double kWay = 4.0, kHalf = 1.15, kFree = 0.8, kEnd = 0.9, kWall = 0.1;
constexpr double kBar[] = {0.03, 0.06, 0.09, 0.12, 0.15};        // of ℓ
constexpr double kGap[] = {1.3, 1.1, 0.95, 0.8, 0.7};            // of the breadth
constexpr double kBelowTop[] = {-0.05, 0.04, 0.10, 0.17, 0.24};  // of ℓ, below the robot's top
constexpr int kStations[] = {1, 1, 2, 2, 3};

double Millimetres(double metres) { return std::round(1e3 * metres) / 1e3; }

// Draws one scene and writes it down; places are in millimetres.
class Drawing {
 public:
  Drawing(const BenchKey& key, const BenchSizes& sizes, std::uint64_t seed)
      : key_(key), sizes_(sizes), level_(LevelOf(key.difficulty, sizes)), random_(seed) {}

  BenchScene Draw(const std::string& robot) {
    Room();
    const std::vector<std::string> stations = Stations();
    const double first = kFree * sizes_.leg, room = (kWay - 2.0 * kFree) * sizes_.leg;
    const int count = static_cast<int>(stations.size());
    for (int i = 0; i < count; ++i) {
      const double x = first + room * (i + Between(0.35, 0.65)) / count;
      // The hardest is the first of its kind; so are all of a mix, which has one of each.
      const bool hardest = key_.kind == "mix" || i == 0;
      const std::string& kind = stations[static_cast<size_t>(i)];
      if (kind == "below") Bar(x, hardest);
      if (kind == "beside") Doorway(x, hardest);
      if (kind == "overhead") Beam(x, hardest);
    }
    const bool mixed = key_.kind == "mix";
    if (mixed || key_.kind == "below") Blocks(mixed ? key_.difficulty : 3 * key_.difficulty);
    if (mixed || key_.kind == "beside") Posts(mixed ? (key_.difficulty + 1) / 2 : key_.difficulty);
    if (mixed || key_.kind == "overhead") Hangings((key_.difficulty + 1) / 2);
    made_.scene = "# halfstep bench: " + key_.Name() + Comment() + "\nname: " + key_.Name() +
                  "\nobstacles:\n" + items_;
    made_.config = Config(robot);
    return std::move(made_);
  }

 private:
  double Between(double least, double most) { return Uniform(least, most, random_); }

  // Texts say exactly what is there.
  void Box(const std::string& name, double x, double y, double bottom, double length, double width,
           double height, double yaw_deg = 0.0) {
    length = Millimetres(length), width = Millimetres(width), height = Millimetres(height);
    items_ += "  - name: " + name +
              Formatted("\n    box: {size_m: [%.3f, %.3f, %.3f]}\n", length, width, height) +
              Formatted("    pose: {xyz: [%.4f, %.4f, %.4f], rpy_deg: [0, 0, %.1f]}\n", x, y,
                        bottom + 0.5 * height, yaw_deg);
  }
  std::string Numbered(const char* what) { return Formatted("%s %d", what, ++count_); }

  // Four walls.
  void Room() {
    const double l = sizes_.leg, t = kWall * l, h = sizes_.height;
    const double length = (kWay + 2.0 * kEnd) * l, side = kHalf * l + 0.5 * t;
    Box("wall left", 0.5 * kWay * l, side, 0.0, length, t, h);
    Box("wall right", 0.5 * kWay * l, -side, 0.0, length, t, h);
    Box("wall behind", -kEnd * l - 0.5 * t, 0.0, 0.0, t, 2.0 * kHalf * l, h);
    Box("wall ahead", (kWay + kEnd) * l + 0.5 * t, 0.0, 0.0, t, 2.0 * kHalf * l, h);
  }

  // What lies across, in the order of the way.
  std::vector<std::string> Stations() {
    if (key_.kind != "mix")
      return std::vector<std::string>(static_cast<size_t>(level_.stations), key_.kind);
    std::vector<std::string> kinds = {"below", "beside", "overhead"};
    for (int i = 2; i > 0; --i)
      std::swap(kinds[static_cast<size_t>(i)], kinds[static_cast<size_t>(Pick(i + 1, random_))]);
    return kinds;
  }

  void Bar(double x, bool hardest) {
    const double top = hardest ? level_.bar : Millimetres(Between(0.5, 1.0) * level_.bar);
    made_.bar = std::max(made_.bar, top);
    Box(Numbered("bar"), x, 0.0, 0.0, 0.03 * sizes_.leg, 2.2 * kHalf * sizes_.leg, top,
        Between(-8.0, 8.0));
  }

  void Doorway(double x, bool hardest) {
    const double gap = hardest ? level_.gap : Millimetres(Between(1.0, 1.3) * level_.gap);
    made_.gap = std::min(made_.gap, gap);
    const double half = kHalf * sizes_.leg, t = kWall * sizes_.leg;
    const double most = std::max(0.0, half - 0.5 * gap - 0.05 * sizes_.leg);
    const double y = Millimetres(Between(-most, most));
    const std::string name = Numbered("doorway");
    doors_.push_back({x, y, gap});
    const double left = half - (y + 0.5 * gap), right = half + (y - 0.5 * gap);
    if (left > 0.005) Box(name + " left", x, half - 0.5 * left, 0.0, t, left, sizes_.height);
    if (right > 0.005) Box(name + " right", x, 0.5 * right - half, 0.0, t, right, sizes_.height);
  }

  void Beam(double x, bool hardest) {
    const double low =
        hardest ? level_.headroom
                : Millimetres(Between(level_.headroom, level_.headroom + 0.1 * sizes_.leg));
    made_.headroom = std::min(made_.headroom, low);
    Box(Numbered("beam"), x, 0.0, low, Between(0.1, 0.4) * sizes_.leg, 2.0 * kHalf * sizes_.leg,
        0.1 * sizes_.leg);
  }

  // A place of the room between its ends.
  std::pair<double, double> Anywhere() {
    const double x = Between(kFree, kWay - kFree) * sizes_.leg;
    return {x, Between(-0.95 * kHalf, 0.95 * kHalf) * sizes_.leg};
  }

  // No higher than the highest bar.
  void Blocks(int count) {
    for (int i = 0; i < count; ++i) {
      const auto [x, y] = Anywhere();
      const double length = Between(0.06, 0.25) * sizes_.leg;
      const double width = Between(0.06, 0.25) * sizes_.leg;
      const double height = Between(0.3, 1.0) * level_.bar, yaw_deg = Between(-90.0, 90.0);
      Box(Numbered("block"), x, y, 0.0, length, width, height, yaw_deg);
    }
  }

  // Beside the doorways: those stay passable.
  void Posts(int count) {
    for (int i = 0; i < count; ++i) {
      const auto [x, y] = Anywhere();
      const double radius = Millimetres(Between(0.04, 0.1) * sizes_.leg);
      const double height = Millimetres(Between(0.5, 1.0) * sizes_.height);
      const bool in_door = std::ranges::any_of(doors_, [&, x = x, y = y](const Door& door) {
        return Hypot(x - door.x, y - door.y) < 0.5 * door.gap + 0.6 * sizes_.breadth;
      });
      const std::string name = Numbered("post");
      if (in_door) continue;
      items_ += "  - name: " + name +
                Formatted("\n    cylinder: {radius_m: %.3f, length_m: %.3f}\n", radius, height) +
                Formatted("    pose: {xyz: [%.4f, %.4f, %.4f]}\n", x, y, 0.5 * height);
    }
  }

  // Lower than the beams, and to be walked around.
  void Hangings(int count) {
    for (int i = 0; i < count; ++i) {
      const auto [x, y] = Anywhere();
      const double low = Millimetres(Between(0.6, 0.95) * level_.headroom);
      const double length = Between(0.08, 0.2) * sizes_.leg;
      const double width = Between(0.08, 0.2) * sizes_.leg;
      Box(Numbered("lamp"), x, y, low, length, width, 0.15 * sizes_.leg, Between(-90.0, 90.0));
    }
  }

  std::string Comment() const {
    std::string text;
    if (made_.bar > 0.0) text += Formatted("; bar %.3f m", made_.bar);
    if (std::isfinite(made_.gap)) text += Formatted("; doorway %.3f m", made_.gap);
    if (std::isfinite(made_.headroom)) text += Formatted("; headroom %.3f m", made_.headroom);
    return text;
  }

  std::string Config(const std::string& robot) const {
    const double l = sizes_.leg, half = kHalf * l;
    return "# halfstep bench: " + key_.Name() + Comment() + "\nname: " + key_.Name() +
           "\nrobot: " + robot + "\nscene: " + key_.Name() + "_scene.yaml\n" +
           Formatted("start:\n  left:  {x_m: 0, y_m: %.4f}\n  right: {x_m: 0, y_m: %.4f}\n",
                     0.5 * sizes_.width, -0.5 * sizes_.width) +
           Formatted("goal: {part: mid_feet, x_m: %.3f, y_m: 0, radius_m: %.3f}\n", kWay * l,
                     0.2 * l) +
           Formatted("planner: {effort: 6, workspace_m: [%.3f, %.3f, %.3f, %.3f]}\n", -kEnd * l,
                     -half, (kWay + kEnd) * l, half) +
           "smoothing: {methods: [dichotomy]}\n";
  }

  struct Door {
    double x, y, gap;  // [m]
  };

  const BenchKey& key_;
  const BenchSizes& sizes_;
  BenchLevel level_;
  std::mt19937_64 random_;
  BenchScene made_;
  std::string items_;
  std::vector<Door> doors_;
  int count_ = 0;
};

}  // namespace

BenchSizes BenchSizesOf(const RobotModel& robot) {
  const Eigen::AlignedBox3d bounds = StandingBounds(robot);
  return {.leg = Millimetres(LegLengthOf(robot)),
          .width = Millimetres(robot.standing_width),
          .height = Millimetres(bounds.max().z()),
          .breadth = Millimetres(bounds.sizes().y())};
}

std::vector<std::string> BenchKinds() { return {"below", "beside", "overhead", "mix"}; }

std::string BenchKey::Name() const { return kind + Formatted("_%d_%03d", difficulty, seed); }

BenchLevel LevelOf(int difficulty, const BenchSizes& sizes) {
  HALFSTEP_CHECK(difficulty >= 1 && difficulty <= kMostDifficult, "difficulty " << difficulty);
  const int i = difficulty - 1;
  return {.bar = Millimetres(Nth(kBar, i) * sizes.leg),
          .gap = Millimetres(Nth(kGap, i) * sizes.breadth),
          .headroom = Millimetres(sizes.height - Nth(kBelowTop, i) * sizes.leg),
          .stations = Nth(kStations, i)};
}

BenchScene DrawBenchScene(const BenchKey& key, const BenchSizes& sizes, const std::string& robot) {
  const std::vector<std::string> kinds = BenchKinds();
  const auto kind = std::ranges::find(kinds, key.kind);
  HALFSTEP_CHECK(kind != kinds.end(), "no kind " << key.kind);
  HALFSTEP_CHECK(key.seed >= 1 && key.seed <= kMostBenchSeed, "seed " << key.seed);
  const auto number = static_cast<std::uint64_t>(kind - kinds.begin());
  const std::uint64_t seed = static_cast<std::uint64_t>(key.seed) * 64 + number * 8 +
                             static_cast<std::uint64_t>(key.difficulty);
  return Drawing(key, sizes, seed).Draw(robot);
}

}  // namespace halfstep
