#pragma once

#include "experiments/config/experiment_config.h"
#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/findings.h"
#include "planner/scene/scene.h"

namespace halfstep::verify {

/// What a config demands of walks, as a certificate would say it. A family of margins that is not
/// known here is a disagreement.
CertificateText DemandsOf(const MarginLimits& limits, Findings* findings);

/// How the statements of an episode are looked at.
struct EpisodeProofOptions {
  double period = 0.005;     ///< of the rows that are played [s]
  double tolerance = 0.001;  ///< VerifyOptions [m]
};

/// Whether each half-step that began could begin: the walk cut after it, from where it begins to
/// its end, keeps every demanded margin against the world of the grant that allowed it, with its
/// obstacles anywhere within r + v·min(|t − t_m|, H) of where they were measured at t_m
/// (CheckStopBranch). `walk` is the last one, which has all of them. Where only the rows played
/// straight do not keep them, they are too coarse. Precondition: CheckGrantNumbers() returned true.
void CheckEpisodeProof(const EpisodeText& episode, const DescribedWalk& walk, const Scene& scene,
                       const CertificateText& demands, const EpisodeProofOptions& options,
                       Findings* findings);

}  // namespace halfstep::verify
