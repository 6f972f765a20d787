#pragma once

#include <string>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Distance of the whole robot's ZMP inside the support polygon [m], negative outside: masses and
/// inertias of all links, angular momentum included, where the family `zmp` has a point mass.
/// Subject: the step in the air, or −1. Where nothing is demanded (kNotDemanded) it has no rows,
/// and its proofs say nothing; where the robot's masses are not known, or the floor does not push,
/// it reads −∞. Source: wpg/README.md, "Dynamics of the whole robot".
class ZmpRobotMargin final : public WholeFamily {
 public:
  /// Of the family `zmp_robot`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kZmpRobot,
      .name = "zmp_robot",
      .unit = "m",
      .key = "zmp_robot_m",
      .meaning =
          "ZMP of the whole robot, with all links' masses, inside the support polygon; none: not "
          "demanded",
      .remedy =
          "a longer `half_step.duration_s` or a lower `half_step.via_height_m` (the legs' momentum "
          "moves the ZMP), or another `half_step.support_point_m` where it is missed at rest on "
          "one "
          "foot",
      .scale = 0.01,
      .demanded = 0.01,
      .raised = true,
      .cost = MarginCost::kJointSpeeds,
      .row = MarginFamily::kZmpRobot,
      .may_be_none = true,
  };

  /// Needs nothing of the place.
  explicit ZmpRobotMargin(const MarginPlace&) : WholeFamily(kTraits) {}

  int count() const override;
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override;
};

}  // namespace halfstep
