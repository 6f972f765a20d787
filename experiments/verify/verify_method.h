#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/verify/findings.h"
#include "experiments/verify/run_manifest.h"
#include "experiments/verify/verify_run.h"

namespace halfstep::verify {

/// What a certificate says that it guarantees, and what it does not speak of, as found here.
struct VerifiedStatement {
  std::string statement;                ///< the certificate's own
  std::vector<NotCovered> not_covered;  ///< MethodVerification::not_covered
  bool claimed = true;                  ///< whether the certificate's verdict is `certified`
};

/// Checks all that a run says of one method, whose folder is named `folder`. Throws InputError for
/// what cannot be read.
VerifiedStatement VerifyMethod(const VerifyOptions& options, const RunManifest& manifest,
                               const std::string& folder, Findings* findings);

}  // namespace halfstep::verify
