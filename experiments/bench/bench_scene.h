#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace halfstep {

struct RobotModel;

/// What the scenes of the benchmark go by, in whole millimetres, so that rounding elsewhere does
/// not reach the scenes.
struct BenchSizes {
  double leg = 0.0;      ///< ℓ, RobotMeasures::leg_length [m]
  double width = 0.0;    ///< RobotMeasures::standing_width [m]
  double height = 0.0;   ///< of the standing robot [m]
  double breadth = 0.0;  ///< of the standing robot, arms included, along y [m]
};
/// Those of a robot.
BenchSizes BenchSizesOf(const RobotModel& robot);

/// below, beside, overhead, mix.
std::vector<std::string> BenchKinds();
/// Difficulties are 1 to this.
inline constexpr int kMostDifficult = 5;
/// Seeds are 1 to this.
inline constexpr int kMostBenchSeed = 999;

/// Which scene of the benchmark.
struct BenchKey {
  std::string kind;    ///< of BenchKinds()
  int difficulty = 1;  ///< 1 to kMostDifficult
  int seed = 1;        ///< 1 to kMostBenchSeed

  /// "below_3_012": the scene's name, and that of its files.
  std::string Name() const;
};

/// A scene of the benchmark: a room of 5.8 ℓ × 2.3 ℓ between walls as high as the robot, from whose
/// one end the robot walks to the other, 4 ℓ along x. Its difficulty is exactly one number, or
/// three; what the seed draws besides is no harder.
struct BenchScene {
  std::string scene;   ///< text of the scene file
  std::string config;  ///< text of the config, without a planner's name; the robot as given
  double bar = 0.0;    ///< top of the highest bar that lies across the room [m]; 0: none does
  /// Breadth of the narrowest doorway, and height below the lowest beam across [m]; ∞: none.
  double gap = std::numeric_limits<double>::infinity(), headroom = gap;
};

/// The numbers of a difficulty.
struct BenchLevel {
  double bar = 0.0;       ///< top of the highest bar [m]
  double gap = 0.0;       ///< breadth of the narrowest doorway [m]
  double headroom = 0.0;  ///< height below the lowest beam [m]
  int stations = 1;       ///< obstacles that lie across, one after the other; of a mix three
};
/// Precondition: 1 ≤ difficulty ≤ kMostDifficult (std::logic_error).
BenchLevel LevelOf(int difficulty, const BenchSizes& sizes);

/// Draws a scene: the same bytes for the same key and sizes, everywhere. `robot` is what the config
/// names. Precondition: a valid key (std::logic_error).
BenchScene DrawBenchScene(const BenchKey& key, const BenchSizes& sizes, const std::string& robot);

}  // namespace halfstep
