#pragma once

#include "experiments/config/experiment_config.h"
#include "experiments/verify/certificate_text.h"
#include "experiments/verify/findings.h"

namespace halfstep::verify {

/// What a config demands of walks, as a certificate would say it. A family of margins that is not
/// known here is a disagreement.
CertificateText DemandsOf(const MarginLimits& limits, Findings* findings);

}  // namespace halfstep::verify
