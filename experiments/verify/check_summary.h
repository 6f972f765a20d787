#pragma once

#include <string>
#include <vector>

#include "experiments/config/smoothing_config.h"
#include "experiments/verify/certificate_text.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"
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

/// Whether `worst_margin` of a method's row is the least of its family's column of trajectory.csv,
/// and no family that has a column comes nearer to its limit than `worst_margin_name`, by (margin −
/// demanded)/scale. The value of a family without a column is not looked at.
void CheckWorstMargin(const std::vector<SummaryRow>& summary, const std::string& folder,
                      const std::vector<PlayedRow>& rows, const RobotModel& robot,
                      const CertificateText& certificate, const MarginLimits& config,
                      Findings* findings);

}  // namespace halfstep::verify
