#pragma once

#include <array>
#include <vector>

#include "experiments/checker/walk_statements.h"
#include "experiments/verify/certificate_text.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::checker {

/// How much less the margins of a motion in a tube around a walk may be than the walk's, in all
/// postures, rounded up. Source: smoothing/README.md, "Tubes".
class TubeLoss {
 public:
  /// Borrows nothing.
  TubeLoss(const verify::TubeText& tube, const RobotModel& robot);

  /// What is to be demanded of the walk so that every motion in the tube keeps what was demanded
  /// before the tube raised it, and no less than is demanded: of a family that does not depend on
  /// bodies, or of a statement about some [unit of the family].
  double Demanded(verify::Family family, double demanded) const;
  /// The same of a statement.
  double Demanded(const WalkStatement& statement) const;

 private:
  // A body seen from the line of the robot's joints.
  struct OnLine {
    size_t gap = 0;                  // between which two points of the line it is
    std::array<Interval, 14> far{};  // no point of it is farther from each of them [m]
    Interval way;                    // or from where it is planned [m]
  };
  double Raised(verify::Family family, double demanded, const Interval& loss) const;

  verify::TubeText tube_;
  Interval sole_;  // how far points of the soles are from where they are planned [m]
  std::vector<OnLine> bodies_;
};

}  // namespace halfstep::checker
