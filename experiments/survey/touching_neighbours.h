#pragma once

#include <string>
#include <vector>

#include "experiments/survey/found_legs.h"
#include "experiments/survey/self_gaps.h"
#include "wpg/robot/robot_fields.h"

namespace halfstep {

/// Bodies that come nearer than this are watched for, or touch by design [m]: 1.4 times the self
/// clearance that is demanded of the robot by default.
double NearByDesign(const RobotModel& robot);

/// Whether a pair is of both legs.
bool AreOfBothLegs(const RobotModel& robot, const SelfGap& gap);

/// How many joints of the legs, which move while walking, are between two bodies' links.
int LegJointsBetween(const UrdfTree& urdf, const FoundLegs& legs, const RobotModel& robot,
                     const SelfGap& gap);

/// The URDF link of a body.
std::string LinkOf(const RobotBody& body);

/// What a body does that is `gap` [m] away from another one: "comes within 3.2 mm of", or
/// "reaches 3.2 mm into" where they overlap.
std::string NearnessText(double gap);

/// Links whose bodies touch by design: those of one leg, or of a leg and the trunk, with at most
/// two leg joints between them, that come nearer than NearByDesign in the sampled postures; and
/// with more joints between them, that stand nearer. Limbs beside the plane of symmetry can be
/// turned away and are no neighbours of the legs. The reason tells how near they come.
std::vector<ExcludedPair> NeighboursThatTouch(const UrdfTree& urdf, const FoundLegs& legs,
                                              const std::vector<double>& posture,
                                              const RobotModel& robot, const SelfGaps& gaps);

}  // namespace halfstep
