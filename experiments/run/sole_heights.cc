#include "experiments/run/sole_heights.h"

#include <cmath>
#include <limits>

#include "wpg/nth.h"

namespace halfstep {

SoleHeights::SoleHeights(const RobotModel& robot, const Scene& scene, double foothold)
    : ground_(scene.ground),
      outline_(robot.sole_outline),
      foothold_(foothold),
      borders_(*scene.ground) {}

double SoleHeights::At(const Pose2& X_WF, double from, double most) const {
  if (borders_.empty()) return ground_->HeightEverywhere();
  for (const int level : borders_.LevelsNear(outline_, X_WF)) {  // the highest first
    const double height = Nth(ground_->Levels(), level).height;
    if (std::abs(height - from) > most) continue;
    if (foothold_ > 0.0 ? borders_.NearestTo(outline_, X_WF, level).distance >= foothold_
                        : borders_.Bears(outline_, X_WF, level)) {
      return height;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace halfstep
