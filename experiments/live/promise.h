#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/live/world.h"
#include "smoothing/proof/feasibility_test.h"

namespace halfstep {

// What an episode promises, and whether it held. The promise: as long as every obstacle is, at
// every time t of the walk, within r + v·min(|t − t_m|, H) of where the world of the half-step
// under way has it, and no obstacle or no-step area is there that this world does not have, the
// moving robot touches none. The half-step under way is the latest that has begun; its world is
// the one that its grant was proved against.

/// Instants of a walk at which what is true is looked at are so far apart [s].
inline constexpr double kLook = 0.005;

/// An obstacle or a no-step area that did not keep the promise's condition.
struct BrokenPromise {
  std::string name;  ///< of the obstacle; of an area "no-step area 1"
  /// Whether it was in all the worlds that it was not as they said. What was not in a world is not
  /// covered by any key.
  bool was_there = true;
  /// The earliest time by which it was not as a world says: at the look at what was true, or the
  /// measurement [s].
  double from = std::numeric_limits<double>::infinity();
  std::optional<double> measured;  ///< when the first frame was taken that contradicts a world [s]
  std::optional<double> known;     ///< when that became known [s]
  int frames = 0;                  ///< that contradict a world that was not void
  double beyond = 0.0;             ///< the most that it was farther than allowed [m]
  bool rested = false;  ///< a world had taken it to rest (sensing.rests_after) that it was not as
  double speed = 0.0;   ///< the least v that would have allowed all of it [m/s]; ∞: none
  double error = 0.0;   ///< the least r that would have [m]
  /// Keys of scene and config, each with the least value that would have allowed all of it: any one
  /// is enough. "obstacles[crate].motion.speed_m_s: 0.8".
  std::vector<std::string> covered_by;
  /// When half-steps were under way for whose clearance from it nothing vouches: what was true is
  /// outside, or a later frame contradicts their world. In order, apart; empty: the robot stood
  /// [s].
  std::vector<TimeSpan> unproved;

  /// Takes in a place that it should not have been at, known by so many measurements: 2, or 1 where
  /// what was true is compared with a measurement.
  void Add(const Contradiction& place, int measurements);
};

/// An obstacle that the moving robot touched.
struct TouchedObstacle {
  std::string obstacle;  ///< its name
  std::string body;      ///< of the robot, where it was deepest
  double from = 0.0;     ///< the first instant at which it touched [s]
  double depth = 0.0;    ///< at most so deep [m]
  double deepest = 0.0;  ///< when [s]
};

/// How it went in one word.
enum class PromiseStatus {
  kKept,     ///< every obstacle kept its r and v
  kNotKept,  ///< one did not, and nothing is known to have been touched
  kTouched,  ///< the moving robot touched an obstacle
};
/// As manifests call it: "kept", "not_kept", "touched".
std::string_view Name(PromiseStatus status);

/// Whether the promise of an episode held.
struct Promise {
  /// By what it was judged: "script" (what was true, and what was measured), "simulation" (the
  /// same, but the robot strayed as simulated) or "measurements" alone.
  std::string judged_by = "measurements";
  std::vector<BrokenPromise> broken;     ///< in the order of `from`, then of names
  std::vector<TouchedObstacle> touched;  ///< in the order of `from`; none by measurements alone

  /// How it went.
  PromiseStatus status() const {
    if (!touched.empty()) return PromiseStatus::kTouched;
    return broken.empty() ? PromiseStatus::kKept : PromiseStatus::kNotKept;
  }
};

}  // namespace halfstep
