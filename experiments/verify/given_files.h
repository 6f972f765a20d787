#pragma once

#include <string>
#include <vector>

#include "experiments/verify/verify_run.h"
#include "wpg/files/yaml_fields.h"

namespace halfstep::verify {

/// A file in place of what a config names under `key`.
YamlOverride NamedInstead(const char* key, const std::string& path);

/// What takes the place of a config's robot and scene when they are given on the command line.
std::vector<YamlOverride> GivenFiles(const VerifyOptions& options);

}  // namespace halfstep::verify
