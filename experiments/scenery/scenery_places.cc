#include "experiments/scenery/scenery_places.h"

#include <algorithm>
#include <stdexcept>

#include "wpg/files/ros_package_path.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

// Folders in which a package or model may lie, or which may be it.
std::vector<fs::path> PlacesToLook(const std::vector<fs::path>& models, const fs::path& from) {
  std::vector<fs::path> places = models;
  const std::vector<fs::path> of_ros = RosPackagePath();
  places.insert(places.end(), of_ros.begin(), of_ros.end());
  std::error_code ignored;
  fs::path above = fs::absolute(from, ignored).lexically_normal().parent_path();
  for (; above.has_relative_path(); above = above.parent_path()) {
    places.push_back(above);
    places.push_back(above / "models");
  }
  return places;
}

}  // namespace

fs::path SceneryPlaces::Find(const std::string& uri, const fs::path& from) const {
  const size_t colon = uri.find("://");
  if (colon == std::string::npos) {
    return (from.parent_path() / uri).lexically_normal();
  }
  const std::string scheme = uri.substr(0, colon);
  std::string rest = uri.substr(colon + 3);
  if (scheme == "file") {
    return rest.starts_with('/') ? fs::path(rest) : (from.parent_path() / rest).lexically_normal();
  }
  if (scheme != "package" && scheme != "model") {
    throw std::runtime_error(Quote(uri) +
                             " is on no disk (valid: package://…, model://…, file://…, or a path)");
  }
  rest.erase(0, std::min(rest.find_first_not_of('/'), rest.size()));  // some have a third slash
  const std::string name = rest.substr(0, rest.find('/'));
  const std::string below = rest.substr(std::min(name.size() + 1, rest.size()));
  if (const auto given = packages.find(name); given != packages.end()) {
    return (fs::path(given->second) / below).lexically_normal();
  }
  std::error_code ignored;
  for (const fs::path& place : PlacesToLook(models, from)) {
    if (place.filename() == name && fs::is_directory(place, ignored)) return place / below;
    if (fs::is_directory(place / name, ignored)) return place / name / below;
  }
  throw std::runtime_error(Quote(uri) + " is not found (valid: --package " + Printable(name) +
                           "=FOLDER" + (scheme == "model" ? ", or --models FOLDER" : "") +
                           "; --without NAME leaves a thing out)");
}

}  // namespace halfstep
