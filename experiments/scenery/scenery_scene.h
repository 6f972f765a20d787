#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/scenery/scenery.h"

namespace halfstep {

/// A scene file that is made of another program's file, and the meshes beside it.
struct SceneFiles {
  std::string text;                                     ///< of the scene file
  std::map<std::filesystem::path, std::string> meshes;  ///< OBJ beside it, by their paths
  std::map<std::string, int> kinds;                     ///< how many obstacles of each kind
};

/// The files of a scene at `out`. Files that it names are named from its folder, and `head` goes to
/// its top as comments. Throws InputError for a mesh or a place that a scene cannot have.
SceneFiles SceneFilesOf(const Scenery& scenery, const std::filesystem::path& out,
                        const std::vector<std::string>& head);

}  // namespace halfstep
