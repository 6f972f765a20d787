#include "experiments/replay/episode_folder.h"

#include <optional>

#include "experiments/config/experiment.h"

namespace halfstep::replay {

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
