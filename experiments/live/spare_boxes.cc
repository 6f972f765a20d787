#include "experiments/live/spare_boxes.h"

#include <algorithm>
#include <utility>

#include "wpg/files/input_error.h"

namespace halfstep {

std::vector<std::string> SpareNames(const LiveOptions& options) {
  std::vector<std::string> names;
  for (int i = 1; i <= options.spare_boxes; ++i) names.push_back("spare_" + std::to_string(i));
  return names;
}

Scene WithSpareBoxes(Scene scene, const LiveOptions& options) {
  std::vector<std::string> complaints;
  const size_t own = scene.obstacles.size();
  for (const std::string& name : SpareNames(options)) {
    for (size_t i = 0; i < own; ++i) {
      if (scene.obstacles[i].name != name) continue;
      complaints.push_back("live.spare_boxes: '" + name +
                           "' is an obstacle of the scene already (valid: fewer, or another name "
                           "in the scene)");
    }
    Obstacle box{.name = name, .shape = Box{{0.2, 0.2, 0.1}}};
    box.X_WO.translation().z() = 0.05;
    scene.obstacles.push_back(std::move(box));
  }
  if (!complaints.empty()) throw InputError(complaints);
  return scene;
}

Place LoadEpisodePlace(const LiveConfig& config) {
  Place place = LoadPlace(config.experiment);
  place.scene = WithSpareBoxes(std::move(place.scene), config.live);
  return place;
}

}  // namespace halfstep
