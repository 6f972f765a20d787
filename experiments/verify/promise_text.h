#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace halfstep::verify {

/// An obstacle or a no-step area that was not as worlds of an episode say (experiments/episodes.md,
/// "Whether the promise held"), by manifest.json or as it is derived here.
struct BrokenText {
  std::string name;       ///< of the obstacle, or "no-step area 1"
  bool was_there = true;  ///< in all the worlds that it was not as they say
  double from = std::numeric_limits<double>::infinity();  ///< the earliest such time [s]
  std::optional<double> measured, known;                  ///< of the first frame that says so [s]
  long frames = 0;                                        ///< that do
  double beyond = 0;                    ///< the most that it was farther than allowed [m]
  bool rested = false;                  ///< a world took it to rest
  double speed = 0, error = 0;          ///< least v [m/s] and r [m] that allow all of it
  std::vector<std::string> covered_by;  ///< keys that do
  std::vector<std::pair<double, double>> unproved;  ///< when walked without proof of it [s]
};

/// An obstacle that was touched; how deep is not looked at.
struct TouchText {
  std::string obstacle;  ///< its name
  double from = 0;       ///< the first instant [s]
};

/// `promise` of an episode's manifest.json.
struct PromiseText {
  std::string status;              ///< kept, not_kept, touched
  std::string judged_by;           ///< script, simulation, measurements
  std::vector<BrokenText> broken;  ///< names differ
  std::vector<TouchText> touched;  ///< the same
};

/// `promise` of the text of a manifest.json. Throws InputError when it has none, or another.
PromiseText ReadPromise(const std::string& path, const std::string& manifest);

}  // namespace halfstep::verify
