#pragma once

#include <string>

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/findings.h"

namespace halfstep::verify {

/// Which stop branches a config demands.
struct StopBranchDemand {
  std::string branches;  ///< none, down or all, as in YAML
  double period = 0.0;   ///< of the rows that are played [s]
};

/// Whether every demanded stop branch keeps every margin: the walk that ends with half-step k, from
/// where half-step k + 1 would begin to its end. Says how many do, and how many of them are too
/// coarse to tell. `tolerance` [m]: VerifyOptions.
void CheckStopBranches(const DescribedWalk& walk, const StopBranchDemand& demand,
                       const CertificateText& certificate, double tolerance, Distances* distances,
                       Findings* findings);

/// Whether config.yaml demands the stop branches that `acceptance`, of manifest.json, says were
/// demanded.
void CheckDemandOfStopBranches(const std::string& branches, const std::string& acceptance,
                               Findings* findings);

}  // namespace halfstep::verify
