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

/// `given`, or the shipped file of a name: NAME.yaml in `folder` of DataFolder() (`configs`,
/// `episodes`, `scenes`, `sweeps`) where `given` is a name without a folder or an extension, and
/// nothing that is called so is there.
std::filesystem::path ShippedOr(const std::filesystem::path& given, const std::string& folder);

/// The same for what has to be there: throws InputError, which names the nearest shipped file,
/// where a name is of no file.
std::filesystem::path FileOrShipped(const std::string& given, const std::string& folder);

/// What to say of a text that names no robot: the nearest shipped one, what is valid, and for a
/// URDF which command makes a robot file of it.
std::string UnknownRobot(const std::string& robot);
/// "did you mean 'x.yaml'? " for the nearest file of the folder where `missing` was looked for; ""
/// when none is near.
std::string NearestFile(const std::filesystem::path& missing);

}  // namespace halfstep
