#pragma once

#include <filesystem>
#include <string>
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

/// What to say of a text that names no robot: the nearest shipped one, what is valid, and for a URDF
/// which command makes a robot file of it.
std::string UnknownRobot(const std::string& robot);
/// "did you mean 'x.yaml'? " for the nearest file of the folder where `missing` was looked for; ""
/// when none is near.
std::string NearestFile(const std::filesystem::path& missing);

}  // namespace halfstep
