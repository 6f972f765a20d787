#pragma once

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"
#include "experiments/verify/walk_floor.h"

namespace halfstep::verify {

/// Whether the robot that plays rows straight keeps clearances, and its bodies their heights above
/// the floor, less `tolerance` [m] (VerifyOptions). Where it does not, they are too coarse
/// (Findings::TooCoarse): that the walk keeps all of it is proved. Other margins of that motion are
/// those of its rows or means of what the walk has between them.
void CheckPlayed(const PlayedMotion& motion, const WalkFloor& floor,
                 const CertificateText& certificate, double tolerance, Distances* distances,
                 Findings* findings);

}  // namespace halfstep::verify
