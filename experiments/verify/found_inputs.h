#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep::verify {

/// Where the files of a robot or a scene may be, and by what they are known.
struct InputSearch {
  std::string what;                           ///< "robot" or "scene"
  std::filesystem::path run;                  ///< folder of the run or episode
  std::vector<std::filesystem::path> places;  ///< of the first file, the likeliest first
  std::string sha256;                         ///< of all of them, by manifest.json
};

/// A robot or a scene, and the first place where another one lay ("": none did).
template <typename Input>
struct Found {
  Input input;         ///< as it was read
  std::string passed;  ///< a place before its own
};

/// What is read from the first of the places that has the files which the manifest is about: they
/// are known by their hash, wherever they lie. What lies in the run folder belongs to it, so it is
/// taken even when its hash is another, for the checks to say so. Throws InputError when it is
/// nowhere, with a sentence that says where was looked; that is no disagreement.
Found<RobotModel> FindRobot(const InputSearch& search);
/// The same of a scene.
Found<Scene> FindScene(const InputSearch& search);

/// The complaint about a robot or a scene that is nowhere.
std::string NotFound(const InputSearch& search);

}  // namespace halfstep::verify
