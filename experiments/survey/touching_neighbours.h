#pragma once

#include <vector>

#include "experiments/survey/found_legs.h"
#include "experiments/survey/self_gaps.h"
#include "wpg/robot/robot_fields.h"

namespace halfstep {

/// Bodies that come nearer than this are watched for, or touch by design [m]: a little more than
/// the self clearance that is demanded by default.
constexpr double kTouchByDesign = 7e-3;

/// Whether a pair is of both legs.
bool AreOfBothLegs(const RobotModel& robot, const SelfGap& gap);

/// Links whose bodies touch by design: those of one leg, or of a leg and the trunk, with at most
/// two leg joints between them, that come nearer than kTouchByDesign in the sampled postures; and
/// with more joints between them, that stand nearer. Limbs beside the plane of symmetry can be
/// turned away and are no neighbours of the legs. The reason tells how near they come.
std::vector<ExcludedPair> NeighboursThatTouch(const UrdfTree& urdf, const FoundLegs& legs,
                                              const std::vector<double>& posture,
                                              const RobotModel& robot, const SelfGaps& gaps);

}  // namespace halfstep
