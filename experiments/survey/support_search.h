#pragma once

#include "smoothing/margins/margin.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The least margin of a family in the six steps that a robot would take by default (SixSteps), in
/// the family's unit, looked at every `period` [s]. For guesses: nothing is proved by it.
double LeastInSixSteps(const RobotModel& robot, MarginFamily family, double period);

/// Where in the support sole CoM and ZMP shall rest on one foot, and what was missed elsewhere.
struct FoundSupport {
  double offset = 0.0;  ///< RobotModel::support_point [m]
  double before = 0.0;  ///< the whole robot's ZMP inside the support polygon without it [m]
  double after = 0.0;   ///< the same with it [m]
};

/// Where the whole robot's ZMP, in six steps, is not as far inside the support polygon as is
/// demanded by default: the support point, in whole millimetres, with which both ZMPs, the
/// robot's and the point mass's, have most left of what is demanded of each. Offset 0 where nothing is missed, where the
/// robot's masses are not known, or where no other offset is better.
FoundSupport FindSupport(RobotModel robot);

}  // namespace halfstep
