#pragma once

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"

namespace halfstep::verify {

/// Whether the robot that plays rows of `walk` straight keeps every margin that `certificate`
/// demands, less `tolerance` [m] (VerifyOptions). Where it does not, the walk itself is asked, at
/// rows 1 ms apart: if it agrees, the rows are too coarse (Findings::TooCoarse), and else it is a
/// disagreement.
void CheckPlayed(const PlayedMotion& motion, const DescribedWalk& walk,
                 const CertificateText& certificate, double tolerance, Distances* distances,
                 Findings* findings);

/// The same for what half-step `last`, from 0, leads to: the walk that ends with it, from where
/// that half-step begins to its end, in rows at the multiples of `period` [s] and at both ends.
/// `begin` [s]: not before this time.
void CheckStopBranch(const DescribedWalk& walk, int last, double begin, double period,
                     const CertificateText& certificate, double tolerance, Distances* distances,
                     Findings* findings);

}  // namespace halfstep::verify
