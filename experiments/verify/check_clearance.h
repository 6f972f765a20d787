#pragma once

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"

namespace halfstep::verify {

/// Distances that are by bounding volumes this far beyond what is required are not measured [m].
inline constexpr double kQuick = 0.02;

/// Whether the played motion keeps, at every instant, the clearances that the certificate demands
/// less `tolerance` [m], of bodies from obstacles and of bodies from each other. A pair's distance
/// at one instant, less what the motion can take off it until another instant
/// (PlayedMotion::PathInWorld, PathInWaist) and the obstacle's own motion, proves a stretch of
/// time, and stretches are joined. Where one would be shorter than 1/256 of the time between two
/// rows, the pair is left open, which is a disagreement. Source: [Schwarzer2005] §3; distances
/// along the path: conservative advancement.
void CheckClearances(const PlayedMotion& motion, const CertificateText& certificate,
                     double tolerance, Distances* distances, Findings* findings);

}  // namespace halfstep::verify
