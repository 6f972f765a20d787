#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/verify/certificate_text.h"
#include "wpg/files/input_file.h"

namespace halfstep::verify {

class JsonMember;

/// What manifest.json says of a run; nothing of it is believed.
struct RunManifest {
  /// What it says of one method.
  struct Method {
    std::string name, status;  ///< its name, and how it ended
    std::string verdict;       ///< on its walk; "": of a run that is older than this member
    double duration = 0;       ///< [s]
  };
  std::string name, robot, scene, objective, acceptance;  ///< as the run was asked for
  std::string config_sha256, robot_sha256, scene_sha256;  ///< hexadecimal text
  std::vector<InputFile> robot_files, scene_files;        ///< without paths
  long seed = 0, half_steps = 0;            ///< of planners and random starts; of the walk
  std::vector<Method> methods;              ///< raw first
  std::vector<NotCoveredItem> not_covered;  ///< by certificates of the run
  std::map<std::string, InputFile> files;   ///< of the run, by relative path

  /// Whether a method of this run has the folder; dichotomy/published's is dichotomy_published.
  bool HasFolder(const std::string& folder) const { return MethodOf(folder) != nullptr; }
  const Method* MethodOf(const std::string& folder) const;  ///< nullptr: none
};

/// The file `name` of which a manifest states length and hash, without a path. Throws InputError.
InputFile ListedFile(const JsonMember& member, const std::string& name);
/// Those of a manifest's member `files`, by relative path. Throws InputError.
std::map<std::string, InputFile> ListedFiles(const JsonMember& root);
/// Throws InputError for what is no manifest of a run.
RunManifest ReadManifest(const std::string& path, const std::string& text);

/// The folder of a method in a run.
std::string FolderOfMethod(std::string method);

}  // namespace halfstep::verify
