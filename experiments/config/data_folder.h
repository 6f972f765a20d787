#pragma once

#include <filesystem>
#include <vector>

namespace halfstep {

/// The folder of what halfstep ships: `robots`, `scenes`, `configs`, `episodes`, `sweeps`. The one
/// that the environment variable HALFSTEP_DATA names; else the nearest `share/halfstep` above the
/// library or program that holds this function, so that an installed copy finds its own wherever it
/// is; else that of the prefix that halfstep was configured for, of /usr/local or of /usr. Need not
/// exist.
std::filesystem::path DataFolder();
std::filesystem::path RobotsFolder();  ///< of the shipped robots, `NAME.yaml`
std::filesystem::path ScenesFolder();  ///< of the shipped scenes

/// Paths of a folder's *.yaml, sorted; none when it cannot be read.
std::vector<std::filesystem::path> YamlFiles(const std::filesystem::path& folder);

}  // namespace halfstep
