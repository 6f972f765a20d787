#include "experiments/replay/episode_folder.h"

#include <optional>

#include "experiments/config/experiment.h"
#include "experiments/live/spare_boxes.h"
#include "wpg/files/input_error.h"

namespace halfstep::replay {

RecordedEpisode ReadEpisode(const std::filesystem::path& folder) {
  LiveConfig config = LoadLiveConfig((folder / "config.yaml").string(), {});
  WholeRobot robot = LoadWholeRobot(RobotPath(config.experiment).string());
  const std::optional<std::filesystem::path> scene = ScenePath(config.experiment);
  if (config.live.sensing.source == "client") {
    throw InputError({folder.string() +
                      ": where obstacles truly were is not known: clients measured them (valid: an "
                      "episode with live.sensing.source: stand_in)"});
  }
  TrueWorld truth(WithSpareBoxes(scene ? LoadScene(scene->string()) : Scene(), config.live),
                  config.experiment.goal, config.live);
  ReferenceMotion motion(ReadTrajectory(folder / "trajectory.csv", robot.model));
  return {std::move(config), std::move(robot), std::move(truth), std::move(motion)};
}

}  // namespace halfstep::replay
