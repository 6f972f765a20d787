#include "wpg/files/ros_package_path.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace halfstep {

std::vector<std::filesystem::path> RosPackagePath() {
  std::vector<std::filesystem::path> folders;
  const char* const paths = std::getenv("ROS_PACKAGE_PATH");
  for (std::string_view rest = paths == nullptr ? "" : paths; !rest.empty();) {
    const size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) folders.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return folders;
}

}  // namespace halfstep
