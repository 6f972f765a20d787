#pragma once

#include <array>
#include <functional>
#include <limits>

#include "experiments/checker/check_trajectory.h"
#include "experiments/checker/proof_hints.h"
#include "experiments/checker/walk_motion.h"
#include "experiments/verify/certificate_text.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::checker {

/// Whether a walk keeps all that its certificate says is demanded, at every instant from `from` to
/// `to` (its end where that is earlier), found from the walk's definition alone: rows of
/// certificates are not read. Time is halved where the bounds of a statement do not suffice, down
/// to 1 µs. Findings have the families of smoothing/README.md, "Margins"; what is demanded of a
/// family that is not looked at is among `not_covered`. `crouch`: how far the waist is kept below
/// where the robot file has it [m]. `progress(done)`, done ∈ [0, 1], says whether to go on.
/// `hints`: where directions that were found are noted, or those that are told. With a tube every
/// motion in it keeps what was demanded before the tube raised it. Throws InputError for a tube
/// over solid ground, which no certificate is of. Source: experiments/check.md.
TrajectoryCheck CheckWalk(const WalkMotion& motion, const RobotModel& robot, const Scene& scene,
                          const verify::CertificateText& certificate, double crouch,
                          const std::function<bool(double done)>& progress = {},
                          ProofHints* hints = nullptr, double from = 0.0,
                          double to = std::numeric_limits<double>::infinity());

/// What findings of a family are about. Precondition: it is not kOwn.
TrajectoryFinding::Kind KindOf(verify::Family family);

}  // namespace halfstep::checker
