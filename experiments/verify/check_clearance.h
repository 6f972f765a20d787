#pragma once

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"

namespace halfstep::verify {

/// Whether the played motion keeps, at every instant, the clearances that the certificate demands
/// less `tolerance` [m]: each pair's distance at an instant, less what the motion can take off it
/// until another one (PlayedMotion::PathInWorld), covers a stretch of time; the stretches are
/// joined. One shorter than 1/256 of the time between two rows is left open and disagrees.
/// Bodies against obstacles and bodies against bodies.
/// Source: [Schwarzer2005] §3; distances along the path: conservative advancement.
void CheckClearances(const PlayedMotion& motion, const CertificateText& certificate,
                     double tolerance, Distances* distances, Findings* findings);

}  // namespace halfstep::verify
