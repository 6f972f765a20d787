#pragma once

#include <vector>

#include "experiments/replay/simulation.h"

namespace halfstep::replay {

/// A body of the robot in touch with an obstacle, never apart for longer than 50 ms.
struct TouchRecord {
  int body = 0;          ///< Touch::body
  int obstacle = 0;      ///< Touch::obstacle
  double begin = 0.0;    ///< first instant of contact [s]
  double end = 0.0;      ///< last instant of contact [s]
  double force = 0.0;    ///< greatest [N]
  bool at_rest = false;  ///< the planned motion was at rest at each of its instants
};

/// Counts the contacts of a simulated robot and obstacles.
class TouchLog {
 public:
  /// To be called with the contacts of each time step, in the order of time. `at_rest`: whether the
  /// planned motion is at rest then.
  void Note(double t, const std::vector<Touch>& touches, bool at_rest);

  /// In the order of their beginnings.
  const std::vector<TouchRecord>& records() const { return records_; }

 private:
  std::vector<TouchRecord> records_;
};

}  // namespace halfstep::replay
