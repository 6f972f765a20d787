#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace halfstep {

/// Where files are that other files name: `package://NAME/…`, `model://NAME/…`, `file://…`, or a
/// path beside the file that names it.
struct SceneryPlaces {
  std::map<std::string, std::string> packages;  ///< NAME → folder, of packages and of models
  std::vector<std::filesystem::path> models;    ///< folders with folders of models in them

  /// The path of what a file `from` names. A package or model that is not known is looked for in
  /// the folders of models, in ROS_PACKAGE_PATH, above `from`, and beside what is above. Throws
  /// std::runtime_error with a sentence.
  std::filesystem::path Find(const std::string& uri, const std::filesystem::path& from) const;
};

}  // namespace halfstep
