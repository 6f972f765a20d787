#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/config/smoothing_config.h"
#include "experiments/verify/certificate_text.h"
#include "experiments/verify/findings.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// The family by that name; none, which is a disagreement, when it is not known here.
std::optional<Family> FamilyNamed(const std::string& name, Findings* findings);

/// Checks verdict and statement (which is another one where the ground has more levels than one),
/// limits and demands, the duration (`end` is the trajectory's [s]),
/// the counts of statements, and every row by itself: begin < end, margin − bound ≥ demanded,
/// finite where it must be. At every instant of [0, D] the statements of a family must add up to
/// its count, exactly.
void CheckArithmetic(const CertificateText& certificate, const std::vector<ClaimRow>& rows,
                     const RobotModel& robot, const Scene& scene, double end, Findings* findings);

/// Whether the certificate demands at least as much as the run's config does, defaults included,
/// and limits speeds at least as tightly. A family that the config knows and verify does not is a
/// disagreement. What the config demands of joint accelerations counts where these are limited;
/// `robot` has the limits that the config assumes.
void CheckAgainstConfig(const CertificateText& certificate, const RobotModel& robot,
                        const SmoothingConfig& smoothing, Findings* findings);

}  // namespace halfstep::verify
