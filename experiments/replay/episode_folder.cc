#include "experiments/replay/episode_folder.h"

#include <optional>

#include "experiments/config/experiment.h"
#include "experiments/tables/json_file.h"

namespace halfstep::replay {

bool IsEpisode(const std::filesystem::path& folder) {
  const std::filesystem::path manifest = folder / "manifest.json";
  if (!std::filesystem::exists(manifest)) return false;
  const nlohmann::json json = ReadJsonObject(manifest);
  return json.contains("kind") && json["kind"] == "episode";
}

RecordedEpisode ReadEpisode(const std::filesystem::path& folder) {
  LiveConfig config = LoadLiveConfig((folder / "config.yaml").string(), {});
  WholeRobot robot = LoadWholeRobot(RobotPath(config.experiment).string());
  const std::optional<std::filesystem::path> scene = ScenePath(config.experiment);
  TrueWorld truth(scene ? LoadScene(scene->string()) : Scene(), config.experiment.goal,
                  config.live);
  ReferenceMotion motion(ReadTrajectory(folder / "trajectory.csv", robot.model));
  return {std::move(config), std::move(robot), std::move(truth), std::move(motion)};
}

}  // namespace halfstep::replay
