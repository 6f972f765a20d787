#pragma once

#include <filesystem>
#include <string>

#include "experiments/verify/findings.h"
#include "experiments/verify/run_manifest.h"
#include "experiments/verify/verify_run.h"

namespace halfstep::verify {

/// Checks all that a run says of one method, whose folder is named `folder`. Returns the
/// certificate's statement. Throws InputError for what cannot be read.
std::string VerifyMethod(const VerifyOptions& options, const RunManifest& manifest,
                         const std::string& folder, Findings* findings);

}  // namespace halfstep::verify
