#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/verify/findings.h"
#include "experiments/verify/run_manifest.h"

namespace halfstep::verify {

/// Whether the files of a run's root and of the folder `method` are those that its manifest lists:
/// each with its length and SHA-256, none missing. A file that the manifest must list and does not
/// is a disagreement; any other file that is not listed is only named. Folders of other methods are
/// left out.
void CheckFiles(const std::string& run, const std::string& method, const RunManifest& manifest,
                Findings* findings);

}  // namespace halfstep::verify
