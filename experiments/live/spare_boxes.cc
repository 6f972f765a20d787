#include "experiments/live/spare_boxes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/config/data_folder.h"
#include "wpg/files/input_error.h"

namespace halfstep {

Scene WithSpareBoxes(Scene scene, const LiveOptions& options) {
  const double lowest = scene.ground->Floor();
  const double floor = std::isfinite(lowest) ? lowest : 0.0;
  for (const std::string& name : SpareNames(options)) {
    Obstacle box{.name = name, .shape = Box{{0.2, 0.2, 0.1}}};
    box.X_WO.translation().z() = floor + 0.05;
    scene.obstacles.push_back(std::move(box));
  }
  return scene;
}

Place LoadEpisodePlace(const LiveConfig& config) {
  Place place = LoadPlace(config.experiment);
  place.scene = WithSpareBoxes(std::move(place.scene), config.live);
  std::vector<std::string> complaints;
  for (const SceneMistake& one : MistakesOf(config.live, place.scene)) {
    complaints.push_back("live." + one.key + ": " + one.what);
  }
  if (!complaints.empty()) throw InputError(complaints);
  return place;
}

LoadedEpisode LoadEpisode(const std::string& given, const std::vector<YamlOverride>& overrides,
                          const std::function<LiveConfig(LiveConfig)>& change,
                          const Toolbox& tools) {
  const std::string path = FileOrShipped(given, "episodes").string();
  const std::string text = ReadYamlFile(path);
  LoadedEpisode loaded{.config = change(ParseLiveConfig(path, text, overrides, nullptr, tools)),
                       .place = {}};
  loaded.place = LoadPlace(loaded.config.experiment);
  loaded.place.scene = WithSpareBoxes(std::move(loaded.place.scene), loaded.config.live);
  // Again for its complaints: where in the file something stands that does not fit the scene.
  (void)ParseLiveConfig(path, text, overrides, &loaded.place.scene, tools);
  return loaded;
}

}  // namespace halfstep
