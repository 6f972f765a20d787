#pragma once

#include <map>
#include <set>
#include <string>

#include "experiments/verify/findings.h"
#include "experiments/verify/run_manifest.h"
#include "wpg/files/input_file.h"

namespace halfstep::verify {

/// Files of a folder, by relative path.
struct FolderFiles {
  std::set<std::string> there;   ///< those that are looked at
  std::set<std::string> needed;  ///< those that a manifest must list
};

/// Whether the files of a folder are those that its manifest lists: each with its length and
/// SHA-256, none missing. A needed file that is not listed is a disagreement; any other file that
/// is not listed is only named.
void CheckListedFiles(const std::string& folder, const FolderFiles& files,
                      const std::map<std::string, InputFile>& listed, Findings* findings);

/// The same for a run's root and its folder `method`. Folders of other methods are left out.
void CheckFiles(const std::string& run, const std::string& method, const RunManifest& manifest,
                Findings* findings);

}  // namespace halfstep::verify
