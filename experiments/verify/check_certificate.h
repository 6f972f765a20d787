#pragma once

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/findings.h"
#include "smoothing/margins/margin.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// Verdict, counts of statements and pairs that are not watched (those of the robot, whatever the
/// certificate says), duration, and every row's arithmetic: begin < end, margin − bound ≥ demanded,
/// finite where it must be. At every instant of [0, D] the statements of a family add up to its
/// count, exactly. `end` is the trajectory's [s].
void CheckArithmetic(const CertificateText& certificate, const std::vector<ClaimRow>& rows,
                     const RobotModel& robot, double end, Findings* findings);

/// Whether the certificate demands as much as the run's config does, defaults included, of the very
/// families that the config knows.
void CheckAgainstConfig(const CertificateText& certificate, const MarginLimits& config,
                        Findings* findings);

}  // namespace halfstep::verify
