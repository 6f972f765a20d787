#pragma once

#include <vector>

#include "smoothing/margins/tube.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// How far the bodies of a robot may be from where they are planned in a tube, in any posture,
/// rounded up: from levers that the robot alone decides. Const. Source: smoothing/README.md,
/// "Tubes".
class TubeLevers {
 public:
  /// Of a robot; nothing is borrowed.
  explicit TubeLevers(const RobotModel& robot);

  /// How far any point of RobotModel::bodies[body] may be from its place [m].
  double WayOf(size_t body, const Tube& tube) const;
  /// How much nearer the bodies of RobotModel::self_pairs[pair] may be [m].
  double NearerBy(size_t pair, const Tube& tube) const;

 private:
  struct Lever {
    double joints = 0.0;  // sum over the joints between body and end [m]
    double end = 0.0;     // from the origin of waist or sole [m]
  };
  struct Body {
    Lever waist;
    std::vector<Lever> soles;  // of its leg; both, of a body on the waist
  };
  struct Pair {
    size_t a = 0, b = 0;
    double joints = 0.0;  // sum over the joints between them [m]
  };

  std::vector<Body> bodies_;
  std::vector<Pair> pairs_;
};

}  // namespace halfstep
