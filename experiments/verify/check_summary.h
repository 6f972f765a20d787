#pragma once

#include "experiments/verify/certificate_text.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/run_manifest.h"
#include "experiments/verify/walk_text.h"

namespace halfstep::verify {

/// Whether summary.csv has a row for each method of the manifest, in its order, and whether the row
/// of `folder` agrees with certificate, manifest, iterates.csv (`iterations` rows; raw has none)
/// and the other rows. How often and how long the method computed is not checked, for no other file
/// vouches for it.
void CheckSummary(const std::vector<SummaryRow>& rows, const RunManifest& manifest,
                  const std::string& folder, const CertificateText& certificate, long iterations,
                  Findings* findings);

}  // namespace halfstep::verify
