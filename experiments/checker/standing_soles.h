#pragma once

#include "experiments/checker/check_trajectory.h"
#include "experiments/checker/proof_hints.h"
#include "experiments/checker/walk_motion.h"
#include "experiments/verify/certificate_text.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::checker {

/// Adds what is kept by the sole's outline wherever a sole stands at `from` [s] or later: its
/// distance from each no-step area, and how far it lies inside one level of the ground, where there
/// are more (planner/README.md, "Levels"). What is wanted is in `certificate`. `hints` are noted or
/// told of no-step areas (experiments/proof.md).
void AddStandingSoles(const WalkMotion& motion, const RobotModel& robot, const Scene& scene,
                      const verify::CertificateText& certificate, double from, ProofHints* hints,
                      TrajectoryCheck* check);

}  // namespace halfstep::checker
