#pragma once

#include <vector>

#include "experiments/verify/verify_run.h"
#include "wpg/files/yaml_fields.h"

namespace halfstep::verify {

/// What takes the place of a config's robot and scene when they are given on the command line.
std::vector<YamlOverride> GivenFiles(const VerifyOptions& options);

}  // namespace halfstep::verify
