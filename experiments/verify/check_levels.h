#pragma once

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"

namespace halfstep::verify {

/// Whether on ground with levels every sole that stands lies as far inside its level as is
/// demanded, and every sole that moves horizontally keeps off the solids of the ground, as far as
/// `floor` demands less `tolerance` [m]. Says nothing where there is one level everywhere.
void CheckLevels(const PlayedMotion& motion, const CertificateText& certificate, double tolerance,
                 Distances* distances, Findings* findings);

}  // namespace halfstep::verify
