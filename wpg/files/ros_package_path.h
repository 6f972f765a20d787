#pragma once

#include <filesystem>
#include <vector>

namespace halfstep {

/// The folders of the environment variable ROS_PACKAGE_PATH, in its order; none where it is not
/// set.
std::vector<std::filesystem::path> RosPackagePath();

}  // namespace halfstep
